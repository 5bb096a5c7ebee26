#include "conchoid/bem/body_operator.hpp"

#include <algorithm>
#include <optional>

#include "conchoid/bem/rigid_body.hpp"
#include "conchoid/core/bytes.hpp"

namespace conchoid {

BodyOperator::BodyOperator(TriMesh surface, std::vector<BoundaryKind> kinds, const ElasticConstants& m,
                           const BemSettings& settings, std::span<const LoadCase> expected)
    : settings_(settings),
      discretisation_(std::move(surface), std::move(kinds), m, settings.quadrature_tolerance),
      entries_(discretisation_),
      solver_(make_body_solver(settings.solver, entries_, rigid_motions(), kept())),
      columns_(entries_) {
  make_columns(expected);
  entries_.drop_pairs();
}

KeptSystem BodyOperator::kept() const {
  return kept_system(settings_.cache, settings_.solver, surface(), kinds(), material(),
                     settings_.quadrature_tolerance);
}

KeptSystem kept_system(const std::shared_ptr<const ByteCache>& cache, const std::string& what,
                       const TriMesh& surface, const std::vector<BoundaryKind>& kinds,
                       const ElasticConstants& m, double quadrature_tolerance) {
  if (!cache) return {};
  ByteWriter all;
  all.put_text(what);
  all.put(quadrature_tolerance);
  all.put(m.youngs_modulus);
  all.put(m.poisson_ratio);
  all.put(static_cast<std::uint64_t>(surface.node_count()));
  for (const Vec3& x : surface.positions)
    all.put_all(std::span<const double>(x.data(), 3));
  for (const auto& c : surface.corners)
    for (const NodeId n : c)
      all.put(n.value);
  for (const BoundaryKind& kind : kinds) {
    const Mat3 held = kind.held();
    all.put_all(std::span<const double>(held.data(), 9));
  }
  return {cache.get(), cache_name("operator", all.bytes())};
}

// Columns are kept together with those that the same loads asked for.
void BodyOperator::make_columns(std::span<const LoadCase> loads) {
  const KeptSystem system = kept();
  if (!system.cache || loads.empty()) {
    right_hand_sides(loads);
    return;
  }
  ByteWriter places;
  places.put_text(system.name);
  for (const LoadCase& load : loads) {
    require_fitting_load(surface(), kinds(), load);
    for (const LoadSource& source : sources_of(load)) {
      places.put(static_cast<std::uint32_t>(source.kind == Prescribed::displacement));
      places.put(static_cast<std::uint64_t>(source.index));
    }
  }
  const std::string name = cache_name("columns", places.bytes());
  if (const std::optional<KeptBytes> known = system.cache->recall(name)) {
    columns_.take(*known);
    return;
  }
  right_hand_sides(loads);
  ByteWriter out;
  columns_.put(out);
  system.cache->keep(name, out.bytes());
}

RigidMotions BodyOperator::rigid_motions() const {
  RigidMotions out;
  for (const auto& motion : floating_motions(surface(), kinds())) {
    std::vector<double> r;
    for (NodeId node : discretisation_.free_nodes)
      r.insert(r.end(), &motion[3 * node.index()], &motion[3 * node.index()] + 3);
    out.push_back(std::move(r));
  }
  return out;
}

std::vector<double> BodyOperator::right_hand_sides(std::span<const LoadCase> loads) const {
  std::vector<double> all;
  all.reserve(loads.size() * discretisation_.unknowns());
  for (const LoadCase& load : loads) {
    require_fitting_load(surface(), kinds(), load);
    const std::vector<double> f = columns_.right_hand_side(load);
    all.insert(all.end(), f.begin(), f.end());
  }
  return all;
}

std::vector<double> BodyOperator::reduced(std::span<const LoadCase> loads) const {
  std::vector<double> z = right_hand_sides(loads);
  solver_->reduce(z.data(), loads.size());
  solver_->middle(z.data(), loads.size());
  return z;
}

std::vector<double> BodyOperator::solve(std::span<const LoadCase> loads) const {
  std::vector<double> x = reduced(loads);
  solver_->expand(x.data(), loads.size());
  return x;
}

std::shared_ptr<const BodyOperator> make_body_operator(TriMesh surface, const BoundaryData& data,
                                                       const ElasticConstants& m,
                                                       const BemSettings& settings) {
  const LoadCase load = load_case(surface, data);
  return std::make_shared<const BodyOperator>(std::move(surface), data.kind, m, settings,
                                              std::span(&load, 1));
}

}  // namespace conchoid

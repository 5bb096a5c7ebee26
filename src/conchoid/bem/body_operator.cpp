#include "conchoid/bem/body_operator.hpp"

#include <algorithm>

#include "conchoid/bem/rigid_body.hpp"

namespace conchoid {

BodyOperator::BodyOperator(TriMesh surface, std::vector<BoundaryKind> kinds, const ElasticConstants& m,
                           const BemSettings& settings, std::span<const LoadCase> expected)
    : settings_(settings),
      discretisation_(std::move(surface), std::move(kinds), m, settings.quadrature_tolerance),
      entries_(discretisation_),
      solver_(make_body_solver(settings.solver, entries_, rigid_motions())),
      columns_(entries_) {
  right_hand_sides(expected);
  entries_.drop_pairs();
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

std::vector<double> BodyOperator::solve(std::span<const LoadCase> loads) const {
  std::vector<double> x = right_hand_sides(loads);
  solver_->solve(x.data(), loads.size());
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

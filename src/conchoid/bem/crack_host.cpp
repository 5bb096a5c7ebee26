#include "conchoid/bem/crack_host.hpp"

#include <algorithm>

#include "conchoid/bem/quadratic_body.hpp"
#include "conchoid/bem/quadratic_rows.hpp"
#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

class LinearHost : public CrackHost {
 public:
  explicit LinearHost(std::shared_ptr<const BodyOperator> body) : body_(std::move(body)) {}

  std::size_t tractions() const override { return body_->discretisation().tractions(); }
  std::size_t unknowns() const override { return body_->discretisation().unknowns(); }
  const HalfSolver& solver() const override { return body_->solver(); }

  std::vector<EnrichmentRows> rows(const EnrichedSpace& space, std::span<const LoadSource> sources,
                                   const std::vector<std::size_t>& wanted,
                                   PairMemory* memory) const override {
    return assemble_enrichment_rows(*body_, space, sources, wanted, memory);
  }

  std::vector<double> reduced_loads(std::span<const LoadCase> loads) const override {
    return body_->reduced(loads);
  }

  void add_displacement(const double* x, IdVector<NodeId, Vec3>& u) const override {
    const BodyDiscretisation& d = body_->discretisation();
    for (std::size_t i = 0; i < d.free_nodes.size(); ++i)
      u[d.free_nodes[i]] += Eigen::Map<const Vec3>(x + d.tractions() + 3 * i);
  }

  void add_traction(const double* x, std::vector<Vec3>& t) const override {
    const BodyDiscretisation& d = body_->discretisation();
    for (std::size_t i = 0; i < d.held_triangles.size(); ++i)
      t[d.held_triangles[i].index()] += Eigen::Map<const Vec3>(x + 3 * i);
  }

 private:
  std::shared_ptr<const BodyOperator> body_;
};

class QuadraticHost : public CrackHost {
 public:
  explicit QuadraticHost(std::shared_ptr<const BodyOperator> body)
      : body_(std::move(body)), quadratic_(body_->settings().quadratic), space_(quadratic_->space()) {}

  std::size_t tractions() const override { return space_.tractions(); }
  std::size_t unknowns() const override { return space_.tractions() + space_.displacements(); }
  const HalfSolver& solver() const override { return quadratic_->factors(); }

  std::vector<EnrichmentRows> rows(const EnrichedSpace& space, std::span<const LoadSource> sources,
                                   const std::vector<std::size_t>& wanted,
                                   PairMemory* memory) const override {
    std::vector<EnrichmentRows> rows = assemble_enrichment_rows(*body_, space, sources, wanted, memory);
    std::vector<DenseMatrix> own = assemble_quadratic_rows(space_, space, wanted);
    for (std::size_t w = 0; w < rows.size(); ++w)
      rows[w].body = std::move(own[w]);
    return rows;
  }

  std::vector<double> reduced_loads(std::span<const LoadCase> loads) const override {
    for (const LoadCase& load : loads) {
      require_fitting_load(body_->surface(), body_->kinds(), load);
      if (!sources_of(load).empty())
        throw InputError("a cracked body of quadratic elements takes its load as a field; use as_field()");
    }
    return std::vector<double>(loads.size() * unknowns(), 0.0);
  }

  void add_displacement(const double* x, IdVector<NodeId, Vec3>& u) const override {
    for (std::size_t i = 0; i < space_.free_nodes.size(); ++i)
      if (const std::size_t node = space_.free_nodes[i]; node < u.size())
        u[NodeId(node)] += Eigen::Map<const Vec3>(x + tractions() + 3 * i);
  }

  void add_traction(const double* x, std::vector<Vec3>& t) const override {
    const auto& held = space_.corners.held_triangles;
    for (std::size_t h = 0; h < held.size(); ++h)
      for (std::size_t a = 0; a < 3; ++a)
        t[held[h].index()] += Eigen::Map<const Vec3>(x + 9 * h + 3 * a) / 3;
  }

 private:
  std::shared_ptr<const BodyOperator> body_;
  std::shared_ptr<const QuadraticBody> quadratic_;
  const QuadraticSpace& space_;
};

}  // namespace

std::unique_ptr<CrackHost> make_crack_host(std::shared_ptr<const BodyOperator> body) {
  if (body->settings().quadratic) return std::make_unique<QuadraticHost>(std::move(body));
  return std::make_unique<LinearHost>(std::move(body));
}

}  // namespace conchoid

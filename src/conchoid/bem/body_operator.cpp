#include "conchoid/bem/body_operator.hpp"

#include <algorithm>
#include <string>

#include "conchoid/bem/rigid_body.hpp"
#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

std::vector<BoundaryKind> fitting_kinds(const TriMesh& surface, std::vector<BoundaryKind> kinds) {
  if (kinds.size() != surface.triangle_count())
    throw InputError("body: " + std::to_string(kinds.size()) + " kinds of conditions for a surface of " +
                     std::to_string(surface.triangle_count()) + " triangles; give one for each");
  return kinds;
}

}  // namespace

BodyOperator::BodyOperator(TriMesh surface, std::vector<BoundaryKind> kinds, const ElasticConstants& m,
                           const BemSettings& settings)
    : surface_(std::move(surface)),
      kinds_(fitting_kinds(surface_, std::move(kinds))),
      m_(m),
      settings_(settings),
      integrator_(settings.quadrature_tolerance),
      body_(assemble_body(surface_, kinds_, m_, integrator_)) {
  factor();
}

void BodyOperator::factor() {
  if (!V_.append({}, body_.V.data))
    throw ComputationError(
        "the single layer matrix is not positive definite: the surface mesh has overlapping or nearly "
        "degenerate triangles; run `conchoid mesh` on it and remesh");
  DenseMatrix columns = transposed(body_.K);  // each row one column of K
  solve_single_layer(columns.data.data(), columns.rows);
  VinvK_ = transposed(columns);
  DenseMatrix schur = body_.D;
  add_transposed_product(body_.K, VinvK_, schur);
  hold_rigid_motions(schur);
  if (!S_.append({}, schur.data))
    throw ComputationError(
        "the body's stiffness is not positive definite: the surface mesh has overlapping or nearly "
        "degenerate triangles; run `conchoid mesh` on it and remesh");
}

// D annihilates rigid motions; adding α r rᵀ for each makes it definite and leaves balanced solutions
// unchanged.
void BodyOperator::hold_rigid_motions(DenseMatrix& schur) const {
  double trace = 0;
  for (std::size_t i = 0; i < schur.rows; ++i)
    trace += schur(i, i);
  const double alpha = trace / static_cast<double>(std::max<std::size_t>(schur.rows, 1));
  for (const auto& motion : floating_motions(surface_, kinds_)) {
    std::vector<double> r(schur.rows, 0.0);
    for (std::size_t i = 0; i < surface_.node_count(); ++i)
      if (const int at = body_.unknowns.displacement[i]; at >= 0)
        std::copy_n(&motion[3 * i], 3, &r[3 * static_cast<std::size_t>(at)]);
    for (std::size_t i = 0; i < schur.rows; ++i)
      if (r[i] != 0)
        for (std::size_t j = 0; j < schur.columns; ++j)
          schur(i, j) += alpha * r[i] * r[j];
  }
}

BodyLoad BodyOperator::load(const LoadCase& load) const {
  require_fitting_load(surface_, kinds_, load);
  return assemble_load(surface_, kinds_, m_, body_, integrator_, load);
}

std::vector<BodyLoad> BodyOperator::loads(std::span<const LoadCase> loads) const {
  std::vector<BodyLoad> out;
  for (const LoadCase& one : loads)
    out.push_back(load(one));
  return out;
}

void BodyOperator::solve_single_layer(double* b, std::size_t count) const {
  V_.solve(b, count);
}

std::shared_ptr<const BodyOperator> make_body_operator(TriMesh surface, const BoundaryData& data,
                                                       const ElasticConstants& m,
                                                       const BemSettings& settings) {
  return std::make_shared<const BodyOperator>(std::move(surface), data.kind, m, settings);
}

}  // namespace conchoid

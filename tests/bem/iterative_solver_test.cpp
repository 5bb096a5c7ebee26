#include "conchoid/bem/iterative_solver.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "conchoid/bem/body_operator.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/mesh/models.hpp"

namespace conchoid {
namespace {

Eigen::MatrixXd random_spd(Eigen::Index n) {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(n, n);
  return a * a.transpose() + Eigen::MatrixXd::Identity(n, n);
}

}  // namespace

TEST(ConjugateGradients, SolveWhatTheyApply) {
  const Eigen::MatrixXd a = random_spd(40);
  const auto apply = [&](const double* x, double* y) {
    Eigen::Map<Eigen::VectorXd>(y, 40) = a * Eigen::Map<const Eigen::VectorXd>(x, 40);
  };
  const Eigen::VectorXd exact = Eigen::VectorXd::LinSpaced(40, -1, 2), diagonal = a.diagonal();
  Eigen::VectorXd b = a * exact;
  conjugate_gradients(apply, {diagonal.data(), 40}, {b.data(), 40});
  EXPECT_LT((b - exact).norm(), 1e-9 * exact.norm());
}

TEST(ConjugateGradients, GivingUpIsAnError) {
  const Eigen::MatrixXd a = random_spd(40);
  const auto apply = [&](const double* x, double* y) {
    Eigen::Map<Eigen::VectorXd>(y, 40) = a * Eigen::Map<const Eigen::VectorXd>(x, 40);
  };
  const Eigen::VectorXd diagonal = a.diagonal();
  Eigen::VectorXd b = Eigen::VectorXd::Ones(40);
  EXPECT_THROW(conjugate_gradients(apply, {diagonal.data(), 40}, {b.data(), 40}, {1e-12, 3}),
               ComputationError);
}

// Nothing but products of the dense solver, on a body that is held and one that is not.
TEST(SolveByProducts, GivesWhatTheFactorsGive) {
  const TriMesh mesh = box_mesh({1, 1, 1}, 2, 2, 2);
  for (const double held_below : {-0.9, -2.0}) {
    std::vector<BoundaryKind> kinds(mesh.triangle_count(), BoundaryKind::traction);
    for (std::size_t t = 0; t < kinds.size(); ++t)
      if (unit_normal(mesh, TriId(t)).z() < held_below) kinds[t] = BoundaryKind::displacement;
    const BodyOperator body(mesh, kinds, {1.0, 0.327});
    const std::size_t n = body.discretisation().unknowns();
    const Eigen::VectorXd f = Eigen::VectorXd::LinSpaced(static_cast<Eigen::Index>(n), -1, 2);
    Eigen::VectorXd factors = f, products = f;
    body.solver().solve(factors.data());
    const std::vector<double> diagonal(n, 1.0);
    std::size_t calls = 0;
    const auto apply = [&](const double* x, double* y) {
      ++calls;
      body.solver().apply(x, y);
    };
    solve_by_products(apply, body.discretisation().tractions(), diagonal, {products.data(), n});
    EXPECT_GT(calls, 10u);
    EXPECT_LT((products - factors).norm(), 1e-9 * factors.norm());
  }
}

}  // namespace conchoid

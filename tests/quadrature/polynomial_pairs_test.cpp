#include "conchoid/quadrature/polynomial_pairs.hpp"

#include <gtest/gtest.h>

#include "pair_table.hpp"

// Pairs with polynomial densities: against slow integrals of the kernels' own closed form for density 1 on small
// cells, and their sums against the pairs with constant densities.
namespace conchoid {
namespace {

using oracle::NamedPair;

std::vector<NamedPair> all_pairs() {
  std::vector<NamedPair> all;
  for (const auto& some : {oracle::common_edge_pairs(), oracle::common_vertex_pairs(), oracle::far_pairs()})
    all.insert(all.end(), some.begin(), some.end());
  all.push_back({"itself", oracle::panel(oracle::base, 0, 1, 2), oracle::panel(oracle::base, 0, 1, 2)});
  const auto above = [](double gap) {
    return oracle::panel({Vec3(0.1, -0.2, gap), Vec3(0.9, 0.1, gap), Vec3(0.2, 0.6, gap)}, 7, 8, 9);
  };
  for (const double gap : {0.3, 0.1, 1e-2, 1e-3})
    all.push_back({"parallel, gap " + std::to_string(gap), oracle::panel(oracle::base, 0, 1, 2), above(gap)});
  all.push_back(
      {"small beside large", oracle::panel(oracle::base, 0, 1, 2),
       oracle::panel({Vec3(0.5, 0.2, 0.01), Vec3(0.51, 0.2, 0.012), Vec3(0.505, 0.21, 0.02)}, 7, 8, 9)});
  return all;
}

class PolynomialPairs : public testing::TestWithParam<double> {};

TEST_P(PolynomialPairs, AddUpToConstantDensities) {
  const PolynomialPairIntegrator integrator(GetParam());
  const PairIntegrator exact(1e-11);
  for (const NamedPair& pair : all_pairs())
    for (const auto& [x, y] : {std::pair{pair.x, pair.y}, std::pair{pair.y, pair.x}}) {
      Family sum = Family::Zero();
      for (const SingleLayerPair& part : integrator.single_layer(x, y))
        sum += oracle::family(part);
      EXPECT_LE(oracle::relative_error(sum, oracle::family(exact.single_layer(x, y))), 4 * GetParam())
          << "single layer, " << pair.name;
      const Eigen::Matrix<double, 1, 6> over_x = integrator.double_layer(x, y).colwise().sum();
      Vec3 corners;  // N_k is φ_k and half of its neighbouring middles
      for (int k = 0; k < 3; ++k)
        corners[k] = over_x[k] + 0.5 * (over_x[3 + k] + over_x[3 + (k + 2) % 3]);
      EXPECT_LE(oracle::double_layer_error(x, y, corners, oracle::vector(exact.double_layer(x, y))),
                4 * GetParam())
          << "double layer, " << pair.name;
    }
}

INSTANTIATE_TEST_SUITE_P(Tolerances, PolynomialPairs, testing::Values(1e-4, 1e-6, 1e-8));

/// Y cut into cells, on which the density is constant up to second order in their size.
template <class F>
void over_small_cells(const Triangle& t, int depth, const F& f) {
  if (depth == 0) {
    f(t);
    return;
  }
  Triangle middle;
  for (int k = 0; k < 3; ++k)
    middle[k] = 0.5 * (t[k] + t[(k + 1) % 3]);
  over_small_cells(middle, depth - 1, f);
  for (int k = 0; k < 3; ++k)
    over_small_cells({t[k], middle[k], middle[(k + 2) % 3]}, depth - 1, f);
}

Vec3 barycentric(const Triangle& t, const Vec3& normal, const Vec3& p) {
  return PanelPotential(t, normal, 0).corner_functions(p);
}

TEST(PolynomialPotentials, FollowSumsOverSmallCells) {
  const Panel y = oracle::panel(oracle::base);
  const PanelPotential whole(y.x, y.normal, 0);
  for (const Vec3& x :
       {Vec3(0.4, 0.3, 0.7), Vec3(1.2, -0.3, -0.4), Vec3(0.5, -0.6, 0.0), Vec3(0.3, 0.3, 0.05)}) {
    Eigen::Matrix<double, 7, 3> linear = Eigen::Matrix<double, 7, 3>::Zero();
    Eigen::Matrix<double, 6, 1> quadratic = Eigen::Matrix<double, 6, 1>::Zero();
    Mat3 gradient = Mat3::Zero();
    over_small_cells(y.x, 6, [&](const Triangle& t) {
      const PanelPotential cell(t, y.normal, 0);
      const Vec3 N = barycentric(y.x, y.normal, (t[0] + t[1] + t[2]) / 3);
      const Vec3 monomials(1, N[1], N[2]);
      Eigen::Matrix<double, 6, 1> second;
      second << 1, N[1], N[2], N[1] * N[1], N[1] * N[2], N[2] * N[2];
      linear += cell.single_layer(x) * monomials.transpose();
      quadratic += cell.double_layer(x).sum() * second;
      gradient += cell.gradient(x) * monomials.transpose();
    });
    EXPECT_LT((whole.linear_single_layer(x) - linear).norm(), 1e-3 * linear.norm());
    EXPECT_LE((whole.quadratic_double_layer(x) - quadratic).norm(), 1e-3 * quadratic.norm() + 1e-15);
    EXPECT_LT((whole.linear_gradient(x) - gradient).norm(), 1e-3 * gradient.norm());
    EXPECT_LT((whole.linear_single_layer(x).col(0) - whole.single_layer(x)).norm(), 1e-12);
    EXPECT_LT((whole.linear_gradient(x).col(0) - whole.gradient(x)).norm(), 1e-12);
  }
}

/// Densities of the pair, each point for itself: the outer panel by the slow rule.
TEST(PolynomialPairs, SingleDensitiesFollowSlowIntegrals) {
  const PolynomialPairIntegrator integrator(1e-7);
  for (const NamedPair& pair : all_pairs()) {
    const PanelPotential of_x(pair.x.x, pair.x.normal, 0), of_y(pair.y.x, pair.y.normal, 0);
    Eigen::Matrix<double, 9, 1> laplace = Eigen::Matrix<double, 9, 1>::Zero();
    Eigen::Matrix<double, 12, 1> dbl = Eigen::Matrix<double, 12, 1>::Zero();
    const double d = (pair.x.center - pair.y.center).norm() + pair.x.radius + pair.y.radius;
    const double scale = pair.x.area * pair.y.area / d;
    for (const Triangle& t : oracle::cut_by(pair.x, pair.y)) {
      laplace += oracle::over_triangle<9>(t, 1e-8 * scale, [&](const Vec3& p) {
        const Vec3 N = of_x.corner_functions(p), m = of_y.linear_single_layer(p).row(0).transpose();
        Eigen::Matrix<double, 9, 1> v;
        v << N[0] * (m[0] - m[1] - m[2]), N[0] * m[1], N[0] * m[2], N[1] * (m[0] - m[1] - m[2]), N[1] * m[1],
            N[1] * m[2], N[2] * (m[0] - m[1] - m[2]), N[2] * m[1], N[2] * m[2];
        return v;
      });
      dbl += oracle::over_triangle<12>(t, 1e-8 * scale / d, [&](const Vec3& p) {
        const Vec3 N = of_x.corner_functions(p);
        const Eigen::Matrix<double, 6, 1> m = of_y.quadratic_double_layer(p);
        Eigen::Matrix<double, 12, 1>
            v;  // N_0, N_2 with φ of corner 1, of corner 0, and of the edges 01, 12, 20
        const double phi1 = 2 * m[3] - m[1], phi0 = m[0] - 3 * (m[1] + m[2]) + 2 * m[3] + 4 * m[4] + 2 * m[5];
        const double phi3 = 4 * (m[1] - m[3] - m[4]), phi4 = 4 * m[4], phi5 = 4 * (m[2] - m[4] - m[5]);
        const double phi2 = 2 * m[5] - m[2];
        v << N[0] * phi0, N[0] * phi1, N[0] * phi2, N[0] * phi3, N[0] * phi4, N[0] * phi5, N[2] * phi0,
            N[2] * phi1, N[2] * phi2, N[2] * phi3, N[2] * phi4, N[2] * phi5;
        return v;
      });
    }
    const LinearSingleLayerPair single = integrator.single_layer(pair.x, pair.y);
    for (int i = 0; i < 9; ++i)
      EXPECT_NEAR(single[static_cast<std::size_t>(i)].laplace, laplace[i], 1e-6 * laplace.sum()) << pair.name;
    const QuadraticDoubleLayerPair found = integrator.double_layer(pair.x, pair.y);
    const double size = std::max(scale / d, dbl.cwiseAbs().maxCoeff());
    for (int k = 0; k < 6; ++k) {
      EXPECT_NEAR(found(0, k), dbl[k], 1e-6 * size) << pair.name;
      EXPECT_NEAR(found(2, k), dbl[6 + k], 1e-6 * size) << pair.name;
    }
  }
}

// A gap of 0 at a corner once asked for a grading of infinitely many levels.
TEST(PolynomialPairs, PanelsThatTouchWithoutCommonCornersAddUp) {
  const PolynomialPairIntegrator integrator;
  const PairIntegrator constant(1e-6);
  for (const NamedPair& pair : oracle::near_pairs()) {
    if (pair.name != "corner in the face" && pair.name != "hanging along part of an edge") continue;
    double sum = 0;
    for (const SingleLayerPair& part : integrator.single_layer(pair.x, pair.y))
      sum += part.laplace;
    const double all = constant.single_layer(pair.x, pair.y).laplace;
    EXPECT_NEAR(sum, all, 1e-5 * all) << pair.name;
    EXPECT_TRUE(integrator.double_layer(pair.x, pair.y).allFinite()) << pair.name;
  }
}

}  // namespace
}  // namespace conchoid

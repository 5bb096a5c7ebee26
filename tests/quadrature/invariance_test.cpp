#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "conchoid/core/error.hpp"
#include "pair_table.hpp"

namespace conchoid {
namespace {

using oracle::NamedPair;

std::vector<NamedPair> all_pairs() {
  std::vector<NamedPair> all;
  for (const auto& some : {oracle::common_edge_pairs(), oracle::common_vertex_pairs(), oracle::near_pairs(),
                           oracle::far_pairs()}) {
    all.insert(all.end(), some.begin(), some.end());
  }
  all.push_back({"coincident", all.front().x, all.front().x});
  return all;
}

template <class F>
Panel mapped(const Panel& p, const F& map) {
  return make_panel({map(p.x[0]), map(p.x[1]), map(p.x[2])}, p.vertex);
}

Mat3 matrix(const SingleLayerPair& p) {
  const auto& t = p.tensor;
  Mat3 m;
  m << t[0], t[5], t[4], t[5], t[1], t[3], t[4], t[3], t[2];
  return m;
}

TEST(Invariance, SingleLayerIsSymmetricBitForBit) {
  const PairIntegrator integrator;
  for (const NamedPair& p : all_pairs()) {
    const SingleLayerPair a = integrator.single_layer(p.x, p.y), b = integrator.single_layer(p.y, p.x);
    EXPECT_EQ(a.laplace, b.laplace) << p.name;
    EXPECT_EQ(a.tensor, b.tensor) << p.name;
  }
}

TEST(Invariance, SymmetricAlsoWithoutIds) {
  const PairIntegrator integrator;
  for (const NamedPair& p : oracle::near_pairs()) {
    const Panel x = oracle::panel(p.x.x), y = oracle::panel(p.y.x);
    EXPECT_EQ(integrator.single_layer(x, y).tensor, integrator.single_layer(y, x).tensor) << p.name;
  }
}

// Among far pairs of all rules, so that groups of every length come about.
TEST(Invariance, ManyPairsTogetherHaveTheBitsOfEach) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> within(-1, 1);
  const auto vector = [&](double size) {
    return Vec3(size * Vec3(within(random), within(random), within(random)));
  };
  std::vector<Panel> panels;
  for (int i = 0; i < 60; ++i) {
    const Vec3 center = vector(4);
    panels.push_back(make_panel({center + vector(0.5), center + vector(0.5), center + vector(0.5)},
                                {NodeId(3 * i), NodeId(3 * i + 1), NodeId(3 * i + 2)}));
  }
  const std::vector<NamedPair> named = all_pairs();
  std::vector<PanelPair> pairs;
  for (std::size_t i = 0; i < 400; ++i) {
    pairs.push_back({&panels[i * 37 % panels.size()], &panels[i * 101 % panels.size()]});
    if (i % 5 == 0) pairs.push_back({&named[i % named.size()].x, &named[i % named.size()].y});
  }
  for (const double tolerance : {1e-4, 1e-6, 1e-9}) {
    const PairIntegrator integrator(tolerance);
    std::vector<SingleLayerPair> single(pairs.size());
    std::vector<DoubleLayerPair> dbl(pairs.size());
    integrator.single_layer(pairs, single.data());
    integrator.double_layer(pairs, dbl.data());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const SingleLayerPair alone = integrator.single_layer(*pairs[i].x, *pairs[i].y);
      ASSERT_EQ(single[i].laplace, alone.laplace) << i;
      ASSERT_EQ(single[i].tensor, alone.tensor) << i;
      ASSERT_EQ(dbl[i], integrator.double_layer(*pairs[i].x, *pairs[i].y)) << i;
    }
  }
}

TEST(Invariance, APowerOfTwoScalesTheBits) {
  const PairIntegrator integrator;
  for (const NamedPair& p : all_pairs()) {
    for (double s : {std::ldexp(1.0, -20), 8.0, std::ldexp(1.0, 30)}) {
      const auto scale = [&](const Vec3& v) { return Vec3(s * v); };
      const Panel x = mapped(p.x, scale), y = mapped(p.y, scale);
      EXPECT_EQ(integrator.single_layer(x, y).laplace, s * s * s * integrator.single_layer(p.x, p.y).laplace)
          << p.name;
      const DoubleLayerPair before = integrator.double_layer(p.x, p.y), after = integrator.double_layer(x, y);
      for (int j = 0; j < 3; ++j)
        EXPECT_EQ(after[j], s * s * before[j]) << p.name;
    }
  }
}

TEST(Invariance, ARotationTurnsTheTensorAndNothingElse) {
  const Mat3 q = Eigen::AngleAxisd(1.1, Vec3(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
  const PairIntegrator integrator(1e-8);
  for (const NamedPair& p : all_pairs()) {
    const auto turn = [&](const Vec3& v) { return Vec3(q * v + Vec3(3, -1, 2)); };
    const Panel x = mapped(p.x, turn), y = mapped(p.y, turn);
    const SingleLayerPair before = integrator.single_layer(p.x, p.y), after = integrator.single_layer(x, y);
    EXPECT_NEAR(after.laplace, before.laplace, 2e-8 * before.laplace) << p.name;
    EXPECT_LT((matrix(after) - q * matrix(before) * q.transpose()).cwiseAbs().maxCoeff(),
              2e-8 * before.laplace)
        << p.name;
    EXPECT_LT(oracle::double_layer_error(x, y, oracle::vector(integrator.double_layer(x, y)),
                                         oracle::vector(integrator.double_layer(p.x, p.y))),
              2e-8)
        << p.name;
  }
}

TEST(Invariance, TurningTheCornersOfAPanelTurnsItsCornerFunctions) {
  const PairIntegrator integrator(1e-9);
  for (const NamedPair& p : all_pairs()) {
    const Panel y = make_panel({p.y.x[1], p.y.x[2], p.y.x[0]}, {p.y.vertex[1], p.y.vertex[2], p.y.vertex[0]});
    const DoubleLayerPair a = integrator.double_layer(p.x, p.y), b = integrator.double_layer(p.x, y);
    EXPECT_LT(oracle::double_layer_error(p.x, y, oracle::vector(b), Vec3(a[1], a[2], a[0])), 2e-9) << p.name;
  }
}

/// The four quarters of a panel; corners keep their ids, midpoints get ids of their own, the same on both
/// sides of an edge.
std::vector<Panel> quarters(const Panel& p) {
  const auto mid_id = [](NodeId a, NodeId b) {
    return NodeId(1000 + 100 * std::min(a.value, b.value) + std::max(a.value, b.value));
  };
  std::array<Vec3, 3> m;
  std::array<NodeId, 3> id;
  for (int i = 0; i < 3; ++i) {
    m[i] = 0.5 * (p.x[i] + p.x[(i + 1) % 3]);
    id[i] = mid_id(p.vertex[i], p.vertex[(i + 1) % 3]);
  }
  std::vector<Panel> parts = {make_panel(m, id)};
  for (int i = 0; i < 3; ++i)
    parts.push_back(make_panel({p.x[i], m[i], m[(i + 2) % 3]}, {p.vertex[i], id[i], id[(i + 2) % 3]}));
  return parts;
}

TEST(Invariance, FourQuartersAddUpToTheirPanel) {
  const double tolerance = 1e-8;
  const PairIntegrator integrator(tolerance);
  for (const NamedPair& p : all_pairs()) {
    Family sum = Family::Zero();
    double flux = 0;
    for (const Panel& x : quarters(p.x)) {
      for (const Panel& y : quarters(p.y)) {
        sum += oracle::family(integrator.single_layer(x, y));
        flux += oracle::vector(integrator.double_layer(x, y)).sum();
      }
    }
    EXPECT_LT(oracle::relative_error(sum, oracle::family(integrator.single_layer(p.x, p.y))), 2 * tolerance)
        << p.name;
    const double d = (p.x.center - p.y.center).norm() + p.x.radius + p.y.radius;
    const double whole = oracle::vector(integrator.double_layer(p.x, p.y)).sum();
    EXPECT_NEAR(flux, whole, 16 * tolerance * std::max(p.x.area * p.y.area / (d * d), std::abs(whole)))
        << p.name;
  }
}

TEST(Invariance, AFaceOfAClosedBodySeesHalfTheSphere) {
  // Octahedron: Σ_Y ∫_X ∫_Y ∂/∂n (1/R) = −2π · area for every face X, the face itself giving 0.
  std::vector<Panel> faces;
  const auto node = [](int axis, int sign) { return 2 * axis + (sign > 0 ? 1 : 0); };
  for (int sx : {-1, 1}) {
    for (int sy : {-1, 1}) {
      for (int sz : {-1, 1}) {
        const Vec3 x = 1.3 * sx * Vec3::UnitX(), y = 0.8 * sy * Vec3::UnitY(), z = sz * Vec3::UnitZ();
        faces.push_back(sx * sy * sz > 0 ? oracle::panel({x, y, z}, node(0, sx), node(1, sy), node(2, sz))
                                         : oracle::panel({y, x, z}, node(1, sy), node(0, sx), node(2, sz)));
      }
    }
  }
  const PairIntegrator integrator(1e-10);
  for (const Panel& x : faces) {
    double sum = 0;
    for (const Panel& y : faces)
      sum += oracle::vector(integrator.double_layer(x, y)).sum();
    EXPECT_NEAR(sum / x.area, -2 * std::numbers::pi, 1e-11);
  }
}

TEST(Invariance, RandomPairsAgreeAcrossTolerances) {
  // Anything goes: random corners, thin and fat, small and large, touching through ids or not. The worst is a
  // needle of 0.2° near a panel a hundred times its size, whose double layer keeps 1.4e-6 and not the coarse
  // tolerance.
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const PairIntegrator coarse(1e-6), fine(1e-10);
  for (int i = 0; i < 1500; ++i) {
    const auto point = [&] { return Vec3(normal(random), normal(random), normal(random)); };
    Triangle a = {point(), point(), point()}, b = {point(), point(), point()};
    if (i % 3 == 1) a[2] = a[0] + uniform(random) * (a[1] - a[0]) + 0.02 * point();
    if (i % 5 == 1) b[2] = b[0] + uniform(random) * (b[1] - b[0]) + 0.02 * point();
    const int shared = i % 4;  // 3: far smaller
    if (shared == 3) b = {a[0] + 0.01 * b[0], a[0] + 0.01 * b[1], a[0] + 0.01 * b[2]};
    if (shared == 1 || shared == 2) b[0] = a[1];
    if (shared == 2) b[1] = a[0];
    const Panel x = oracle::panel(a, 0, 1, 2);
    const Panel y = oracle::panel(b, shared == 1 || shared == 2 ? 1 : 5, shared == 2 ? 0 : 6, 7);
    EXPECT_LT(oracle::relative_error(oracle::family(coarse.single_layer(x, y)),
                                     oracle::family(fine.single_layer(x, y))),
              1e-6)
        << i;
    EXPECT_LT(oracle::double_layer_error(x, y, oracle::vector(coarse.double_layer(x, y)),
                                         oracle::vector(fine.double_layer(x, y))),
              2e-6)
        << i;
  }
}

TEST(Tolerance, OutsideItsRangeIsRefused) {
  EXPECT_THROW(PairIntegrator(0.0), InputError);
  EXPECT_THROW(PairIntegrator(1e-14), InputError);
  EXPECT_THROW(PairIntegrator(0.5), InputError);
}

}  // namespace
}  // namespace conchoid

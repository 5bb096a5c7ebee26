#include "arbitrary_rotation.hpp"
#include "expect_accurate.hpp"

namespace conchoid {
namespace {

// Pairs in parallel planes as plates have them: edges above edges, corners above corners, thin ones.
std::vector<oracle::NamedPair> parallel_pairs() {
  std::vector<oracle::NamedPair> pairs;
  const auto add = [&](const std::string& name, const Triangle& x, const Triangle& y) {
    pairs.push_back({name, oracle::panel(x, 0, 1, 2), oracle::panel(y, 7, 8, 9)});
  };
  const auto raised = [](Triangle t, double gap) {
    for (Vec3& corner : t)
      corner.z() += gap;
    return t;
  };
  const Triangle& base = oracle::base;
  const Triangle beside = {Vec3(1, 0, 0), Vec3(1.3, 0.8, 0), Vec3(0.3, 0.8, 0)};
  const Triangle thin = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.4, 0.02, 0)};
  for (double gap : {0.05, 1e-3, 1e-6}) {
    const std::string at = ", gap " + std::to_string(gap);
    add("the same twice" + at, base, raised(base, gap));
    add("below" + at, raised(base, gap), base);
    add("turned over" + at, base, raised({base[0], base[2], base[1]}, gap));
    // Closer than that the slow integrals miss the peak along the edge.
    if (gap >= 1e-3) add("edge above edge" + at, base, raised(beside, gap));
    add("thin" + at, thin, raised(base, gap));
    add("both thin" + at, thin, raised({Vec3(0.1, -0.01, 0), Vec3(0.9, 0.01, 0), Vec3(0.5, 0.01, 0)}, gap));
  }
  add("beside each other in the plane, without common ids", base, beside);
  add("the same twice, without common ids", base, base);
  return pairs;
}

TEST(Parallel, BothLayersKeepEveryTolerance) {
  oracle::expect_accurate(parallel_pairs());
}

TEST(Parallel, IntegralsTurnWithThePanels) {
  const Mat3 Q = test::arbitrary_rotation();
  for (const oracle::NamedPair& pair : parallel_pairs()) {
    const auto turned = [&](const Panel& p) {
      return make_panel({Q * p.x[0], Q * p.x[1], Q * p.x[2]}, p.vertex);
    };
    const PairIntegrator integrator(1e-6);
    const SingleLayerPair here = integrator.single_layer(pair.x, pair.y),
                          there = integrator.single_layer(turned(pair.x), turned(pair.y));
    EXPECT_NEAR(here.laplace, there.laplace, 2e-6 * here.laplace) << pair.name;
    const DoubleLayerPair a = integrator.double_layer(pair.x, pair.y),
                          b = integrator.double_layer(turned(pair.x), turned(pair.y));
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(a[k], b[k], 2e-6 * pair.x.area * pair.y.area * (1 + std::abs(a[k]))) << pair.name;
  }
}

}  // namespace
}  // namespace conchoid

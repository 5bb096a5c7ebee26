#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "conchoid/learn/forest.hpp"
#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/sim/recorders.hpp"
#include "conchoid/sim/run.hpp"
#include "scenes.hpp"

// A forest with the feature set `versatile` is tied to no size, material or load.
namespace conchoid {
namespace {

struct Cube {
  double size = 1;       // edge [m]
  double stiffness = 1;  // × E, strength and load
  double load = 1;       // × load alone
};

Scene scene(const Cube& c) {
  const double k = c.stiffness;
  const Vec3 f = k * c.load * Vec3(3e7, 1e7, 9e7);
  return test::scene_from_text(
      fmt::format("[body]\nmodel = 'cube'\nscale = {}\n", c.size) +
      test::material_text({.E = 3.1e9 * k, .strength = 7.6e7 * k, .toughness = 1e6 * k * std::sqrt(c.size)}) +
      test::resolution_text(0.1 * c.size, 0.02 * c.size) + test::boundary_text("z+", "traction", f) +
      test::boundary_text("z-", "traction", -f) + "[run]\ninertia_relief = true\n");
}

const RegressionForest& forest() {
  static const RegressionForest trained = [] {
    const Scene s = scene({});
    const auto body = std::make_shared<const PreparedBody>(prepare(s));
    Fracture fracture(body, load_of(s, *body), s.run);
    SampleRecorder recorder(SampleRecorder::Fields::all);
    fracture.add_observer(recorder);
    while (fracture.step().moving) {
    }
    return RegressionForest::train(recorder.take(),
                                   {.trees = 10, .depth = 8, .features = FeatureSet::versatile});
  }();
  return trained;
}

RunResult predicted(const Cube& cube) {
  RunOptions options;
  options.method = "forest";
  options.regressor = &forest();
  options.progress = false;
  return run_scene(scene(cube), options);
}

void expect_scaled(const RunResult& a, const RunResult& b, double size) {
  EXPECT_EQ(a.document.stop, b.document.stop);
  EXPECT_EQ(a.document.frames, b.document.frames);
  ASSERT_EQ(a.crack.node_count(), b.crack.node_count());
  for (std::size_t i = 0; i < a.crack.node_count(); ++i)
    ASSERT_NEAR((b.crack.positions[NodeId(i)] / size - a.crack.positions[NodeId(i)]).norm(), 0, 1e-9);
}

// Powers of four change no bit: whatever is not scale-free shows.
TEST(Versatile, ACubeOfAnotherSizeAndMaterialBreaksAsItsScaledCopy) {
  const RunResult one = predicted({});
  EXPECT_GE(one.document.frames, 3);
  expect_scaled(one, predicted({.size = 1.0 / 1024}), 1.0 / 1024);
  expect_scaled(one, predicted({.size = 64, .stiffness = 16}), 64);
}

// Neither the size of the load nor K_c is looked at: it decides whether a front moves, not where to.
TEST(Versatile, MoreLoadOnACrackThatRunsAnywayTakesTheSameWay) {
  RunResult shorter = predicted({}), longer = predicted({.load = 1.25});
  if (shorter.document.frames > longer.document.frames) std::swap(shorter, longer);
  // Steps are longer by some per cent under more load, which trees answer by steps of their own in the end, and the last
  // ligament may break at once a frame earlier or later.
  EXPECT_GE(shorter.document.frames, 3);
  EXPECT_LE(longer.document.frames, shorter.document.frames + 1);
  const ClosestPointTree surface(longer.crack);
  for (const FrontRow& row : shorter.front)
    if (row.frame <= 3) {
      EXPECT_LT(std::sqrt(surface.closest(row.position).squared_distance), 0.01) << row.frame;
    }
}

}  // namespace
}  // namespace conchoid

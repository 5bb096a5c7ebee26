#include <gtest/gtest.h>

#include <numbers>

#include "conchoid/core/random.hpp"
#include "conchoid/intersect/self_intersection.hpp"
#include "conchoid/sim/run.hpp"
#include "intersect/cut_shapes.hpp"
#include "scenes.hpp"

// Whatever a scene does to a body, what comes out are proper solids.
namespace conchoid {
namespace {

struct Body {
  std::string text, pulled, opposite;  // [body] and regions
  double size;                         // cube root of the volume, about
  double strength;                     // of the load that starts a crack [Pa]
};

Body draw_body(Random& random, const test::TemporaryFolder& folder) {
  switch (random.index(5)) {
    case 0:
      return {"[body]\nmodel = 'cube'\n", "z+", "z-", 1, 7.6e7};
    case 1:
      return {"[body]\nmodel = 'cylinder'\n", "top", "bottom", 1, 7.6e7};
    case 2:
      return {"[body]\nmodel = 'edge-crack-cube'\n", "z+", "z-", 1, 2e6};
    case 3:
      return {"[body]\nmodel = 'cube'\nscale = 0.01\n", "x+", "x-", 0.01, 7.6e7};
    default:
      return {test::mesh_body_text(test::write_mesh_in(folder, "ball.obj", shapes::icosphere(2))) +
                  test::region_text("top", test::half_space_text(Vec3::UnitZ(), 0.6)) +
                  test::region_text("bottom", test::half_space_text(-Vec3::UnitZ(), 0.6)),
              "top", "bottom", 1.6, 1.2e8};
  }
}

std::string draw_field(Random& random, double size) {
  const Vec3 n = random.unit_vector();
  switch (random.index(5)) {
    case 0:
      return fmt::format(
          "[[material.toughness_field]]\nkind = 'layers'\ndirection = {}\nwavelength = {}\namplitude = {}\n",
          test::text(n), test::text(size * random.uniform(0.05, 0.4)), test::text(random.uniform(0.1, 0.8)));
    case 1:
      return fmt::format(
          "[[material.toughness_field]]\nkind = 'grains'\nsize = {}\nweakening = {}\nspread = 0.2\nseed = "
          "{}\n",
          test::text(size * random.uniform(0.1, 0.3)), test::text(random.uniform(0.2, 0.8)),
          static_cast<int>(random.uniform(1, 1000)));
    case 2:
      return fmt::format(
          "[[material.toughness_field]]\nkind = 'noise'\nwavelength = {}\namplitude = {}\nseed = {}\n",
          test::text(size * random.uniform(0.1, 0.5)), test::text(random.uniform(0.1, 0.6)),
          static_cast<int>(random.uniform(1, 1000)));
    default:
      return "";
  }
}

std::string draw_scene(std::uint64_t seed, const test::TemporaryFolder& folder) {
  Random random(seed);
  const Body body = draw_body(random, folder);
  const Vec3 load = random.uniform(1.05, 2) * body.strength * random.unit_vector();
  const double crack = body.size * random.uniform(0.1, 0.2);
  return body.text + test::material_text({.toughness = 1e6 * std::sqrt(body.size)}) +
         draw_field(random, body.size) + test::resolution_text(crack, crack * random.uniform(0.12, 0.25)) +
         test::boundary_text(body.pulled, "traction", load) +
         test::boundary_text(body.opposite, "traction", -load) +
         fmt::format("[run]\ninertia_relief = true\nframes = {}\nmax_cracks = {}\n",
                     static_cast<int>(random.uniform(3, 10)), static_cast<int>(random.uniform(1, 4)));
}

void expect_solids(const RunResult& result, const std::string& text) {
  double volume = 0;
  for (const Fragment& f : result.fragments) {
    EXPECT_TRUE(f.watertight) << text;
    EXPECT_TRUE(self_intersections(f.mesh, 1).empty()) << text;
    volume += f.volume;
  }
  EXPECT_NEAR(volume, result.document.body_volume, 0.005 * result.document.body_volume) << text;
  for (const std::string& w : result.document.warnings)
    EXPECT_EQ(w.find("could not be cut"), std::string::npos) << text << w;
}

class RandomScenes : public testing::TestWithParam<int> {};

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kScenesPerTest = 4;  // ten times slower, at least
#else
constexpr int kScenesPerTest = 20;
#endif

TEST_P(RandomScenes, BreakIntoProperSolids) {
  const test::TemporaryFolder folder;
  RunOptions options;
  options.progress = false;
  int cracked = 0, pieces = 0;
  for (int i = 0; i < kScenesPerTest; ++i) {
    const int seed = kScenesPerTest * GetParam() + i;
    SCOPED_TRACE(seed);
    const std::string text = draw_scene(static_cast<std::uint64_t>(seed), folder);
    const RunResult result = run_scene(test::scene_from_text(text), options);
    expect_solids(result, text);
    pieces += static_cast<int>(result.fragments.size());
    cracked += result.cracks > 0 ? 1 : 0;
  }
  EXPECT_GE(4 * cracked, kScenesPerTest);
  RecordProperty("pieces", pieces);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomScenes, testing::Range(0, 10));

}  // namespace
}  // namespace conchoid

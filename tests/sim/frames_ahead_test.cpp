#include "conchoid/sim/frames_ahead.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "conchoid/sim/fracture.hpp"
#include "conchoid/sim/run.hpp"
#include "scenes.hpp"

namespace conchoid {
namespace {

/// The crack of a scene after its first frame.
CrackState grown_crack(const Scene& scene) {
  const auto body = std::make_shared<const PreparedBody>(prepare(scene));
  Fracture fracture(body, load_of(scene, *body), scene.run);
  fracture.step();
  return fracture.crack();
}

Scene edge_crack() {
  return test::scene_from_text(
      "[body]\nmodel = 'edge-crack-cube'\n" + test::material_text() + test::resolution_text(0.1, 0.02) +
      test::boundary_text("z+", "traction", {0, 0, 1e7}) +
      test::boundary_text("z-", "traction", {0, 0, -1e7}) + "[run]\nmax_cracks = 0\n");
}

}  // namespace

TEST(FramesAhead, AreWhatIsLeftOfTheSectionInStripsOfTheFront) {
  const Scene scene = edge_crack();
  const CrackState crack = grown_crack(scene);
  const TriMesh body = prepare(scene).surface;
  const std::vector<int> frames = frames_ahead(crack, body, 0.1);
  ASSERT_EQ(frames.size(), crack.points.size());
  double area = 0;
  for (std::size_t t = 0; t < crack.trimmed.triangle_count(); ++t)
    area += area_vector(crack.trimmed, TriId(t)).norm();
  const double strips = (1 - area) / (static_cast<double>(frames.size()) * 0.01);
  for (const int f : frames)
    EXPECT_EQ(f, static_cast<int>(std::ceil(strips - 1e-6)));
  EXPECT_NEAR(strips, 6, 1.5);  // of seven, one is made
  // With strips of half the width four times as many, with twice the width a quarter.
  EXPECT_EQ(frames_ahead(crack, body, 0.05)[0], static_cast<int>(std::ceil(4 * strips)));
  EXPECT_EQ(frames_ahead(crack, body, 0.01)[0], kMostFramesAhead);
  EXPECT_EQ(frames_ahead(crack, body, 0.2)[0], static_cast<int>(std::ceil(strips / 4)));
}

TEST(FramesAhead, AreManyWhereThereIsNoEndInSight) {
  const CrackState crack = grown_crack(edge_crack());
  EXPECT_EQ(frames_ahead(crack, {}, 0.1), std::vector<int>(crack.points.size(), kMostFramesAhead));
}

}  // namespace conchoid

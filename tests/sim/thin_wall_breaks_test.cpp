#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "conchoid/mesh/models.hpp"
#include "conchoid/sim/fracture.hpp"
#include "hollow_bodies.hpp"
#include "scenes.hpp"

// Thin walls that bend and break, with elements several times as long as they are thick.
namespace conchoid {
namespace {

const std::string kGlass = "[material]\nname = 'glass'\nstrength = 4.5e7\n";

/// The first step, in which a crack starts, and so many more.
StepReport break_on(Fracture& fracture, int more) {
  const StepReport first = fracture.step();
  for (int i = 0; i < more; ++i)
    fracture.step();
  return first;
}

Fracture fracture_of(const Scene& scene) {
  const auto body = std::make_shared<const PreparedBody>(prepare(scene));
  EXPECT_TRUE(body->quadratic);
  return Fracture(body, load_of(scene, *body), scene.run);
}

}  // namespace

// Held along its normal at the edges, pressed on a patch of 20 mm in its middle.
TEST(ThinWallBreaks, APaneThatIsHitCracksFromTheFarFaceRadially) {
  const test::TemporaryFolder folder;
  const double side = 0.3, t = 0.006;
  std::string text =
      test::mesh_body_text(test::write_mesh_in(folder, "pane.obj", box_mesh({side, side, t}, 2, 2, 1))) +
      "remesh = 900\n" + kGlass + test::resolution_text(t / 2, t / 20) +
      fmt::format("[[region]]\nname = 'patch'\nsphere = [0, 0, {}, 0.01]\nedge = 0.006\n", t / 2) +
      test::boundary_text("patch", "force", {0, 0, -1300});
  int number = 0;
  for (const Vec3& n : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)}) {
    const std::string name = fmt::format("side{}", number++);
    text += test::region_text(name, test::half_space_text(n, side / 2 - 1e-4)) +
            fmt::format("[[boundary]]\nregion = '{}'\ndisplacement = ['free', 'free', 0.0]\n", name);
  }
  Fracture fracture = fracture_of(test::scene_from_text(text));
  const StepReport first = break_on(fracture, 4);
  ASSERT_EQ(first.new_cracks, 1u);
  EXPECT_LT(first.start.position.z(), -0.49 * t) << "where the bending pulls";
  EXPECT_LT(first.start.position.head<2>().norm(), 0.02);
  // On the far face it runs along a line through the middle; on the side of the patch, where the pane is pressed, it is shorter.
  const CutComplex& cut = fracture.crack().cut;
  std::vector<Vec3> far;
  double near_length = 0;
  for (const Edge& e : cut.mouth) {
    const Vec3 &a = cut.positions[e.a], &b = cut.positions[e.b];
    if (a.z() < -0.49 * t && b.z() < -0.49 * t) far.insert(far.end(), {a, b});
    if (a.z() > 0.49 * t && b.z() > 0.49 * t) near_length += (b - a).norm();
  }
  ASSERT_FALSE(far.empty());
  Vec3 one = far.front(), other = far.front();
  for (const Vec3& x : far)
    if ((x - far.front()).norm() > (one - far.front()).norm()) one = x;
  for (const Vec3& x : far)
    if ((x - one).norm() > (other - one).norm()) other = x;
  const Vec3 across = cross(other - one, Vec3::UnitZ()).normalized();
  double aside = 0;
  for (const Vec3& x : far)
    aside = std::max(aside, std::abs(across.dot(x)));
  RecordProperty("length", test::text((other - one).norm()));
  RecordProperty("aside", test::text(aside));
  EXPECT_GT((other - one).norm(), 4 * t);
  EXPECT_LT(aside, t / 2) << "of the middle";
  EXPECT_LT(near_length, (other - one).norm());
}

// Squeezed between two fingers at its rim.
TEST(ThinWallBreaks, AWineGlassThatIsSqueezedCracksThroughItsWallFromTheRimDown) {
  using Line = std::vector<std::array<double, 2>>;
  const Line outside = {{0.0045, 0.066}, {0.010, 0.070},  {0.018, 0.0745}, {0.026, 0.082}, {0.032, 0.092},
                        {0.0355, 0.105}, {0.0362, 0.118}, {0.035, 0.134},  {0.0325, 0.150}},
             inside = {{0.0175, 0.0759}, {0.0249, 0.083}, {0.0307, 0.0927}, {0.03403, 0.1053},
                       {0.0347, 0.118},  {0.0335, 0.134}, {0.031, 0.150}};
  Line outline = {{0, 0},          {0.012, 0},     {0.024, 0},      {0.034, 0},     {0.034, 0.002},
                  {0.022, 0.0035}, {0.010, 0.006}, {0.0045, 0.012}, {0.0045, 0.03}, {0.0045, 0.048}};
  outline.insert(outline.end(), outside.begin(), outside.end());
  outline.insert(outline.end(), inside.rbegin(), inside.rend());
  outline.push_back({0, 0.0715});
  const test::TemporaryFolder folder;
  std::string text =
      test::mesh_body_text(test::write_mesh_in(folder, "glass.obj", shapes::turned(outline, 24, false))) +
      kGlass + test::resolution_text(0.00075, 0.000075);
  for (const double side : {-1.0, 1.0}) {
    const std::string name = side < 0 ? "left" : "right";
    text += fmt::format("[[region]]\nname = '{}'\nsphere = [{}, 0, 0.15, 0.012]\n", name, side * 0.0325) +
            test::boundary_text(name, "force", {-side * 110, 0, 0});
  }
  const Scene scene = test::scene_from_text(text);
  Fracture fracture = fracture_of(scene);
  const StepReport first = break_on(fracture, 8);
  ASSERT_EQ(first.new_cracks, 1u);
  const Vec3 origin = fracture.body().origin;
  EXPECT_GT(first.start.position.z() + origin.z(), 0.13) << "at the rim";
  const auto radius_at = [](const Line& line, double z) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      if (z <= line[i + 1][1])
        return line[i][0] + (line[i + 1][0] - line[i][0]) * (z - line[i][1]) / (line[i + 1][1] - line[i][1]);
    return line.back()[0];
  };
  const CutComplex& cut = fracture.crack().cut;
  bool at_outside = false, at_inside = false;
  double lowest = 1, highest = 0;
  for (const Edge& e : cut.mouth) {
    const Vec3 x = cut.positions[e.a] + origin;
    const double r = x.head<2>().norm(), outer = radius_at(outside, x.z()), inner = radius_at(inside, x.z());
    at_outside = at_outside || r > outer - 0.25 * (outer - inner);
    at_inside = at_inside || r < inner + 0.25 * (outer - inner);
    lowest = std::min(lowest, x.z());
    highest = std::max(highest, x.z());
  }
  EXPECT_TRUE(at_outside && at_inside) << "it opens at both faces of the wall";
  RecordProperty("length", test::text(highest - lowest));
  EXPECT_GT(highest - lowest, 3 * 0.0015);
}

}  // namespace conchoid

#include "conchoid/intersect/plane_cover.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "conchoid/intersect/self_intersection.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/mesh/surface_parts.hpp"
#include "intersect/cut_shapes.hpp"

namespace conchoid {
namespace {

bool meets_itself(const TriMesh& mesh) {
  for (std::size_t s = 0; s < mesh.triangle_count(); ++s)
    for (std::size_t t = s + 1; t < mesh.triangle_count(); ++t)
      if (triangles_intersect(mesh, TriId(s), TriId(t))) return true;
  return false;
}

TriMesh moved(TriMesh mesh, const std::function<Vec3(const Vec3&)>& by) {
  for (Vec3& x : mesh.positions)
    x = by(x);
  return mesh;
}

/// A ramp around the z axis from angle 0 on, that rises by 0.1 a turn.
TriMesh ramp(double angle) {
  return shapes::sheet(0, angle, 0.5, 1, static_cast<int>(std::ceil(8 * angle)), 3, [](double a, double r) {
    return Vec3(r * std::cos(a), r * std::sin(a), 0.1 * a / (2 * std::numbers::pi));
  });
}

TEST(PlaneCover, OfAWavySheetFromAnySide) {
  const TriMesh wavy = shapes::sheet(-1, 1, -1, 1, 12, 9, [](double u, double v) {
    return Vec3(u, v, 0.3 * std::sin(3 * u) * std::cos(2 * v));
  });
  for (int axis = 0; axis < 3; ++axis)
    for (const double mirror : {1.0, -1.0}) {
      const TriMesh turned = moved(
          wavy, [&](const Vec3& x) { return Vec3(x[axis], mirror * x[(axis + 1) % 3], x[(axis + 2) % 3]); });
      EXPECT_TRUE(covers_plane_once(turned)) << axis << ' ' << mirror;
      EXPECT_TRUE(self_intersections(turned, 5).empty());
    }
  EXPECT_FALSE(meets_itself(wavy));
}

TEST(PlaneCover, ARampCoversItLessThanOneTurn) {
  EXPECT_TRUE(covers_plane_once(ramp(6)));
  EXPECT_FALSE(
      covers_plane_once(ramp(7)));  // above itself, though seen from one side and nowhere through itself
  EXPECT_FALSE(covers_plane_once(ramp(14)));
  EXPECT_FALSE(meets_itself(ramp(7)));
  const TriMesh flat = moved(ramp(7), [](const Vec3& x) { return Vec3(x.x(), x.y(), 0); });
  EXPECT_FALSE(covers_plane_once(flat));
  EXPECT_FALSE(self_intersections(flat, 5).empty());
}

TEST(PlaneCover, HolesAreNoMatterAndPartsAreOneByOne) {
  TriMesh holed =
      shapes::sheet(-1, 1, -1, 1, 8, 8, [](double u, double v) { return Vec3(u, v, 0.1 * u * v); });
  TriMesh with_holes;
  with_holes.positions = holed.positions;
  for (std::size_t t = 0; t < holed.triangle_count(); ++t) {
    const Vec3 x = centroid(holed, TriId(t)).cwiseAbs();
    if (!(x.x() > 0.3 && x.x() < 0.7 && x.y() < 0.3)) with_holes.corners.push_back(holed.corners[TriId(t)]);
  }
  ASSERT_LT(with_holes.triangle_count(), holed.triangle_count());
  EXPECT_TRUE(covers_plane_once(with_holes));
  const TriMesh above = moved(holed, [](const Vec3& x) { return Vec3(x + Vec3(0, 0, 0.5)); });
  EXPECT_FALSE(covers_plane_once(join({holed, above})));
  EXPECT_FALSE(covers_plane_once(icosphere(1, 2)));
  EXPECT_FALSE(covers_plane_once(TriMesh{}));
}

// Whatever it says yes to does not meet itself: sheets that are crumpled more and more, on a lattice, where much touches.
TEST(PlaneCover, NeverOfASheetThatMeetsItself) {
  std::mt19937 random(11);
  int yes = 0, no = 0, met = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const double height = 0.02 * static_cast<double>(trial % 15);
    std::uniform_real_distribution<double> by(-height, height);
    const double lattice = trial % 2 == 0 ? 0 : 16;
    const TriMesh sheet =
        moved(shapes::sheet(-0.5, 0.5, -0.5, 0.5, 5, 5, [](double u, double v) { return Vec3(u, v, 0); }),
              [&](const Vec3& x) {
                const Vec3 y = x + Vec3(by(random), by(random), by(random));
                return lattice > 0 ? Vec3((lattice * y).array().round().matrix() / lattice) : y;
              });
    const bool meets = meets_itself(sheet);
    const bool covers = covers_plane_once(sheet);
    EXPECT_FALSE(covers && meets) << trial;
    EXPECT_EQ(self_intersections(sheet, 1).empty(), !meets) << trial;
    ++(covers ? yes : no);
    met += meets ? 1 : 0;
  }
  EXPECT_GT(yes, 60);
  EXPECT_GT(no, 60);
  EXPECT_GT(met, 30);
}

}  // namespace
}  // namespace conchoid

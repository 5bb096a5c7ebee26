#include "conchoid/surface/open_slits.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "conchoid/intersect/self_intersection.hpp"
#include "intersect/cut_shapes.hpp"

namespace conchoid {
namespace {

using namespace shapes;

constexpr double width = 1e-5;

void expect_clear(const Fragment& f) {
  EXPECT_TRUE(self_intersections(f.mesh, 1).empty());
}

double fracture_area(const Fragment& f) {
  double area = 0;
  for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t)
    if (f.face_kind[t] == FaceKind::fracture) area += area_vector(f.mesh, TriId(t)).norm();
  return area;
}

TEST(OpenSlits, FacesPartByTheWidthAndStayTogetherAtTheFront) {
  const TriMesh body = cube(3);
  const TriMesh half = sheet(-0.8, 0.1, -0.8, 0.8, 6, 6, [](double u, double v) { return Vec3(u, v, 0.03); });
  Fragment f = cut_into_fragments(body, {half}, {}).at(0);
  const Fragment closed = f;
  ASSERT_FALSE(self_intersections(f.mesh, 1).empty());
  open_slits(f, width);
  expect_clear(f);
  EXPECT_EQ(f.mesh.corners, closed.mesh.corners);
  EXPECT_EQ(f.volume, closed.volume);
  for (std::size_t i = 0; i < f.mesh.node_count(); ++i) {
    const Vec3 &x = closed.mesh.positions[NodeId(i)], &y = f.mesh.positions[NodeId(i)];
    if (std::abs(x.z() - 0.03) > 1e-12 || x.x() > 0.1 - 1e-12) {
      EXPECT_EQ(x, y);
    } else {
      EXPECT_NEAR(std::abs(y.z() - x.z()), 0.5 * width, 1e-15);
      EXPECT_NEAR((y - x).head<2>().norm(), 0, 1e-15) << "leaves the surface of the cube";
    }
  }
  // 0.6 deep and open by the width but for its last row, which narrows from there to the front
  const double row = 0.9 / 6;
  EXPECT_NEAR(closed.volume - enclosed_volume(f.mesh), width * (0.6 - 0.5 * row), 0.02 * width);
}

// Inner cracks, crossing slits, slits that end on others, curved and tilted ones, a mouth in a round surface.
TEST(OpenSlits, NoPieceTouchesItself) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int slits = 0;
  for (int k = 0; k < 40; ++k) {
    const TriMesh body = k % 2 ? icosphere(3) : cube(3);
    std::vector<TriMesh> sheets;
    for (int i = 0; i <= k % 3; ++i) {
      const Mat3 r = random_rotation(random);
      const double bend = 0.3 * uniform(random), end = 0.4 * uniform(random), at = 0.3 * uniform(random);
      sheets.push_back(sheet(k % 5 ? -1.6 : -0.3, end, -1.6, k % 4 ? 1.6 : 0.2, 11, 13,
                             [&](double u, double v) { return Vec3(r * Vec3(u, v, at + bend * u * u)); }));
    }
    for (Fragment& f : cut_into_fragments(body, sheets, {})) {
      const double area = fracture_area(f);
      slits += self_intersections(f.mesh, 1).empty() ? 0 : 1;
      open_slits(f, width);
      expect_clear(f);
      EXPECT_NEAR(fracture_area(f), area, 1e-3 * area);
      EXPECT_NEAR(enclosed_volume(f.mesh), f.volume, width * area);
    }
    if (HasFailure()) FAIL() << "seed " << k;
  }
  EXPECT_GT(slits, 25);
}

TEST(OpenSlits, PiecesWithoutSlitsKeepEveryBit) {
  const TriMesh body = cube(3);
  const TriMesh plane =
      sheet(-0.8, 0.8, -0.8, 0.8, 5, 5, [](double u, double v) { return Vec3(u, v, 0.07 + 0.05 * u); });
  for (Fragment& f : cut_into_fragments(body, {plane}, {})) {
    const TriMesh before = f.mesh;
    open_slits(f, width);
    EXPECT_EQ(f.mesh.positions, before.positions);
  }
}

}  // namespace
}  // namespace conchoid

#include "conchoid/surface/convex_hull.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "conchoid/surface/fragments.hpp"
#include "conchoid/surface/mass_properties.hpp"
#include "intersect/cut_shapes.hpp"

namespace conchoid {
namespace {

using namespace shapes;

/// Largest distance of a node outside the hull; the hull must be closed, convex and made of the mesh's nodes.
double check(const TriMesh& hull, const TriMesh& mesh) {
  EXPECT_TRUE(is_watertight(hull));
  EXPECT_GT(enclosed_volume(hull), 0);
  EXPECT_EQ(hull.triangle_count(), 2 * hull.node_count() - 4);  // Euler, a closed ball of triangles
  std::set<std::array<double, 3>> nodes;
  for (const Vec3& x : mesh.positions)
    nodes.insert({x[0], x[1], x[2]});
  for (const Vec3& x : hull.positions)
    EXPECT_TRUE(nodes.contains({x[0], x[1], x[2]}));
  double outside = 0;
  for (std::size_t t = 0; t < hull.triangle_count(); ++t) {
    const Vec3 n = unit_normal(hull, TriId(t)), p = hull.positions[hull.corners[TriId(t)][0]];
    if (area_vector(hull, TriId(t)).norm() > 1e-9 * surface_area(hull))
      for (const Vec3& x : mesh.positions)
        outside = std::max(outside, n.dot(x - p));
  }
  return outside;
}

TEST(ConvexHull, OfConvexBodiesIsTheBody) {
  const TriMesh hull = convex_hull(cube(4));
  EXPECT_LT(check(hull, cube(4)), 1e-14);
  EXPECT_NEAR(enclosed_volume(hull), 1, 1e-14);
  const TriMesh ball = icosphere(2);
  EXPECT_LT(check(convex_hull(ball), ball), 1e-14);
  EXPECT_NEAR(enclosed_volume(convex_hull(ball)), enclosed_volume(ball), 1e-13);
}

TEST(ConvexHull, HoldsEveryNodeOfEveryPiece) {
  std::mt19937 random(12);
  for (int seed = 0; seed < 12; ++seed) {
    const double scale = seed % 3 == 0 ? 1e-3 : 1;
    const Vec3 shift = seed % 2 ? Vec3(100, -200, 300) : Vec3::Zero();
    const auto place = [&](const Vec3& x) { return Vec3(scale * x + shift); };
    std::vector<TriMesh> sheets;
    for (int k = 0; k < 2; ++k) {
      const Mat3 r = random_rotation(random);
      sheets.push_back(mapped(sheet(-1.3, 1.3, -1.3, 1.3, 20, 20,
                                    [&](double u, double v) {
                                      return Vec3(
                                          r * Vec3(u, v, 0.1 * k + 0.2 * std::sin(4 * u) * std::cos(3 * v)));
                                    }),
                              place));
    }
    for (const Fragment& f : cut_into_fragments(mapped(icosphere(3), place), sheets, {})) {
      const TriMesh hull = convex_hull(f.mesh);
      EXPECT_LT(check(hull, f.mesh), 1e-12 * (scale + shift.norm()));
      EXPECT_GT(enclosed_volume(hull), f.volume);
      EXPECT_LT(hull.node_count(), f.mesh.node_count());
      EXPECT_EQ(convex_hull(f.mesh).corners, hull.corners);
    }
    if (HasFailure()) FAIL() << "seed " << seed;
  }
}

TEST(ConvexHull, OfFlatThingsThereIsNone) {
  EXPECT_EQ(
      convex_hull(sheet(0, 1, 0, 1, 3, 3, [](double u, double v) { return Vec3(u, v, 0); })).triangle_count(),
      0u);
  EXPECT_EQ(convex_hull({}).triangle_count(), 0u);
}

}  // namespace
}  // namespace conchoid

#include "conchoid/sim/mended_fragment.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "conchoid/mesh/models.hpp"
#include "conchoid/remesh/validate.hpp"
#include "conchoid/surface/mass_properties.hpp"

namespace conchoid {
namespace {

/// A box whose top is a fracture face; one node in the middle of the top lies a hair across an edge of its neighbours.
Fragment folded_box() {
  Fragment f;
  f.mesh = box_mesh(Vec3::Constant(1), 4, 4, 4);
  const Box box = bounding_box(f.mesh);
  for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t) {
    const bool top = centroid(f.mesh, TriId(t)).z() > box.high.z() - 1e-9;
    f.face_kind.push_back(top ? FaceKind::fracture : FaceKind::original);
    f.source.emplace_back(t);
  }
  f.volume = enclosed_volume(f.mesh);
  f.watertight = true;
  // Divide one triangle of the top at a place just inside its edge, then push that place over the edge.
  for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t) {
    if (f.face_kind[t] != FaceKind::fracture) continue;
    const auto c = f.mesh.corners[TriId(t)];
    const Triangle x = f.mesh.triangle(TriId(t));
    const Vec3 middle = 0.5 * (x[0] + x[1]);
    if ((middle - box.center()).head<2>().cwiseAbs().maxCoeff() > 0.3) continue;
    const Vec3 over = middle + 1e-7 * (middle - x[2]).normalized();
    const NodeId n = f.mesh.positions.add(over);
    f.mesh.corners[TriId(t)] = {c[0], c[1], n};
    f.mesh.corners.push_back({c[1], c[2], n});
    f.mesh.corners.push_back({c[2], c[0], n});
    for (int k = 0; k < 2; ++k) {
      f.face_kind.push_back(FaceKind::fracture);
      f.source.emplace_back(t);
    }
    return f;
  }
  return f;
}

TEST(MendedFragment, AFoldIsTakenOutAndTheRestStays) {
  Fragment f = folded_box();
  ASSERT_FALSE(is_solid(f));
  const double volume = enclosed_volume(f.mesh);
  const std::size_t triangles = f.mesh.triangle_count();
  mend_fragment(f);
  EXPECT_TRUE(is_solid(f));
  EXPECT_TRUE(f.watertight);
  EXPECT_NEAR(enclosed_volume(f.mesh), volume, 1e-6);
  EXPECT_NEAR(static_cast<double>(f.mesh.triangle_count()), static_cast<double>(triangles), 10);
  ASSERT_EQ(f.face_kind.size(), f.mesh.triangle_count());
  ASSERT_EQ(f.source.size(), f.mesh.triangle_count());
  double fracture = 0;
  for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t)
    if (f.face_kind[t] == FaceKind::fracture) fracture += area_vector(f.mesh, TriId(t)).norm();
  EXPECT_NEAR(fracture, 1, 1e-5);
}

// A tube that came apart had such a sliver at the rim of a piece, whose file no scene could use.
TEST(MendedFragment, ASliverThatIsFoldedIsFoundAtItsNodes) {
  Fragment f = folded_box();
  mend_folded_slivers(f);
  EXPECT_TRUE(is_solid(f));
}

TEST(MendedFragment, SliversThatLieFlatStay) {
  Fragment f = folded_box();
  Vec3& middle = f.mesh.positions[NodeId(f.mesh.node_count() - 1)];
  const Vec3 inside = f.mesh.positions[f.mesh.corners[TriId(f.mesh.triangle_count() - 1)][0]];  // x[2]
  middle += 3e-7 * (inside - middle).normalized();
  ASSERT_TRUE(is_solid(f));
  const TriMesh before = f.mesh;
  mend_folded_slivers(f);
  EXPECT_EQ(f.mesh.positions, before.positions);
  EXPECT_EQ(f.mesh.corners, before.corners);
}

TEST(MendedFragment, ASolidIsLeftAsItIs) {
  Fragment f;
  f.mesh = box_mesh(Vec3::Constant(1), 2, 2, 2);
  EXPECT_TRUE(is_solid(f));
}

// Faces parted by slits need not pass through each other where the surface without the slits does.
TEST(MendedFragment, TheSurfaceWithoutSlitsIsMendedToo) {
  Fragment f = folded_box();
  f.unfinished.solid = f.mesh;
  f.mesh = box_mesh(Vec3::Constant(1), 4, 4, 4);
  f.face_kind.resize(f.mesh.triangle_count());
  f.source.resize(f.mesh.triangle_count());
  ASSERT_TRUE(is_solid(f));
  mend_fragment(f);
  EXPECT_TRUE(find_defects(f.unfinished.solid).empty());
  EXPECT_EQ(f.unfinished.solid_face.size(), f.unfinished.solid.triangle_count());
}

/// A box with two nodes that are the same but for the last bits, as rounded cuts leave them, on an edge of its top.
Fragment box_with_needles() {
  Fragment f;
  f.mesh = box_mesh(Vec3::Constant(1), 4, 4, 4);
  const double top = bounding_box(f.mesh).high.z() - 1e-9;
  const auto at_top = [&](std::size_t t) { return centroid(f.mesh, TriId(t)).z() > top; };
  for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t)
    for (std::size_t u = t + 1; u < f.mesh.triangle_count() && f.face_kind.empty(); ++u) {
      const auto x = f.mesh.corners[TriId(t)], y = f.mesh.corners[TriId(u)];
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) {
          const NodeId a = x[k], b = x[(k + 1) % 3], c = x[(k + 2) % 3], d = y[(l + 2) % 3];
          if (!f.face_kind.empty() || y[l] != b || y[(l + 1) % 3] != a || !at_top(t) || !at_top(u)) continue;
          Vec3 middle = 0.5 * (f.mesh.positions[a] + f.mesh.positions[b]);
          const NodeId n = f.mesh.positions.add(middle);
          middle.x() = std::nextafter(middle.x(), 2);
          const NodeId m = f.mesh.positions.add(middle);
          f.mesh.corners[TriId(t)] = {a, m, c};
          f.mesh.corners[TriId(u)] = {b, n, d};
          for (const auto& more : {std::array{m, b, c}, {n, a, d}, {a, n, m}, {b, m, n}})
            f.mesh.corners.push_back(more);
          f.face_kind.assign(f.mesh.triangle_count(), FaceKind::original);
        }
    }
  for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t)
    f.source.emplace_back(t);
  return f;
}

// A piece of a tube was left as it was, as its surface had such triangles.
TEST(MendedFragment, TrianglesWithoutAreaAreTakenOutOfASolid) {
  Fragment f = box_with_needles();
  ASSERT_TRUE(is_solid(f));
  ASSERT_FALSE(find_defects(f.mesh).empty());
  f.unfinished.solid = f.mesh;
  mend_fragment(f);
  EXPECT_TRUE(find_defects(f.mesh).empty());
  EXPECT_TRUE(find_defects(f.unfinished.solid).empty());
  EXPECT_NEAR(enclosed_volume(f.mesh), 1, 1e-12);
  EXPECT_EQ(f.face_kind.size(), f.mesh.triangle_count());
}

}  // namespace
}  // namespace conchoid

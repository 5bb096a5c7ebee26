#include "conchoid/remesh/unite_bodies.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "conchoid/formats/formats.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/mesh/surface_parts.hpp"
#include "conchoid/surface/mass_properties.hpp"

namespace conchoid {
namespace {

TriMesh cube_at(const Vec3& center) {
  TriMesh cube = box_mesh({1, 1, 1}, 2, 2, 2);
  for (Vec3& x : cube.positions)
    x += center;
  return cube;
}

std::size_t parts_of(const TriMesh& mesh) {
  return surface_parts(mesh).size();
}

// Of a chip; cut by each other they are two bodies as before, that meet as before.
TriMesh splinters() {
  return read_mesh(std::filesystem::path(CONCHOID_SOURCE_DIR) / "tests/data/slivers_that_meet.off");
}

TEST(UniteBodies, MakesOneOfTwoThatPassThroughEachOther) {
  TriMesh mesh = join({cube_at({0, 0, 0}), cube_at({0.4, 0.3, 0.2})});
  EXPECT_EQ(unite_bodies(mesh), 1u);
  EXPECT_EQ(parts_of(mesh), 1u);
  EXPECT_NEAR(enclosed_volume(mesh), 2 - 0.6 * 0.7 * 0.8, 1e-9);
}

TEST(UniteBodies, LeavesTwoThatStayTwo) {
  const TriMesh slivers = splinters();
  TriMesh mesh = slivers;
  EXPECT_EQ(unite_bodies(mesh), 0u);
  EXPECT_EQ(mesh.triangle_count(), slivers.triangle_count());
}

TEST(UniteBodies, UnitesTheOthersWhereTwoCannotBe) {
  TriMesh mesh = join({splinters(), cube_at({5, 0, 0}), cube_at({5.4, 0.3, 0.2})});
  EXPECT_EQ(unite_bodies(mesh), 1u);
  EXPECT_EQ(parts_of(mesh), 3u);
}

}  // namespace
}  // namespace conchoid

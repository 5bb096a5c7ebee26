#include "conchoid/mesh/carry_attributes.hpp"

#include <gtest/gtest.h>

#include "conchoid/mesh/models.hpp"

namespace conchoid {

TEST(CarryAttributes, BothSidesOfACreaseKeepTheirOwn) {
  AttributedMesh from{box_mesh(Vec3(1, 1, 1), 2, 2, 2), {}};
  for (std::size_t t = 0; t < from.mesh.triangle_count(); ++t) {
    const Vec3 n = unit_normal(from.mesh, TriId(t));
    from.attributes.normal.push_back({n, n, n});
    std::array<Vec2, 3> uv;
    for (std::size_t k = 0; k < 3; ++k)
      uv[k] = from.mesh.triangle(TriId(t))[k].head<2>();
    from.attributes.uv.push_back(uv);
    from.attributes.material.push_back(n.z() > 0.5 ? 1 : 0);
  }
  from.attributes.materials = {"side", "top"};
  const TriMesh to = box_mesh(Vec3(1, 1, 1), 5, 3, 4);
  const SurfaceAttributes carried = carried_over(from, to);
  ASSERT_EQ(carried.normal.size(), to.triangle_count());
  EXPECT_EQ(carried.materials, from.attributes.materials);
  for (std::size_t t = 0; t < to.triangle_count(); ++t) {
    const Vec3 n = unit_normal(to, TriId(t));
    EXPECT_EQ(carried.material[t], n.z() > 0.5 ? 1 : 0);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LT((carried.normal[t][k] - n).norm(), 1e-12);
  }
}

TEST(CarryAttributes, LinearValuesComeBackOnAnyTriangulationInside) {
  AttributedMesh from{box_mesh(Vec3(1, 1, 1), 1, 1, 1), {}};
  for (std::size_t t = 0; t < from.mesh.triangle_count(); ++t) {
    std::array<Vec2, 3> uv;
    for (std::size_t k = 0; k < 3; ++k)
      uv[k] = from.mesh.triangle(TriId(t))[k].head<2>();
    from.attributes.uv.push_back(uv);
  }
  const TriMesh to = from.mesh;
  const SurfaceAttributes carried = carried_over(from, to);
  for (std::size_t t = 0; t < to.triangle_count(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LT((carried.uv[t][k] - to.triangle(TriId(t))[k].head<2>()).norm(), 1e-12);
  EXPECT_TRUE(carried_over({from.mesh, {}}, to).empty());
}

}  // namespace conchoid

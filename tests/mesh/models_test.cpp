#include "conchoid/mesh/models.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "conchoid/core/error.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/remesh/validate.hpp"
#include "mesh/mesh_checks.hpp"

namespace conchoid {
namespace {

constexpr double pi = std::numbers::pi;

std::string defects_text(const TriMesh& mesh) {
  std::string text;
  for (const MeshDefect& d : find_defects(mesh))
    text += d.what + "\n";
  return text;
}

void expect_regions_partition(const BodyModel& model) {
  std::set<TriId> seen;
  for (const Region& region : model.regions) {
    EXPECT_FALSE(region.triangles.empty()) << region.name;
    EXPECT_TRUE(std::is_sorted(region.triangles.begin(), region.triangles.end())) << region.name;
    for (TriId t : region.triangles)
      EXPECT_TRUE(seen.insert(t).second) << region.name << " shares triangle " << t.value;
  }
  EXPECT_EQ(seen.size(), model.mesh.triangle_count());
}

double region_area(const BodyModel& model, const std::string& name) {
  const Region* region = find_region(model.regions, name);
  if (region == nullptr) return 0;
  double area = 0;
  for (TriId t : region->triangles)
    area += area_vector(model.mesh, t).norm();
  return area;
}

TEST(BuiltInModel, CubeHas120TrianglesOfOneCubicMetre) {
  const BodyModel cube = built_in_model("cube");
  EXPECT_EQ(cube.mesh.triangle_count(), 120u);
  EXPECT_EQ(cube.mesh.node_count(), 62u);
  EXPECT_EQ(defects_text(cube.mesh), "");
  EXPECT_NEAR(enclosed_volume(cube.mesh), 1.0, 1e-14);
  expect_regions_partition(cube);
  for (const char* side : {"x-", "x+", "y-", "y+", "z-", "z+"}) {
    EXPECT_NEAR(region_area(cube, side), 1.0, 1e-14) << side;
    EXPECT_EQ(find_region(cube.regions, side)->triangles.size(), 20u);
  }
  EXPECT_GT(smallest_angle_degrees(cube.mesh), 30.0);
}

TEST(BuiltInModel, CubeIsItsOwnMirrorImageBitForBit) {
  const TriMesh cube = built_in_model("cube").mesh;
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_TRUE(triangle_soup(mirrored(cube, axis)) == triangle_soup(cube)) << "axis " << axis;
  TriMesh turned = cube;  // x → y → z → x
  for (Vec3& x : turned.positions)
    x = Vec3(x.z(), x.x(), x.y());
  EXPECT_TRUE(triangle_soup(turned) == triangle_soup(cube));
}

TEST(BuiltInModel, CylinderFillsItsPolygon) {
  const BodyModel cylinder = built_in_model("cylinder");
  EXPECT_EQ(cylinder.mesh.triangle_count(), 192u);
  EXPECT_EQ(defects_text(cylinder.mesh), "");
  expect_regions_partition(cylinder);
  const double polygon = 0.5 * 16 * 0.25 * std::sin(2 * pi / 16);
  EXPECT_NEAR(region_area(cylinder, "top"), polygon, 1e-14);
  EXPECT_NEAR(region_area(cylinder, "bottom"), polygon, 1e-14);
  EXPECT_GT(enclosed_volume(cylinder.mesh), 0.95 * pi / 4);
  EXPECT_LT(enclosed_volume(cylinder.mesh), pi / 4);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_TRUE(triangle_soup(mirrored(cylinder.mesh, axis)) == triangle_soup(cylinder.mesh))
        << "axis " << axis;
  EXPECT_GT(smallest_angle_degrees(cylinder.mesh), 30.0);
}

TEST(BuiltInModel, BarIsNotchedInTheMiddleOfItsBottom) {
  const BodyModel bar = built_in_model("bar");
  EXPECT_EQ(bar.mesh.triangle_count(), 416u);
  EXPECT_EQ(defects_text(bar.mesh), "");
  expect_regions_partition(bar);
  EXPECT_NEAR(enclosed_volume(bar.mesh), 0.2 * 0.04 * 0.05 - 0.5 * 0.014 * 0.01 * 0.04, 1e-12);
  EXPECT_NEAR(region_area(bar, "load"), 0.025 * 0.04, 1e-12);
  EXPECT_EQ(find_region(bar.regions, "support-left")->triangles.size(), 4u);
  for (TriId t : find_region(bar.regions, "support-left")->triangles) {
    EXPECT_DOUBLE_EQ(centroid(bar.mesh, t).z(), -0.025);
    EXPECT_LT(centroid(bar.mesh, t).x(), -0.07);
  }
  double tip = -1;
  for (TriId t : find_region(bar.regions, "notch")->triangles)
    for (const Vec3& x : bar.mesh.triangle(t))
      tip = std::max(tip, x.z());
  EXPECT_NEAR(tip, -0.015, 1e-15);
  for (int axis : {0, 1})
    EXPECT_TRUE(triangle_soup(mirrored(bar.mesh, axis)) == triangle_soup(bar.mesh)) << "axis " << axis;
  EXPECT_GT(smallest_angle_degrees(bar.mesh), 20.0);
}

TEST(BuiltInModel, EdgeCrackReachesThirtyCentimetresIn) {
  const BodyModel model = built_in_model("edge-crack-cube");
  EXPECT_EQ(defects_text(model.mesh), "");
  EXPECT_TRUE(find_sheet_defects(model.crack).empty());
  EXPECT_EQ(model.mesh.triangle_count() + model.crack.triangle_count(), 308u);
  EXPECT_NEAR(surface_area(model.crack), 0.3, 1e-14);
  const Box box = bounding_box(model.crack);
  EXPECT_EQ(box.low, Vec3(-0.5, -0.5, 0));
  EXPECT_EQ(box.high, Vec3(-0.5 + 0.3, 0.5, 0));
  for (std::size_t t = 0; t < model.crack.triangle_count(); ++t)
    EXPECT_NEAR(unit_normal(model.crack, TriId(t)).z(), 1.0, 1e-15);
  EXPECT_TRUE(triangle_soup(mirrored(model.crack, 1)) == triangle_soup(model.crack));
}

TEST(BuiltInModel, InfiniteBodyHasNoSurface) {
  EXPECT_EQ(built_in_model("infinite").mesh.triangle_count(), 0u);
}

TEST(BuiltInModel, UnknownNameIsRefusedWithTheKnownOnes) {
  try {
    built_in_model("teapot");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("teapot"), std::string::npos);
    for (const std::string& name : built_in_model_names())
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos);
  }
}

TEST(BoxMesh, HasTheVolumeAndCountsOfItsGrid) {
  const TriMesh box = box_mesh({1, 2, 3}, 2, 3, 4);
  EXPECT_EQ(box.triangle_count(), 4u * (6 + 12 + 8));
  EXPECT_EQ(defects_text(box), "");
  EXPECT_NEAR(enclosed_volume(box), 6.0, 1e-13);
  EXPECT_THROW(box_mesh({1, 1, 1}, 0, 1, 1), InputError);
  EXPECT_THROW(box_mesh({1, 0, 1}, 1, 1, 1), InputError);
}

TEST(BoxMesh, EvenCellCountsMakeItMirrorSymmetric) {
  const TriMesh box = box_mesh({1, 2, 3}, 2, 4, 6);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_TRUE(triangle_soup(mirrored(box, axis)) == triangle_soup(box)) << "axis " << axis;
}

TEST(Icosphere, ApproachesTheBall) {
  const TriMesh sphere = icosphere(2.0, 3);
  EXPECT_EQ(sphere.triangle_count(), 1280u);
  EXPECT_EQ(defects_text(sphere), "");
  for (const Vec3& x : sphere.positions)
    EXPECT_NEAR(x.norm(), 2.0, 1e-14);
  EXPECT_NEAR(enclosed_volume(sphere), 4 * pi / 3 * 8, 0.02 * 4 * pi / 3 * 8);
}

}  // namespace
}  // namespace conchoid

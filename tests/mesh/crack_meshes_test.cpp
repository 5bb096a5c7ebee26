#include "conchoid/mesh/crack_meshes.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "conchoid/core/error.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/remesh/validate.hpp"
#include "mesh/mesh_checks.hpp"

namespace conchoid {
namespace {

constexpr double pi = std::numbers::pi;

/// Spread of a set of lengths: largest over smallest.
struct Spread {
  double low = 1e300, high = 0;
  void add(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  double ratio() const { return high / low; }
};

struct FrontRing {
  Spread edges;    ///< lengths of the front edges
  Spread heights;  ///< distance of the node behind each front edge from its line
  std::size_t count = 0;
};

/// Checks that each triangle has at most one front edge and a node inside the sheet behind it.
FrontRing front_ring(const TriMesh& sheet) {
  const std::vector<Edge> front = boundary_edges(sheet);
  std::set<NodeId> on_front;
  for (const Edge& e : front) {
    on_front.insert(e.a);
    on_front.insert(e.b);
  }
  FrontRing ring;
  ring.count = front.size();
  for (const auto& c : sheet.corners)
    for (std::size_t k = 0; k < 3; ++k) {
      if (!std::binary_search(front.begin(), front.end(), Edge(c[k], c[(k + 1) % 3]))) continue;
      const NodeId behind = c[(k + 2) % 3];
      EXPECT_FALSE(on_front.contains(behind));
      const Vec3 a = sheet.positions[c[k]], b = sheet.positions[c[(k + 1) % 3]];
      ring.edges.add((b - a).norm());
      ring.heights.add(area_vector2(a, b, sheet.positions[behind]).norm() / (b - a).norm());
    }
  return ring;
}

void expect_plane_sheet(const TriMesh& sheet, const Vec3& normal) {
  EXPECT_TRUE(find_sheet_defects(sheet).empty());
  for (std::size_t t = 0; t < sheet.triangle_count(); ++t)
    EXPECT_NEAR(unit_normal(sheet, TriId(t)).dot(normal.normalized()), 1.0, 1e-12);
}

TEST(DiscCrack, TriangleCountsAreSixKSquared) {
  const Vec3 center(1, 2, 3), normal(1, 1, 2);
  for (const int rings : {1, 2, 3, 5, 8, 12, 16}) {
    const TriMesh disc = disc_crack(center, normal, 0.2, {.triangles = 6 * rings * rings});
    EXPECT_EQ(disc.triangle_count(), static_cast<std::size_t>(6 * rings * rings));
    EXPECT_EQ(boundary_edges(disc).size(), static_cast<std::size_t>(6 * rings));
    expect_plane_sheet(disc, normal);
  }
  EXPECT_EQ(disc_crack(center, normal, 0.2, {.triangles = 400}).triangle_count(), 384u);
}

TEST(DiscCrack, FrontIsARegularRing) {
  const Vec3 center(1, 2, 3), normal(1, 1, 2);
  const TriMesh disc = disc_crack(center, normal, 0.2, {.triangles = 384});
  const FrontRing ring = front_ring(disc);
  EXPECT_EQ(ring.count, 48u);
  EXPECT_LT(ring.edges.ratio(), 1 + 1e-12);
  EXPECT_NEAR(ring.edges.low, 2 * 0.2 * std::sin(pi / 48), 1e-14);
  EXPECT_GT(ring.heights.low, 0.85 * ring.edges.low);
  EXPECT_LT(ring.heights.high, 1.05 * ring.edges.low);
  for (const Edge& e : boundary_edges(disc))
    EXPECT_NEAR((disc.positions[e.a] - center).norm(), 0.2, 1e-14);
}

TEST(DiscCrack, HasNoHandedness) {
  const TriMesh disc = disc_crack(Vec3::Zero(), Vec3::UnitZ(), 1.0, {.triangles = 150}, Vec3(1, 0, 0));
  for (int axis : {0, 1})
    EXPECT_TRUE(triangle_soup(mirrored(disc, axis)) == triangle_soup(disc));
}

TEST(DiscCrack, EdgeLengthSetsTheRingWidth) {
  const FrontRing ring = front_ring(disc_crack(Vec3::Zero(), Vec3::UnitX(), 1.0, {.edge = 0.1}));
  EXPECT_EQ(ring.count, 60u);
  EXPECT_NEAR(ring.edges.low, 0.1, 0.01);
}

TEST(DiscCrack, ScalingByAPowerOfTwoKeepsTheBits) {
  const Vec3 normal(0.3, -0.2, 0.9);
  const TriMesh small = disc_crack({1, 0, 0}, normal, 0.3, {.triangles = 96});
  const TriMesh large = disc_crack({1024, 0, 0}, normal, 0.3 * 1024, {.triangles = 96});
  for (std::size_t n = 0; n < small.node_count(); ++n)
    EXPECT_EQ(small.positions[NodeId(n)] * 1024, large.positions[NodeId(n)]);
}

TEST(EllipseCrack, FrontIsARegularRingOnTheEllipse) {
  for (const double aspect : {1.1, 1.5, 2.0, 4.0}) {
    const TriMesh sheet =
        ellipse_crack({0, 0, 5}, Vec3::UnitZ(), aspect, 1.0, {.triangles = 600}, Vec3::UnitX());
    expect_plane_sheet(sheet, Vec3::UnitZ());
    EXPECT_NEAR(static_cast<double>(sheet.triangle_count()), 600, 110) << aspect;
    const FrontRing ring = front_ring(sheet);
    EXPECT_LT(ring.edges.ratio(), 1.02) << aspect;
    EXPECT_GT(ring.heights.low, 0.6 * ring.edges.low) << aspect;
    EXPECT_LT(ring.heights.high, 1.2 * ring.edges.low) << aspect;
    for (const Edge& e : boundary_edges(sheet)) {
      const Vec3& x = sheet.positions[e.a];
      EXPECT_NEAR(x.x() * x.x() / (aspect * aspect) + x.y() * x.y(), 1.0, 1e-12);
    }
    EXPECT_NEAR(surface_area(sheet), pi * aspect, 0.02 * pi * aspect);
    EXPECT_GT(smallest_angle_degrees(sheet), 15) << aspect;
  }
}

TEST(EllipseCrack, AxesMayComeInEitherOrder) {
  const TriMesh wide = ellipse_crack(Vec3::Zero(), Vec3::UnitZ(), 2, 1, {.triangles = 300}, Vec3::UnitX());
  const TriMesh tall = ellipse_crack(Vec3::Zero(), Vec3::UnitZ(), 1, 2, {.triangles = 300}, Vec3::UnitY());
  EXPECT_EQ(wide.triangle_count(), tall.triangle_count());
  EXPECT_NEAR(bounding_box(tall).high.x(), bounding_box(wide).high.x(), 1e-14);
  EXPECT_NEAR(bounding_box(tall).high.x(), 2, 1e-14);
}

TEST(RectangleCrack, EveryFrontEdgeHasItsNodeStraightBehindIt) {
  const Vec3 edge1(0.4, 0, 0), edge2(0, 0, 0.24);
  const TriMesh sheet = rectangle_crack({0, 1, 0}, edge1, edge2, {.edge = 0.03});
  expect_plane_sheet(sheet, -Vec3::UnitY());
  EXPECT_NEAR(surface_area(sheet), 0.4 * 0.24, 1e-14);
  const FrontRing ring = front_ring(sheet);
  EXPECT_EQ(ring.count, 2u * (13 + 8));
  EXPECT_LT(ring.edges.ratio(), 1.2);
  EXPECT_LT(ring.heights.ratio(), 1 + 1e-12);
  EXPECT_NEAR(ring.heights.low / ring.edges.low, 0.8, 0.1);
  EXPECT_GT(smallest_angle_degrees(sheet), 30);
}

TEST(RectangleCrack, TargetIsMetAndMirrorImagesAgree) {
  for (const int target : {60, 100, 200, 384, 500, 1000}) {
    const TriMesh sheet = rectangle_crack(Vec3::Zero(), {2, 0, 0}, {0, 1, 0}, {.triangles = target});
    EXPECT_NEAR(static_cast<double>(sheet.triangle_count()), target, 0.2 * target);
    for (int axis : {0, 1})
      EXPECT_TRUE(triangle_soup(mirrored(sheet, axis)) == triangle_soup(sheet));
  }
}

TEST(CrackMeshes, ImpossibleSizesAreRefused) {
  const Vec3 o = Vec3::Zero(), z = Vec3::UnitZ();
  EXPECT_THROW(disc_crack(o, z, 0.0, {.triangles = 96}), InputError);
  EXPECT_THROW(disc_crack(o, z, -1.0, {.triangles = 96}), InputError);
  EXPECT_THROW(disc_crack(o, z, std::nan(""), {.triangles = 96}), InputError);
  EXPECT_THROW(disc_crack(o, o, 1.0, {.triangles = 96}), InputError);
  EXPECT_THROW(disc_crack(o, z, 1.0, {}), InputError);
  EXPECT_THROW(disc_crack(o, z, 1.0, {.triangles = 96, .edge = 0.1}), InputError);
  EXPECT_THROW(disc_crack(o, z, 1.0, {.edge = 1e-9}), InputError);
  EXPECT_THROW(disc_crack(o, z, 1.0, {.triangles = 96}, z), InputError);
  EXPECT_THROW(rectangle_crack(o, z, z, {.triangles = 96}), InputError);
  EXPECT_THROW(rectangle_crack(o, z, Vec3(1e-9, 0, 0), {.triangles = 96}), InputError);
}

TEST(ExtendSheetBeyond, AddsOneStripOfTheAskedWidth) {
  const TriMesh sheet = built_in_model("edge-crack-cube").crack;
  std::vector<Edge> mouth;
  for (const Edge& e : boundary_edges(sheet)) {
    const Vec3 a = sheet.positions[e.a], b = sheet.positions[e.b];
    auto both_at = [&](int axis, double value) { return a[axis] == value && b[axis] == value; };
    if (both_at(0, -0.5) || both_at(1, -0.5) || both_at(1, 0.5)) mouth.push_back(e);
  }
  EXPECT_EQ(mouth.size(), 14u + 4 + 4);
  const TriMesh extended = extend_sheet_beyond(sheet, mouth, 0.1);
  EXPECT_EQ(extended.triangle_count(), sheet.triangle_count() + 2 * mouth.size());
  EXPECT_TRUE(find_sheet_defects(extended).empty());
  const Box box = bounding_box(extended);
  EXPECT_NEAR(box.low.x(), -0.6, 1e-14);
  EXPECT_NEAR(box.low.y(), -0.6, 1e-14);
  EXPECT_NEAR(box.high.y(), 0.6, 1e-14);
  EXPECT_NEAR(box.high.x(), -0.2, 1e-14);
  EXPECT_NEAR(surface_area(extended), 0.4 * 1.2, 1e-13);
  for (std::size_t t = 0; t < extended.triangle_count(); ++t)
    EXPECT_NEAR(unit_normal(extended, TriId(t)).z(), 1.0, 1e-13);
  for (std::size_t n = 0; n < sheet.node_count(); ++n)
    EXPECT_EQ(extended.positions[NodeId(n)], sheet.positions[NodeId(n)]);
}

TEST(ExtendSheetBeyond, InnerEdgesAreRefused) {
  const TriMesh disc = disc_crack(Vec3::Zero(), Vec3::UnitZ(), 1, {.triangles = 24});
  EXPECT_THROW(extend_sheet_beyond(disc, {Edge(NodeId(0), NodeId(1))}, 0.1), InputError);
  EXPECT_THROW(extend_sheet_beyond(disc, boundary_edges(disc), 0.0), InputError);
}

// Three edges across, each a third of those along: the inner nodes of both sides do not pass each other.
TEST(RectangleCrack, AThinOneDoesNotFold) {
  for (double width : {0.03, 0.05, 0.08})
    expect_plane_sheet(rectangle_crack(Vec3::Zero(), {1, 0, 0}, {0, width, 0}, {.edge = 0.05}),
                       Vec3::UnitZ());
}

}  // namespace
}  // namespace conchoid

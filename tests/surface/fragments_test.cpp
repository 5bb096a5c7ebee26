#include "conchoid/surface/fragments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "conchoid/formats/formats.hpp"
#include "conchoid/surface/mass_properties.hpp"
#include "conchoid/surface/separation.hpp"
#include "intersect/cut_shapes.hpp"
#include "scans.hpp"

namespace conchoid {
namespace {

using namespace shapes;

struct Total {
  double volume = 0;
  std::size_t flat = 0;  ///< triangles without area
};

/// Every fragment closed, oriented, with sound tags; original faces lie where they came from.
Total check(const std::vector<Fragment>& fragments, const TriMesh& body) {
  Total total;
  const Box box = bounding_box(body);
  const double tolerance = 1e-11 * std::max(box.low.norm(), box.high.norm());
  double original_area = 0;
  std::set<std::array<double, 3>> nodes;
  for (const Vec3& x : body.positions)
    nodes.insert({x.x(), x.y(), x.z()});
  std::set<std::array<double, 3>> kept;
  for (const Fragment& f : fragments) {
    EXPECT_TRUE(f.watertight);
    EXPECT_EQ(f.face_kind.size(), f.mesh.triangle_count());
    EXPECT_EQ(f.source.size(), f.mesh.triangle_count());
    std::map<std::pair<NodeId, NodeId>, int> directed;
    std::vector<int> fans(f.mesh.node_count(), 0);
    for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t) {
      const auto& c = f.mesh.corners[TriId(t)];
      for (int k = 0; k < 3; ++k) {
        ++directed[{c[k], c[(k + 1) % 3]}];
        ++fans[c[k].index()];
      }
      const double area = area_vector(f.mesh, TriId(t)).norm();
      if (area < 1e-24) ++total.flat;
      if (f.face_kind[t] == FaceKind::original) {
        original_area += area;
        EXPECT_LT(f.source[t].index(), body.triangle_count());
        const Vec3 n = unit_normal(body, f.source[t]);
        EXPECT_NEAR(n.dot(centroid(f.mesh, TriId(t)) - body.positions[body.corners[f.source[t]][0]]), 0,
                    tolerance);
      }
    }
    for (const auto& [edge, uses] : directed) {
      EXPECT_EQ(uses, 1);
      EXPECT_TRUE(directed.contains({edge.second, edge.first}));
    }
    EXPECT_EQ(std::count(fans.begin(), fans.end(), 0), 0) << "unused nodes";
    EXPECT_NEAR(f.volume, enclosed_volume(f.mesh), 1e-12 * enclosed_volume(body));
    for (const Vec3& x : f.mesh.positions)
      kept.insert({x.x(), x.y(), x.z()});
    total.volume += f.volume;
  }
  for (std::size_t i = 1; i < fragments.size(); ++i)
    EXPECT_GE(fragments[i - 1].volume, fragments[i].volume * (1 - 1e-8));
  EXPECT_TRUE(std::includes(kept.begin(), kept.end(), nodes.begin(), nodes.end()))
      << "nodes of the body are missing";
  EXPECT_NEAR(original_area, surface_area(body), 1e-11 * surface_area(body));
  return total;
}

TriMesh plane_sheet(const Mat3& r, double d, double reach, int n) {
  return sheet(-reach, reach, -reach, reach, n, n,
               [&](double u, double v) { return Vec3(u * r.col(0) + v * r.col(1) + d * r.col(2)); });
}

TEST(Fragments, PlaneCutsTheCubeInTwo) {
  const TriMesh body = cube(4);
  const auto f = cut_into_fragments(body, {plane_sheet(Mat3::Identity(), 0.1, 0.8, 5)}, {});
  ASSERT_EQ(f.size(), 2u);
  EXPECT_NEAR(check(f, body).volume, 1.0, 1e-14);
  EXPECT_NEAR(f[0].volume, 0.6, 1e-14);
  EXPECT_NEAR(f[1].volume, 0.4, 1e-14);
  EXPECT_NEAR((f[0].center_of_mass - Vec3(0, 0, -0.2)).norm(), 0, 1e-14);
  EXPECT_NEAR(f[0].mass, 600, 1e-10);
  // box 1 × 1 × 0.6: m/12 (b² + c²)
  EXPECT_NEAR(f[0].inertia(0, 0), 600.0 / 12 * (1 + 0.36), 1e-10);
  EXPECT_NEAR(f[0].inertia(2, 2), 600.0 / 12 * 2, 1e-10);
  EXPECT_NEAR(f[0].inertia(0, 1), 0, 1e-10);
}

TEST(Fragments, SheetInThePlaneOfMeshNodes) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double reach : {0.5, 0.6}) {
      Mat3 r = Mat3::Zero();
      r((axis + 1) % 3, 0) = r((axis + 2) % 3, 1) = r(axis, 2) = 1;
      const TriMesh body = cube(4);
      const auto f = cut_into_fragments(body, {plane_sheet(r, 0.0, reach, 4)}, {});
      ASSERT_EQ(f.size(), 2u);
      EXPECT_NEAR(check(f, body).volume, 1.0, 1e-14);
      EXPECT_NEAR(f[0].volume, 0.5, 1e-14);
    }
}

TEST(Fragments, SheetOnAFaceOfTheBodyCutsNothingOff) {
  const TriMesh body = cube(3);
  for (const double z : {-0.5, 0.5}) {
    const auto f = cut_into_fragments(body, {plane_sheet(Mat3::Identity(), z, 0.7, 3)}, {});
    ASSERT_EQ(f.size(), 1u);
    EXPECT_NEAR(check(f, body).volume, 1.0, 1e-14);
  }
}

TEST(Fragments, PartialSheetLeavesASlit) {
  const TriMesh body = cube(3);
  const TriMesh half = sheet(-0.8, 0.1, -0.8, 0.8, 6, 6, [](double u, double v) { return Vec3(u, v, 0.03); });
  const auto f = cut_into_fragments(body, {half}, {});
  ASSERT_EQ(f.size(), 1u);
  EXPECT_NEAR(check(f, body).volume, 1.0, 1e-14);
  double fracture = 0;
  Vec3 sum = Vec3::Zero();
  for (std::size_t t = 0; t < f[0].mesh.triangle_count(); ++t)
    if (f[0].face_kind[t] == FaceKind::fracture) {
      fracture += area_vector(f[0].mesh, TriId(t)).norm();
      sum += area_vector(f[0].mesh, TriId(t));
    }
  EXPECT_NEAR(fracture, 2 * 0.6, 1e-14);  // two faces, 0.6 deep, 1 wide
  EXPECT_NEAR(sum.norm(), 0, 1e-14);
  // both faces share nodes along the front only
  std::set<NodeId> up, down;
  for (std::size_t t = 0; t < f[0].mesh.triangle_count(); ++t)
    if (f[0].face_kind[t] == FaceKind::fracture && area_vector(f[0].mesh, TriId(t)).norm() > 1e-12)
      for (const NodeId id : f[0].mesh.corners[TriId(t)])
        (area_vector(f[0].mesh, TriId(t)).z() > 0 ? up : down).insert(id);
  std::vector<NodeId> both;
  std::set_intersection(up.begin(), up.end(), down.begin(), down.end(), std::back_inserter(both));
  EXPECT_GE(both.size(), 3u);
  for (const NodeId id : both)
    EXPECT_NEAR(f[0].mesh.positions[id].x(), 0.1, 1e-15);
}

// One row of triangles, front on both long sides: all edges across it join front nodes.
TEST(Fragments, NarrowSlitsStayClosedAndManifold) {
  const TriMesh body = cube(3);
  for (const double end : {0.8, 0.3}) {
    const TriMesh row =
        sheet(0.1, 0.2, -0.8, end, 1, 7, [](double u, double v) { return Vec3(u, v, 0.03 + 0.1 * u); });
    const auto f = cut_into_fragments(body, {row}, {});
    ASSERT_EQ(f.size(), 1u);
    EXPECT_NEAR(check(f, body).volume, 1.0, 1e-14);
    double fracture = 0;
    for (std::size_t t = 0; t < f[0].mesh.triangle_count(); ++t)
      if (f[0].face_kind[t] == FaceKind::fracture) fracture += area_vector(f[0].mesh, TriId(t)).norm();
    EXPECT_NEAR(fracture, 2 * 0.1 * std::sqrt(1.01) * (std::min(end, 0.5) + 0.5), 1e-13);
  }
}

TEST(Fragments, ALoneTriangleOpensNothing) {
  const TriMesh body = cube(3);
  TriMesh lone;
  lone.positions = {Vec3(0.1, 0, 0), Vec3(0.2, 0, 0), Vec3(0.1, 0.1, 0.05)};
  lone.corners = {{NodeId(0), NodeId(1), NodeId(2)}};
  const auto f = cut_into_fragments(body, {lone}, {});
  ASSERT_EQ(f.size(), 1u);
  EXPECT_NEAR(check(f, body).volume, 1.0, 1e-14);
  EXPECT_EQ(f[0].mesh.triangle_count(), body.triangle_count());
}

TEST(Fragments, CrackInsideIsACavityOfTheOnePiece) {
  const TriMesh body = cube(2);
  const auto f =
      cut_into_fragments(body, {disc(Vec3(0.1, 0, 0), Vec3(1, 0, 0), Vec3(0, 0.6, 0.8), 0.2, 3)}, {});
  ASSERT_EQ(f.size(), 1u);
  EXPECT_NEAR(check(f, body).volume, 1.0, 1e-14);
  EXPECT_EQ(f[0].mesh.triangle_count(), body.triangle_count() + 2 * 54);
}

TEST(Fragments, CrossingAndMeetingSheets) {
  const TriMesh body = cube(3);
  const auto slab = [](double u0, double u1, int axis, double offset) {
    return sheet(u0, u1, -0.8, 0.8, 5, 4, [=](double u, double v) {
      Vec3 x;
      x[axis] = offset;
      x[(axis + 1) % 3] = u;
      x[(axis + 2) % 3] = v;
      return x;
    });
  };
  // x = 0.125 and y = −0.05, both through: four pieces
  auto f = cut_into_fragments(body, {slab(-0.8, 0.8, 0, 0.125), slab(-0.9, 0.9, 1, -0.05)}, {});
  ASSERT_EQ(f.size(), 4u);
  EXPECT_NEAR(check(f, body).volume, 1.0, 1e-14);
  EXPECT_NEAR(f[0].volume, 0.625 * 0.55, 1e-14);
  EXPECT_NEAR(f[3].volume, 0.375 * 0.45, 1e-14);
  // the second ends at the first (its u is z, its v is x): T
  const TriMesh stem_past =
      sheet(-0.8, 0.8, -0.8, 0.13, 5, 4, [](double u, double v) { return Vec3(v, -0.05, u); });
  const TriMesh stem_exact =
      sheet(-0.8, 0.8, -0.875, 0.125, 5, 4, [](double u, double v) { return Vec3(v, -0.05, u); });
  for (const TriMesh& stem : {stem_past, stem_exact}) {
    f = cut_into_fragments(body, {slab(-0.8, 0.8, 0, 0.125), stem}, {});
    ASSERT_EQ(f.size(), 3u);
    EXPECT_NEAR(check(f, body).volume, 1.0, 1e-14);
    EXPECT_NEAR(f[0].volume, 0.375, 1e-14);
    EXPECT_NEAR(f[1].volume, 0.625 * 0.55, 1e-14);
  }
  // two cracks that do not cut through, crossing each other: one piece
  f = cut_into_fragments(body,
                         {disc(Vec3::Zero(), Vec3(1, 0, 0), Vec3(0, 1, 0), 0.3, 3),
                          disc(Vec3::Zero(), Vec3(0, 1, 0), Vec3(0, 0, 1), 0.3, 3)},
                         {});
  ASSERT_EQ(f.size(), 1u);
  EXPECT_NEAR(check(f, body).volume, 1.0, 1e-14);
}

TEST(Fragments, SliversJoinTheirNeighbour) {
  const TriMesh body = cube(3);
  FragmentSettings settings;
  settings.minimum_volume_fraction = 1e-3;
  const TriMesh shaving = plane_sheet(Mat3::Identity(), 0.5 - 5e-4, 0.7, 3);
  auto f = cut_into_fragments(body, {shaving}, settings);
  ASSERT_EQ(f.size(), 1u);
  EXPECT_NEAR(check(f, body).volume, 1.0, 1e-14);
  EXPECT_EQ(std::count(f[0].face_kind.begin(), f[0].face_kind.end(), FaceKind::fracture), 0);
  settings.minimum_volume_fraction = 1e-4;
  f = cut_into_fragments(body, {shaving}, settings);
  ASSERT_EQ(f.size(), 2u);
  EXPECT_NEAR(f[1].volume, 5e-4, 1e-14);
}

TEST(Fragments, RandomCurvedSheetsThroughTheSphere) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::size_t pieces = 0, flat = 0;
  for (int seed = 0; seed < 120; ++seed) {
    const TriMesh body = icosphere(2 + seed % 2);
    std::vector<TriMesh> sheets;
    for (int k = 0; k < 1 + seed % 3; ++k) {
      const Mat3 r = random_rotation(random);
      const double a = 0.3 * uniform(random), d = 0.5 * uniform(random);
      const int n = 3 + seed % 20;
      sheets.push_back(sheet(-1.3, 1.3, -1.3, 1.3, n, n, [&](double u, double v) {
        return Vec3(r * Vec3(u, v, d + a * std::sin(3 * u) * std::cos(2 * v)));
      }));
    }
    const auto f = cut_into_fragments(body, sheets, {});
    const Total total = check(f, body);
    EXPECT_NEAR(total.volume / enclosed_volume(body), 1.0, 1e-12);
    EXPECT_GE(f.size(), 2u);
    pieces += f.size();
    flat += total.flat;
    if (HasFailure()) FAIL() << "seed " << seed;
  }
  EXPECT_GT(pieces, 300u);
  EXPECT_EQ(flat, 0u);
}

TEST(Fragments, MovedAndRotatedBodiesBreakAlike) {
  std::mt19937 random(5);
  const TriMesh body = cube(3), one = plane_sheet(random_rotation(random), 0.1, 1.2, 7),
                two = plane_sheet(random_rotation(random), -0.1, 1.2, 5);
  const auto base = cut_into_fragments(body, {one, two}, {});
  ASSERT_EQ(base.size(), 4u);
  for (int k = 0; k < 10; ++k) {
    const Mat3 r = random_rotation(random);
    const auto move = [&](const Vec3& x) { return Vec3(r * x + Vec3(1e4, -2e4, 3e4)); };
    const TriMesh moved = mapped(body, move);
    const auto f = cut_into_fragments(moved, {mapped(one, move), mapped(two, move)}, {});
    ASSERT_EQ(f.size(), base.size());
    for (std::size_t i = 0; i < f.size(); ++i) {
      EXPECT_TRUE(f[i].watertight);
      EXPECT_NEAR(f[i].volume, base[i].volume, 1e-9);
      EXPECT_EQ(f[i].mesh.triangle_count(), base[i].mesh.triangle_count());
    }
  }
}

TEST(Fragments, SheetsThatPassThroughThemselves) {
  // a curl: the curve (x, z)(u) crosses itself, drawn out along y and tilted
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int seed = 0; seed < 60; ++seed) {
    const TriMesh body = seed % 2 ? icosphere(2) : cube(2 + seed % 5);
    const Mat3 r = random_rotation(random);
    const double size = 0.25 + 0.2 * std::abs(uniform(random)), lean = 0.3 * uniform(random),
                 x0 = 0.5 * uniform(random);
    const int n = 8 + seed % 13;
    const TriMesh curl = sheet(-2.2, 2.2, -1.4, 1.4, 2 * n, n, [&](double u, double v) {
      return Vec3(r * Vec3(x0 + u * u * u * 0.4 - 0.6 * size * u * 3, v + lean * u, size * (1 - u * u)));
    });
    const auto f = cut_into_fragments(body, {curl}, {});
    EXPECT_NEAR(check(f, body).volume / enclosed_volume(body), 1.0, 1e-12);
    if (HasFailure()) FAIL() << "seed " << seed;
  }
}

TEST(Fragments, ManySheetsThroughASlit) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int seed = 0; seed < 200; ++seed) {
    const TriMesh body = cube(1 + seed % 4);
    const Mat3 r = seed % 5 ? random_rotation(random) : Mat3(Mat3::Identity());
    const double d = 0.2 * uniform(random);
    std::vector<TriMesh> sheets{
        seed % 2 ? disc(Vec3(0.1, 0, 0.05), Vec3(1, 0, 0), Vec3(0, 1, 0), 0.3, 4)
                 : sheet(-0.9, 0.05, -0.9, 0.9, 9, 8, [](double u, double v) { return Vec3(u, v, 0.05); })};
    sheets.push_back(plane_sheet(r, d, 1.2, 3 + seed % 5));
    for (int k = 0; k < seed % 4; ++k)
      sheets.push_back(plane_sheet(random_rotation(random), -d, 1.2, 4));
    const auto f = cut_into_fragments(body, sheets, {});
    EXPECT_NEAR(check(f, body).volume, 1.0, 1e-12);
    EXPECT_GE(f.size(), seed % 5 ? 2u : 1u);
    if (HasFailure()) FAIL() << "seed " << seed;
  }
}

TEST(Fragments, DomeOverACrackInside) {
  // a flat disc in the inside and a cap over it, which reaches a little through: they close off a lens
  const TriMesh body = cube(2);
  const TriMesh flat = disc(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), 0.3, 4);
  TriMesh cap = disc(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), 0.28, 5);
  for (Vec3& x : cap.positions)
    x.z() = 0.1 - 2 * x.squaredNorm();
  const auto f = cut_into_fragments(body, {flat, cap}, {});
  ASSERT_EQ(f.size(), 2u);
  EXPECT_NEAR(check(f, body).volume, 1.0, 1e-14);
  EXPECT_NEAR(f[1].volume, std::numbers::pi * 0.1 * 0.1 / 4, 1e-3);  // paraboloid: π h²/(2·2)
}

using FragmentsScan = test::ScanTest;

TEST_P(FragmentsScan, IsCutByAWavyPlane) {
  const TriMesh body = read_mesh(GetParam().file);
  const Box box = bounding_box(body);
  std::mt19937 random(10);
  for (int k = 0; k < 3; ++k) {
    const Mat3 r = random_rotation(random);
    const TriMesh plane = sheet(-120, 120, -120, 120, 60, 60, [&](double u, double v) {
      return Vec3(box.center() + r * Vec3(u, v, 3 * std::sin(0.1 * u)));
    });
    const auto start = std::chrono::steady_clock::now();
    const auto f = cut_into_fragments(body, {plane}, {});
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    RecordProperty("milliseconds", static_cast<int>(1000 * seconds.count()));
    EXPECT_GE(f.size(), 2u);
    EXPECT_NEAR(check(f, body).volume / enclosed_volume(body), 1.0, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Scans, FragmentsScan, testing::ValuesIn(test::scans()), test::scan_name);

TEST(Separation, CountsPiecesOfTheCoarseComplex) {
  const TriMesh body = cube(4);
  EXPECT_EQ(count_pieces(corefine(body, plane_sheet(Mat3::Identity(), 0.1, 0.8, 5))), 2u);
  EXPECT_TRUE(separates(corefine(body, plane_sheet(Mat3::Identity(), 0.0, 0.5, 4))));
  EXPECT_FALSE(separates(corefine(
      body, sheet(-0.8, 0.49, -0.8, 0.8, 6, 6, [](double u, double v) { return Vec3(u, v, 0.03); }))));
  EXPECT_FALSE(separates(corefine(body, plane_sheet(Mat3::Identity(), 0.1, 0.4, 5))));
  EXPECT_FALSE(separates(corefine(body, plane_sheet(Mat3::Identity(), 3.0, 0.4, 5))));
}

}  // namespace
}  // namespace conchoid

#include "conchoid/intersect/corefine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <set>

#include "intersect/cut_shapes.hpp"
#include "mesh/mesh_checks.hpp"

namespace conchoid {
namespace {

using namespace shapes;

Vec3 area_of(const IdVector<NodeId, Vec3>& x, const std::array<NodeId, 3>& c) {
  return 0.5 * area_vector2(x[c[0]], x[c[1]], x[c[2]]);
}

/// What every cut must fulfil. Returns the area of the sheet inside.
double check(const CutComplex& cut, const TriMesh& surface, const TriMesh& sheet) {
  const auto& x = cut.positions;
  EXPECT_EQ(cut.surface_node_count, surface.node_count());
  EXPECT_EQ(cut.sheet_node.size(), x.size());
  EXPECT_EQ(cut.surface_parent.size(), cut.surface.size());
  EXPECT_EQ(cut.sheet_parent.size(), cut.sheet.size());
  bool same_bits = true;
  for (std::size_t i = 0; i < surface.node_count(); ++i)
    same_bits = same_bits && (x[NodeId(i)].array() == surface.positions[NodeId(i)].array()).all();
  EXPECT_TRUE(same_bits) << "surface nodes moved";

  // area vectors of the pieces add up to the parents', and no piece is turned over
  IdVector<TriId, Vec3> sum(surface.triangle_count(), Vec3::Zero());
  IdVector<TriId, double> absolute(surface.triangle_count(), 0.0);
  for (std::size_t p = 0; p < cut.surface.size(); ++p) {
    const Vec3 a = area_of(x, cut.surface[TriId(p)]);
    sum[cut.surface_parent[p]] += a;
    absolute[cut.surface_parent[p]] += a.norm();
  }
  double scale = 0;
  for (const Vec3& p : surface.positions)
    scale = std::max(scale, p.cwiseAbs().maxCoeff());
  for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
    const Vec3 parent = area_vector(surface, TriId(t));
    const double size = std::sqrt(parent.norm());
    EXPECT_LT((sum[TriId(t)] - parent).norm(), 1e-13 * (size + scale) * size) << "surface triangle " << t;
    EXPECT_LT(absolute[TriId(t)] - parent.norm(), 1e-12 * (size + scale) * size) << "surface triangle " << t;
  }

  // edges
  std::map<Edge, int> in_surface, in_sheet;
  std::set<std::pair<NodeId, NodeId>> directed;
  for (const auto& c : cut.surface)
    for (int k = 0; k < 3; ++k) {
      ++in_surface[Edge(c[k], c[(k + 1) % 3])];
      EXPECT_TRUE(directed.insert({c[k], c[(k + 1) % 3]}).second) << "an edge is used twice in one direction";
    }
  for (const auto& [edge, uses] : in_surface)
    EXPECT_EQ(uses, 2);
  std::set<std::pair<NodeId, NodeId>> sheet_directed;
  for (const auto& c : cut.sheet)
    for (int k = 0; k < 3; ++k) {
      ++in_sheet[Edge(c[k], c[(k + 1) % 3])];
      EXPECT_TRUE(sheet_directed.insert({c[k], c[(k + 1) % 3]}).second);
    }
  EXPECT_TRUE(std::is_sorted(cut.mouth.begin(), cut.mouth.end()));
  EXPECT_EQ(std::adjacent_find(cut.mouth.begin(), cut.mouth.end()), cut.mouth.end());
  for (const Edge& e : cut.mouth) {
    EXPECT_EQ(in_surface[e], 2);
    EXPECT_EQ(in_sheet[e], 1);
  }
  std::set<NodeId> surface_nodes;
  for (const auto& c : cut.surface)
    surface_nodes.insert(c.begin(), c.end());
  for (const auto& [edge, uses] : in_sheet)
    if (!std::binary_search(cut.mouth.begin(), cut.mouth.end(), edge)) {
      EXPECT_FALSE(in_surface.contains(edge));
    }

  double area = 0;
  for (const auto& c : cut.sheet)
    area += area_of(x, c).norm();
  (void)sheet;
  return area;
}

/// Area of the polygon where the plane n·x = d meets the cube [−½, ½]³: Sutherland-Hodgman clipping of a
/// large square.
double section_area(const Vec3& n, double d) {
  Vec3 u = std::abs(n.x()) < 0.6 ? cross(n, Vec3(1, 0, 0)) : cross(n, Vec3(0, 1, 0));
  u /= u.norm();
  const Vec3 v = cross(n, u), o = d * n;
  std::vector<Vec3> polygon{o - 9 * u - 9 * v, o + 9 * u - 9 * v, o + 9 * u + 9 * v, o - 9 * u + 9 * v};
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      std::vector<Vec3> next;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double fa = 0.5 - side * a[axis], fb = 0.5 - side * b[axis];
        if (fa >= 0) next.push_back(a);
        if ((fa >= 0) != (fb >= 0)) next.push_back(a + fa / (fa - fb) * (b - a));
      }
      polygon = next;
    }
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    sum += 0.5 * area_vector2(polygon[0], polygon[i], polygon[i + 1]);
  return sum.norm();
}

TEST(Corefine, RandomPlanesThroughTheCubeHaveTheAreaOfTheClippedPlane) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int seed = 0; seed < 200; ++seed) {
    const Mat3 r = random_rotation(random);
    const double d = 0.7 * uniform(random);
    const int n = 1 + seed % 5, m = 1 + seed % 7;
    const TriMesh body = cube(n);
    const TriMesh plane = sheet(-1.5, 1.5, -1.6, 1.4, m, m + 1, [&](double u, double v) {
      return Vec3(u * r.col(0) + v * r.col(1) + d * r.col(2));
    });
    const CutComplex cut = corefine(body, plane);
    EXPECT_NEAR(check(cut, body, plane), section_area(r.col(2), d), 1e-12) << "seed " << seed;
    if (HasFailure()) return;
  }
}

TEST(Corefine, PlanesThroughMeshNodesAndFaces) {
  for (int n = 1; n <= 6; ++n)
    for (int k = 0; k <= n; ++k)
      for (int axis = 0; axis < 3; ++axis)
        for (const double reach : {0.5, 0.75}) {
          const double d = -0.5 + double(k) / n;
          const TriMesh body = cube(n);
          const TriMesh plane = sheet(-reach, reach, -reach, reach, n, n, [&](double u, double v) {
            Vec3 x;
            x[axis] = d;
            x[(axis + 1) % 3] = u;
            x[(axis + 2) % 3] = v;
            return x;
          });
          const CutComplex cut = corefine(body, plane);
          const double area = check(cut, body, plane);
          EXPECT_NEAR(area, k > 0 && k < n ? 1.0 : std::round(area), 1e-12);
          if (HasFailure()) return;
        }
}

TEST(Corefine, RandomCurvedSheetsInTheSphere) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::size_t mouths = 0;
  for (int seed = 0; seed < 200; ++seed) {
    const Mat3 r = random_rotation(random);
    const double a = 0.4 * uniform(random), b = 0.4 * uniform(random), d = 0.5 * uniform(random),
                 size = 0.5 + 0.8 * std::abs(uniform(random));
    const int n = 2 + seed % 17;
    const TriMesh body = icosphere(seed % 4);
    const TriMesh wavy = sheet(-size, size, -size, size, n, n, [&](double u, double v) {
      return Vec3(r * Vec3(u, v, d + a * std::sin(3 * u) * std::cos(2 * v) + b * u * v));
    });
    const CutComplex cut = corefine(body, wavy);
    check(cut, body, wavy);
    mouths += cut.mouth.size();
    for (const auto& c : cut.sheet)
      EXPECT_LT(((cut.positions[c[0]] + cut.positions[c[1]] + cut.positions[c[2]]) / 3.0).norm(), 1.0);
    if (HasFailure()) FAIL() << "seed " << seed;
  }
  EXPECT_GT(mouths, 1000u);
}

double shape(const IdVector<NodeId, Vec3>& x, const std::array<NodeId, 3>& c) {
  double longest = 0;
  for (int k = 0; k < 3; ++k)
    longest = std::max(longest, (x[c[(k + 1) % 3]] - x[c[k]]).squaredNorm());
  return 2 * area_of(x, c).norm() / longest;
}

/// Ends of the mouth: nodes with one mouth edge.
std::size_t mouth_ends(const CutComplex& cut) {
  std::map<NodeId, int> degree;
  for (const Edge& e : cut.mouth) {
    ++degree[e.a];
    ++degree[e.b];
  }
  return static_cast<std::size_t>(
      std::count_if(degree.begin(), degree.end(), [](const auto& d) { return d.second == 1; }));
}

TEST(Corefine, MergingLeavesNoSlivers) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::size_t pieces = 0, slivers = 0, bad_slivers = 0, slivers_before = 0;
  for (int seed = 0; seed < 200; ++seed) {
    const Mat3 r = random_rotation(random);
    const TriMesh body = seed % 2 ? icosphere(1 + seed % 3) : cube(2 + seed % 4);
    const double d = 0.4 * uniform(random), bend = 0.2 * uniform(random), reach = seed % 3 ? 1.3 : 0.45;
    const int n = 3 + seed % 11;
    const TriMesh plane = sheet(-reach, reach + 0.1, -reach, reach, n, n,
                                [&](double u, double v) { return Vec3(r * Vec3(u, v, d + bend * u * v)); });
    const CutComplex exact = corefine(body, plane), cut = corefine(body, plane, {.merge = 0.1});
    const double exact_area = check(exact, body, plane), area = check(cut, body, plane);
    EXPECT_NEAR(area, exact_area, 0.1 * exact_area + 0.02);
    EXPECT_EQ(mouth_ends(cut), mouth_ends(exact));
    for (const auto& c : exact.surface)
      slivers_before += shape(exact.positions, c) < 0.1;
    for (const auto& c : exact.sheet)
      slivers_before += shape(exact.positions, c) < 0.1;
    for (const auto* pieces_of : {&cut.surface, &cut.sheet})
      for (const auto& c : *pieces_of) {
        ++pieces;
        const double q = shape(cut.positions, c);
        slivers += q < 0.1;
        bad_slivers += q < 0.04;
      }
    if (HasFailure()) FAIL() << "seed " << seed;
  }
  EXPECT_GT(pieces, 90000u);
  EXPECT_GT(slivers_before, 0.08 * pieces);
  EXPECT_LT(slivers, 0.012 * pieces);       // altitude below a tenth of the longest edge
  EXPECT_LT(bad_slivers, 0.0015 * pieces);  // … below 4 %
}

TEST(Corefine, SheetThatEndsOnTheFaceOpensThere) {
  // edge crack from the face x = −½, its boundary nodes exactly on it
  for (const double tilt : {0.0, 0.3}) {
    const TriMesh body = cube(4);
    const TriMesh crack = sheet(-0.5, -0.2, -0.5, 0.5, 3, 9,
                                [&](double u, double v) { return Vec3(u, v, 0.06 + tilt * (u + 0.5)); });
    const CutComplex cut = corefine(body, crack, {.merge = 0.1});
    check(cut, body, crack);
    std::size_t on_face = 0;
    double length = 0;
    for (const Edge& e : cut.mouth) {
      const Vec3 &a = cut.positions[e.a], &b = cut.positions[e.b];
      if (a.x() != -0.5 || b.x() != -0.5) continue;
      ++on_face;
      length += (b - a).norm();
    }
    EXPECT_GE(on_face, 9u);
    EXPECT_NEAR(length, 1.0, 1e-14);
    std::set<NodeId> found;
    for (std::size_t i = 0; i < cut.positions.size(); ++i)
      if (cut.sheet_node[NodeId(i)].valid()) {
        EXPECT_TRUE(found.insert(cut.sheet_node[NodeId(i)]).second) << "two nodes for one of the sheet";
        EXPECT_LT((cut.positions[NodeId(i)] - crack.positions[cut.sheet_node[NodeId(i)]]).norm(), 0.04);
      }
    for (std::size_t j = 1; j < 9; ++j)
      EXPECT_TRUE(found.contains(NodeId(4 * j))) << "boundary node " << j << " is lost";
    EXPECT_EQ(mouth_ends(cut), 2u);
  }
}

// A plane sheet stays plane where its nodes must not leave it, however near nodes of the surface lie.
TEST(Corefine, MergingBendsTheSheetNoMoreThanItIsAllowed) {
  const TriMesh body = cube(6);
  double bent = 0;
  for (const double offset : {0.004, 0.008, 0.012, 0.015})
    for (const double tilt : {0.0, 0.01, 0.05}) {
      const TriMesh plane = sheet(-0.71, 0.72, -0.73, 0.71, 9, 9,
                                  [&](double u, double v) { return Vec3(u, v, offset + tilt * u); });
      const Vec3 n = unit_normal(plane, TriId(0)), on = plane.positions[NodeId(0)];
      const auto farthest = [&](const CutComplex& cut) {
        double most = 0;
        for (const Edge& e : cut.mouth)
          for (const NodeId node : {e.a, e.b})
            most = std::max(most, std::abs((cut.positions[node] - on).dot(n)));
        return most;
      };
      bent = std::max(bent, farthest(corefine(body, plane, {.merge = 0.1})));
      EXPECT_LE(farthest(corefine(body, plane, {.merge = 0.1, .across = 0.02})), 0.02 * 0.25)
          << offset << " " << tilt;
    }
  EXPECT_GT(bent, 0.04 * 0.15);  // where they may, they do
}

TEST(Corefine, SheetsInsideAndOutside) {
  const TriMesh body = icosphere(2);
  const TriMesh crack = disc(Vec3(0.1, 0.2, 0), Vec3(1, 0, 0), Vec3(0, 0.6, 0.8), 0.5, 4);
  TriMesh both = crack;  // and a second part far away
  for (const Vec3& x : crack.positions)
    both.positions.push_back(x + Vec3(3, 0, 0));
  for (const auto& c : crack.corners)
    both.corners.push_back({NodeId(c[0].index() + crack.node_count()),
                            NodeId(c[1].index() + crack.node_count()),
                            NodeId(c[2].index() + crack.node_count())});
  for (const TriMesh& sheet : {crack, both})
    for (const double merge : {0.0, 0.1}) {
      const CutComplex cut = corefine(body, sheet, {merge});
      check(cut, body, sheet);
      EXPECT_TRUE(cut.mouth.empty());
      EXPECT_EQ(cut.surface, body.corners);
      EXPECT_EQ(cut.sheet.size(), crack.triangle_count());
      EXPECT_EQ(cut.positions.size(), body.node_count() + crack.node_count());
    }
  const CutComplex outside =
      corefine(body, mapped(crack, [](const Vec3& x) { return Vec3(x + Vec3(3, 0, 0)); }));
  EXPECT_TRUE(outside.sheet.empty());
  EXPECT_EQ(outside.surface, body.corners);
}

TEST(Corefine, GrowingCrackLeavesTheRestAlone) {
  const TriMesh body = icosphere(3);
  const auto at = [](double u, double v) { return Vec3(u, v, 0.1 + 0.2 * std::sin(3 * u)); };
  // rows along v, so that growth in v appends nodes and triangles
  const TriMesh before = sheet(-1.1, 1.1, -1.1, -0.1, 10, 5, at);
  TriMesh after = sheet(-1.1, 1.1, -1.1, 0.1, 10, 6, at);
  std::copy(before.positions.begin(), before.positions.end(), after.positions.begin());  // the same bits
  for (const double merge : {0.0, 0.1}) {
    const CutComplex a = corefine(body, before, {merge}), b = corefine(body, after, {merge});
    std::set<std::array<double, 9>> pieces;
    const auto key = [](const CutComplex& cut, const std::array<NodeId, 3>& c) {
      std::array<double, 9> k;
      for (int i = 0; i < 9; ++i)
        k[i] = cut.positions[c[i / 3]][i % 3];
      return k;
    };
    for (const auto* layer : {&b.surface, &b.sheet})
      for (const auto& c : *layer)
        pieces.insert(key(b, c));
    std::size_t compared = 0;
    for (const auto* layer : {&a.surface, &a.sheet})
      for (const auto& c : *layer) {
        if (a.positions[c[0]].y() > -0.5 || a.positions[c[1]].y() > -0.5 || a.positions[c[2]].y() > -0.5)
          continue;
        ++compared;
        EXPECT_TRUE(pieces.contains(key(a, c)));
      }
    EXPECT_GT(compared, 100u);
  }
}

struct Scene {
  TriMesh body, sheet;
};

/// Bodies and sheets in special position (nodes of each on faces, edges and nodes of the other) and in
/// general position.
Scene scene(int seed, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Mat3 r = random_rotation(random);
  const int n = 2 + seed % 4;
  const double d = 0.3 * uniform(random), bend = 0.3 * uniform(random);
  switch (seed % 4) {
    case 0:
      return {cube(n), shapes::sheet(-0.5, 0.75, -0.5, 0.5, 2 * n, n,
                                     [](double u, double v) { return Vec3(u, v, 0); })};
    case 1:
      return {cube(4), shapes::sheet(-0.75, 0.75, -0.75, 0.75, 6, 6,
                                     [](double u, double v) { return Vec3(u, v, 0.5 * (u + v)); })};
    case 2:
      return {icosphere(2), shapes::sheet(-1.2, 0.6, -1, 1.3, 7, 8, [&](double u, double v) {
                return Vec3(r * Vec3(u, v, d + bend * u * v));
              })};
    default:
      return {cube(n), disc(Vec3(0.5, 0, 0), Vec3(0, 1, 0), Vec3(0.6, 0, 0.8), 0.5, 4)};
  }
}

void expect_same_bits(const CutComplex& a, const CutComplex& b) {
  ASSERT_EQ(a.positions.size(), b.positions.size());
  for (std::size_t i = 0; i < a.positions.size(); ++i)
    EXPECT_TRUE((a.positions[NodeId(i)].array() == b.positions[NodeId(i)].array()).all());
  EXPECT_EQ(a.sheet_node, b.sheet_node);
  EXPECT_EQ(a.surface, b.surface);
  EXPECT_EQ(a.surface_parent, b.surface_parent);
  EXPECT_EQ(a.sheet, b.sheet);
  EXPECT_EQ(a.sheet_parent, b.sheet_parent);
  EXPECT_EQ(a.mouth, b.mouth);
}

void turn_round(IdVector<TriId, std::array<NodeId, 3>>& pieces) {
  for (auto& c : pieces) {
    std::swap(c[1], c[2]);
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
  }
}

TEST(Corefine, ReflectedAndScaledInputGivesTheSameBits) {
  std::mt19937 random(6);
  for (int seed = 0; seed < 40; ++seed)
    for (const double merge : {0.0, 0.1}) {
      const Scene s = scene(seed, random);
      CutComplex cut = corefine(s.body, s.sheet, {merge});
      check(cut, s.body, s.sheet);
      for (const double factor : {0x1p-20, 8.0, 0x1p60}) {
        const auto grow = [&](const Vec3& x) { return Vec3(factor * x); };
        CutComplex scaled = corefine(mapped(s.body, grow), mapped(s.sheet, grow), {merge});
        for (Vec3& x : scaled.positions)
          x /= factor;
        expect_same_bits(scaled, cut);
      }
      CutComplex reflected = corefine(mirrored(s.body, 0), mirrored(s.sheet, 0), {merge});
      for (Vec3& x : reflected.positions)
        x.x() = -x.x();
      turn_round(reflected.surface);
      turn_round(reflected.sheet);
      for (auto* pieces : {&cut.surface, &cut.sheet})
        for (auto& c : *pieces)
          std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
      expect_same_bits(reflected, cut);
      if (HasFailure()) FAIL() << "seed " << seed << " merge " << merge;
    }
}

TEST(Corefine, AlmostSpecialPositionsStayValid) {
  std::mt19937 random(7);
  for (int seed = 0; seed < 120; ++seed)
    for (const double merge : {0.0, 0.1}) {
      const Scene s = scene(seed, random);
      const Mat3 r = random_rotation(random);
      const Vec3 shift = seed % 3 ? Vec3(10.0 * (seed % 7), -1, 3) : Vec3(0, 0, 0);
      const auto move = [&](const Vec3& x) { return Vec3(r * x + shift); };
      const TriMesh body = mapped(s.body, move), sheet = mapped(s.sheet, move);
      check(corefine(body, sheet, {merge}), body, sheet);
      if (HasFailure()) FAIL() << "seed " << seed << " merge " << merge;
    }
}

TEST(Corefine, TwentyThousandByHundredThousandTriangles) {
  const TriMesh body = icosphere(6),
                wavy = shapes::sheet(-1.2, 1.2, -1.2, 1.2, 100, 100, [](double u, double v) {
                  return Vec3(u, v, 0.1 * std::sin(9 * u) * std::cos(7 * v));
                });
  const auto start = std::chrono::steady_clock::now();
  const CutComplex cut = corefine(body, wavy);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  RecordProperty("milliseconds", static_cast<int>(1000 * seconds));
  check(cut, body, wavy);
}

}  // namespace
}  // namespace conchoid

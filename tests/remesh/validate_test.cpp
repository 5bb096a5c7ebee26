#include "conchoid/remesh/validate.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <random>

#include "conchoid/core/error.hpp"
#include "conchoid/intersect/self_intersection.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/mesh/models.hpp"
#include "mesh/mesh_checks.hpp"

namespace conchoid {
namespace {

std::set<DefectKind> kinds(const TriMesh& mesh) {
  std::set<DefectKind> found;
  for (const MeshDefect& defect : find_defects(mesh))
    found.insert(defect.kind);
  return found;
}

struct BrokenMesh {
  const char* name;
  std::function<void(TriMesh&)> damage;  ///< done to the cube of 120 triangles
  DefectKind kind;
  std::vector<std::string> fragments;
};

const std::vector<BrokenMesh> broken_meshes = {
    {"hole", [](TriMesh& m) { m.corners.pop_back(); }, DefectKind::open_edge, {"hole", "close"}},
    {"flipped",
     [](TriMesh& m) { std::swap(m.corners[TriId(7)][0], m.corners[TriId(7)][1]); },
     DefectKind::inconsistent_edge,
     {"7", "flip"}},
    {"duplicate",
     [](TriMesh& m) { m.corners.push_back(m.corners[TriId(3)]); },
     DefectKind::duplicate,
     {"3 and 120", "remove"}},
    {"turned duplicate",
     [](TriMesh& m) {
       const auto c = m.corners[TriId(3)];
       m.corners.push_back({c[2], c[1], c[0]});
     },
     DefectKind::duplicate,
     {"3 and 120"}},
    {"NaN",
     [](TriMesh& m) { m.positions[NodeId(5)].y() = std::nan(""); },
     DefectKind::not_finite,
     {"node 5", "finite"}},
    {"infinite",
     [](TriMesh& m) { m.positions[NodeId(6)].x() = INFINITY; },
     DefectKind::not_finite,
     {"node 6"}},
    {"index",
     [](TriMesh& m) { m.corners[TriId(9)][2] = NodeId(62); },
     DefectKind::index_out_of_range,
     {"triangle 9", "62"}},
    {"negative index",
     [](TriMesh& m) { m.corners[TriId(9)][2] = NodeId(); },
     DefectKind::index_out_of_range,
     {"triangle 9", "-1"}},
    {"node twice",
     [](TriMesh& m) { m.corners[TriId(9)][2] = m.corners[TriId(9)][0]; },
     DefectKind::repeated_node,
     {"triangle 9", "twice"}},
    {"collapsed",
     [](TriMesh& m) { m.positions[m.corners[TriId(0)][1]] = m.positions[m.corners[TriId(0)][0]]; },
     DefectKind::degenerate,
     {"triangle 0", "no area"}},
    {"fin",
     [](TriMesh& m) {
       const NodeId tip = m.positions.add(Vec3(0, 0, 2));
       m.corners.push_back({m.corners[TriId(0)][0], m.corners[TriId(0)][1], tip});
     },
     DefectKind::crowded_edge,
     {"more than two", "120"}},
    {"loose node",
     [](TriMesh& m) { m.positions.push_back(Vec3(3, 3, 3)); },
     DefectKind::unused_node,
     {"node 62"}},
    {"inside out", [](TriMesh& m) { m = flipped(m); }, DefectKind::inside_out, {"inward", "flip"}},
    {"two cubes at a node",
     [](TriMesh& m) {
       TriMesh other = m;
       const auto corner = [](const TriMesh& mesh, const Vec3& x) {
         return NodeId(static_cast<std::size_t>(std::find(mesh.positions.begin(), mesh.positions.end(), x) -
                                                mesh.positions.begin()));
       };
       const NodeId here = corner(m, Vec3(0.5, 0.5, 0.5));
       const NodeId there(corner(other, Vec3(-0.5, -0.5, -0.5)).value +
                          static_cast<std::int32_t>(m.node_count()));
       append(m, other, Vec3::Ones());
       for (auto& c : m.corners)
         for (NodeId& n : c)
           if (n == there) n = here;
     },
     DefectKind::pinched_node,
     {"touch only there"}},
    {"overlapping cubes",
     [](TriMesh& m) { append(m, TriMesh(m), Vec3(0.3, 0.2, 0.1)); },
     DefectKind::self_intersection,
     {"intersect", "repair"}},
    {"touching cubes",
     [](TriMesh& m) { append(m, TriMesh(m), Vec3(1, 0, 0)); },
     DefectKind::self_intersection,
     {"intersect"}},
    {"the cube twice",
     [](TriMesh& m) { append(m, TriMesh(m)); },
     DefectKind::self_intersection,
     {"intersect"}},
    {"cavity outward",
     [](TriMesh& m) { append(m, icosphere(0.2, 1)); },
     DefectKind::inside_out,
     {"cavity", "120"}},
    {"body beside it inward",
     [](TriMesh& m) { append(m, flipped(icosphere(0.2, 1)), Vec3(2, 0, 0)); },
     DefectKind::inside_out,
     {"triangle 120", "inward"}},
    {"flattened",
     [](TriMesh& m) {
       for (Vec3& x : m.positions)
         x.z() = 0;
     },
     DefectKind::degenerate,
     {"no area"}},
    {"thin as nothing",
     [](TriMesh& m) {
       m = {};
       m.positions.assign({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.3, 0.3, 1e-14)});
       m.corners.assign({{NodeId(0), NodeId(2), NodeId(1)},
                         {NodeId(0), NodeId(1), NodeId(3)},
                         {NodeId(1), NodeId(2), NodeId(3)},
                         {NodeId(2), NodeId(0), NodeId(3)}});
     },
     DefectKind::no_volume,
     {"no volume", "thickness"}},
    {"nothing", [](TriMesh& m) { m = {}; }, DefectKind::empty, {"no triangles"}},
    {"node pushed through the far face",
     [](TriMesh& m) {
       for (Vec3& x : m.positions)
         if (x == Vec3(0, 0, 0.5)) x.z() = -0.7;
     },
     DefectKind::self_intersection,
     {"intersect"}},
};

TEST(RequireValidBody, NamesEveryKindOfDefectWithItsPlace) {
  for (const BrokenMesh& broken : broken_meshes) {
    TriMesh mesh = built_in_model("cube").mesh;
    broken.damage(mesh);
    EXPECT_TRUE(kinds(mesh).contains(broken.kind)) << broken.name;
    try {
      require_valid_body(mesh, "cube.ply");
      ADD_FAILURE() << broken.name << " was accepted";
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.rfind("cube.ply: ", 0), 0u) << message;
      for (const std::string& fragment : broken.fragments)
        EXPECT_NE(message.find(fragment), std::string::npos)
            << broken.name << ": '" << fragment << "' not in: " << message;
    }
  }
}

TEST(RequireValidBody, AcceptsBodiesWithCavitiesAndSeveralParts) {
  TriMesh mesh = built_in_model("cube").mesh;
  append(mesh, flipped(icosphere(0.4, 1)));
  append(mesh, icosphere(0.2, 1));
  append(mesh, icosphere(0.2, 1), Vec3(3, 0, 0));
  EXPECT_NO_THROW(require_valid_body(mesh, "nested"));
}

TEST(RequireValidBody, DoesNotCareForSizeOrPlace) {
  for (const double scale : {1e-9, 1.0, 1e9}) {
    TriMesh mesh = icosphere(1, 3);
    for (Vec3& x : mesh.positions)
      x = scale * (x + Vec3(1e4, -2e4, 1e4));
    EXPECT_NO_THROW(require_valid_body(mesh, "ball")) << scale;
    std::swap(mesh.positions[NodeId(100)], mesh.positions[NodeId(300)]);
    EXPECT_THROW(require_valid_body(mesh, "ball"), InputError) << scale;
  }
}

TEST(RequireValidSheet, OpenSheetsMayBeOpenButNotFoldedOrTwisted) {
  TriMesh disc = disc_crack(Vec3::Zero(), Vec3(1, 2, 3), 1, {.triangles = 150});
  EXPECT_NO_THROW(require_valid_sheet(disc, "disc"));
  EXPECT_THROW(require_valid_body(disc, "disc"), InputError);
  TriMesh twisted = disc;
  std::swap(twisted.corners[TriId(4)][0], twisted.corners[TriId(4)][1]);
  EXPECT_THROW(require_valid_sheet(twisted, "twisted"), InputError);
  TriMesh folded;  // two triangles on the same side of their common edge
  folded.positions.assign({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.5, 0.5, 0)});
  folded.corners.assign({{NodeId(0), NodeId(1), NodeId(2)}, {NodeId(1), NodeId(0), NodeId(3)}});
  EXPECT_THROW(require_valid_sheet(folded, "folded"), InputError);
  folded.positions[NodeId(3)] = Vec3(0.5, -0.5, 0);
  EXPECT_NO_THROW(require_valid_sheet(folded, "unfolded"));
  append(disc, disc_crack(Vec3(0.1, 0, 0), Vec3(3, 2, -1), 1, {.triangles = 150}));
  EXPECT_THROW(require_valid_sheet(disc, "crossing"), InputError);
}

/// Slow oracle: every pair.
std::vector<std::pair<TriId, TriId>> all_pairs(const TriMesh& mesh) {
  std::vector<std::pair<TriId, TriId>> pairs;
  for (std::size_t s = 0; s < mesh.triangle_count(); ++s)
    for (std::size_t t = s + 1; t < mesh.triangle_count(); ++t)
      if (triangles_intersect(mesh, TriId(s), TriId(t))) pairs.emplace_back(TriId(s), TriId(t));
  return pairs;
}

TEST(SelfIntersections, AgreeWithTheTestOfAllPairs) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    TriMesh mesh;
    for (int n = 0; n < 150; ++n)
      mesh.positions.push_back(Vec3(uniform(random), uniform(random), uniform(random)));
    const double size = trial % 2 == 0 ? 0.1 : 1.0;
    for (int n = 0; n < 150; n += 3) {
      mesh.positions[NodeId(n + 1)] = mesh.positions[NodeId(n)] + size * mesh.positions[NodeId(n + 1)];
      mesh.positions[NodeId(n + 2)] = mesh.positions[NodeId(n)] + size * mesh.positions[NodeId(n + 2)];
      mesh.corners.push_back({NodeId(n), NodeId(n + 1), NodeId(n + 2)});
    }
    for (int t = 0; t < 50; ++t)  // some that share nodes
      mesh.corners.push_back({NodeId(t), NodeId(t + 40), NodeId(t + 90)});
    auto pairs = all_pairs(mesh);
    EXPECT_EQ(self_intersections(mesh, 1000000), pairs) << trial;
    std::vector<TriId> some;
    for (int t = trial % 3; t < 100; t += 3)
      some.emplace_back(t);
    auto of_some = pairs;
    std::erase_if(of_some, [&](const auto& pair) {
      return pair.first.index() % 3 != some[0].index() && pair.second.index() % 3 != some[0].index();
    });
    EXPECT_EQ(self_intersections(mesh, some, 1000000), of_some) << trial;
    of_some.resize(std::min<std::size_t>(of_some.size(), 5));
    EXPECT_EQ(self_intersections(mesh, some, 5), of_some) << trial;
    pairs.resize(std::min<std::size_t>(pairs.size(), 7));
    EXPECT_EQ(self_intersections(mesh, 7), pairs) << "the first ones, whichever way they were found";
  }
}

/// Slow oracle for one pair that uses no signs of determinants: the smallest distance between dense samples
/// of both triangles.
double sampled_distance(const Triangle& a, const Triangle& b) {
  constexpr int n = 24;
  double smallest = 1e300;
  auto sample = [](const Triangle& t, int i, int j) {
    return Vec3(t[0] + (t[1] - t[0]) * (double(i) / n) + (t[2] - t[0]) * (double(j) / n));
  };
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j) {
      const Vec3 x = sample(a, i, j);
      for (int k = 0; k <= n; ++k)
        for (int l = 0; k + l <= n; ++l)
          smallest = std::min(smallest, (x - sample(b, k, l)).squaredNorm());
    }
  return std::sqrt(smallest);
}

TEST(TrianglesIntersect, AgreesWithTheDistanceOfSampledPoints) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int meeting = 0, apart = 0;
  for (int trial = 0; trial < 60; ++trial) {
    TriMesh mesh;
    for (int n = 0; n < 6; ++n)
      mesh.positions.push_back(Vec3(uniform(random), uniform(random), 0.7 * uniform(random)));
    mesh.corners.assign({{NodeId(0), NodeId(1), NodeId(2)}, {NodeId(3), NodeId(4), NodeId(5)}});
    const double distance = sampled_distance(mesh.triangle(TriId(0)), mesh.triangle(TriId(1)));
    const bool meet = triangles_intersect(mesh, TriId(0), TriId(1));
    meeting += meet;
    apart += !meet;
    constexpr double spacing =
        2.0 / 24;  // edges are shorter than 3.2, samples of meeting triangles closer than this
    if (meet) {
      EXPECT_LT(distance, 1.5 * spacing) << trial;
    } else {
      EXPECT_GT(distance, 0.0) << trial;
    }
    if (distance > 1.5 * spacing) {
      EXPECT_FALSE(meet) << trial;
    }
  }
  EXPECT_GT(meeting, 10);
  EXPECT_GT(apart, 10);
}

TEST(TrianglesIntersect, DecidesTouchingExactly) {
  TriMesh mesh;
  mesh.positions.assign({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.25, 0.25, 0),
                         Vec3(0.25, 0.25, 1), Vec3(0.5, 0.25, 1)});
  mesh.corners.assign({{NodeId(0), NodeId(1), NodeId(2)}, {NodeId(3), NodeId(4), NodeId(5)}});
  EXPECT_TRUE(triangles_intersect(mesh, TriId(0), TriId(1)));  // a corner on the face
  mesh.positions[NodeId(3)].z() = 1e-300;
  EXPECT_FALSE(triangles_intersect(mesh, TriId(0), TriId(1)));
  mesh.positions[NodeId(3)].z() = -1e-300;
  EXPECT_TRUE(triangles_intersect(mesh, TriId(0), TriId(1)));
  // Coplanar: one inside the other, then beside it.
  mesh.positions[NodeId(3)] = Vec3(0.1, 0.1, 0);
  mesh.positions[NodeId(4)] = Vec3(0.2, 0.1, 0);
  mesh.positions[NodeId(5)] = Vec3(0.1, 0.2, 0);
  EXPECT_TRUE(triangles_intersect(mesh, TriId(0), TriId(1)));
  for (int n = 3; n < 6; ++n)
    mesh.positions[NodeId(n)] += Vec3(1, 1, 0);
  EXPECT_FALSE(triangles_intersect(mesh, TriId(0), TriId(1)));
}

TEST(SelfIntersections, NoneInARotatedBoxOfCoplanarTriangles) {
  TriMesh box = box_mesh({1, 2, 3}, 20, 30, 40);
  Mat3 rotation;
  rotation << 0.36, 0.48, -0.8, -0.8, 0.6, 0, 0.48, 0.64, 0.6;
  for (Vec3& x : box.positions)
    x = rotation * x + Vec3(17, 5, 3);
  EXPECT_TRUE(self_intersections(box, 10).empty());
}

TEST(FindDefects, EightyThousandTrianglesTakeSeconds) {
  const TriMesh ball = icosphere(1, 6);  // 81,920
  TriMesh two = ball;
  for (Vec3& x : two.positions)
    x *= 1 + 0.05 * std::sin(20 * x.x()) * std::cos(17 * x.y());
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(find_defects(two).empty());
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  RecordProperty("seconds", std::to_string(seconds));
  EXPECT_LT(seconds, 10.0);  // under two where nothing else runs; sanitizers and busy machines get room
}

}  // namespace
}  // namespace conchoid

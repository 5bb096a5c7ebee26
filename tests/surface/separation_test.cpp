#include "conchoid/surface/separation.hpp"

#include <gtest/gtest.h>

#include <map>

#include "conchoid/core/error.hpp"
#include "conchoid/core/random.hpp"
#include "intersect/cut_shapes.hpp"

namespace conchoid {
namespace {

/// What is whole: nothing cuts it.
CutComplex uncut(const TriMesh& mesh) {
  CutComplex cut;
  cut.positions = mesh.positions;
  cut.surface_node_count = mesh.node_count();
  cut.sheet_node.resize(mesh.node_count());
  cut.surface = mesh.corners;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    cut.surface_parent.emplace_back(t);
  return cut;
}

TriMesh tetrahedron() {
  TriMesh mesh;
  mesh.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  const auto add = [&](int a, int b, int c) { mesh.corners.push_back({NodeId(a), NodeId(b), NodeId(c)}); };
  add(0, 2, 1);
  add(0, 1, 3);
  add(1, 2, 3);
  add(2, 0, 3);
  return mesh;
}

/// Corners joined edge by edge, all of them: numbers of vertices in the order in which faces have them.
std::vector<std::array<std::int32_t, 3>> vertices_by_edges(const CutComplex& cut, const Shells& shells) {
  const std::size_t surface = cut.surface.size(), sheet = cut.sheet.size(), faces = surface + 2 * sheet;
  UnionFind corners(3 * faces);
  const auto join_along = [&](const Edge& e, std::size_t f, std::size_t g) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const NodeId a = shells.corners[f][i], b = shells.corners[f][(i + 1) % 3];
        if (Edge(a, b) != e || shells.corners[g][k] != b || shells.corners[g][(k + 1) % 3] != a) continue;
        corners.join(3 * f + i, 3 * g + (k + 1) % 3);
        corners.join(3 * f + (i + 1) % 3, 3 * g + k);
      }
  };
  const auto runs = [&](std::size_t f, const Edge& e) {
    for (std::size_t i = 0; i < 3; ++i)
      if (shells.corners[f][i] == e.a && shells.corners[f][(i + 1) % 3] == e.b) return true;
    return false;
  };
  std::map<std::pair<NodeId, NodeId>, std::vector<std::size_t>> at;
  for (std::size_t f = 0; f < surface + sheet; ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge e(shells.corners[f][i], shells.corners[f][(i + 1) % 3]);
      at[{e.a, e.b}].push_back(f);
    }
  for (const auto& [nodes, around] : at) {
    const Edge e(nodes.first, nodes.second);
    const auto join = [&](std::size_t f, std::size_t g) { join_along(e, f, g); };
    std::vector<std::size_t> on_surface, on_sheet;
    for (const std::size_t f : around)
      (f < surface ? on_surface : on_sheet).push_back(f);
    if (on_sheet.empty()) {
      join(on_surface.at(0), on_surface.at(1));
    } else if (on_surface.empty() && on_sheet.size() == 1) {
      join(on_sheet[0], on_sheet[0] + sheet);
    } else if (on_surface.empty()) {
      const bool same = runs(on_sheet.at(0), e) != runs(on_sheet.at(1), e);
      join(on_sheet[0], same ? on_sheet[1] : on_sheet[1] + sheet);
      join(on_sheet[0] + sheet, same ? on_sheet[1] + sheet : on_sheet[1]);
    } else {
      for (const std::size_t f : on_surface)
        join(f, runs(f, e) != runs(on_sheet.at(0), e) ? on_sheet[0] : on_sheet[0] + sheet);
    }
  }
  std::map<std::size_t, std::int32_t> number;
  std::vector<std::array<std::int32_t, 3>> vertex(faces);
  for (std::size_t f = 0; f < faces; ++f)
    for (std::size_t k = 0; k < 3; ++k)
      vertex[f][k] =
          number.try_emplace(corners.root(3 * f + k), static_cast<std::int32_t>(number.size())).first->second;
  return vertex;
}

TEST(Gluing, JoinsTheSameCornersAsEdgesDoOneByOne) {
  const TriMesh body = shapes::icosphere(3);
  Random random(5);
  for (int round = 0; round < 30; ++round) {
    const double reach = random.uniform(0.3, 1.5), height = random.uniform(-0.8, 0.8),
                 bend = random.uniform(0, 0.3);
    const TriMesh sheet = shapes::sheet(-1.2, reach, -1.2, 1.2, 13, 11, [&](double u, double v) {
      return Vec3(u, v, height + bend * u * v);
    });
    const CutComplex cut = corefine(body, sheet);
    const Shells shells = glue(cut);
    EXPECT_EQ(shells.vertex, vertices_by_edges(cut, shells)) << round;
    EXPECT_EQ(shells.volume.size(), reach > 1.2 ? 2u : shells.volume.size());
  }
}

TEST(Gluing, PartsThatTouchInANodeAreApart) {
  TriMesh mesh = tetrahedron();
  const TriMesh one = mesh;
  for (std::size_t n = 1; n < one.node_count(); ++n)
    mesh.positions.push_back(-one.positions[NodeId(n)]);
  for (auto c : one.corners) {
    for (NodeId& n : c)
      if (n.index() > 0) n = NodeId(n.index() + 3);
    std::swap(c[1], c[2]);
    mesh.corners.push_back(c);
  }
  const Shells shells = glue(uncut(mesh));
  EXPECT_EQ(shells.volume.size(), 2u);
  EXPECT_EQ(shells.vertex_count, 8u);
  for (const double volume : shells.volume)
    EXPECT_NEAR(volume, 1.0 / 6, 1e-15);
}

TEST(Gluing, RefusesEdgesWithMoreOrLessThanTwoTriangles) {
  TriMesh open = shapes::icosphere(1);
  open.corners.pop_back();
  EXPECT_THROW(glue(uncut(open)), ComputationError);
  TriMesh twice = shapes::icosphere(1);
  twice.corners.push_back(twice.corners.back());
  EXPECT_THROW(glue(uncut(twice)), ComputationError);
}

}  // namespace
}  // namespace conchoid

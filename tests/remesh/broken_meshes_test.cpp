// Every defect alone and in pairs, on three bodies: mended where it is, without a new surface.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "conchoid/mesh/corners.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/remesh/repair.hpp"
#include "conchoid/remesh/separate_bodies.hpp"
#include "conchoid/remesh/validate.hpp"
#include "mesh/mesh_checks.hpp"

namespace conchoid {
namespace {

/// A ring with round section.
TriMesh torus(double radius, double thickness, int around, int section) {
  TriMesh mesh;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < section; ++j) {
      const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * j / section;
      const double r = radius + thickness * std::cos(b);
      mesh.positions.push_back(Vec3(r * std::cos(a), r * std::sin(a), thickness * std::sin(b)));
    }
  const auto node = [&](int i, int j) {
    return NodeId(static_cast<std::size_t>((i % around) * section + j % section));
  };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < section; ++j) {
      mesh.corners.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      mesh.corners.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  return mesh;
}

double mean_edge(const TriMesh& mesh) {
  return std::sqrt(surface_area(mesh) / static_cast<double>(mesh.triangle_count()) * 4 / std::sqrt(3.0));
}

// Each takes a share of the triangles apart that no other one uses.

/// A node in the middle of an edge that one neighbour knows only by a flat triangle.
void flat_triangle(TriMesh& m) {
  const TriId t(m.triangle_count() / 8);
  const auto [a, b, c] = m.corners[t];
  const NodeId middle = m.positions.add(0.5 * (m.positions[a] + m.positions[b]));
  m.corners[t] = {a, middle, c};
  m.corners.push_back({middle, b, c});
  m.corners.push_back({a, b, middle});
}

/// The same without the flat triangle: a hole without area.
void open_junction(TriMesh& m) {
  const TriId t(m.triangle_count() / 4);
  const auto [a, b, c] = m.corners[t];
  const NodeId middle = m.positions.add(0.5 * (m.positions[a] + m.positions[b]));
  m.corners[t] = {a, middle, c};
  m.corners.push_back({middle, b, c});
}

/// A seam: the triangles of one half have their own nodes, a little off.
void loose_seam(TriMesh& m) {
  const double off = 1e-7 * mean_edge(m), x = bounding_box(m).center().x() + 0.1234 * mean_edge(m);
  IdVector<NodeId, NodeId> copy(m.node_count());
  for (auto& corners : m.corners) {
    const Vec3 center = (m.positions[corners[0]] + m.positions[corners[1]] + m.positions[corners[2]]) / 3;
    if (center.x() < x) continue;
    for (NodeId& n : corners) {
      if (n.index() >= copy.size()) continue;
      if (!copy[n].valid()) copy[n] = m.positions.add(m.positions[n] + off * Vec3(0.3, -0.2, 0.4));
      n = copy[n];
    }
  }
}

/// A triangle there twice, another one turned over.
void doubled_and_turned(TriMesh& m) {
  m.corners.push_back(m.corners[TriId(m.triangle_count() / 3)]);
  std::swap(m.corners[TriId(2)][0], m.corners[TriId(2)][1]);
}

/// One triangle is missing.
void hole(TriMesh& m) {
  m.corners.erase(m.corners.begin() + static_cast<long>(m.triangle_count() / 2));
}

/// A tent on two neighbouring triangles, and the floor in it.
void inner_wall(TriMesh& m) {
  const TriId t(2 * m.triangle_count() / 3);
  const auto [a, b, c] = m.corners[t];
  const NodeId top = m.positions.add(centroid(m, t) + 0.05 * mean_edge(m) * unit_normal(m, t));
  m.corners.push_back({a, b, top});
  m.corners.push_back({b, c, top});
  m.corners.push_back({c, a, top});
}

/// A fin: a triangle that stands on an edge.
void fin(TriMesh& m) {
  const TriId t(5 * m.triangle_count() / 8);
  const auto [a, b, c] = m.corners[t];
  const NodeId top =
      m.positions.add(0.5 * (m.positions[a] + m.positions[b]) + mean_edge(m) * unit_normal(m, t));
  m.corners.push_back({a, b, top});
  m.corners.push_back({b, a, top});
}

/// A small hollow whose tip is a node of the surface: outside and hollow touch there.
void pinch(TriMesh& m) {
  const TriId t(3 * m.triangle_count() / 4);
  const NodeId a = m.corners[t][0];
  const Vec3 n = unit_normal(m, t), x = m.positions[a];
  const double e = 0.1 * mean_edge(m);
  const Vec3 u = cross(n, Vec3(0.3, 0.5, 0.8)).normalized(), v = cross(n, u);
  const NodeId p = m.positions.add(x - e * (n + 0.4 * u)),
               q = m.positions.add(x - e * (n - 0.3 * u + 0.4 * v)),
               r = m.positions.add(x - e * (n - 0.3 * u - 0.4 * v));
  TriMesh hollow;
  hollow.positions = m.positions;
  hollow.corners = {{p, q, r}, {a, q, p}, {a, r, q}, {a, p, r}};
  const bool outward = (hollow.positions[p] - x).dot(area_vector(hollow, TriId(0))) > 0;
  for (const auto& c : hollow.corners)
    m.corners.push_back(outward ? std::array{c[0], c[2], c[1]} : c);
}

/// A small hollow that opens in an edge of the surface, whose ends are tips of it.
void pocket(TriMesh& m) {
  const TriId t(m.triangle_count() / 5);
  const NodeId a = m.corners[t][0], b = m.corners[t][1];
  const Vec3 x = 0.5 * (m.positions[a] + m.positions[b]);
  Vec3 n = Vec3::Zero();
  for (std::size_t s = 0; s < m.triangle_count(); ++s)
    if (has(m.corners[TriId(s)], a) && has(m.corners[TriId(s)], b)) n += unit_normal(m, TriId(s));
  n.normalize();
  const Vec3 across = cross(n, (m.positions[b] - m.positions[a]).normalized());
  const double e = 0.1 * mean_edge(m);
  const NodeId p = m.positions.add(x - e * (n + 0.3 * across)),
               q = m.positions.add(x - e * (n - 0.3 * across));
  for (const auto& c : {std::array{a, b, p}, {b, a, q}, {a, p, q}, {b, q, p}})
    m.corners.push_back(c);
}

/// A node of a rather flat part pushed inward, through the other side of the body.
void spike(TriMesh& m) {
  const auto is_flat_at = [&](NodeId n, const Vec3& normal) {
    for (std::size_t s = 0; s < m.triangle_count(); ++s)
      if (has(m.corners[TriId(s)], n) && unit_normal(m, TriId(s)).dot(normal) < 0.8) return false;
    return true;
  };
  std::size_t i = 7 * m.triangle_count() / 8;
  while (!is_flat_at(m.corners[TriId(i)][0], unit_normal(m, TriId(i))))
    ++i;
  const TriId t(i);
  const NodeId a = m.corners[t][0];
  const Vec3 inward = -unit_normal(m, t);
  while (find_defects(m, 1).empty())
    m.positions[a] += 0.3 * mean_edge(m) * inward;
}

struct Defect {
  const char* name;
  std::function<void(TriMesh&)> make;
};
const std::vector<Defect> defects = {{"spike", spike},
                                     {"flat", flat_triangle},
                                     {"junction", open_junction},
                                     {"hole", hole},
                                     {"doubled", doubled_and_turned},
                                     {"wall", inner_wall},
                                     {"fin", fin},
                                     {"pinch", pinch},
                                     {"pocket", pocket},
                                     {"seam", loose_seam}};

struct Broken {
  std::string name;
  TriMesh mesh;
  double volume;  ///< of the body before it was broken
};

std::vector<Broken> broken_meshes() {
  const std::vector<std::pair<std::string, TriMesh>> bodies = {
      {"box", box_mesh(Vec3(3, 2, 1), 9, 6, 3)}, {"ball", icosphere(1, 3)}, {"ring", torus(1, 0.3, 40, 16)}};
  std::vector<Broken> all;
  const auto add = [&](std::size_t body, std::size_t i, std::size_t j) {
    Broken b{bodies[body].first + "." + defects[i].name, bodies[body].second, 0};
    b.volume = enclosed_volume(b.mesh);
    defects[i].make(b.mesh);
    if (j != i) {
      defects[j].make(b.mesh);
      b.name += std::string("+") + defects[j].name;
    }
    all.push_back(std::move(b));
  };
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    for (std::size_t i = 0; i < defects.size(); ++i)
      add(body, i, i);
    for (std::size_t i = 0; i < defects.size(); ++i)
      for (std::size_t j = i + 1; j < defects.size(); ++j)
        add(body, i, j);
  }
  return all;
}

TriMesh two(const TriMesh& body, const Vec3& shift) {
  TriMesh mesh = body;
  append(mesh, body, shift);
  return mesh;
}

}  // namespace

TEST(BrokenMeshes, EveryDefectAloneAndInPairsIsMendedWhereItIs) {
  const std::vector<Broken> all = broken_meshes();
  EXPECT_GE(all.size(), 30u);
  for (const Broken& b : all) {
    SCOPED_TRACE(b.name);
    EXPECT_FALSE(find_defects(b.mesh).empty());
    const Repair repair = repaired(b.mesh);
    EXPECT_TRUE(repair.method == RepairMethod::tidying || repair.method == RepairMethod::mending);
    EXPECT_EQ(needed_repair(b.mesh), repair.method);
    EXPECT_TRUE(find_defects(repair.mesh).empty());
    EXPECT_EQ(separate_bodies(repair.mesh).size(), 1u) << "a scene takes one body";
    EXPECT_NEAR(repair.volume_after, b.volume, 1e-3 * b.volume);
    EXPECT_LE(repair.mesh.triangle_count(), b.mesh.triangle_count() * 3 / 2);
    if (repair.method == RepairMethod::mending) {
      EXPECT_NE(repair.mending.text(), "");
    }
  }
}

TEST(BrokenMeshes, ASpikeThroughTheBodyIsCutOffAndClosed) {
  for (const TriMesh& body : {box_mesh(Vec3(3, 2, 1), 9, 6, 3), icosphere(1, 3), torus(1, 0.3, 40, 16)}) {
    TriMesh mesh = body;
    spike(mesh);
    ASSERT_FALSE(find_defects(mesh).empty());
    const Repair repair = repaired(mesh);
    EXPECT_EQ(repair.method, RepairMethod::mending);
    EXPECT_GT(repair.mending.cut_triangles, 0u);
    EXPECT_NEAR(repair.volume_after, enclosed_volume(body), 1e-3 * enclosed_volume(body));
  }
}

TEST(BrokenMeshes, OverlappingBodiesBecomeOne) {
  const double pi = std::numbers::pi;
  const TriMesh ball = icosphere(1, 3);
  const Repair balls = repaired(two(ball, Vec3(1.02, 0.03, 0.05)));
  EXPECT_EQ(balls.method, RepairMethod::mending);
  EXPECT_EQ(balls.mending.united_bodies, 1u);
  EXPECT_NE(balls.mending.text().find("united"), std::string::npos);
  EXPECT_EQ(separate_bodies(balls.mesh).size(), 1u);
  const double d = Vec3(1.02, 0.03, 0.05).norm(), lens = pi * (4 + d) * (2 - d) * (2 - d) / 12;
  EXPECT_NEAR(balls.volume_after, 2 * enclosed_volume(ball) - lens, 0.02 * lens);
  EXPECT_LE(balls.mesh.triangle_count(), 2 * ball.triangle_count() * 3 / 2);

  // Boxes that share planes, edges and parts of faces: nothing is in general position.
  const TriMesh box = box_mesh(Vec3(1, 1, 1), 2, 2, 2);
  const double half = enclosed_volume(box) / 2;
  for (const Vec3& shift : {Vec3(0.5, 0, 0), Vec3(0.5, 0.5, 0), Vec3(0.5, 0.5, 0.5), Vec3(0.25, 0, 0)}) {
    SCOPED_TRACE(shift.transpose());
    const Repair boxes = repaired(two(box, shift));
    EXPECT_EQ(boxes.method, RepairMethod::mending);
    EXPECT_EQ(separate_bodies(boxes.mesh).size(), 1u);
    const double overlap = (1 - shift.x()) * (1 - shift.y()) * (1 - shift.z());
    EXPECT_NEAR(boxes.volume_after, 4 * half - overlap, 1e-9);
  }
  // A small box on a large one, and one that touches it along an edge or in a point.
  TriMesh stacked = box;
  append(stacked, box_mesh(Vec3(0.5, 0.5, 0.5), 1, 1, 1), Vec3(0.1, 0.05, 0.75));
  const Repair stack = repaired(stacked);
  EXPECT_EQ(stack.method, RepairMethod::mending);
  EXPECT_EQ(separate_bodies(stack.mesh).size(), 1u);
  EXPECT_NEAR(stack.volume_after, 1.125, 1e-9);
}

TEST(BrokenMeshes, BodiesThatOnlyTouchArePartedAndCounted) {
  const TriMesh box = box_mesh(Vec3(1, 1, 1), 2, 2, 2);
  for (const Vec3& shift : {Vec3(1, 1, 0), Vec3(1, 1, 1)}) {
    const Repair repair = repaired(two(box, shift));
    EXPECT_EQ(repair.method, RepairMethod::mending);
    EXPECT_GT(repair.mending.split_nodes, 0u);
    EXPECT_EQ(separate_bodies(repair.mesh).size(), 2u);
    EXPECT_NEAR(repair.volume_after, 2, 2e-3);
  }
  const Repair joined = repaired(two(box, Vec3(1, 0, 0)));  // a whole face in common
  EXPECT_EQ(joined.mending.inner_walls, 8u);
  EXPECT_EQ(separate_bodies(joined.mesh).size(), 1u);
  EXPECT_NEAR(joined.volume_after, 2, 1e-12);
}

TEST(BrokenMeshes, ALevelSetKeepsSharpEdgesAndFewTriangles) {
  TriMesh mesh = box_mesh(Vec3(2, 1, 1), 2, 1, 1);
  mesh.corners.erase(mesh.corners.begin() + 3);
  const Repair repair = repaired(mesh, 0.05);
  EXPECT_EQ(repair.method, RepairMethod::level_set);
  EXPECT_TRUE(find_defects(repair.mesh).empty());
  EXPECT_LT(repair.mesh.triangle_count(), repair.lattice_triangles / 8);
  EXPECT_NEAR(repair.volume_after, 2, 2e-3);
  EXPECT_LT(repair.lost, 0.01) << "corners are where they were";
}

}  // namespace conchoid

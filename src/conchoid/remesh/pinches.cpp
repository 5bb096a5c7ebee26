#include "conchoid/remesh/pinches.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <vector>

#include "conchoid/core/union_find.hpp"
#include "conchoid/intersect/unfold.hpp"
#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/remesh/edge_sides.hpp"

namespace conchoid {
namespace {

/// The two triangles on both sides of a wedge of the inside.
using Wedge = std::array<TriId, 2>;

/// Of an edge, by what lies around it: between two sides lies the inside if both look away from it.
std::vector<Wedge> wedges_of(const std::vector<EdgeSide>& around) {
  std::vector<Wedge> wedges;
  for (std::size_t i = 0; i < around.size(); ++i) {
    const EdgeSide &now = around[i], &next = around[(i + 1) % around.size()];
    if (around.size() > 1 && !now.forward && next.forward) wedges.push_back({now.triangle, next.triangle});
  }
  return wedges;
}

/// Corner k of triangle t is number 3t + k; joined corners belong to one fan.
class Fans {
 public:
  explicit Fans(const TriMesh& mesh) : mesh_(mesh), corners_(3 * mesh.triangle_count()) {
    for_each_edge(sides_by_edge(mesh), [&](auto begin, auto end) {
      if (end - begin == 2) return join(begin->triangle, (begin + 1)->triangle, begin->edge);
      const std::vector<EdgeSide> around = around_edge(mesh, {begin, end});
      for (const Wedge& wedge : wedges_of(around))
        join(wedge[0], wedge[1], begin->edge);
    });
  }
  std::size_t root(TriId t, std::size_t k) { return corners_.root(3 * t.index() + k); }

 private:
  std::size_t number(TriId t, NodeId n) const {
    const auto& c = mesh_.corners[t];
    return 3 * t.index() + (c[0] == n ? 0u : c[1] == n ? 1u : 2u);
  }
  void join(TriId s, TriId t, const Edge& e) {
    for (const NodeId n : {e.a, e.b})
      corners_.join(number(s, n), number(t, n));
  }

  const TriMesh& mesh_;
  UnionFind corners_;
};

struct Fan {
  std::vector<TriId> triangles;
  Vec3 outward = Vec3::Zero();
};

Vec3 outward_of(const TriMesh& mesh, const std::vector<TriId>& triangles) {
  std::vector<Vec3> normals;
  for (const TriId t : triangles)
    normals.push_back(unit_normal(mesh, t));
  const Vec3 best = common_direction(normals);
  return best.isZero(0) ? std::accumulate(normals.begin(), normals.end(), Vec3(Vec3::Zero())) : best;
}

/// Whether a point y near the node lies on the inner side of a fan.
bool lies_inside(const TriMesh& mesh, NodeId node, const Fan& fan, const Vec3& y) {
  const Vec3& x = mesh.positions[node];
  double nearest = std::numeric_limits<double>::infinity();
  Vec3 away = Vec3::Zero(), normal = Vec3::Zero();
  for (const TriId t : fan.triangles) {
    const Vec3 p = closest_point_on_triangle(mesh.triangle(t), y);
    const double distance = (y - p).norm();
    if (distance < nearest * (1 - 1e-9)) normal = Vec3::Zero();
    if (distance > nearest * (1 + 1e-9)) continue;
    nearest = std::min(nearest, distance);
    away = y - p;
    normal += p == x ? fan.outward : unit_normal(mesh, t);
  }
  return away.dot(normal) < 0;
}

bool holds(const TriMesh& mesh, NodeId node, const Fan& fan, const Fan& other, double reach) {
  const Vec3& x = mesh.positions[node];
  int inside = 0, outside = 0;
  for (const TriId t : other.triangles)
    ++(lies_inside(mesh, node, fan, x + reach * (centroid(mesh, t) - x).normalized()) ? inside : outside);
  return inside > outside;
}

/// Halves the triangles of a wedge at an edge by a node of their own.
void part_wedge(TriMesh& mesh, const Edge& edge, const Wedge& wedge, std::vector<TriId>& halved) {
  const Vec3 &a = mesh.positions[edge.a], &b = mesh.positions[edge.b];
  const Vec3 outward = unit_normal(mesh, wedge[0]) + unit_normal(mesh, wedge[1]);
  const Vec3 at = 0.5 * (a + b) - pinch_gap * (b - a).norm() * outward.normalized();
  const NodeId middle = mesh.positions.add(at);
  for (const TriId t : wedge) {
    auto other = mesh.corners[t];
    std::replace(mesh.corners[t].begin(), mesh.corners[t].end(), edge.b, middle);
    std::replace(other.begin(), other.end(), edge.a, middle);
    mesh.corners.push_back(other);
    halved.push_back(t);
  }
}

}  // namespace

std::size_t split_pinches(TriMesh& mesh) {
  if (mesh.corners.empty()) return 0;
  Fans fans(mesh);
  std::map<NodeId, std::map<std::size_t, std::vector<TriId>>> fans_of;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      fans_of[mesh.corners[TriId(t)][k]][fans.root(TriId(t), k)].push_back(TriId(t));
  std::erase_if(fans_of, [](const auto& node) { return node.second.size() < 2; });

  const TriMesh before = mesh;
  std::size_t added = 0;
  for (const auto& [node, all] : fans_of) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const auto& [root, triangles] : all)
      for (const TriId t : triangles)
        for (const NodeId n : before.corners[t])
          if (n != node) shortest = std::min(shortest, (before.positions[n] - before.positions[node]).norm());
    std::vector<Fan> parts;
    for (const auto& [root, triangles] : all)
      parts.push_back({triangles, outward_of(before, triangles)});
    for (std::size_t f = 0; f < parts.size(); ++f) {
      bool hollow = false;
      for (std::size_t g = 0; g < parts.size(); ++g)
        hollow = hollow || (g != f && holds(before, node, parts[f], parts[g], 0.1 * shortest));
      const Vec3 at = before.positions[node] + (hollow ? 1 : -1) * pinch_gap * shortest * parts[f].outward;
      const NodeId copy = f == 0 ? node : mesh.positions.add(at);
      mesh.positions[copy] = at;
      if (f > 0) ++added;
      for (const TriId t : parts[f].triangles)
        for (std::size_t k = 0; k < 3; ++k)
          if (before.corners[t][k] == node) mesh.corners[t][k] = copy;
    }
  }
  return added;
}

std::size_t part_edges(TriMesh& mesh, std::vector<TriId>& halved) {
  constexpr int most_rounds = 3;  // where such edges have a triangle in common
  std::size_t added = 0;
  bool again = true;
  for (int round = 0; round < most_rounds && again; ++round) {
    again = false;
    std::vector<std::pair<Edge, std::vector<Wedge>>> edges;
    std::vector<char> taken(mesh.triangle_count(), 0);
    for_each_edge(sides_by_edge(mesh), [&](auto begin, auto end) {
      if (end - begin <= 2) return;
      std::vector<Wedge> wedges = wedges_of(around_edge(mesh, {begin, end}));
      if (2 * wedges.size() != static_cast<std::size_t>(end - begin)) return;
      if (std::any_of(begin, end, [&](const EdgeSide& s) { return taken[s.triangle.index()] != 0; })) {
        again = true;
        return;
      }
      for (auto side = begin; side != end; ++side)
        taken[side->triangle.index()] = 1;
      edges.emplace_back(begin->edge, std::move(wedges));
    });
    for (const auto& [edge, wedges] : edges)
      for (const Wedge& wedge : wedges) {
        part_wedge(mesh, edge, wedge, halved);
        ++added;
      }
  }
  return added;
}

}  // namespace conchoid

#include "conchoid/mesh/surface_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>

#include "conchoid/core/interrupt.hpp"
#include "conchoid/core/union_find.hpp"
#include "conchoid/mesh/sort_by_edge.hpp"
#include "conchoid/mesh/winding_number.hpp"

namespace conchoid {
namespace {

/// For each undirected edge: how often it is run through from a to b, less from b to a; zeros are left out.
std::vector<std::pair<Edge, int>> unbalanced_edges(const TriMesh& mesh) {
  std::vector<std::pair<Edge, int>> sides;
  sides.reserve(3 * mesh.triangle_count());
  for (const auto& c : mesh.corners)
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeId p = c[k], q = c[(k + 1) % 3];
      if (p != q) sides.emplace_back(Edge(p, q), p < q ? 1 : -1);
    }
  throw_if_interrupted();
  sort_by_edge(sides, mesh.node_count(), [](const auto& side) { return side.first; });
  std::vector<std::pair<Edge, int>> sums;
  for (std::size_t i = 0; i < sides.size();) {
    int sum = 0;
    const std::size_t first = i;
    for (; i < sides.size() && sides[i].first == sides[first].first; ++i)
      sum += sides[i].second;
    if (sum != 0) sums.emplace_back(sides[first].first, sum);
  }
  return sums;
}

bool contains(const Box& outer, const Box& inner) {
  return (outer.low.array() <= inner.low.array()).all() && (inner.high.array() <= outer.high.array()).all();
}

/// Some nodes of the inner part are looked at: one that crosses the outer part is not within it.
bool lies_within(const TriMesh& inner, const TriMesh& outer) {
  constexpr std::size_t looked_at = 16;
  const std::size_t step = std::max<std::size_t>(1, inner.node_count() / looked_at);
  for (std::size_t n = 0; n < inner.node_count(); n += step)
    if (std::abs(winding_number(outer, inner.positions[NodeId(n)])) < 0.5) return false;
  return true;
}

void find_depths(const TriMesh& mesh, std::vector<SurfacePart>& parts) {
  if (parts.size() < 2) return;
  std::vector<TriMesh> meshes;
  std::vector<Box> boxes;
  for (const SurfacePart& part : parts) {
    meshes.push_back(submesh(mesh, part.triangles));
    boxes.push_back(bounding_box(meshes.back()));
  }
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (std::size_t q = 0; q < parts.size(); ++q, throw_if_interrupted())
      if (p != q && contains(boxes[q], boxes[p]) && lies_within(meshes[p], meshes[q])) ++parts[p].depth;
}

}  // namespace

std::vector<TriMesh> split_parts(const TriMesh& mesh) {
  const std::vector<int> part = connected_parts(mesh);
  std::vector<TriMesh> parts(part.empty() ? 0 : 1 + *std::max_element(part.begin(), part.end()));
  std::vector<NodeId> moved(mesh.node_count());
  for (std::size_t i = 0; i < mesh.node_count(); ++i)
    moved[i] = parts[part[i]].positions.add(mesh.positions[NodeId(i)]);
  for (const auto& c : mesh.corners)
    parts[part[c[0].index()]].corners.push_back(
        {moved[c[0].index()], moved[c[1].index()], moved[c[2].index()]});
  return parts;
}

TriMesh submesh(const TriMesh& mesh, const std::vector<TriId>& triangles) {
  TriMesh part;
  IdVector<NodeId, NodeId> ids(mesh.node_count());
  for (TriId t : triangles) {
    throw_if_interrupted();
    std::array<NodeId, 3> corners = mesh.corners[t];
    for (NodeId& n : corners) {
      if (!ids[n].valid()) ids[n] = part.positions.add(mesh.positions[n]);
      n = ids[n];
    }
    part.corners.push_back(corners);
  }
  return part;
}

std::vector<SurfacePart> surface_parts(const TriMesh& mesh) {
  const std::vector<int> part_of_node = connected_parts(mesh);
  std::map<int, std::size_t> place;
  std::vector<SurfacePart> parts;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    throw_if_interrupted();
    const int name = part_of_node[mesh.corners[TriId(t)][0].index()];
    const auto [found, fresh] = place.try_emplace(name, parts.size());
    if (fresh) parts.emplace_back().closed = true;
    parts[found->second].triangles.push_back(TriId(t));
  }
  throw_if_interrupted();
  for (const auto& [edge, sum] : unbalanced_edges(mesh))
    parts[place.at(part_of_node[edge.a.index()])].closed = false;
  for (SurfacePart& part : parts) {
    // About a point of its own: the volume of an open surface depends on it.
    const auto& first = mesh.triangle(part.triangles.front());
    Box box{first[0], first[0]};
    for (TriId t : part.triangles)
      for (const Vec3& x : mesh.triangle(t)) {
        box.low = box.low.cwiseMin(x);
        box.high = box.high.cwiseMax(x);
      }
    for (TriId t : part.triangles) {
      throw_if_interrupted();
      const Triangle x = mesh.triangle(t);
      const Vec3 a = x[0] - box.center(), b = x[1] - box.center(), c = x[2] - box.center();
      part.volume += a.dot(cross(b, c)) / 6;
      part.area += area_vector(mesh, t).norm();
    }
  }
  find_depths(mesh, parts);
  return parts;
}

std::vector<BoundaryLoop> boundary_loops(const TriMesh& mesh) {
  std::map<NodeId, std::vector<NodeId>> next;  // nodes that can be reached, the smallest last
  for (const auto& [edge, sum] : unbalanced_edges(mesh))
    for (int i = 0; i < std::abs(sum); ++i)
      sum > 0 ? next[edge.a].push_back(edge.b) : next[edge.b].push_back(edge.a);
  for (auto& [node, reached] : next)
    std::sort(reached.rbegin(), reached.rend());

  std::vector<BoundaryLoop> loops;
  for (auto& [start, reached] : next)
    while (!reached.empty()) {
      // A walk that comes back to one of its nodes has closed a simple loop there.
      std::vector<NodeId> walk = {start};
      std::map<NodeId, std::size_t> place = {{start, 0}};
      while (!next[walk.back()].empty()) {
        std::vector<NodeId>& choices = next[walk.back()];
        const NodeId to = choices.back();
        choices.pop_back();
        const auto [found, fresh] = place.try_emplace(to, walk.size());
        if (fresh) {
          walk.push_back(to);
          continue;
        }
        const auto from = walk.begin() + static_cast<std::ptrdiff_t>(found->second);
        loops.emplace_back(from, walk.end());
        for (auto n = from + 1; n != walk.end(); ++n)
          place.erase(*n);
        walk.erase(from + 1, walk.end());
      }
    }
  for (BoundaryLoop& loop : loops)
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  std::sort(loops.begin(), loops.end());
  return loops;
}

TriMesh part_within(const Box& box, const TriMesh& mesh) {
  std::vector<TriId> within;
  for (TriId t(0); t.index() < mesh.triangle_count(); ++t.value)
    if (overlap(box_of(mesh.triangle(t)), box)) within.push_back(t);
  return submesh(mesh, within);
}

TriMesh join(const std::vector<TriMesh>& meshes) {
  TriMesh all;
  for (const TriMesh& mesh : meshes) {
    const std::size_t first = all.node_count();
    all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
    for (const auto& c : mesh.corners)
      all.corners.push_back(
          {NodeId(c[0].index() + first), NodeId(c[1].index() + first), NodeId(c[2].index() + first)});
  }
  return all;
}

TriMesh split_fans(const TriMesh& mesh, double gap) {
  if (mesh.corners.empty()) return mesh;
  const auto place = [&](TriId t, NodeId n) {
    const auto& c = mesh.corners[t];
    return 3 * t.index() + static_cast<std::size_t>(std::find(c.begin(), c.end(), n) - c.begin());
  };
  UnionFind corners(3 * mesh.triangle_count());
  const auto neighbours = triangle_neighbours(mesh);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (const TriId other = neighbours[TriId(t)][k]; other.valid())
        for (const NodeId n : {mesh.corners[TriId(t)][k], mesh.corners[TriId(t)][(k + 1) % 3]})
          corners.join(place(TriId(t), n), place(other, n));
  std::map<NodeId, std::vector<std::size_t>> fans;  // roots
  for (std::size_t i = 0; i < 3 * mesh.triangle_count(); ++i)
    if (corners.root(i) == i) fans[mesh.corners[TriId(i / 3)][i % 3]].push_back(i);
  TriMesh out = mesh;
  std::map<std::size_t, NodeId> copy;  // by root
  for (const auto& [node, roots] : fans)
    for (std::size_t f = 0; roots.size() > 1 && f < roots.size(); ++f)
      copy[roots[f]] = f == 0 ? node : out.positions.add(mesh.positions[node]);
  std::map<NodeId, Vec3> towards;
  for (std::size_t i = 0; i < 3 * mesh.triangle_count(); ++i)
    if (const auto at = copy.find(corners.root(i)); at != copy.end()) {
      const TriId t(i / 3);
      out.corners[t][i % 3] = at->second;
      const Vec3 way = centroid(mesh, t) - mesh.positions[mesh.corners[t][i % 3]];
      towards.try_emplace(at->second, Vec3::Zero()).first->second += way;
    }
  for (const auto& [node, way] : towards)
    if (way.norm() > 0) out.positions[node] += gap * way.normalized();
  return out;
}

}  // namespace conchoid

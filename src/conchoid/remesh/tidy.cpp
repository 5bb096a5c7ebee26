#include "conchoid/remesh/tidy.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>
#include <vector>

#include "conchoid/core/interrupt.hpp"
#include "conchoid/mesh/place.hpp"
#include "conchoid/mesh/surface_parts.hpp"
#include "conchoid/remesh/editable_mesh.hpp"
#include "conchoid/remesh/flat_triangles.hpp"

namespace conchoid {
namespace {

bool is_useful(const TriMesh& mesh, TriId t, bool flat_ones_are_useless) {
  const auto& c = mesh.corners[t];
  if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) return false;
  return !flat_ones_are_useless || flatness(mesh.triangle(t)) > flattest_triangle;
}

void turn(std::array<NodeId, 3>& corners) {
  std::swap(corners[1], corners[2]);
}

/// Neighbours across edges of exactly two triangles, and whether the two run through the edge the same way.
struct Link {
  TriId triangle;
  bool against;
};

IdVector<TriId, std::vector<Link>> links(const TriMesh& mesh) {
  struct Side {
    Edge edge;
    TriId triangle;
    bool forward;
  };
  std::vector<Side> sides;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeId p = mesh.corners[TriId(t)][k], q = mesh.corners[TriId(t)][(k + 1) % 3];
      sides.push_back({Edge(p, q), TriId(t), p < q});
    }
  std::stable_sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.edge < b.edge; });
  IdVector<TriId, std::vector<Link>> result(mesh.triangle_count());
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].edge == sides[i].edge)
      ++end;
    if (end - i == 2) {
      const bool against = sides[i].forward == sides[i + 1].forward;
      result[sides[i].triangle].push_back({sides[i + 1].triangle, against});
      result[sides[i + 1].triangle].push_back({sides[i].triangle, against});
    }
    i = end;
  }
  return result;
}

}  // namespace

std::size_t merge_equal_nodes(TriMesh& mesh) {
  const IdVector<NodeId, NodeId> kept = first_at_place(mesh);
  std::size_t merged = 0;
  for (std::size_t n = 0; n < kept.size(); ++n)
    merged += kept[NodeId(n)] != NodeId(n);
  for (auto& c : mesh.corners)
    for (NodeId& n : c)
      n = kept[n];
  return merged;
}

std::size_t drop_useless_triangles(TriMesh& mesh, bool flat_ones) {
  std::vector<std::pair<std::array<NodeId, 3>, TriId>> keys;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!is_useful(mesh, TriId(t), flat_ones)) continue;
    keys.emplace_back(mesh.corners[TriId(t)], TriId(t));
    std::sort(keys.back().first.begin(), keys.back().first.end());
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(
      std::unique(keys.begin(), keys.end(), [](const auto& a, const auto& b) { return a.first == b.first; }),
      keys.end());
  std::vector<TriId> kept;
  for (const auto& key : keys)
    kept.push_back(key.second);
  std::sort(kept.begin(), kept.end());
  const std::size_t removed = mesh.triangle_count() - kept.size();
  IdVector<TriId, std::array<NodeId, 3>> corners;
  for (TriId t : kept)
    corners.push_back(mesh.corners[t]);
  mesh.corners = std::move(corners);
  return removed;
}

std::size_t drop_unused_nodes(TriMesh& mesh) {
  IdVector<NodeId, char> used(mesh.node_count());
  for (const auto& c : mesh.corners)
    for (NodeId n : c)
      used[n] = 1;
  IdVector<NodeId, NodeId> ids(mesh.node_count());
  IdVector<NodeId, Vec3> positions;
  for (std::size_t n = 0; n < used.size(); ++n)
    if (used[NodeId(n)]) ids[NodeId(n)] = positions.add(mesh.positions[NodeId(n)]);
  for (auto& c : mesh.corners)
    for (NodeId& n : c)
      n = ids[n];
  const std::size_t removed = mesh.node_count() - positions.size();
  mesh.positions = std::move(positions);
  return removed;
}

std::size_t turn_parts(TriMesh& mesh) {
  std::size_t turned = 0;
  for (const SurfacePart& part : surface_parts(mesh))
    if (part.inside_out()) {
      for (TriId t : part.triangles)
        turn(mesh.corners[t]);
      turned += part.triangles.size();
    }
  return turned;
}

void orient_neighbours_alike(TriMesh& mesh) {
  const auto neighbours = links(mesh);
  IdVector<TriId, char> seen(mesh.triangle_count()), turned(mesh.triangle_count());
  for (std::size_t first = 0; first < mesh.triangle_count(); ++first) {
    throw_if_interrupted();
    if (seen[TriId(first)]) continue;
    std::vector<TriId> patch = {TriId(first)};
    seen[TriId(first)] = 1;
    double kept_area = 0, turned_area = 0;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      const TriId t = patch[i];
      (turned[t] ? turned_area : kept_area) += area_vector(mesh, t).norm();
      for (const Link& link : neighbours[t]) {
        if (seen[link.triangle]) continue;
        seen[link.triangle] = 1;
        turned[link.triangle] = link.against ? !turned[t] : turned[t];
        patch.push_back(link.triangle);
      }
    }
    const bool turn_the_others = turned_area > kept_area;
    for (TriId t : patch)
      if ((turned[t] != 0) != turn_the_others) turn(mesh.corners[t]);
  }
}

TriMesh tidied(const TriMesh& mesh, TidyReport& report) {
  TriMesh out = mesh;
  report.merged_nodes = merge_equal_nodes(out);
  report.removed_triangles = drop_useless_triangles(out);
  const auto before = out.corners;
  orient_neighbours_alike(out);
  turn_parts(out);
  report.turned_triangles = 0;
  for (std::size_t t = 0; t < before.size(); ++t)
    report.turned_triangles += before[TriId(t)] != out.corners[TriId(t)];
  report.removed_nodes = drop_unused_nodes(out) - report.merged_nodes;
  return out;
}

}  // namespace conchoid

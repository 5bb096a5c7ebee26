#include "conchoid/remesh/feature_lines.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace conchoid {
namespace {

std::vector<Edge> sharp_edges(const TriMesh& mesh, double angle) {
  const double limit = std::cos(angle);
  const auto neighbours = triangle_neighbours(mesh);
  std::vector<Edge> sharp;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const TriId other = neighbours[TriId(t)][k];
      if (!other.valid() || other < TriId(t)) continue;
      const auto& c = mesh.corners[TriId(t)];
      if (unit_normal(mesh, TriId(t)).dot(unit_normal(mesh, other)) < limit)
        sharp.emplace_back(c[k], c[(k + 1) % 3]);
    }
  std::sort(sharp.begin(), sharp.end());
  return sharp;
}

/// Drops connected groups of edges that are shorter together than `shortest_line`.
std::vector<Edge> long_lines(const TriMesh& mesh, const std::vector<Edge>& edges, double shortest_line) {
  std::map<NodeId, std::vector<std::size_t>> at_node;
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (NodeId n : {edges[e].a, edges[e].b})
      at_node[n].push_back(e);
  std::vector<bool> seen(edges.size(), false);
  std::vector<Edge> kept;
  for (std::size_t first = 0; first < edges.size(); ++first) {
    if (seen[first]) continue;
    std::vector<std::size_t> line = {first};
    seen[first] = true;
    double length = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const Edge e = edges[line[i]];
      length += (mesh.positions[e.a] - mesh.positions[e.b]).norm();
      for (NodeId n : {e.a, e.b})
        for (std::size_t next : at_node[n])
          if (!seen[next]) {
            seen[next] = true;
            line.push_back(next);
          }
    }
    if (length >= shortest_line)
      for (std::size_t e : line)
        kept.push_back(edges[e]);
  }
  return kept;
}

}  // namespace

FeatureLines::FeatureLines(const TriMesh& mesh, double angle, double shortest_line)
    : at_node_(mesh.node_count()), kind_(mesh.node_count(), Kind::free) {
  for (const Edge& e : long_lines(mesh, sharp_edges(mesh, angle), shortest_line))
    insert(e);
  const double straight = std::cos(angle);
  for (std::size_t n = 0; n < mesh.node_count(); ++n) {
    const auto& ends = at_node_[NodeId(n)];
    if (ends.size() == 2) {
      const Vec3 before = mesh.positions[NodeId(n)] - mesh.positions[ends[0]];
      const Vec3 after = mesh.positions[ends[1]] - mesh.positions[NodeId(n)];
      kind_[NodeId(n)] = before.normalized().dot(after.normalized()) < straight ? Kind::corner : Kind::crease;
    } else {
      kind_[NodeId(n)] = ends.empty() ? Kind::free : Kind::corner;
    }
  }
}

FeatureLines::Kind FeatureLines::kind(NodeId n) const {
  return n.index() < kind_.size() ? kind_[n] : Kind::free;
}

std::array<NodeId, 2> FeatureLines::along(NodeId n) const {
  return {at_node_[n][0], at_node_[n][1]};
}

std::optional<FeatureLines::Merge> FeatureLines::merge(const Edge& e) const {
  const Kind a = kind(e.a), b = kind(e.b);
  if (a == Kind::free && b == Kind::free) return Merge{e.b, e.a, true};
  if (a == Kind::free) return Merge{e.a, e.b, false};
  if (b == Kind::free) return Merge{e.b, e.a, false};
  if (!contains(e) || (a == Kind::corner && b == Kind::corner)) return std::nullopt;
  const Merge merge = a == Kind::corner   ? Merge{e.b, e.a, false}
                      : b == Kind::corner ? Merge{e.a, e.b, false}
                                          : Merge{e.b, e.a, false};
  for (NodeId beyond : along(merge.removed))
    if (beyond != merge.kept && contains(Edge(beyond, merge.kept)))
      return std::nullopt;  // a line of three edges
  return merge;
}

std::vector<NodeId>& FeatureLines::lines_at(NodeId n) {
  if (n.index() >= at_node_.size()) {
    at_node_.resize(n.index() + 1);
    kind_.resize(n.index() + 1, Kind::free);
  }
  return at_node_[n];
}

void FeatureLines::insert(const Edge& e) {
  edges_.insert(e);
  lines_at(e.a).push_back(e.b);
  lines_at(e.b).push_back(e.a);
}

void FeatureLines::erase(const Edge& e) {
  edges_.erase(e);
  std::erase(lines_at(e.a), e.b);
  std::erase(lines_at(e.b), e.a);
}

void FeatureLines::was_split(const Edge& e, NodeId middle) {
  if (!contains(e)) return;
  erase(e);
  insert(Edge(e.a, middle));
  insert(Edge(middle, e.b));
  kind_[middle] = Kind::crease;
}

void FeatureLines::was_collapsed(NodeId removed, NodeId kept) {
  if (kind(removed) == Kind::free) return;
  const std::vector<NodeId> ends = at_node_[removed];
  for (NodeId end : ends) {
    erase(Edge(removed, end));
    if (end != kept) insert(Edge(kept, end));
  }
}

}  // namespace conchoid

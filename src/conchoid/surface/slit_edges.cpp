#include "conchoid/surface/slit_edges.hpp"

#include <algorithm>
#include <map>

#include "conchoid/mesh/corners.hpp"
#include "conchoid/mesh/sort_by_edge.hpp"

namespace conchoid {
namespace {

std::vector<EdgeUse> sheet_edges(const CutComplex& cut) {
  return edge_uses(cut.sheet, cut.positions.size());
}

bool on_mouth(const CutComplex& cut, const Edge& e) {
  return std::binary_search(cut.mouth.begin(), cut.mouth.end(), e);
}

bool is_front(const CutComplex& cut, const Edge& e, int count) {
  return count == 1 && !on_mouth(cut, e);
}

// Per node whether it is on the front.
std::vector<char> front_nodes(const CutComplex& cut, const std::vector<EdgeUse>& edges) {
  std::vector<char> front(cut.positions.size(), 0);
  for (const auto& [e, n] : edges)
    if (is_front(cut, e, n)) front[e.a.index()] = front[e.b.index()] = 1;
  return front;
}

// Few triangles: all of what has to be looked at more closely has its corners there.
bool all_on(const std::vector<char>& front, const Corners& c) {
  return front[c[0].index()] && front[c[1].index()] && front[c[2].index()];
}

// Whether there were some.
bool leave_out_loose_pieces(CutComplex& cut, const std::vector<EdgeUse>& edges) {
  const std::vector<char> front = front_nodes(cut, edges);
  const auto is_front_edge = [&](const Edge& e) {
    const auto at = std::lower_bound(edges.begin(), edges.end(), e,
                                     [](const EdgeUse& use, const Edge& edge) { return use.edge < edge; });
    return is_front(cut, e, at->count);
  };
  const auto is_loose = [&](const Corners& c) {
    return all_on(front, c) && is_front_edge({c[0], c[1]}) && is_front_edge({c[1], c[2]}) &&
           is_front_edge({c[2], c[0]});
  };
  if (std::none_of(cut.sheet.begin(), cut.sheet.end(), is_loose)) return false;
  IdVector<TriId, Corners> sheet;
  std::vector<TriId> parent;
  for (std::size_t t = 0; t < cut.sheet.size(); ++t) {
    if (is_loose(cut.sheet[TriId(t)])) continue;
    sheet.push_back(cut.sheet[TriId(t)]);
    parent.push_back(cut.sheet_parent[t]);
  }
  cut.sheet = std::move(sheet);
  cut.sheet_parent = std::move(parent);
  return true;
}

// Edges to halve: in order, and only the first of each triangle.
std::map<Edge, NodeId> edges_to_halve(const CutComplex& cut, const std::vector<EdgeUse>& edges) {
  const std::vector<char> front = front_nodes(cut, edges);
  std::map<Edge, NodeId> halve;
  for (const auto& [e, n] : edges)
    if (front[e.a.index()] && front[e.b.index()] && !is_front(cut, e, n)) halve.emplace(e, NodeId());
  const auto one_each = [&](const IdVector<TriId, Corners>& triangles) {
    if (halve.empty()) return;
    for (const Corners& c : triangles) {
      if (!all_on(front, c)) continue;  // else it has no two of them
      std::vector<Edge> found;
      for (int k = 0; k < 3; ++k)
        if (const Edge e(c[k], c[(k + 1) % 3]); halve.contains(e)) found.push_back(e);
      std::sort(found.begin(), found.end());
      for (std::size_t i = 1; i < found.size(); ++i)
        halve.erase(found[i]);
    }
  };
  one_each(cut.surface);
  one_each(cut.sheet);
  return halve;
}

// At most one edge of each.
void halve_triangles(IdVector<TriId, Corners>& triangles, std::vector<TriId>& parents,
                     const std::map<Edge, NodeId>& middle, std::size_t node_count) {
  std::vector<char> at_end(node_count, 0);
  for (const auto& [e, node] : middle)
    at_end[e.a.index()] = at_end[e.b.index()] = 1;
  IdVector<TriId, Corners> out;
  std::vector<TriId> out_parents;
  out.reserve(triangles.size() + 2 * middle.size());
  out_parents.reserve(triangles.size() + 2 * middle.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Corners& c = triangles[TriId(t)];
    Corners first = c;
    for (int k = 0; k < 3; ++k) {
      if (!at_end[c[k].index()] || !at_end[c[(k + 1) % 3].index()]) continue;
      const auto at = middle.find(Edge(c[k], c[(k + 1) % 3]));
      if (at == middle.end()) continue;
      first = {c[k], at->second, c[(k + 2) % 3]};
      out.push_back({at->second, c[(k + 1) % 3], c[(k + 2) % 3]});
      out_parents.push_back(parents[t]);
    }
    out.push_back(first);
    out_parents.push_back(parents[t]);
  }
  triangles = std::move(out);
  parents = std::move(out_parents);
}

}  // namespace

void split_edges_between_front_nodes(CutComplex& cut) {
  std::vector<EdgeUse> edges = sheet_edges(cut);
  if (leave_out_loose_pieces(cut, edges)) edges = sheet_edges(cut);
  for (auto middle = edges_to_halve(cut, edges); !middle.empty(); middle = edges_to_halve(cut, edges)) {
    std::vector<Edge> mouth;
    for (auto& [e, node] : middle) {
      node = cut.positions.add(0.5 * (cut.positions[e.a] + cut.positions[e.b]));
      cut.sheet_node.push_back(NodeId());
    }
    for (const Edge& e : cut.mouth) {
      const auto at = middle.find(e);
      if (at == middle.end()) {
        mouth.push_back(e);
        continue;
      }
      mouth.emplace_back(e.a, at->second);
      mouth.emplace_back(at->second, e.b);
    }
    std::sort(mouth.begin(), mouth.end());
    cut.mouth = std::move(mouth);
    halve_triangles(cut.surface, cut.surface_parent, middle, cut.positions.size());
    halve_triangles(cut.sheet, cut.sheet_parent, middle, cut.positions.size());
    edges = sheet_edges(cut);
  }
}

}  // namespace conchoid

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

void leave_out_loose_pieces(CutComplex& cut) {
  std::vector<Edge> front;
  for (const auto& [e, n] : sheet_edges(cut))
    if (is_front(cut, e, n)) front.push_back(e);
  IdVector<TriId, Corners> sheet;
  std::vector<TriId> parent;
  for (std::size_t t = 0; t < cut.sheet.size(); ++t) {
    const Corners& c = cut.sheet[TriId(t)];
    int fronts = 0;
    for (int k = 0; k < 3; ++k) {
      const Edge e(c[k], c[(k + 1) % 3]);
      fronts += std::binary_search(front.begin(), front.end(), e) ? 1 : 0;
    }
    if (fronts == 3) continue;
    sheet.push_back(c);
    parent.push_back(cut.sheet_parent[t]);
  }
  cut.sheet = std::move(sheet);
  cut.sheet_parent = std::move(parent);
}

// Edges to halve: in order, and only the first of each triangle.
std::map<Edge, NodeId> edges_to_halve(const CutComplex& cut) {
  const std::vector<EdgeUse> count = sheet_edges(cut);
  std::vector<char> front(cut.positions.size(), 0);
  for (const auto& [e, n] : count)
    if (is_front(cut, e, n)) front[e.a.index()] = front[e.b.index()] = 1;
  std::map<Edge, NodeId> halve;
  for (const auto& [e, n] : count)
    if (!is_front(cut, e, n) && front[e.a.index()] && front[e.b.index()]) halve.emplace(e, NodeId());
  const auto one_each = [&](const IdVector<TriId, Corners>& triangles) {
    if (halve.empty()) return;
    for (const Corners& c : triangles) {
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

void halve_triangles(IdVector<TriId, Corners>& triangles, std::vector<TriId>& parents,
                     const std::map<Edge, NodeId>& middle) {
  IdVector<TriId, Corners> out;
  std::vector<TriId> out_parents;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Corners& c = triangles[TriId(t)];
    Corners first = c;
    for (int k = 0; k < 3; ++k) {
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
  leave_out_loose_pieces(cut);
  for (auto middle = edges_to_halve(cut); !middle.empty(); middle = edges_to_halve(cut)) {
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
    halve_triangles(cut.surface, cut.surface_parent, middle);
    halve_triangles(cut.sheet, cut.sheet_parent, middle);
  }
}

}  // namespace conchoid

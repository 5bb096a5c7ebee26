#include "conchoid/intersect/inside_pieces.hpp"

#include <algorithm>

#include "conchoid/core/error.hpp"
#include "conchoid/core/union_find.hpp"
#include "conchoid/mesh/sort_by_edge.hpp"

namespace conchoid {
namespace {

struct Half {
  Edge edge;
  bool along;  ///< the piece runs from edge.a to edge.b
  std::size_t piece;
};

std::vector<Half> sorted_halves(const std::vector<Corners>& pieces) {
  std::vector<Half> halves;
  for (std::size_t p = 0; p < pieces.size(); ++p)
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeId a = pieces[p][k], b = pieces[p][(k + 1) % 3];
      halves.push_back({Edge(a, b), a < b, p});
    }
  std::size_t nodes = 0;
  for (const Half& h : halves)
    nodes = std::max(nodes, h.edge.b.index() + 1);
  sort_by_edge(halves, nodes, [](const Half& h) { return h.edge; });  // then by piece
  return halves;
}

/// Joins pieces across edges off the mouth; at the mouth, each piece votes for inside (+1) or outside (−1).
std::vector<int> vote_at_mouth(const std::vector<Half>& halves, const std::vector<MouthSide>& mouth,
                               UnionFind& parts, std::size_t piece_count) {
  std::vector<int> votes(piece_count, 0);
  auto m = mouth.begin();
  for (std::size_t begin = 0; begin < halves.size();) {
    std::size_t end = begin + 1;
    while (end < halves.size() && halves[end].edge == halves[begin].edge)
      ++end;
    if (end - begin > 2) throw ComputationError("the crack sheet has an edge with more than two triangles");
    while (m != mouth.end() && m->first < halves[begin].edge)
      ++m;
    if (m != mouth.end() && m->first == halves[begin].edge) {
      for (std::size_t i = begin; i < end; ++i)
        votes[halves[i].piece] += halves[i].along == m->second ? 1 : -1;
    } else if (end - begin == 2) {
      parts.join(halves[begin].piece, halves[begin + 1].piece);
    }
    begin = end;
  }
  return votes;
}

}  // namespace

std::vector<bool> inside_pieces(const std::vector<Corners>& pieces, std::vector<MouthSide> mouth,
                                const std::function<bool(NodeId)>& lies_inside) {
  std::sort(mouth.begin(), mouth.end());
  UnionFind parts(pieces.size());
  const std::vector<int> votes = vote_at_mouth(sorted_halves(pieces), mouth, parts, pieces.size());
  std::vector<int> total(pieces.size(), 0);
  std::vector<bool> touched(pieces.size(), false), inside(pieces.size(), false);
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    total[parts.root(p)] += votes[p];
    if (votes[p] != 0) touched[parts.root(p)] = true;
  }
  for (std::size_t p = 0; p < pieces.size(); ++p) {  // the root is the first piece of its part
    const std::size_t root = parts.root(p);
    if (root == p)
      inside[p] = touched[p] ? total[p] > 0 : lies_inside(pieces[p][0]);
    else
      inside[p] = inside[root];
  }
  return inside;
}

}  // namespace conchoid

#include "conchoid/intersect/inside_pieces.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "conchoid/core/error.hpp"
#include "conchoid/core/union_find.hpp"
#include "conchoid/mesh/sort_by_edge.hpp"

namespace conchoid {
namespace {

/// An edge of a piece.
struct Half {
  Edge edge;
  std::uint32_t piece;
  bool along;  ///< the piece runs from edge.a to edge.b
};

/// Those between two nodes of the mouth, by edge, then by piece.
std::vector<Half> halves_at_mouth(const std::vector<Corners>& pieces, const std::vector<char>& on_mouth) {
  std::vector<Half> halves;
  for (std::size_t p = 0; p < pieces.size(); ++p)
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeId a = pieces[p][k], b = pieces[p][(k + 1) % 3];
      if (on_mouth[a.index()] && on_mouth[b.index()])
        halves.push_back({Edge(a, b), static_cast<std::uint32_t>(p), a < b});
    }
  sort_by_edge(halves, on_mouth.size(), [](const Half& h) { return h.edge; });
  return halves;
}

void join_at_nodes(const std::vector<Corners>& pieces, const std::vector<char>& on_mouth, UnionFind& parts) {
  constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> first(on_mouth.size(), none);  // piece at each node
  for (std::size_t p = 0; p < pieces.size(); ++p)
    for (const NodeId n : pieces[p]) {
      if (on_mouth[n.index()]) continue;
      if (first[n.index()] == none)
        first[n.index()] = static_cast<std::uint32_t>(p);
      else
        parts.join(first[n.index()], p);
    }
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

/// Of the nodes of pieces and mouth.
std::vector<char> nodes_on_mouth(const std::vector<Corners>& pieces, const std::vector<MouthSide>& mouth) {
  std::size_t nodes = 0;
  for (const Corners& c : pieces)
    nodes = std::max(nodes, std::max({c[0], c[1], c[2]}).index() + 1);
  for (const auto& [edge, left] : mouth)
    nodes = std::max(nodes, edge.b.index() + 1);
  std::vector<char> on_mouth(nodes, 0);
  for (const auto& [edge, left] : mouth)
    on_mouth[edge.a.index()] = on_mouth[edge.b.index()] = 1;
  return on_mouth;
}

}  // namespace

std::vector<bool> inside_pieces(const std::vector<Corners>& pieces, std::vector<MouthSide> mouth,
                                const InsideTest& are_inside) {
  std::sort(mouth.begin(), mouth.end());
  const std::vector<char> on_mouth = nodes_on_mouth(pieces, mouth);
  UnionFind parts(pieces.size());
  join_at_nodes(pieces, on_mouth, parts);
  const std::vector<int> votes =
      vote_at_mouth(halves_at_mouth(pieces, on_mouth), mouth, parts, pieces.size());
  std::vector<int> total(pieces.size(), 0);
  std::vector<bool> touched(pieces.size(), false), inside(pieces.size(), false);
  std::vector<std::size_t> root(pieces.size());  // the first piece of its part
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    root[p] = parts.root(p);
    total[root[p]] += votes[p];
    if (votes[p] != 0) touched[root[p]] = true;
  }
  std::vector<NodeId> asked;
  for (std::size_t p = 0; p < pieces.size(); ++p)
    if (root[p] == p && !touched[p]) asked.push_back(pieces[p][0]);
  const std::vector<bool> answers = are_inside(asked);
  auto answer = answers.begin();
  for (std::size_t p = 0; p < pieces.size(); ++p)
    inside[p] = root[p] != p ? inside[root[p]] : touched[p] ? total[p] > 0 : *answer++;
  return inside;
}

}  // namespace conchoid

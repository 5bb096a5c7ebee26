#include "conchoid/mesh/longest_edge_bisection.hpp"

#include <algorithm>

namespace conchoid {
namespace {

using Corners = std::array<NodeId, 3>;
using Middles = std::array<NodeId, 3>;  // of the edges (corner k, corner k+1); invalid: not divided

constexpr double kEqual = 1e-9;  // of squared lengths

Edge edge_of(const Corners& c, int k) {
  return {c[k], c[(k + 1) % 3]};
}

int longest_edge(const IdVector<NodeId, Vec3>& positions, const Corners& c) {
  int longest = 0;
  double length = 0;
  for (int k = 0; k < 3; ++k) {
    const double l = (positions[c[(k + 1) % 3]] - positions[c[k]]).squaredNorm();
    const bool first = l >= length * (1 - kEqual) && edge_of(c, k) < edge_of(c, longest);
    if (k == 0 || l > length * (1 + kEqual) || first) {
      longest = k;
      length = l;
    }
  }
  return longest;
}

class Bisection {
 public:
  explicit Bisection(const TriMesh& mesh)
      : out_{mesh,
             std::vector<TriId>(mesh.triangle_count()),
             {},
             std::vector<std::size_t>(mesh.triangle_count(), kNoHalf)},
        fine_(mesh.triangle_count(), 0) {
    for (std::size_t t = 0; t < out_.parent.size(); ++t)
      out_.parent[t] = TriId(t);
  }

  // One round: the triangles that are too coarse, and what their divided edges need.
  bool divide(const std::function<bool(const Triangle&)>& too_coarse) {
    const std::size_t count = out_.mesh.triangle_count();
    middles_.assign(count, {});
    divided_.assign(count, {});
    edges_.clear();
    for (std::size_t t = 0; t < count; ++t) {
      if (!fine_[t]) fine_[t] = too_coarse(out_.mesh.triangle(TriId(t))) ? 0 : 1;
      if (!fine_[t]) waiting_.push_back(TriId(t));
    }
    if (waiting_.empty()) return false;
    neighbours_ = triangle_neighbours(out_.mesh);
    close();
    add_middles();
    write_pieces();
    return true;
  }

  DividedMesh take() { return std::move(out_); }

 private:
  struct DividedEdge {
    Edge edge;
    TriId t;
    int k;
  };

  // A triangle with any divided edge has its longest divided too.
  void close() {
    while (!waiting_.empty()) {
      const TriId t = waiting_.back();
      waiting_.pop_back();
      const Corners& c = out_.mesh.corners[t];
      const int k = longest_edge(out_.mesh.positions, c);
      if (divided_[t.index()][k]) continue;
      mark(t, k);
      const TriId other = neighbours_[t][k];
      if (!other.valid()) continue;
      for (int j = 0; j < 3; ++j)
        if (edge_of(out_.mesh.corners[other], j) == edge_of(c, k)) mark(other, j);
      waiting_.push_back(other);
    }
  }

  void mark(TriId t, int k) {
    divided_[t.index()][k] = 1;
    edges_.push_back({edge_of(out_.mesh.corners[t], k), t, k});
  }

  // In the order of their edges, which does not depend on how the triangles are oriented.
  void add_middles() {
    std::sort(edges_.begin(), edges_.end(),
              [](const DividedEdge& a, const DividedEdge& b) { return a.edge < b.edge; });
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const Edge& e = edges_[i].edge;
      const bool again = i > 0 && edges_[i - 1].edge == e;
      auto& x = out_.mesh.positions;
      const NodeId node = again ? NodeId(x.size() - 1) : x.add(0.5 * (x[e.a] + x[e.b]));
      middles_[edges_[i].t.index()][edges_[i].k] = node;
    }
  }

  void write_pieces() {
    const DividedMesh whole{
        {{}, std::move(out_.mesh.corners)}, std::move(out_.parent), {}, std::move(out_.half)};
    const std::vector<char> fine = std::move(fine_);
    out_.mesh.corners.clear();
    out_.parent.clear();
    out_.half.clear();
    fine_.clear();
    for (std::size_t t = 0; t < whole.parent.size(); ++t) {
      from_ = whole.parent[t];
      add_pieces(whole.mesh.corners[TriId(t)], middles_[t], whole.half[t]);
      if (out_.parent.size() == fine_.size() + 1) fine_.push_back(fine[t]);
      fine_.resize(out_.parent.size(), 0);
    }
  }

  // At the longest divided edge; the pieces may have another one of them each.
  void add_pieces(const Corners c, const Middles& middle, std::size_t half) {
    int k = longest_edge(out_.mesh.positions, c);
    for (int i = 0; i < 2 && !middle[k].valid(); ++i)
      k = (k + 1) % 3;
    if (!middle[k].valid()) {
      out_.mesh.corners.push_back(c);
      out_.parent.push_back(from_);
      out_.half.push_back(half);
      return;
    }
    const int next = (k + 1) % 3, last = (k + 2) % 3;
    const auto at = [&](int i) {
      return half == kNoHalf ? Vec3(Vec3::Unit(i)) : out_.halves[half].in_parent[static_cast<std::size_t>(i)];
    };
    const Vec3 in_middle = 0.5 * (at(k) + at(next));
    const std::size_t first = out_.halves.size();
    out_.halves.push_back({{c[last], c[k], middle[k]}, {at(last), at(k), in_middle}, half});
    out_.halves.push_back({{c[next], c[last], middle[k]}, {at(next), at(last), in_middle}, half});
    add_pieces(out_.halves[first].corners, {middle[last], NodeId(), NodeId()}, first);
    add_pieces(out_.halves[first + 1].corners, {middle[next], NodeId(), NodeId()}, first + 1);
  }

  DividedMesh out_;
  std::vector<char> fine_;  // per triangle: found not to be too coarse
  IdVector<TriId, std::array<TriId, 3>> neighbours_;
  std::vector<std::array<char, 3>> divided_;  // per triangle and edge
  std::vector<Middles> middles_;
  std::vector<DividedEdge> edges_;  // from either side
  std::vector<TriId> waiting_;
  TriId from_;
};

}  // namespace

DividedMesh bisect_longest_edges(const TriMesh& mesh,
                                 const std::function<bool(const Triangle&)>& too_coarse) {
  Bisection bisection(mesh);
  while (bisection.divide(too_coarse)) {
  }
  return bisection.take();
}

}  // namespace conchoid

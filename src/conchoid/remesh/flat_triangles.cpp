#include "conchoid/remesh/flat_triangles.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "conchoid/remesh/tidy.hpp"
#include "conchoid/remesh/weld.hpp"

namespace conchoid {
namespace {

class FlatTriangles {
 public:
  explicit FlatTriangles(TriMesh& mesh) : mesh_(mesh) {
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
      if (is_flat(TriId(t))) flat_.insert(key(TriId(t)));
    if (flat_.empty()) return;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
      link(TriId(t));
  }

  std::size_t run() {
    std::size_t flipped = 0;
    // Every step makes the longest edges of the flat triangles it touches shorter, but for round-off.
    std::size_t steps = 10 * flat_.size() + 100;
    while (!flat_.empty() && steps-- > 0) {
      const TriId t(flat_.begin()->second);
      flat_.erase(flat_.begin());
      if (flip(t)) ++flipped;
    }
    return flipped;
  }

 private:
  /// Longest edges first, then lowest ids.
  using Key = std::pair<double, std::size_t>;

  bool is_flat(TriId t) const {
    const auto& c = mesh_.corners[t];
    return c[0] != c[1] && c[1] != c[2] && c[2] != c[0] && has_no_area(mesh_.triangle(t));
  }
  std::size_t longest(TriId t) const {
    const Triangle x = mesh_.triangle(t);
    std::array<double, 3> length;
    for (std::size_t k = 0; k < 3; ++k)
      length[k] = (x[(k + 1) % 3] - x[k]).squaredNorm();
    return static_cast<std::size_t>(std::max_element(length.begin(), length.end()) - length.begin());
  }
  Key key(TriId t) const {
    const std::size_t k = longest(t);
    const Triangle x = mesh_.triangle(t);
    return {-(x[(k + 1) % 3] - x[k]).norm(), t.index()};
  }
  Edge edge(TriId t, std::size_t k) const { return {mesh_.corners[t][k], mesh_.corners[t][(k + 1) % 3]}; }
  void link(TriId t) {
    for (std::size_t k = 0; k < 3; ++k)
      at_edge_[edge(t, k)].push_back(t);
  }
  void unlink(TriId t) {
    for (std::size_t k = 0; k < 3; ++k)
      std::erase(at_edge_[edge(t, k)], t);
  }

  /// Two of its nodes coincide: turned over, it would be one again.
  bool is_needle(TriId t) const {
    const Triangle x = mesh_.triangle(t);
    const auto [shortest, longest] =
        std::minmax({(x[1] - x[0]).norm(), (x[2] - x[1]).norm(), (x[0] - x[2]).norm()});
    return shortest <= flattest_triangle * longest;
  }

  bool flip(TriId t) {
    if (is_needle(t)) return false;
    const std::size_t k = longest(t);
    const NodeId a = mesh_.corners[t][k], b = mesh_.corners[t][(k + 1) % 3],
                 c = mesh_.corners[t][(k + 2) % 3];
    const std::vector<TriId>& pair = at_edge_[Edge(a, b)];
    if (pair.size() != 2) return false;
    const TriId u = pair[0] == t ? pair[1] : pair[0];
    NodeId d;
    bool against = false;  // the neighbour runs through the edge from b to a, as it should
    for (std::size_t j = 0; j < 3; ++j)
      if (const NodeId n = mesh_.corners[u][j]; n != a && n != b) {
        d = n;
        against = mesh_.corners[u][(j + 1) % 3] == b;
      }
    if (!d.valid() || d == c || !against) return false;
    if (const auto found = at_edge_.find(Edge(c, d)); found != at_edge_.end() && !found->second.empty())
      return false;
    const bool u_was_flat = is_flat(u);
    if (u_was_flat) {
      if (edge(u, longest(u)) != Edge(a, b)) return false;
      flat_.erase(key(u));
    }
    unlink(t);
    unlink(u);
    mesh_.corners[t] = {c, a, d};
    mesh_.corners[u] = {d, b, c};
    for (const TriId changed : {t, u}) {
      link(changed);
      if (is_flat(changed)) flat_.insert(key(changed));
    }
    return true;
  }

  TriMesh& mesh_;
  std::set<Key> flat_;
  std::map<Edge, std::vector<TriId>> at_edge_;
};

}  // namespace

bool has_no_area(const Triangle& x) {
  const double longest_squared =
      std::max({(x[1] - x[0]).squaredNorm(), (x[2] - x[1]).squaredNorm(), (x[0] - x[2]).squaredNorm()});
  // Twice the area is longest edge times height.
  return !(area_vector2(x[0], x[1], x[2]).norm() > flattest_triangle * longest_squared);
}

bool has_flat_triangle(const TriMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (has_no_area(mesh.triangle(TriId(t)))) return true;
  return false;
}

std::size_t flip_flat_triangles(TriMesh& mesh) {
  return FlatTriangles(mesh).run();
}

FlatTrianglesRemoved remove_flat_triangles(TriMesh& mesh) {
  constexpr int most_rounds = 4;
  FlatTrianglesRemoved removed;
  for (int round = 0; round < most_rounds && has_flat_triangle(mesh); ++round) {
    WeldReport weld;
    mesh = welded(mesh, weld, nullptr, 2 * flattest_triangle);
    removed.welded += weld.nodes;
    removed.flipped += flip_flat_triangles(mesh);
  }
  if (removed.welded > 0) drop_unused_nodes(mesh);
  return removed;
}

}  // namespace conchoid

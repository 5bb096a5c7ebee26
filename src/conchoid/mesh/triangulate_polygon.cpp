#include "conchoid/mesh/triangulate_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

using Index = PlaneIndex;
using Polygon = PlanePolygon;
using Link = PlaneLink;
using Diagonal = std::pair<std::size_t, std::size_t>;  ///< places in a walk, ascending

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Larger polygons are reduced by cutting off ears before the optimal triangulation, whose cost grows with
/// n³.
constexpr std::size_t optimal_limit = 40;

class PolygonTriangulation {
 public:
  explicit PolygonTriangulation(PlaneNodes& nodes) : nodes_(nodes) {}

  void run(Polygon polygon, std::vector<std::array<Index, 3>>& out) {
    cut_ears(polygon, out);
    if (polygon.size() < 3) return;
    std::vector<std::array<std::size_t, 3>> places;
    int budget = 1000;
    if (!triangulate_once_each(polygon, {}, budget, places))
      throw ComputationError("a cut triangle could not be divided into pieces");
    for (const auto& t : places) {
      out.push_back({polygon[t[0]], polygon[t[1]], polygon[t[2]]});
      for (int k = 0; k < 3; ++k)
        nodes_.used.insert(plane_link(polygon[t[k]], polygon[t[(k + 1) % 3]]));
    }
  }

 private:
  /// Small for good shapes (1 for equilateral), huge for no area, prohibitive for the wrong orientation.
  double badness(Index a, Index b, Index c) const {
    const Vec2 &A = nodes_.at[a], &B = nodes_.at[b], &C = nodes_.at[c];
    const double area = plane_area2(A, B, C);
    const double lengths = (B - A).squaredNorm() + (C - B).squaredNorm() + (A - C).squaredNorm();
    if (area <= 0) return 1e12 + 1e30 * -area;
    return std::min(1e12, lengths / (2 * std::sqrt(3.0) * area));
  }

  /// Optimal triangulation in which no diagonal comes twice: both banks of a straight slit like to choose the
  /// same one. Then one of them keeps it and the others are forbidden it.
  bool triangulate_once_each(const Polygon& p, const std::set<Diagonal>& forbidden, int& budget,
                             std::vector<std::array<std::size_t, 3>>& places) const {
    places.clear();
    if (--budget < 0 || !optimal_triangulation(p, forbidden, places)) return false;
    std::map<Link, std::set<Diagonal>> diagonals;
    for (const auto& t : places)
      for (const auto& [i, j] : {Diagonal(t[0], t[1]), Diagonal(t[1], t[2]), Diagonal(t[0], t[2])})
        if (j - i > 1 && j - i < p.size() - 1) diagonals[plane_link(p[i], p[j])].insert({i, j});
    const auto twice =
        std::find_if(diagonals.begin(), diagonals.end(), [](const auto& d) { return d.second.size() > 1; });
    if (twice == diagonals.end()) return true;
    const std::set<Diagonal> rivals = twice->second;
    for (const Diagonal& keeper : rivals) {
      std::set<Diagonal> next = forbidden;
      for (const Diagonal& rival : rivals)
        if (rival != keeper) next.insert(rival);
      if (triangulate_once_each(p, next, budget, places)) return true;
    }
    return false;
  }

  /// Takes well-shaped triangles off a large polygon, the best first, as long as no other node comes near
  /// them.
  void cut_ears(Polygon& p, std::vector<std::array<Index, 3>>& out) {
    constexpr double margin = 1e-9;
    const auto quality = [&](std::size_t i) {
      const std::size_t n = p.size();
      const Index a = p[(i + n - 1) % n], b = p[i], c = p[(i + 1) % n];
      if (a == c || a == b || b == c || !nodes_.allowed(a, c)) return infinity;
      const double bad = badness(a, b, c);
      if (bad > 1e6) return infinity;
      const double tolerance = margin * (nodes_.at[c] - nodes_.at[a]).norm();
      for (const Index q : p) {
        if (q == a || q == b || q == c) continue;
        if (plane_area2(nodes_.at[a], nodes_.at[b], nodes_.at[q]) >
                -tolerance * (nodes_.at[b] - nodes_.at[a]).norm() &&
            plane_area2(nodes_.at[b], nodes_.at[c], nodes_.at[q]) >
                -tolerance * (nodes_.at[c] - nodes_.at[b]).norm() &&
            plane_area2(nodes_.at[c], nodes_.at[a], nodes_.at[q]) >
                -tolerance * (nodes_.at[a] - nodes_.at[c]).norm())
          return infinity;
      }
      // a node that comes twice: the ear must lie on this bank of the slit
      return in_wedge(nodes_, p, (i + n - 1) % n, nodes_.at[c]) &&
                     in_wedge(nodes_, p, (i + 1) % n, nodes_.at[a])
                 ? bad
                 : infinity;
    };
    if (p.size() <= optimal_limit) return;
    std::vector<double> bad(p.size());
    for (std::size_t i = 0; i < p.size(); ++i)
      bad[i] = quality(i);
    bool fresh = true;
    while (p.size() > optimal_limit) {
      std::size_t best = 0;
      for (std::size_t i = 1; i < p.size(); ++i)
        if (bad[i] < bad[best] * (1 - 1e-10) || (bad[i] <= bad[best] * (1 + 1e-10) && p[i] < p[best]))
          best = i;
      if (bad[best] == infinity) {
        if (fresh) return;
        for (std::size_t i = 0; i < p.size(); ++i)
          bad[i] = quality(i);
        fresh = true;
        continue;
      }
      const std::size_t n = p.size();
      const Index a = p[(best + n - 1) % n], c = p[(best + 1) % n];
      out.push_back({a, p[best], c});
      nodes_.used.insert(plane_link(a, c));
      p.erase(p.begin() + static_cast<long>(best));
      bad.erase(bad.begin() + static_cast<long>(best));
      bad[best % p.size()] = quality(best % p.size());
      bad[(best + p.size() - 1) % p.size()] = quality((best + p.size() - 1) % p.size());
      fresh = false;
    }
  }

  /// Triangulation of least total badness (dynamic programming over sub-polygons): places in the walk,
  /// ascending per triangle. False if there is none.
  bool optimal_triangulation(const Polygon& p, const std::set<Diagonal>& forbidden,
                             std::vector<std::array<std::size_t, 3>>& out) const {
    const std::size_t n = p.size();
    std::vector<double> cost(n * n, 0.0);
    std::vector<std::size_t> apex(n * n, 0);
    for (std::size_t span = 2; span < n; ++span)
      for (std::size_t i = 0; i + span < n; ++i) {
        const std::size_t j = i + span;
        double best = infinity;
        std::size_t best_k = 0;
        if (span == n - 1 || (nodes_.allowed(p[i], p[j]) && !forbidden.contains({i, j})))
          for (std::size_t k = i + 1; k < j; ++k) {
            if (p[k] == p[i] || p[k] == p[j]) continue;
            const double c = cost[i * n + k] + cost[k * n + j] + badness(p[i], p[k], p[j]);
            if (c < best * (1 - 1e-10) ||
                (c <= best * (1 + 1e-10) && c < infinity && best_k > 0 && p[k] < p[best_k])) {
              best = c;
              best_k = k;
            }
          }
        cost[i * n + j] = best;
        apex[i * n + j] = best_k;
      }
    if (cost[n - 1] == infinity) return false;
    std::vector<Diagonal> stack{{0, n - 1}};
    while (!stack.empty()) {
      const auto [i, j] = stack.back();
      stack.pop_back();
      if (j - i < 2) continue;
      const std::size_t k = apex[i * n + j];
      out.push_back({i, k, j});
      stack.push_back({i, k});
      stack.push_back({k, j});
    }
    return true;
  }

  PlaneNodes& nodes_;
};

}  // namespace

bool in_wedge(const PlaneNodes& nodes, const PlanePolygon& p, std::size_t i, const Vec2& x) {
  const PlaneIndex before = p[(i + p.size() - 1) % p.size()], after = p[(i + 1) % p.size()];
  if (before == after) return true;
  const Vec2 &a = nodes.at[before], &b = nodes.at[p[i]], &c = nodes.at[after];
  const bool left_in = plane_area2(a, b, x) > 0, left_out = plane_area2(b, c, x) > 0;
  return plane_area2(a, b, c) > 0 ? left_in && left_out : left_in || left_out;
}

void triangulate_polygon(PlaneNodes& nodes, PlanePolygon polygon,
                         std::vector<std::array<PlaneIndex, 3>>& out) {
  PolygonTriangulation(nodes).run(std::move(polygon), out);
}

}  // namespace conchoid

#include "conchoid/crack/closing/bridge_triangulation.hpp"

#include <algorithm>
#include <limits>

#include "conchoid/crack/length_factors.hpp"

namespace conchoid {
namespace {

using Corners = std::array<NodeId, 3>;

bool flat(const Corners& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// Sum of the squared edges over twice the area: 2√3 for an equilateral triangle.
double badness(const IdVector<NodeId, Vec3>& x, const IdVector<NodeId, Vec3>& normals, const Corners& t) {
  if (flat(t)) return 0;
  if (folds(x, normals, t)) return kFoldBadness;
  Corners c = t;
  std::sort(c.begin(), c.end());  // the same bits whichever way round
  const Vec3 u = x[c[1]] - x[c[0]], v = x[c[2]] - x[c[0]];
  return std::min(kFoldBadness / 2,
                  (u.squaredNorm() + v.squaredNorm() + (v - u).squaredNorm()) / cross(u, v).norm());
}

}  // namespace

bool folds(const IdVector<NodeId, Vec3>& positions, const IdVector<NodeId, Vec3>& normals, const Corners& t) {
  const Vec3 twice = cross(positions[t[1]] - positions[t[0]], positions[t[2]] - positions[t[0]]);
  const Vec3 normal = normals[t[0]] + normals[t[1]] + normals[t[2]];
  return twice.dot(normal) <= kFoldCosine * twice.norm() * normal.norm();
}

std::vector<Corners> triangles_between(const IdVector<NodeId, Vec3>& positions,
                                       const IdVector<NodeId, Vec3>& normals, const std::vector<NodeId>& one,
                                       const std::vector<NodeId>& other) {
  std::vector<Corners> triangles;
  if (one.empty() || other.empty()) return triangles;
  // From the end with the smaller id on: the same triangles for a mirrored crack.
  const bool turned = one.back() < one.front();
  std::vector<NodeId> first = one, second(other.rbegin(), other.rend());
  if (turned) {
    std::reverse(first.begin(), first.end());
    std::reverse(second.begin(), second.end());
  }
  const std::size_t m = first.size(), n = second.size();
  const auto triangle = [&](NodeId a, NodeId b, NodeId c) {
    return turned ? Corners{b, a, c} : Corners{a, b, c};
  };
  const auto on_first = [&](std::size_t i, std::size_t j) {
    return triangle(first[i + 1], first[i], second[j]);
  };
  const auto on_second = [&](std::size_t i, std::size_t j) {
    return triangle(second[j], second[j + 1], first[i]);
  };
  constexpr double never = std::numeric_limits<double>::infinity();
  std::vector<double> cost(m * n, never);  // of the best way to (i, j)
  std::vector<bool> along_first(m * n, false);
  cost[0] = 0;
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      if (i + j == 0) continue;
      const double a =
          i > 0 ? cost[(i - 1) * n + j] + badness(positions, normals, on_first(i - 1, j)) : never;
      const double b = j > 0 ? cost[i * n + j - 1] + badness(positions, normals, on_second(i, j - 1)) : never;
      along_first[i * n + j] = a < b || (a == b && second[j] < first[i]);
      cost[i * n + j] = std::min(a, b);
    }
  for (std::size_t i = m - 1, j = n - 1; i + j > 0;) {
    const bool along = along_first[i * n + j];
    --(along ? i : j);
    const Corners t = along ? on_first(i, j) : on_second(i, j);
    if (!flat(t)) triangles.push_back(t);
  }
  std::reverse(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace conchoid

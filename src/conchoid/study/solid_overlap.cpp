#include "conchoid/study/solid_overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "conchoid/core/parallel.hpp"

namespace conchoid {
namespace {

/// A grid of parallel lines through a box.
struct LineGrid {
  Box box;
  int along, first, second;  ///< axis of the lines and the two axes of the grid
  int lines;

  Vec2 cell() const {
    return {(box.high[first] - box.low[first]) / lines, (box.high[second] - box.low[second]) / lines};
  }
  /// Where line (i, j) passes, off the centre of its cell by a fixed irregular amount, so that it does not
  /// run inside faces of regular meshes.
  Vec2 at(int i, int j) const {
    const double u = 0.5 + 0.37 * std::sin(12.9898 * i + 78.233 * j + 1.7),
                 v = 0.5 + 0.37 * std::sin(39.346 * i + 11.135 * j + 0.3);
    return {box.low[first] + (i + u) * cell().x(), box.low[second] + (j + v) * cell().y()};
  }
};

/// Does the half line from p upwards in the second coordinate pass edge a–b? Same answer from both triangles
/// of the edge.
bool passes_edge(const Vec2& a, const Vec2& b, const Vec2& p) {
  if ((a.x() > p.x()) == (b.x() > p.x())) return false;
  const bool ordered = a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  const Vec2 &low = ordered ? a : b, &high = ordered ? b : a;
  return (high.x() - low.x()) * (p.y() - low.y()) - (high.y() - low.y()) * (p.x() - low.x()) < 0;
}

using Crossings = std::vector<std::vector<double>>;

/// Heights at which every line meets the closed mesh, sorted: inside between the first and the second, the
/// third and the fourth, …
Crossings crossings(const TriMesh& mesh, const LineGrid& grid) {
  const Vec2 cell = grid.cell();
  Crossings heights(static_cast<std::size_t>(grid.lines) * static_cast<std::size_t>(grid.lines));
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Triangle triangle = mesh.triangle(TriId(t));
    std::array<Vec2, 3> flat;
    for (std::size_t k = 0; k < 3; ++k)
      flat[k] = {triangle[k][grid.first], triangle[k][grid.second]};
    const Vec3 n = area_vector2(triangle[0], triangle[1], triangle[2]);
    if (n[grid.along] == 0) continue;
    const Vec2 low = flat[0].cwiseMin(flat[1]).cwiseMin(flat[2]),
               high = flat[0].cwiseMax(flat[1]).cwiseMax(flat[2]);
    const auto index = [&](double x, double start, double step) {
      return step > 0 ? std::clamp(static_cast<int>(std::floor((x - start) / step)), 0, grid.lines - 1) : 0;
    };
    const int i0 = index(low.x(), grid.box.low[grid.first], cell.x()),
              i1 = index(high.x(), grid.box.low[grid.first], cell.x());
    const int j0 = index(low.y(), grid.box.low[grid.second], cell.y()),
              j1 = index(high.y(), grid.box.low[grid.second], cell.y());
    for (int i = i0; i <= i1; ++i)
      for (int j = j0; j <= j1; ++j) {
        const Vec2 p = grid.at(i, j);
        const bool inside = passes_edge(flat[0], flat[1], p) ^ passes_edge(flat[1], flat[2], p) ^
                            passes_edge(flat[2], flat[0], p);
        if (!inside) continue;
        const Vec3& x = triangle[0];
        const double height = x[grid.along] - (n[grid.first] * (p.x() - x[grid.first]) +
                                               n[grid.second] * (p.y() - x[grid.second])) /
                                                  n[grid.along];
        heights[static_cast<std::size_t>(i) * static_cast<std::size_t>(grid.lines) +
                static_cast<std::size_t>(j)]
            .push_back(height);
      }
  }
  for (auto& line : heights)
    std::sort(line.begin(), line.end());
  return heights;
}

double length_inside(const std::vector<double>& line) {
  double length = 0;
  for (std::size_t i = 0; i + 1 < line.size(); i += 2)
    length += line[i + 1] - line[i];
  return length;
}

double length_inside_both(const std::vector<double>& p, const std::vector<double>& q) {
  double length = 0;
  for (std::size_t i = 0, j = 0; i + 1 < p.size() && j + 1 < q.size();) {
    length += std::max(0.0, std::min(p[i + 1], q[j + 1]) - std::max(p[i], q[j]));
    if (p[i + 1] < q[j + 1]) {
      i += 2;
    } else {
      j += 2;
    }
  }
  return length;
}

}  // namespace

double intersection_over_union(const TriMesh& a, const TriMesh& b, int lines) {
  if (a.triangle_count() == 0 && b.triangle_count() == 0) return std::numeric_limits<double>::quiet_NaN();
  if (a.triangle_count() == 0 || b.triangle_count() == 0) return 0;
  const Box box_a = bounding_box(a), box_b = bounding_box(b);
  const Box box{box_a.low.cwiseMin(box_b.low), box_a.high.cwiseMax(box_b.high)};
  double both = 0, either = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const LineGrid grid{box, axis, (axis + 1) % 3, (axis + 2) % 3, lines};
    std::array<Crossings, 2> heights;
    parallel_for(2, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t m = begin; m < end; ++m)
        heights[m] = crossings(m == 0 ? a : b, grid);
    });
    const double weight = grid.cell().x() * grid.cell().y();
    for (std::size_t i = 0; i < heights[0].size(); ++i) {
      const double common = length_inside_both(heights[0][i], heights[1][i]);
      both += weight * common;
      either += weight * (length_inside(heights[0][i]) + length_inside(heights[1][i]) - common);
    }
  }
  return either > 0 ? both / either : std::numeric_limits<double>::quiet_NaN();
}

double largest_fragment_overlap(const std::vector<TriMesh>& a, const std::vector<TriMesh>& b, int lines) {
  if (a.empty() || b.empty()) return std::numeric_limits<double>::quiet_NaN();
  constexpr std::size_t candidates = 8;  // a smaller piece cannot overlap the largest one best
  const auto best = [&](const TriMesh& piece, const std::vector<TriMesh>& others) {
    double most = 0;
    for (std::size_t i = 0; i < std::min(candidates, others.size()); ++i)
      most = std::max(most, intersection_over_union(piece, others[i], lines));
    return most;
  };
  return 0.5 * (best(a.front(), b) + best(b.front(), a));
}

}  // namespace conchoid

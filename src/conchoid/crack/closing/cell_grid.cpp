#include "conchoid/crack/closing/cell_grid.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "conchoid/core/parallel.hpp"

namespace conchoid {
namespace {

struct AreaMoments {
  double area = 0;
  Vec3 center = Vec3::Zero();
  Mat3 normals = Mat3::Zero();  // ∫ n nᵀ dA
  Mat3 places = Mat3::Zero();   // ∫ (x − center)(x − center)ᵀ dA, of the triangles' middles
};

AreaMoments area_moments(const TriMesh& mesh) {
  AreaMoments m;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Vec3 a = area_vector(mesh, TriId(t));
    const double area = a.norm();
    if (area == 0) continue;
    m.area += area;
    m.center += area * centroid(mesh, TriId(t));
    m.normals += a * a.transpose() / area;
  }
  if (m.area > 0) m.center /= m.area;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Vec3 x = centroid(mesh, TriId(t)) - m.center;
    m.places += area_vector(mesh, TriId(t)).norm() * x * x.transpose();
  }
  return m;
}

Vec3 largest_axis(const Mat3& tensor) {
  return Eigen::SelfAdjointEigenSolver<Mat3>(tensor).eigenvectors().col(2);
}

// Orthonormal, perhaps left-handed: the first along the largest principal value of ∫ n nᵀ dA, the second across it
// the way the cracks reach farthest, each from the body's middle towards the cracks'. So a mirrored body has the
// mirrored grid. Where the cracks tell no difference any axes do.
Mat3 axes_across(const TriMesh& body, const TriMesh& sheets) {
  const AreaMoments cracks = area_moments(sheets);
  Mat3 axes;
  axes.col(0) = largest_axis(cracks.normals);
  const Mat3 across = Mat3::Identity() - axes.col(0) * axes.col(0).transpose();
  axes.col(1) = largest_axis(across * cracks.places * across);
  axes.col(1) = (across * axes.col(1)).normalized();
  axes.col(2) = conchoid::cross(axes.col(0), axes.col(1));
  const Vec3 towards = cracks.center - area_moments(body).center;
  for (int a = 0; a < 3; ++a)
    if (axes.col(a).dot(towards) < 0) axes.col(a) *= -1;
  return axes;
}

// The line from p to q in the plane, by the ids of their nodes.
class DirectedEdge {
 public:
  DirectedEdge() = default;
  DirectedEdge(const Vec2& p, NodeId a, const Vec2& q, NodeId b)
      : start_(a < b ? p : q), along_(a < b ? Vec2(q - p) : Vec2(p - q)), forward_(a < b) {}
  /// Twice the area of (p, q, x), the same number whichever of the two triangles along p q asks.
  double turn(const Vec2& x) const {
    const double turn = along_.x() * (x.y() - start_.y()) - along_.y() * (x.x() - start_.x());
    return forward_ ? turn : -turn;
  }
  /// Of a point on the edge itself one of its triangles has it, the other has not.
  bool has(double turn) const { return turn > 0 || (turn == 0 && forward_); }

 private:
  Vec2 start_, along_;
  bool forward_ = true;
};

// The lines of cells must not run along faces and edges that lie in the axes, as they do in bodies made by
// program: shares of a cell by which they are off.
constexpr std::array<double, 3> kOffset{0.2718281828, 0.3141592653, 0.2236067977};

}  // namespace

CellGrid::CellGrid(const TriMesh& body, const TriMesh& sheets, double size)
    : size_(size), axes_(axes_across(body, sheets)), origin_(Vec3::Zero()) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec3& x : body.positions) {
    const Vec3 local = axes_.transpose() * x / size_;
    low = low.cwiseMin(local);
    high = high.cwiseMax(local);
  }
  for (int a = 0; a < 3; ++a) {
    count_[a] = static_cast<int>(std::ceil(high[a] - low[a])) + 3;
    low[a] -= 1 + kOffset[a];
  }
  origin_ = size_ * (axes_ * low);
  step_ = {static_cast<std::size_t>(count_[1]) * count_[2], static_cast<std::size_t>(count_[2]), 1};
  const std::vector<Vec3> of_body = places(body), of_sheets = places(sheets);
  std::array<std::vector<std::size_t>, 3> surface;  // cells before it, along each axis
  std::array<std::vector<SheetCrossing>, 3> cracks;
  parallel_for(6, 1, [&](std::size_t task, std::size_t) {
    const int axis = static_cast<int>(task % 3);
    if (task < 3)
      cross(body, of_body, axis, [&](std::size_t c, double, TriId, bool) { surface[axis].push_back(c); });
    else
      cross(sheets, of_sheets, axis, [&](std::size_t c, double depth, TriId t, bool upwards) {
        cracks[axis].push_back({c, axis, depth, t, upwards});
      });
  });
  list_runs(surface[2]);
  stand_walls(surface, cracks);
  list_pairs();
}

void CellGrid::stand_walls(const std::array<std::vector<std::size_t>, 3>& surface,
                           const std::array<std::vector<SheetCrossing>, 3>& cracks) {
  // A wall that is the body's surface stands between two cells inside where something thinner than a cell is left out.
  std::array<std::vector<std::int32_t>, 3> walled;
  parallel_for(3, 1, [&](std::size_t axis, std::size_t) {
    const auto stand = [&](std::size_t c) {
      if (number(c + step_[axis]) < 0) return;
      if (const std::int32_t n = number(c); n >= 0) walled[axis].push_back(n);
    };
    for (const std::size_t c : surface[axis])
      stand(c);
    for (const SheetCrossing& x : cracks[axis])
      stand(x.cell);
  });
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const std::int32_t n : walled[axis])
      walls_[static_cast<std::size_t>(n)] |= static_cast<std::uint8_t>(1U << axis);
    crossings_.insert(crossings_.end(), cracks[axis].begin(), cracks[axis].end());
  }
  std::sort(crossings_.begin(), crossings_.end(), [](const SheetCrossing& x, const SheetCrossing& y) {
    return std::tie(x.cell, x.axis, x.depth, x.triangle) < std::tie(y.cell, y.axis, y.depth, y.triangle);
  });
}

std::int32_t CellGrid::number(std::size_t cell) const {
  const std::size_t line = cell / step_[1];
  for (std::size_t r = first_run_[line]; r < first_run_[line + 1]; ++r)
    if (const std::size_t beyond = cell - runs_[r].cell; beyond < static_cast<std::size_t>(runs_[r].count))
      return runs_[r].number + static_cast<std::int32_t>(beyond);
  return -1;
}

std::array<int, 3> CellGrid::place(std::size_t cell) const {
  return {static_cast<int>(cell / step_[0]), static_cast<int>(cell / step_[1] % count_[1]),
          static_cast<int>(cell % count_[2])};
}

Vec3 CellGrid::center(std::size_t cell) const {
  const auto [i, j, k] = place(cell);
  return position({double(i), double(j), double(k)});
}

std::vector<Vec3> CellGrid::places(const TriMesh& mesh) const {
  std::vector<Vec3> local;
  local.reserve(mesh.node_count());
  for (const Vec3& x : mesh.positions)
    local.push_back(place_of(x));
  return local;
}

template <class Found>
void CellGrid::cross(const TriMesh& mesh, const std::vector<Vec3>& local, int axis,
                     const Found& found) const {
  const int b = (axis + 1) % 3, c = (axis + 2) % 3;
  const bool right_handed = axes_.determinant() > 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    std::array<NodeId, 3> n = mesh.corners[TriId(t)];
    std::array<Vec3, 3> x{local[n[0].index()], local[n[1].index()], local[n[2].index()]};
    std::array<Vec2, 3> p;
    for (int v = 0; v < 3; ++v)
      p[v] = {x[v][b], x[v][c]};
    const auto range = [&](int k, int most) {
      const auto [low, high] = std::minmax({p[0][k], p[1][k], p[2][k]});
      return std::pair{std::max(0, static_cast<int>(std::ceil(low))),
                       std::min(most - 1, static_cast<int>(std::floor(high)))};
    };
    const auto [b0, b1] = range(0, count_[b]);
    const auto [c0, c1] = range(1, count_[c]);
    if (b0 > b1 || c0 > c1) continue;
    const double area = DirectedEdge(p[0], n[0], p[1], n[1]).turn(p[2]);
    if (area == 0) continue;
    const bool upwards = (area > 0) == right_handed;
    if (area < 0) {
      std::swap(n[1], n[2]);
      std::swap(x[1], x[2]);
      std::swap(p[1], p[2]);
    }
    std::array<DirectedEdge, 3> opposite;  // of each corner
    for (int v = 0; v < 3; ++v)
      opposite[(v + 2) % 3] = {p[v], n[v], p[(v + 1) % 3], n[(v + 1) % 3]};
    for (int i = b0; i <= b1; ++i)
      for (int j = c0; j <= c1; ++j) {
        const Vec2 q(i, j);
        std::array<double, 3> w{};
        bool in = true;
        for (int v = 0; v < 3; ++v) {
          w[v] = opposite[v].turn(q);
          in = in && opposite[v].has(w[v]);
        }
        if (!in) continue;
        const double z = (w[0] * x[0][axis] + w[1] * x[1][axis] + w[2] * x[2][axis]) / (w[0] + w[1] + w[2]);
        const double below = std::floor(z);
        if (below < 0 || below >= count_[axis] - 1) continue;
        std::array<int, 3> at{};
        at[axis] = static_cast<int>(below);
        at[b] = i;
        at[c] = j;
        found(cell(at[0], at[1], at[2]), z - below, TriId(t), upwards);
      }
  }
}

// What is inside: from the bottom of each line of cells, in and out at every crossing.
void CellGrid::list_runs(const std::vector<std::size_t>& surface) {
  const std::size_t lines = cells() / step_[1];
  std::vector<std::uint32_t> first(lines + 1, 0);  // crossing of each line
  for (const std::size_t c : surface)
    ++first[c / step_[1] + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::size_t> sorted(surface.size());
  std::vector<std::uint32_t> at(first.begin(), first.end() - 1);
  for (const std::size_t c : surface)
    sorted[at[c / step_[1]]++] = c;
  first_run_.assign(lines + 1, 0);
  std::int32_t number = 0;
  for (std::size_t line = 0; line < lines; ++line) {
    const auto begin = sorted.begin() + first[line], end = sorted.begin() + first[line + 1];
    std::sort(begin, end);
    for (auto c = begin; c + 1 < end; c += 2) {
      const auto count = static_cast<std::int32_t>(c[1] - c[0]);
      if (count == 0) continue;
      if (runs_.size() > first_run_[line] &&
          runs_.back().cell + static_cast<std::size_t>(runs_.back().count) == c[0] + 1)
        runs_.back().count += count;
      else
        runs_.push_back({c[0] + 1, number, count});
      number += count;
    }
    first_run_[line + 1] = static_cast<std::uint32_t>(runs_.size());
  }
  walls_.assign(static_cast<std::size_t>(number), 0);
}

void CellGrid::list_pairs() {
  for (const CellRun& run : runs_)
    if (run.count > 1) pairs_[2].push_back({{run.cell, run.number, run.count - 1}, run.number + 1});
  parallel_for(2, 1, [&](std::size_t axis, std::size_t) {
    std::size_t next = 0;  // run that ends behind the beginning of what lies ahead
    for (const CellRun& run : runs_) {
      const std::size_t low = run.cell + step_[axis], high = low + static_cast<std::size_t>(run.count);
      while (next < runs_.size() && runs_[next].cell + static_cast<std::size_t>(runs_[next].count) <= low)
        ++next;
      for (std::size_t r = next; r < runs_.size() && runs_[r].cell < high; ++r) {
        const CellRun& ahead = runs_[r];
        const std::size_t from = std::max(low, ahead.cell);
        const std::size_t to = std::min(high, ahead.cell + static_cast<std::size_t>(ahead.count));
        pairs_[axis].push_back({{from - step_[axis], run.number + static_cast<std::int32_t>(from - low),
                                 static_cast<std::int32_t>(to - from)},
                                ahead.number + static_cast<std::int32_t>(from - ahead.cell)});
      }
    }
  });
}

}  // namespace conchoid

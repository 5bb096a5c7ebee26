#include "conchoid/crack/fine/face_grid.hpp"

#include <algorithm>
#include <cmath>

#include "conchoid/crack/length_factors.hpp"

namespace conchoid {
namespace {

// Where the path passes through the triangle, as a fraction of the path.
std::optional<double> crossing(const Vec3& from, const Vec3& to, const Triangle& t) {
  const Vec3 d = to - from, n = area_vector2(t[0], t[1], t[2]);
  const double along = d.dot(n);
  if (std::abs(along) <= kGrazingSine * d.norm() * n.norm()) return {};
  const double s = n.dot(t[0] - from) / along;
  if (!(s >= 0 && s <= 1)) return {};
  const Vec3 x = from + s * d;
  for (int k = 0; k < 3; ++k)
    if (n.dot(cross(t[(k + 1) % 3] - t[k], x - t[k])) < 0) return {};
  return s;
}

}  // namespace

std::size_t FaceGrid::CellHash::operator()(const Cell& c) const {
  std::uint64_t h = static_cast<std::uint64_t>(c.x) * 0x9E3779B97F4A7C15ull;
  h = (h ^ (h >> 32)) + static_cast<std::uint64_t>(c.y) * 0xC2B2AE3D27D4EB4Full;
  h = (h ^ (h >> 29)) + static_cast<std::uint64_t>(c.z) * 0x165667B19E3779F9ull;
  return static_cast<std::size_t>(h ^ (h >> 31));
}

FaceGrid::Cell FaceGrid::cell_of(const Vec3& x) const {
  const auto index = [&](double v) { return static_cast<std::int64_t>(std::floor(v / cell_)); };
  return {index(x[0]), index(x[1]), index(x[2])};
}

FaceGrid::Range FaceGrid::range(const std::vector<Vec3>& points) const {
  Vec3 low = points[0], high = points[0];
  for (const Vec3& x : points) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  return {cell_of(low), cell_of(high)};
}

void FaceGrid::take(const TriMesh& mesh, TriId t, int part) {
  const Triangle x = mesh.triangle(t);
  const auto [low, high] = range({x[0], x[1], x[2]});
  for (std::int64_t i = low.x; i <= high.x; ++i)
    for (std::int64_t j = low.y; j <= high.y; ++j)
      for (std::int64_t k = low.z; k <= high.z; ++k)
        triangles_[{i, j, k}].push_back(t);
  part_.push_back(part);
}

void FaceGrid::join(int part, int with) {
  std::replace(part_.begin(), part_.end(), with, part);
}

std::optional<FaceGrid::Hit> FaceGrid::first_hit(const TriMesh& mesh, const Vec3& from, const Vec3& to,
                                                 const std::vector<NodeId>& own) const {
  std::optional<Hit> best;
  const auto [low, high] = range({from, to});
  for (std::int64_t i = low.x; i <= high.x; ++i)
    for (std::int64_t j = low.y; j <= high.y; ++j)
      for (std::int64_t k = low.z; k <= high.z; ++k) {
        const auto found = triangles_.find({i, j, k});
        if (found == triangles_.end()) continue;
        for (const TriId t : found->second) {
          const auto& c = mesh.corners[t];
          if (std::any_of(c.begin(), c.end(),
                          [&](NodeId n) { return std::binary_search(own.begin(), own.end(), n); }))
            continue;
          const auto s = crossing(from, to, mesh.triangle(t));
          if (!s) continue;
          const bool better = !best || *s < best->fraction || (*s == best->fraction && t < best->triangle);
          if (better) best = Hit{t, part_[t.index()], *s};
        }
      }
  return best;
}

}  // namespace conchoid

#include "conchoid/crack/fine/face_grid.hpp"

#include <algorithm>
#include <cmath>

#include "conchoid/crack/length_factors.hpp"
#include "conchoid/mesh/box.hpp"

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

Cell FaceGrid::block_of(const Cell& cell) {
  return {cell.x >> kBlockBits, cell.y >> kBlockBits, cell.z >> kBlockBits};
}

std::size_t FaceGrid::place_in_block(const Cell& cell) {
  constexpr std::int64_t within = (1 << kBlockBits) - 1;
  return static_cast<std::size_t>((((cell.x & within) << kBlockBits | (cell.y & within)) << kBlockBits) |
                                  (cell.z & within));
}

void FaceGrid::take(const TriMesh& mesh, TriId t, int part) {
  const Box box = box_of(mesh.triangle(t));
  for_each_cell(cell_of(box.low, cell_), cell_of(box.high, cell_), [&](const Cell& cell) {
    const auto [block, is_new] = blocks_.try_emplace(block_of(cell));
    if (is_new) block->second.fill(-1);
    std::int32_t& first = block->second[place_in_block(cell)];
    entries_.push_back({t, first});
    first = static_cast<std::int32_t>(entries_.size() - 1);
  });
  part_.push_back(part);
}

void FaceGrid::join(int part, int with) {
  std::replace(part_.begin(), part_.end(), with, part);
}

std::optional<FaceGrid::Hit> FaceGrid::first_hit(const TriMesh& mesh, const Vec3& from, const Vec3& to,
                                                 std::span<const NodeId> own) const {
  std::optional<Hit> best;
  for_each_cell(cell_of(from.cwiseMin(to), cell_), cell_of(from.cwiseMax(to), cell_), [&](const Cell& cell) {
    const auto found = blocks_.find(block_of(cell));
    if (found == blocks_.end()) return;
    for (std::int32_t e = found->second[place_in_block(cell)]; e >= 0;
         e = entries_[static_cast<std::size_t>(e)].next) {
      const TriId t = entries_[static_cast<std::size_t>(e)].triangle;
      const auto& c = mesh.corners[t];
      if (std::any_of(c.begin(), c.end(),
                      [&](NodeId n) { return std::binary_search(own.begin(), own.end(), n); }))
        continue;
      const auto s = crossing(from, to, mesh.triangle(t));
      if (!s) continue;
      const bool better = !best || *s < best->fraction || (*s == best->fraction && t < best->triangle);
      if (better) best = Hit{t, part_[t.index()], *s};
    }
  });
  return best;
}

}  // namespace conchoid

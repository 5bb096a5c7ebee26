#include "conchoid/remesh/fill_holes.hpp"

#include <limits>
#include <utility>

namespace conchoid {
namespace {

constexpr std::size_t longest_for_least_area = 150;

/// least(i, k): smallest area of a triangulation of the nodes i … k of the loop; middle(i, k): the third node
/// of its triangle at the side i k.
void fill_with_least_area(TriMesh& mesh, const BoundaryLoop& loop) {
  const std::size_t n = loop.size();
  std::vector<double> least(n * n, 0);
  std::vector<std::size_t> middle(n * n, 0);
  for (std::size_t span = 2; span < n; ++span)
    for (std::size_t i = 0; i + span < n; ++i) {
      const std::size_t k = i + span;
      least[i * n + k] = std::numeric_limits<double>::infinity();
      for (std::size_t j = i + 1; j < k; ++j) {
        const Vec3 &a = mesh.positions[loop[i]], &b = mesh.positions[loop[j]], &c = mesh.positions[loop[k]];
        const double area = least[i * n + j] + least[j * n + k] + area_vector2(a, b, c).norm();
        if (area < least[i * n + k]) {
          least[i * n + k] = area;
          middle[i * n + k] = j;
        }
      }
    }
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, n - 1}};
  while (!open.empty()) {
    const auto [i, k] = open.back();
    open.pop_back();
    if (k - i < 2) continue;
    const std::size_t j = middle[i * n + k];
    mesh.corners.push_back({loop[k], loop[j], loop[i]});
    open.push_back({i, j});
    open.push_back({j, k});
  }
}

void fill_with_fan(TriMesh& mesh, const BoundaryLoop& loop) {
  Vec3 middle = Vec3::Zero();
  double length = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3 &p = mesh.positions[loop[i]], &q = mesh.positions[loop[(i + 1) % loop.size()]];
    middle += (q - p).norm() * (p + q) / 2;
    length += (q - p).norm();
  }
  const NodeId centre = mesh.positions.add(middle / length);
  for (std::size_t i = 0; i < loop.size(); ++i)
    mesh.corners.push_back({loop[(i + 1) % loop.size()], loop[i], centre});
}

}  // namespace

TriMesh holes_filled(const TriMesh& mesh, const std::vector<BoundaryLoop>& loops) {
  TriMesh out = mesh;
  for (const BoundaryLoop& loop : loops) {
    if (loop.size() < 3) continue;  // there and back again: nothing to fill
    loop.size() <= longest_for_least_area ? fill_with_least_area(out, loop) : fill_with_fan(out, loop);
  }
  return out;
}

}  // namespace conchoid

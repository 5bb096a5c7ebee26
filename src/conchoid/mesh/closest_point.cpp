#include "conchoid/mesh/closest_point.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace conchoid {
namespace {

constexpr std::size_t leaf_size = 4;

Box box_of(const Triangle& t) {
  return {t[0].cwiseMin(t[1]).cwiseMin(t[2]), t[0].cwiseMax(t[1]).cwiseMax(t[2])};
}

double squared_distance(const Box& box, const Vec3& x) {
  return (box.low - x).cwiseMax(x - box.high).cwiseMax(0.0).squaredNorm();
}

Vec3 closest_point_on_segment(const Vec3& a, const Vec3& b, const Vec3& x) {
  const Vec3 ab = b - a;
  const double length2 = ab.squaredNorm();
  if (!(length2 > 0)) return a;
  const double s = std::clamp((x - a).dot(ab) / length2, 0.0, 1.0);
  return s == 1.0 ? b : Vec3(a + s * ab);
}

}  // namespace

Vec3 closest_point_on_triangle(const Triangle& triangle, const Vec3& x) {
  const auto& [a, b, c] = triangle;
  const Vec3 n = area_vector2(a, b, c);
  const double n2 = n.squaredNorm();
  // Signed areas of the three sub-triangles that the foot of the perpendicular makes with the edges.
  if (n2 > 0) {
    const double wa = n.dot(cross(b - x, c - x)), wb = n.dot(cross(c - x, a - x)),
                 wc = n.dot(cross(a - x, b - x));
    if (wa >= 0 && wb >= 0 && wc >= 0) return x - n * (n.dot(x - a) / n2);
  }
  Vec3 best = closest_point_on_segment(a, b, x);
  for (const Vec3& candidate : {closest_point_on_segment(b, c, x), closest_point_on_segment(c, a, x)})
    if ((candidate - x).squaredNorm() < (best - x).squaredNorm()) best = candidate;
  return best;
}

ClosestPointTree::ClosestPointTree(const TriMesh& mesh) {
  triangles_.reserve(mesh.triangle_count());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    triangles_.push_back(mesh.triangle(TriId(t)));
  order_.resize(triangles_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  if (!triangles_.empty()) build(0, triangles_.size());
}

std::size_t ClosestPointTree::build(std::size_t begin, std::size_t end) {
  Box box = box_of(triangles_[order_[begin]]);
  for (std::size_t i = begin + 1; i < end; ++i) {
    const Box other = box_of(triangles_[order_[i]]);
    box = {box.low.cwiseMin(other.low), box.high.cwiseMax(other.high)};
  }
  const std::size_t id = branches_.size();
  branches_.push_back({box, begin, end, 0, 0});
  if (end - begin <= leaf_size) return id;

  Eigen::Index axis = 0;
  (box.high - box.low).maxCoeff(&axis);
  const auto height = [&](std::size_t t) {
    return triangles_[t][0][axis] + triangles_[t][1][axis] + triangles_[t][2][axis];
  };
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::size_t p, std::size_t q) {
    return height(p) != height(q) ? height(p) < height(q) : p < q;
  });
  const std::size_t left = build(begin, middle), right = build(middle, end);
  branches_[id].left = left;
  branches_[id].right = right;
  return id;
}

ClosestPointTree::Hit ClosestPointTree::closest(const Vec3& x) const {
  Hit best;
  best.squared_distance = std::numeric_limits<double>::infinity();
  if (branches_.empty()) return best;
  struct Visit {
    std::size_t branch;
    double squared_distance;
  };
  std::vector<Visit> stack{{0, squared_distance(branches_[0].box, x)}};
  while (!stack.empty()) {
    const Visit visit = stack.back();
    stack.pop_back();
    if (visit.squared_distance > best.squared_distance) continue;
    const Branch& branch = branches_[visit.branch];
    if (branch.left != 0) {
      Visit near{branch.left, squared_distance(branches_[branch.left].box, x)};
      Visit far{branch.right, squared_distance(branches_[branch.right].box, x)};
      if (far.squared_distance < near.squared_distance) std::swap(near, far);
      stack.push_back(far);
      stack.push_back(near);
      continue;
    }
    for (std::size_t i = branch.begin; i < branch.end; ++i) {
      const TriId id(order_[i]);
      const Vec3 point = closest_point_on_triangle(triangles_[order_[i]], x);
      const double d2 = (point - x).squaredNorm();
      if (d2 < best.squared_distance || (d2 == best.squared_distance && id < best.triangle))
        best = {id, point, d2};
    }
  }
  return best;
}

}  // namespace conchoid

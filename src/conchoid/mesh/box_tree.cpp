#include "conchoid/mesh/box_tree.hpp"

#include <algorithm>
#include <numeric>

#include "conchoid/core/interrupt.hpp"

namespace conchoid {
namespace {

constexpr std::size_t leaf_size = 4;

}  // namespace

BoxTree::BoxTree(const TriMesh& mesh) : order_(mesh.triangle_count()) {
  std::vector<Vec3> centers;  // times three
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Triangle x = mesh.triangle(TriId(t));
    boxes_.push_back(box_of(x));
    centers.push_back(x[0] + x[1] + x[2]);
  }
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  if (!order_.empty()) build(centers, 0, order_.size());
}

std::size_t BoxTree::build(const std::vector<Vec3>& centers, std::size_t begin, std::size_t end) {
  throw_if_interrupted();
  Box box = boxes_[order_[begin]];
  for (std::size_t i = begin + 1; i < end; ++i)
    box = united(box, boxes_[order_[i]]);
  const std::size_t id = branches_.size();
  branches_.push_back({box, begin, end, 0, 0});
  if (end - begin <= leaf_size) return id;

  Eigen::Index axis = 0;
  (box.high - box.low).maxCoeff(&axis);
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::size_t p, std::size_t q) {
    const double cp = centers[p][axis], cq = centers[q][axis];
    return cp != cq ? cp < cq : p < q;
  });
  const std::size_t left = build(centers, begin, middle), right = build(centers, middle, end);
  branches_[id].left = left;
  branches_[id].right = right;
  return id;
}

std::vector<TriId> BoxTree::overlapping(const Box& box) const {
  std::vector<TriId> found;
  visit_overlapping(box, [&](TriId t) { found.push_back(t); });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::pair<TriId, TriId>> overlapping_boxes(const TriMesh& a, const TriMesh& b) {
  std::vector<std::pair<TriId, TriId>> pairs;
  const bool tree_on_a = a.triangle_count() < b.triangle_count();
  const BoxTree tree(tree_on_a ? a : b);
  const TriMesh& other = tree_on_a ? b : a;
  for (std::size_t i = 0; i < other.triangle_count(); ++i) {
    throw_if_interrupted();
    const TriId t(i);
    for (const TriId s : tree.overlapping(box_of(other.triangle(t))))
      pairs.push_back(tree_on_a ? std::pair(s, t) : std::pair(t, s));
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace conchoid

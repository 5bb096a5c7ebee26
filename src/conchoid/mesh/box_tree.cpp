#include "conchoid/mesh/box_tree.hpp"

#include <algorithm>

#include "conchoid/core/interrupt.hpp"

namespace conchoid {
namespace {

constexpr std::size_t leaf_size = 4;

}  // namespace

BoxTree::BoxTree(const TriMesh& mesh) {
  std::vector<Item> items;
  items.reserve(mesh.triangle_count());
  boxes_.reserve(mesh.triangle_count());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Triangle x = mesh.triangle(TriId(t));
    boxes_.push_back(box_of(x));
    items.push_back({boxes_.back(), x[0] + x[1] + x[2], t});
  }
  if (items.empty()) return;
  branches_.reserve(items.size());
  build(items, 0, items.size());
  order_.reserve(items.size());
  for (const Item& item : items)
    order_.push_back(item.triangle);
}

std::size_t BoxTree::build(std::vector<Item>& items, std::size_t begin, std::size_t end) {
  throw_if_interrupted();
  Box box = items[begin].box;
  for (std::size_t i = begin + 1; i < end; ++i)
    box = united(box, items[i].box);
  const std::size_t id = branches_.size();
  branches_.push_back({box, begin, end, 0, 0});
  if (end - begin <= leaf_size) return id;

  Eigen::Index axis = 0;
  (box.high - box.low).maxCoeff(&axis);
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [axis](const Item& p, const Item& q) {
    const double cp = p.center[axis], cq = q.center[axis];
    return cp != cq ? cp < cq : p.triangle < q.triangle;
  });
  const std::size_t left = build(items, begin, middle), right = build(items, middle, end);
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

#include "conchoid/mesh/box_tree.hpp"

#include <algorithm>

#include "conchoid/core/interrupt.hpp"
#include "conchoid/core/parallel.hpp"

namespace conchoid {
namespace {

constexpr std::size_t leaf_size = 4;
constexpr std::size_t levels_in_turn = 3, grain = 2000;

/// Of a tree of n triangles. On every level there are branches of two sizes at most, `size` and one more.
std::size_t branches_of(std::size_t n) {
  std::size_t size = n, smaller = 1, larger = 0, all = 0;
  while (smaller + larger > 0) {
    all += smaller + larger;
    if (size <= leaf_size) smaller = 0;
    if (size + 1 <= leaf_size) larger = 0;
    if (size % 2 == 0)
      smaller = 2 * smaller + larger;
    else
      larger = smaller + 2 * larger;
    size /= 2;
  }
  return all;
}

}  // namespace

BoxTree::BoxTree(const TriMesh& mesh) {
  std::vector<Item> items;
  items.reserve(mesh.triangle_count());
  boxes_.reserve(mesh.triangle_count());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Triangle x = mesh.triangle(TriId(t));
    boxes_.push_back(box_of(x));
    items.push_back({x[0] + x[1] + x[2], t});
  }
  build_all(std::move(items));
}

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
  std::vector<Item> items;
  items.reserve(boxes_.size());
  for (const Box& box : boxes_)
    items.push_back({box.low + box.high, items.size()});
  build_all(std::move(items));
}

void BoxTree::build_all(std::vector<Item> items) {
  if (items.empty()) return;
  branches_.resize(branches_of(items.size()));
  // The upper levels one after the other, what is below side by side.
  std::vector<Part> parts{{0, 0, items.size()}};
  std::vector<std::size_t> upper;
  for (std::size_t level = 0; level < levels_in_turn && parts.size() < items.size() / grain; ++level) {
    std::vector<Part> below;
    for (const Part& part : parts)
      if (Part left, right; halve(items, part, left, right)) {
        below.insert(below.end(), {left, right});
        upper.push_back(part.branch);
      }
    parts = std::move(below);
  }
  parallel_for(parts.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      build(items, parts[i]);
  });
  for (std::size_t i = upper.size(); i-- > 0;)
    close(upper[i]);
  order_.reserve(items.size());
  for (const Item& item : items)
    order_.push_back(item.triangle);
}

bool BoxTree::halve(std::vector<Item>& items, const Part& part, Part& left, Part& right) {
  const auto [id, begin, end] = part;
  Branch& branch = branches_[id];
  branch.begin = begin;
  branch.end = end;
  if (end - begin <= leaf_size) {
    branch.box = boxes_[items[begin].triangle];
    for (std::size_t i = begin + 1; i < end; ++i)
      branch.box = united(branch.box, boxes_[items[i].triangle]);
    return false;
  }
  Vec3 low = items[begin].center, high = low;
  for (std::size_t i = begin + 1; i < end; ++i) {
    low = low.cwiseMin(items[i].center);
    high = high.cwiseMax(items[i].center);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [axis](const Item& p, const Item& q) {
    const double cp = p.center[axis], cq = q.center[axis];
    return cp != cq ? cp < cq : p.triangle < q.triangle;
  });
  left = {id + 1, begin, middle};
  right = {id + 1 + branches_of(middle - begin), middle, end};
  branch.left = left.branch;
  branch.right = right.branch;
  return true;
}

void BoxTree::build(std::vector<Item>& items, const Part& part) {
  throw_if_interrupted();
  Part left, right;
  if (!halve(items, part, left, right)) return;
  build(items, left);
  build(items, right);
  close(part.branch);
}

void BoxTree::close(std::size_t branch) {
  Branch& b = branches_[branch];
  b.box = united(branches_[b.left].box, branches_[b.right].box);
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
  constexpr std::size_t at_once = 512;
  std::vector<std::vector<std::pair<TriId, TriId>>> found((other.triangle_count() + at_once - 1) / at_once);
  parallel_for(other.triangle_count(), at_once, [&](std::size_t begin, std::size_t end) {
    auto& own = found[begin / at_once];
    for (std::size_t i = begin; i < end; ++i) {
      const TriId t(i);
      tree.visit_overlapping(box_of(other.triangle(t)),
                             [&](TriId s) { own.push_back(tree_on_a ? std::pair(s, t) : std::pair(t, s)); });
    }
  });
  for (const auto& own : found)
    pairs.insert(pairs.end(), own.begin(), own.end());
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace conchoid

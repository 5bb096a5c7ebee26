#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "conchoid/mesh/box.hpp"

namespace conchoid {

/// Binary tree of axis-aligned boxes around the triangles of a mesh, each set of them halved at the median of
/// the centroids along the axis on which these lie farthest apart. Finds the triangles near a place in about log n steps.
class BoxTree {
 public:
  explicit BoxTree(const TriMesh& mesh);
  /// Of anything else: TriId(i) stands for what is in box i, whose middle is its centroid.
  explicit BoxTree(std::vector<Box> boxes);

  /// Triangles whose boxes meet the given one (touching counts), ascending.
  std::vector<TriId> overlapping(const Box& box) const;

  /// Calls visit(t) for each of these, in no order.
  template <class Visit>
  void visit_overlapping(const Box& box, const Visit& visit) const;

  /// Calls visit(t) for every triangle that may be nearer to x than the bound, near boxes first; visit
  /// returns the bound from there on, a squared distance [m²]. Boxes as far away as the bound are still
  /// visited, so that of equally near triangles any may be chosen.
  template <class Visit>
  void visit_near(const Vec3& x, double bound, const Visit& visit) const;

  /// Calls visit(t) for every triangle that the ray x + s·direction may meet at 0 ≤ s < bound, in no order;
  /// visit returns the bound from there on.
  template <class Visit>
  void visit_along(const Vec3& x, const Vec3& direction, double bound, const Visit& visit) const;

 private:
  struct Branch {
    Box box;
    std::size_t begin = 0, end = 0;   ///< range of order_ below this branch
    std::size_t left = 0, right = 0;  ///< children; 0 for a leaf (the root is nobody's child)
  };
  static constexpr std::size_t deepest = 64;  ///< halving leaves no tree deeper than the bits of a size

  /// A triangle on its way to its place: all that halving asks of it, side by side in memory.
  struct Item {
    Vec3 center;  ///< times any number, the same for all
    std::size_t triangle;
  };
  struct Part {
    std::size_t branch, begin, end;
  };
  void build_all(std::vector<Item> items);
  /// Halves the items of a part; false if they stay together, in a branch that then has its box.
  bool halve(std::vector<Item>& items, const Part& part, Part& left, Part& right);
  void build(std::vector<Item>& items, const Part& part);
  /// The box of a branch that has been halved.
  void close(std::size_t branch);

  std::vector<Box> boxes_;  ///< per triangle
  std::vector<std::size_t> order_;
  std::vector<Branch> branches_;
};

template <class Visit>
void BoxTree::visit_near(const Vec3& x, double bound, const Visit& visit) const {
  if (branches_.empty()) return;
  struct Waiting {
    std::size_t branch;
    double squared_distance;
  };
  std::array<Waiting, deepest> stack;
  std::size_t count = 0;
  stack[count++] = {0, squared_distance(branches_[0].box, x)};
  while (count > 0) {
    const Waiting now = stack[--count];
    if (now.squared_distance > bound) continue;
    const Branch& branch = branches_[now.branch];
    if (branch.left == 0) {
      for (std::size_t i = branch.begin; i < branch.end; ++i)
        bound = visit(TriId(order_[i]));
      continue;
    }
    Waiting near{branch.left, squared_distance(branches_[branch.left].box, x)};
    Waiting far{branch.right, squared_distance(branches_[branch.right].box, x)};
    if (far.squared_distance < near.squared_distance) std::swap(near, far);
    stack[count++] = far;
    stack[count++] = near;
  }
}

template <class Visit>
void BoxTree::visit_along(const Vec3& x, const Vec3& direction, double bound, const Visit& visit) const {
  if (branches_.empty()) return;
  std::array<std::size_t, deepest> stack;
  std::size_t count = 0;
  stack[count++] = 0;
  while (count > 0) {
    const Branch& branch = branches_[stack[--count]];
    if (!may_meet(branch.box, x, direction, bound)) continue;
    if (branch.left != 0) {
      stack[count++] = branch.left;
      stack[count++] = branch.right;
      continue;
    }
    for (std::size_t i = branch.begin; i < branch.end; ++i)
      if (may_meet(boxes_[order_[i]], x, direction, bound)) bound = visit(TriId(order_[i]));
  }
}

template <class Visit>
void BoxTree::visit_overlapping(const Box& box, const Visit& visit) const {
  if (branches_.empty()) return;
  std::array<std::size_t, deepest> stack;
  std::size_t count = 0;
  stack[count++] = 0;
  while (count > 0) {
    const Branch& branch = branches_[stack[--count]];
    if (!overlap(branch.box, box)) continue;
    if (branch.left != 0) {
      stack[count++] = branch.left;
      stack[count++] = branch.right;
      continue;
    }
    for (std::size_t i = branch.begin; i < branch.end; ++i)
      if (overlap(boxes_[order_[i]], box)) visit(TriId(order_[i]));
  }
}

/// All pairs (triangle of a, triangle of b) whose boxes meet (touching counts), ascending.
std::vector<std::pair<TriId, TriId>> overlapping_boxes(const TriMesh& a, const TriMesh& b);

}  // namespace conchoid

#include "conchoid/intersect/corefine_pairs.hpp"

#include <algorithm>
#include <numeric>

namespace conchoid {
namespace {

Box box_of(const TriMesh& mesh, TriId t) {
  const Triangle x = mesh.triangle(t);
  return {x[0].cwiseMin(x[1]).cwiseMin(x[2]), x[0].cwiseMax(x[1]).cwiseMax(x[2])};
}

bool meet(const Box& p, const Box& q) {
  return (p.low.array() <= q.high.array()).all() && (q.low.array() <= p.high.array()).all();
}

/// Binary tree of boxes over the triangles of a mesh, halved at the median of the longest side.
class BoxTree {
 public:
  explicit BoxTree(const TriMesh& mesh) : order_(mesh.triangle_count()) {
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
      boxes_.push_back(box_of(mesh, TriId(t)));
    std::iota(order_.begin(), order_.end(), 0);
    if (!order_.empty()) build(0, order_.size());
  }

  template <class Visit>
  void query(const Box& box, Visit visit) const {
    if (nodes_.empty()) return;
    std::vector<std::size_t> stack{0};
    while (!stack.empty()) {
      const Node& node = nodes_[stack.back()];
      const std::size_t self = stack.back();
      stack.pop_back();
      if (!meet(node.box, box)) continue;
      if (node.right == 0) {
        for (std::size_t i = node.begin; i < node.end; ++i)
          if (meet(boxes_[order_[i]], box)) visit(TriId(order_[i]));
      } else {
        stack.push_back(self + 1);
        stack.push_back(node.right);
      }
    }
  }

  Box all() const { return nodes_.empty() ? Box{Vec3::Zero(), Vec3::Zero()} : nodes_[0].box; }

 private:
  struct Node {
    Box box;
    std::size_t begin, end;
    std::size_t right;  ///< second child (the first follows its parent); 0 for a leaf
  };

  void build(std::size_t begin, std::size_t end) {
    const std::size_t self = nodes_.size();
    Box box = boxes_[order_[begin]];
    for (std::size_t i = begin; i < end; ++i) {
      box.low = box.low.cwiseMin(boxes_[order_[i]].low);
      box.high = box.high.cwiseMax(boxes_[order_[i]].high);
    }
    nodes_.push_back({box, begin, end, 0});
    if (end - begin <= 4) return;
    int axis = 0;
    (box.high - box.low).maxCoeff(&axis);
    const std::size_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + static_cast<long>(begin), order_.begin() + static_cast<long>(middle),
                     order_.begin() + static_cast<long>(end), [&](std::size_t x, std::size_t y) {
                       return boxes_[x].low[axis] + boxes_[x].high[axis] <
                              boxes_[y].low[axis] + boxes_[y].high[axis];
                     });
    build(begin, middle);
    nodes_[self].right = nodes_.size();
    build(middle, end);
  }

  std::vector<Box> boxes_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace

std::vector<std::pair<TriId, TriId>> overlapping_boxes(const TriMesh& a, const TriMesh& b) {
  std::vector<std::pair<TriId, TriId>> pairs;
  const bool tree_on_a = a.triangle_count() < b.triangle_count();
  const BoxTree tree(tree_on_a ? a : b);
  const TriMesh& other = tree_on_a ? b : a;
  const Box all = tree.all();
  for (std::size_t t = 0; t < other.triangle_count(); ++t) {
    const Box box = box_of(other, TriId(t));
    if (!meet(all, box)) continue;
    tree.query(box, [&](TriId s) { pairs.emplace_back(tree_on_a ? s : TriId(t), tree_on_a ? TriId(t) : s); });
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace conchoid

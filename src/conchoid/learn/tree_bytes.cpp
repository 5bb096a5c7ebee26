#include "conchoid/learn/tree_bytes.hpp"

namespace conchoid {
namespace {

constexpr std::uint8_t kLeaf = 255;

}  // namespace

// Breadth first, so that the children of inner nodes follow each other and need no index.
void put_trees(ByteWriter& out, const TreeEnsemble& ensemble) {
  const std::vector<RegressionTree> trees = ensemble.trees();
  out.put(static_cast<std::uint32_t>(trees.size()));
  for (const RegressionTree& tree : trees) {
    std::vector<std::uint8_t> feature(tree.size());
    std::vector<float> number(tree.size());
    for (std::size_t i = 0; i < tree.size(); ++i) {
      feature[i] = tree.left[i] < 0 ? kLeaf : static_cast<std::uint8_t>(tree.feature[i]);
      number[i] = tree.left[i] < 0 ? tree.value[i] : tree.threshold[i];
    }
    out.put(static_cast<std::uint32_t>(tree.size()));
    out.put_all(std::span<const std::uint8_t>(feature));
    out.put_all(std::span<const float>(number));
  }
}

TreeEnsemble get_trees(ByteReader& in, int features) {
  const auto count = in.get<std::uint32_t>();
  if (count > in.left()) throw OutOfBytes();
  std::vector<RegressionTree> trees(count);
  for (RegressionTree& tree : trees) {
    const auto nodes = in.get<std::uint32_t>();
    const auto feature = in.get_all<std::uint8_t>(nodes);
    const auto number = in.get_all<float>(nodes);
    std::int32_t next = 1;
    for (std::size_t i = 0; i < nodes; ++i) {
      const bool is_leaf = feature[i] == kLeaf;
      tree.feature.push_back(is_leaf ? -1 : feature[i]);
      tree.left.push_back(is_leaf ? -1 : next);
      tree.right.push_back(is_leaf ? -1 : next + 1);
      tree.threshold.push_back(is_leaf ? 0 : number[i]);
      tree.value.push_back(is_leaf ? number[i] : 0);
      next += is_leaf ? 0 : 2;
    }
  }
  return TreeEnsemble(trees, features);
}

}  // namespace conchoid

#include "conchoid/learn/tree_ensemble.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

constexpr std::size_t max_features = 128;
constexpr std::size_t max_nodes = std::size_t{1} << 26;
constexpr float endless = std::numeric_limits<float>::infinity();

[[noreturn]] void refuse(const std::string& what) {
  throw InputError("regression tree: " + what);
}

void check_arrays(const RegressionTree& tree) {
  const std::size_t n = tree.size();
  if (n == 0) refuse("it has no nodes");
  if (tree.feature.size() != n || tree.right.size() != n || tree.threshold.size() != n ||
      tree.value.size() != n)
    refuse("its arrays differ in length");
}

}  // namespace

TreeEnsemble::TreeEnsemble(const std::vector<RegressionTree>& trees, int features) : features_(features) {
  if (features < 1 || features > static_cast<int>(max_features))
    refuse("the number of features must lie between 1 and " + std::to_string(max_features));
  for (const RegressionTree& tree : trees) {
    check_arrays(tree);
    if (nodes_.size() + tree.size() > max_nodes) refuse("the forest has too many nodes");
    const auto n = static_cast<std::int32_t>(tree.size());
    const std::size_t root = nodes_.size();
    roots_.push_back(static_cast<std::uint32_t>(root));
    struct Entry {
      std::int32_t node;
      int depth;
    };
    std::vector<Entry> order = {{0, 0}};  // breadth first: position in `order` + root = index in nodes_
    for (std::size_t k = 0; k < order.size(); ++k) {
      const auto [node, depth] = order[k];
      const auto i = static_cast<std::size_t>(node);
      if (tree.left[i] < 0) {
        if (!std::isfinite(tree.value[i])) refuse("a leaf holds no finite number");
        nodes_.push_back({endless, 0u, static_cast<std::uint32_t>(root + k) & 0x3ffffffu});
        values_.push_back(tree.value[i]);
        continue;
      }
      if (tree.left[i] >= n || tree.right[i] < 0 || tree.right[i] >= n) refuse("a child does not exist");
      if (tree.feature[i] < 0 || tree.feature[i] >= features)
        refuse("it asks for a feature that does not exist");
      if (!std::isfinite(tree.threshold[i])) refuse("a threshold is not a finite number");
      if (order.size() + 2 > tree.size()) refuse("a node has two parents");
      nodes_.push_back({tree.threshold[i], static_cast<std::uint32_t>(tree.feature[i]) & 0x3fu,
                        static_cast<std::uint32_t>(root + order.size()) & 0x3ffffffu});
      values_.push_back(0);
      order.push_back({tree.left[i], depth + 1});
      order.push_back({tree.right[i], depth + 1});
    }
    depths_.push_back(order.back().depth);
  }
}

int TreeEnsemble::depth() const {
  return depths_.empty() ? 0 : *std::max_element(depths_.begin(), depths_.end());
}

template <std::size_t Lanes>
void TreeEnsemble::evaluate_block(const float* rows, Answer* answers) const {
  const auto columns = static_cast<std::size_t>(features_);
  std::array<float, Lanes * max_features> x;
  for (std::size_t r = 0; r < Lanes; ++r)
    std::copy_n(rows + r * columns, columns, x.data() + r * max_features);
  std::array<double, Lanes> sum{}, square{};
  const Node* const nodes = nodes_.data();
  for (std::size_t t = 0; t < roots_.size(); ++t) {
    std::array<std::uint32_t, Lanes> at;
    at.fill(roots_[t]);
    for (int level = 0; level < depths_[t]; ++level)
      for (std::size_t r = 0; r < Lanes; ++r) {
        const Node node = nodes[at[r]];
        at[r] =
            node.left + static_cast<std::uint32_t>(!(x[r * max_features + node.feature] < node.threshold));
      }
    for (std::size_t r = 0; r < Lanes; ++r) {
      const double value = values_[at[r]];
      sum[r] += value;
      square[r] += value * value;
    }
  }
  const auto n = static_cast<double>(roots_.size());
  for (std::size_t r = 0; r < Lanes; ++r) {
    const double mean = sum[r] / n;
    const double variance = roots_.size() > 1 ? (square[r] - sum[r] * mean) / (n - 1) : 0.0;
    answers[r] = {mean, std::sqrt(std::max(0.0, variance))};
  }
}

void TreeEnsemble::evaluate(std::span<const float> rows, std::span<Answer> answers) const {
  const auto columns = static_cast<std::size_t>(features_);
  // Rows walk a tree side by side, to hide the latency of memory.
  std::size_t i = 0;
  for (; i + 16 <= answers.size(); i += 16)
    evaluate_block<16>(rows.data() + i * columns, answers.data() + i);
  for (; i + 4 <= answers.size(); i += 4)
    evaluate_block<4>(rows.data() + i * columns, answers.data() + i);
  for (; i < answers.size(); ++i)
    evaluate_block<1>(rows.data() + i * columns, answers.data() + i);
}

std::vector<RegressionTree> TreeEnsemble::trees() const {
  std::vector<RegressionTree> result(roots_.size());
  for (std::size_t t = 0; t < roots_.size(); ++t) {
    RegressionTree& tree = result[t];
    const std::size_t begin = roots_[t];
    const std::size_t end = t + 1 < roots_.size() ? roots_[t + 1] : nodes_.size();
    for (std::size_t i = begin; i < end; ++i) {
      const bool leaf = nodes_[i].threshold == endless;
      const auto left = static_cast<std::int32_t>(nodes_[i].left - begin);
      tree.feature.push_back(leaf ? -1 : static_cast<std::int32_t>(nodes_[i].feature));
      tree.left.push_back(leaf ? -1 : left);
      tree.right.push_back(leaf ? -1 : left + 1);
      tree.threshold.push_back(leaf ? 0 : nodes_[i].threshold);
      tree.value.push_back(values_[i]);
    }
  }
  return result;
}

}  // namespace conchoid

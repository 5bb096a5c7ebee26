#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace conchoid {

/// One regression tree as flat arrays: node 0 is the root; a node with left < 0 is a leaf with a value. At
/// every other node the walk goes left where x[feature] < threshold (compared in single precision), else
/// right.
struct RegressionTree {
  std::vector<std::int32_t> feature, left, right;
  std::vector<float> threshold, value;

  std::size_t size() const { return left.size(); }
};

/// Trees over the same features, ready for fast evaluation of many rows. The answer is the mean of the trees'
/// values.
class TreeEnsemble {
 public:
  TreeEnsemble() = default;
  /// @param features number of features per row
  /// Throws InputError if a tree is not one: feature or child out of range, a node with two parents or none,
  /// not-finite numbers.
  TreeEnsemble(const std::vector<RegressionTree>& trees, int features);

  struct Answer {
    double mean = 0;
    double spread = 0;  ///< standard deviation between the trees (0 for one tree)
  };
  /// Answers for rows.size() / features rows (row after row, finite numbers). Rows are independent: splitting
  /// the work changes no bit.
  void evaluate(std::span<const float> rows, std::span<Answer> answers) const;

  std::size_t tree_count() const { return roots_.size(); }
  std::size_t node_count() const { return nodes_.size(); }
  int depth() const;
  /// The trees as flat arrays again, nodes breadth first.
  std::vector<RegressionTree> trees() const;

 private:
  /// Children are neighbours, so one index holds both; a leaf is its own child under an infinite threshold,
  /// so that a walk of fixed length ends there.
  struct Node {
    float threshold;
    std::uint32_t feature : 6, left : 26;
  };
  template <std::size_t Lanes>
  void evaluate_block(const float* rows, Answer* answers) const;

  int features_ = 0;
  std::vector<Node> nodes_;
  std::vector<float> values_;
  std::vector<std::uint32_t> roots_;
  std::vector<int> depths_;
};

}  // namespace conchoid

#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace conchoid {

/// Sets of the numbers 0 … n−1 that are joined two at a time.
class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i)
      i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// The smaller root stays: numbering by first member.
  void join(std::size_t i, std::size_t j) {
    i = root(i);
    j = root(j);
    if (i < j)
      parent_[j] = i;
    else
      parent_[i] = j;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace conchoid

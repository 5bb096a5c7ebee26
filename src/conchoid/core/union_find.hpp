#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace conchoid {

/// Sets of the numbers 0 … n−1 (n < 2³²) that are joined two at a time.
class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  /// The smaller root stays: numbering by first member.
  void join(std::size_t i, std::size_t j) {
    i = root(i);
    j = root(j);
    if (i < j)
      parent_[j] = static_cast<std::uint32_t>(i);
    else
      parent_[i] = static_cast<std::uint32_t>(j);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace conchoid

#pragma once

#include <cstddef>
#include <vector>

#include "conchoid/quadrature/pair_integrals.hpp"

namespace conchoid {

/// Integrals of panel pairs from one growth of a crack to the next. The panels behind a front are integrated
/// when the nodes behind them come into the system, and again when the front has passed and their other nodes
/// follow; what is known from the first time has the same bits and need not be computed again.
/// Memory: 80 bytes per remembered panel and panel of the body and its cracks; those at the front and at
/// the mouth are remembered.
class PairMemory {
 public:
  /// Integrals of one panel x with all others, as far as they were needed.
  struct Row {
    std::vector<SingleLayerPair> single_layer;  ///< empty: x is not remembered
    std::vector<DoubleLayerPair>
        double_layer;  ///< x where the integral is tested, the other panel's functions
    std::vector<char> has_single, has_double;
    bool empty() const { return single_layer.empty(); }
  };
  static Row row_of(std::size_t panels);

  /// Looks up which of these panels were there when remember() was called last. The lookups below mean them.
  void match(const std::vector<Panel>& panels);
  /// The integral of the pair (x, y), if it is known from x.
  const SingleLayerPair* single_layer(std::size_t x, std::size_t y) const;
  const DoubleLayerPair* double_layer(std::size_t x, std::size_t y) const;

  /// Replaces what is known. @param rows  one per panel
  void remember(const std::vector<Panel>& panels, std::vector<Row> rows);

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  struct Place {
    const Row* row = nullptr;
    std::size_t at = 0;
  };
  Place find(std::size_t x, std::size_t y) const;

  std::vector<Panel> known_;
  std::vector<Row> rows_;            // per known panel
  std::vector<Panel> now_;           // as matched
  std::vector<std::size_t> before_;  // per panel now: which known one it is, or kNone
};

}  // namespace conchoid

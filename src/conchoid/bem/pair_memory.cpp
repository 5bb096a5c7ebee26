#include "conchoid/bem/pair_memory.hpp"

#include <array>
#include <map>

namespace conchoid {
namespace {

using Key = std::array<double, 9>;

Key key_of(const Panel& p) {
  Key key;
  for (std::size_t k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i)
      key[3 * k + static_cast<std::size_t>(i)] = p.x[k][i];
  return key;
}

}  // namespace

PairMemory::Row PairMemory::row_of(std::size_t panels) {
  return {std::vector<SingleLayerPair>(panels), std::vector<DoubleLayerPair>(panels),
          std::vector<char>(panels, 0), std::vector<char>(panels, 0)};
}

void PairMemory::match(const std::vector<Panel>& panels) {
  std::map<Key, std::size_t> known;
  for (std::size_t i = 0; i < known_.size(); ++i)
    known.emplace(key_of(known_[i]), i);
  now_ = panels;
  before_.assign(panels.size(), kNone);
  for (std::size_t i = 0; i < panels.size(); ++i)
    if (const auto found = known.find(key_of(panels[i])); found != known.end()) before_[i] = found->second;
}

PairMemory::Place PairMemory::find(std::size_t x, std::size_t y) const {
  if (x >= before_.size() || y >= before_.size()) return {};
  const std::size_t a = before_[x], b = before_[y];
  if (a == kNone || b == kNone || rows_[a].empty()) return {};
  if (!same_integrals(known_[a], known_[b], now_[x], now_[y])) return {};
  return {&rows_[a], b};
}

const SingleLayerPair* PairMemory::single_layer(std::size_t x, std::size_t y) const {
  const auto [row, at] = find(x, y);
  return row && row->has_single[at] ? &row->single_layer[at] : nullptr;
}

const DoubleLayerPair* PairMemory::double_layer(std::size_t x, std::size_t y) const {
  const auto [row, at] = find(x, y);
  return row && row->has_double[at] ? &row->double_layer[at] : nullptr;
}

void PairMemory::remember(const std::vector<Panel>& panels, std::vector<Row> rows) {
  known_ = panels;
  rows_ = std::move(rows);
  now_.clear();
  before_.clear();
}

}  // namespace conchoid

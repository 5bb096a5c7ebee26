#include "conchoid/surface/small_fragments.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "conchoid/surface/contacts.hpp"
#include "conchoid/surface/weld_fragments.hpp"

namespace conchoid {
namespace {

/// Pieces joined so far, and what they share.
class Groups {
 public:
  explicit Groups(const std::vector<Fragment>& pieces)
      : count_(pieces.size()), into_(pieces.size()), stuck_(pieces.size(), false), shared_(pieces.size()) {
    std::iota(into_.begin(), into_.end(), 0);
    for (const Fragment& f : pieces)
      volume_.push_back(f.volume);
    for (const FragmentContact& c : fragment_contacts(pieces))
      shared_[c.first][c.second] = shared_[c.second][c.first] = c.area;
  }

  void shrink(const FragmentLimits& limits) {
    for (std::size_t small = smallest(); small < into_.size(); small = smallest()) {
      const bool too_many = limits.maximum_count > 0 && count_ > limits.maximum_count;
      if (!too_many && volume_[small] >= limits.minimum_volume) return;
      if (shared_[small].empty())
        stuck_[small] = true;
      else
        join(small, closest(small));
    }
  }

  /// Members of each group, by their first.
  std::map<std::size_t, std::vector<std::size_t>> members() const {
    std::map<std::size_t, std::vector<std::size_t>> out;
    std::vector<std::size_t> first(into_.size(), into_.size());
    for (std::size_t i = 0; i < into_.size(); ++i) {
      std::size_t& f = first[into_[i]];
      if (f == into_.size()) f = i;
      out[f].push_back(i);
    }
    return out;
  }

 private:
  std::size_t smallest() const {
    std::size_t found = into_.size();
    for (std::size_t i = 0; i < into_.size(); ++i)
      if (into_[i] == i && !stuck_[i] && (found == into_.size() || volume_[i] < volume_[found])) found = i;
    return found;
  }

  std::size_t closest(std::size_t small) const {
    return std::max_element(shared_[small].begin(), shared_[small].end(),
                            [](const auto& x, const auto& y) { return x.second < y.second; })
        ->first;
  }

  void join(std::size_t small, std::size_t into) {
    for (const auto& [other, area] : shared_[small]) {
      shared_[other].erase(small);
      if (other == into) continue;
      shared_[other][into] += area;
      shared_[into][other] += area;
    }
    shared_[small].clear();
    volume_[into] += volume_[small];
    for (std::size_t& i : into_)
      if (i == small) i = into;
    --count_;
  }

  std::size_t count_;
  std::vector<std::size_t> into_;
  std::vector<double> volume_;
  std::vector<bool> stuck_;
  std::vector<std::map<std::size_t, double>> shared_;
};

}  // namespace

std::vector<Fragment> joined_small_fragments(std::vector<Fragment> fragments, const FragmentLimits& limits) {
  const bool few = limits.maximum_count == 0 || fragments.size() <= limits.maximum_count;
  if (few && std::all_of(fragments.begin(), fragments.end(),
                         [&](const Fragment& f) { return f.volume >= limits.minimum_volume; }))
    return fragments;
  Groups groups(fragments);
  groups.shrink(limits);
  std::vector<Fragment> out;
  for (const auto& [first, members] : groups.members())
    out.push_back(members.size() == 1 ? fragments[first] : welded(fragments, members));
  return out;
}

}  // namespace conchoid

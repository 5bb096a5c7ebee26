#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "conchoid/learn/front_network.hpp"

namespace conchoid {

struct NetworkSettings {
  int members = 8;         ///< networks whose mean counts, 1 … 64
  int width = 64;          ///< of the hidden layers, 2 … 1024
  int convolutions = 3;    ///< 1 … 16: so many neighbours on either side count
  int epochs = 30;         ///< times that all samples are looked at, ≥ 1
  double rate = 3e-3;      ///< of learning, at the beginning; falls to nothing as a cosine
  std::uint64_t seed = 1;  ///< of the first weights and of the order of the samples
};

/// What networks are fitted to: columns side by side.
struct NetworkData {
  FrontNetwork::Matrix rows, wanted;  ///< features, labels
  std::vector<char> goes_on;          ///< per column, whether the next one is its neighbour
  std::vector<int> group;             ///< per column, that of its run (run_groups.hpp)
};

/// A network fitted to all groups but `left_out` by stochastic gradients (AdamW, Loshchilov & Hutter 2019) over batches of
/// whole stretches of fronts, as it was after the epoch in which it answered that group best; if nothing is left out, as
/// it was at the end. The same bits on every run on one kind of processor (BLAS), if BLAS is held to one thread. @param progress  called after every epoch; may throw to stop
FrontNetwork fit_network(const NetworkData& data, int left_out, const NetworkSettings& settings,
                         const std::function<void()>& progress);

}  // namespace conchoid

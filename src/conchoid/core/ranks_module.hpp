#pragma once

#include <string>

#include "conchoid/core/module.hpp"

namespace conchoid {

constexpr Module kRanksModule{"conchoid_ranks", "MPI", "CONCHOID_WITH_MPI"};

/// What the module does for Ranks; one call at a time.
using RanksBegin = void(int& rank, int& size);
using RanksSend = void(int to, const std::string& bytes);
/// @return whether there was a message @param from  in: of this rank, or any if below 0; out: whose it is
using RanksPoll = bool(int& from, std::string& bytes);
using RanksEnd = void();

}  // namespace conchoid

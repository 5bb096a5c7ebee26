#pragma once

#include <map>
#include <string>

#include "conchoid/learn/database.hpp"
#include "conchoid/learn/evaluate.hpp"
#include "conchoid/learn/regressor.hpp"

namespace conchoid {

/// What `database info` tells.
struct DatabaseInfo {
  DatabaseHeader header;
  std::size_t runs = 0, samples = 0, excluded_runs = 0, training_samples = 0;
  // Of the training samples, what the published feature sets leave out:
  std::size_t end_game_samples = 0;  ///< is_end_game()
  std::size_t new_node_samples = 0;  ///< is_new_on_front()
  bool complete = false;
  std::vector<std::string> features;         ///< names of the recorded quantities
  std::vector<std::string> feature_sets;     ///< sets that can be computed from them
  std::map<std::string, std::size_t> stops;  ///< number of runs per reason to stop
  std::map<std::string, std::size_t>
      exclusions;  ///< number of runs per reason of exclusion (the part before the colon)
  double mean_frames = 0;
  double wall_seconds = 0;  ///< of all runs together
  std::uint64_t hash = 0;   ///< Database::hash
};
DatabaseInfo database_info(const Database& database);

/// Of one quantity over samples. The coefficient of variation is the standard deviation over the mean, with
/// the sign of the mean.
struct Statistics {
  double median = 0, mean = 0, coefficient_of_variation = 0, minimum = 0, maximum = 0;
};
Statistics statistics(std::vector<double> values);

/// What `database stats` tells: K_I, K_II, K_III [Pa√m] over the training samples (the published Table 1).
struct DatabaseStatistics {
  std::size_t samples = 0;
  std::array<Statistics, 3> K;
};
DatabaseStatistics database_statistics(const Database& database);

// One JSON object each, as the command line prints it.
std::string json_text(const DatabaseInfo& info);
std::string json_text(const DatabaseStatistics& statistics);
std::string json_text(const Evaluation& evaluation);
/// Kind, settings, provenance, ranges and sizes of a regressor.
std::string json_text(const Regressor& regressor);

}  // namespace conchoid

#pragma once

#include <filesystem>

#include "conchoid/core/ranks.hpp"
#include "conchoid/learn/database.hpp"
#include "conchoid/sim/database_spec.hpp"

namespace conchoid {

struct GenerateOptions {
  std::filesystem::path out;  ///< database file
  int shard = 1, shards = 1;  ///< this program's share: runs with id ≡ shard − 1 modulo shards
  bool resume = false;        ///< go on with what `out` holds
  bool close = false;         ///< make no more runs: write `out` from those that are finished
  Ranks* ranks = nullptr;     ///< of a job whose processes share the runs; null: this one makes all
};

/// Runs the scenes of a database, one per worker thread, and keeps every finished run at once
/// (learn/database.hpp). The database is the same for every number of threads and ranks, and after an interruption the
/// same as without one. Of several ranks the first one alone reads and writes files of the database: the others send it what
/// they have made. All need the specification and what it names. Throws Interrupted after Ctrl-C; what is finished is on the disk and is taken up by
/// `resume`. A run that cannot be computed is recorded as excluded, with its message as the reason.
void generate_database(const DatabaseSpec& spec, const GenerateOptions& options);

}  // namespace conchoid

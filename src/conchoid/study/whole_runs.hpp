#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "conchoid/io/outcome.hpp"
#include "conchoid/learn/regressor.hpp"
#include "conchoid/mesh/tri_mesh.hpp"
#include "conchoid/sim/database_spec.hpp"

namespace conchoid {

/// A method that whole runs are made by (sim/methods.hpp).
struct RunMethod {
  std::string title;   ///< in tables
  std::string method;  ///< by name
  const Regressor* regressor = nullptr;
  std::optional<double> tolerance = {};  ///< of hybrid runs (sim/methods.hpp)
};

/// A run by one method beside the same solved by boundary elements. Both end with the first separation.
struct WholeRun {
  std::int32_t run = 0;
  std::string body_class, title;  ///< of the method, or of a small change
  StopReason stop = StopReason::intact, solved_stop = StopReason::intact;
  int frames = 0, solved_frames = 0;
  double surface =
      0;  ///< mean distance of the crack surfaces / diagonal of the body; 1: only one has a crack
  double of_crack = 0;                     ///< the same / diagonal of the solved crack
  double seconds = 0, solved_seconds = 0;  ///< of finding openings
};

/// Runs of a specification, of which no more than a few should be in any database that regressors were trained on. Runs
/// that boundary elements end within less than `least_frames`, or cannot compute, say nothing and are left out. A
/// method has 2 n + 4 frames, n those solved. Runs are made in parallel; the answer does not depend on the number of threads.
struct WholeRuns {
  std::vector<WholeRun> rows;  ///< run after run, methods in their order
  int left_out = 0;            ///< runs
};
struct WholeRunSettings {
  int least_frames = 4;
  double load = 1;  ///< times that of the specification
  bool noise_floor =
      false;  ///< boundary elements on the small changes of each scene, too (small_changes.hpp)
};
WholeRuns whole_runs(const DatabaseSpec& spec, std::span<const std::int32_t> runs,
                     const std::vector<RunMethod>& methods, const WholeRunSettings& settings = {});

/// The crack surfaces of a row, made again, to be looked at.
struct CrackSurfaces {
  TriMesh body, solved, made;
};
/// Of rows of one method, in their order; `settings` are those of their table. Runs are made in parallel. Throws InputError
/// where the specification has no such run.
std::vector<CrackSurfaces> crack_surfaces(const DatabaseSpec& spec, std::span<const WholeRun> rows,
                                          const RunMethod& method, const WholeRunSettings& settings = {});

/// The rows of a method that are farthest off, the farthest first.
std::vector<WholeRun> farthest_off(const WholeRuns& runs, const std::string& title, std::size_t count);

/// What a method does over the runs of a class.
struct WholeRunScore {
  int runs = 0;
  double median = 0, p95 = 0, largest = 0;  ///< of WholeRun::surface
  double frames_ratio = 0;                  ///< median of frames / solved frames
  double opening_ratio = 0;                 ///< seconds / solved seconds, both summed over the runs
  int lost = 0;  ///< runs at the frame limit that boundary elements ended otherwise
};
/// By class and title; the class "" is all of them together.
std::map<std::pair<std::string, std::string>, WholeRunScore> scores(const WholeRuns& runs);

}  // namespace conchoid

#pragma once

#include <cstdint>
#include <string>

namespace conchoid {

/// What has to be known about a finished run to decide whether to learn from it.
struct RunSummary {
  double alpha = 0;           ///< slope of the force direction [degree], 0 … 90
  std::int32_t frames = 0;    ///< frames the run took
  bool stopped = true;        ///< came to an end by itself (arrested, separated), not by the frame limit
  std::int32_t cracks = 0;    ///< cracks that started
  double largest_growth = 0;  ///< farthest distance any crack front has travelled [m]
  double resolution = 1;      ///< r̄ [m]
};

/// The published exclusions, with the numbers that the publication leaves open.
struct ExclusionSettings {
  std::int32_t frame_limit = 31;  ///< published
  std::int32_t many_cracks = 3;   ///< from so many cracks on, all of them tiny, a run is excluded
  double tiny_growth = 2;         ///< a crack is tiny if its front has travelled less than this many r̄
  double alpha_limit = 85;        ///< slopes above this count as "near 90°" [degree]
};

/// Why a run is not to be learned from; empty if it may be. Published reasons: forces near α = 90°, runs that
/// do not stop within 31 frames, runs that only make many tiny cracks; and runs in which nothing cracks,
/// which have no samples anyway.
std::string exclusion_reason(const RunSummary& run, const ExclusionSettings& settings = {});

}  // namespace conchoid

#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "conchoid/study/frame_history.hpp"

namespace conchoid {

/// Metrics between two runs of one scene. What cannot be said is NaN (null in JSON).
struct Comparison {
  double surface_mean = 0;   ///< mean distance between the crack surfaces, both directions averaged [m]; one
                             ///< diagonal where only one run has a crack
  double surface_p95 = 0;    ///< 95th percentile, likewise [m]
  double bbox_diagonal = 0;  ///< of the body; of both crack surfaces where the body is infinite [m]
  std::array<int, 2> frames{0, 0};
  Vec3 sif_log_error = Vec3::Zero();  ///< per mode, see conchoid::sif_log_error
  double area_ratio = 0;              ///< crack area of b over crack area of a
  double largest_fragment_iou =
      0;                  ///< intersection over union of the largest fragments, see largest_fragment_overlap
  bool same_body = true;  ///< the bounding boxes of the bodies agree
  double crack_diagonal = 0;  ///< of the bounding box of a's crack surface, or b's where a has none [m]
  std::array<StopReason, 2> stop{StopReason::intact, StopReason::intact};
  double front_distance = 0;    ///< mean of FrameComparison::front_distance over the frames both have [m]
  double kink_angle_error = 0;  ///< root mean square of FrameComparison::kink_angle over these frames [rad]
  std::array<std::vector<double>, 2> volumes;  ///< of the fragments, largest first [m³]
  double volume_error = 0;  ///< Σ|V_a − V_b| over the fragments by rank, over Σ V_a; missing ones are empty
  double fragment_chamfer = 0;  ///< see conchoid::fragment_chamfer [m]
  std::vector<FrameComparison> history;
};

/// How much the stress intensities of two runs differ: per mode the mean over the frames both have of |ln(K̄_a
/// / K̄_b)|, K̄ the mean of |K| over the front nodes of a frame. 0.1 stands for about 10 %. A mode that plays
/// no part in a frame (K̄ below 2 % of that run's mean √(K_I² + K_II² + K_III²), in both runs) is left out
/// there; where it does so in one run, that share counts as its K̄. NaN for a mode that plays no part in any
/// frame.
Vec3 sif_log_error(const std::vector<FrontRow>& a, const std::vector<FrontRow>& b);

/// Chamfer distance between fragments: each is paired with the one of the other run that it overlaps best; of
/// the two surfaces the mean distance of points of one from the other, both directions averaged [m]. Mean over
/// the fragments of both runs, weighted by volume. NaN where one of the runs has no fragments. (The sum of both
/// directions, as learned shape predictors report it, is twice this.)
double fragment_chamfer(const std::vector<Fragment>& a, const std::vector<Fragment>& b);

Comparison compare(const RunData& a, const RunData& b);

/// Reads two run folders and compares them. Throws InputError (file and remedy) for a folder that is foreign,
/// unfinished or damaged.
Comparison compare_runs(const std::filesystem::path& a, const std::filesystem::path& b);

/// The object that `compare --json` prints.
std::string comparison_json(const Comparison& comparison);

}  // namespace conchoid

#pragma once

#include <array>
#include <map>
#include <vector>

#include "conchoid/io/run_folder.hpp"

namespace conchoid {

/// Averages over the front points of one frame.
struct FrontAverage {
  Vec3 intensity = Vec3::Zero();  ///< of |K_I|, |K_II|, |K_III| [Pa√m]
  double length = 0;              ///< of √(K_I² + K_II² + K_III²) [Pa√m]
  std::size_t points = 0;
};
/// By frame.
std::map<int, FrontAverage> front_averages(const std::vector<FrontRow>& rows);

/// Two runs in a frame that both have. What cannot be said is NaN.
struct FrameComparison {
  int frame = 0;
  std::array<double, 2> crack_area{};  ///< of the boundary elements after the frame [m²]
  std::array<Vec3, 2> intensity{};     ///< FrontAverage::intensity [Pa√m]
  double front_distance = 0;  ///< mean distance of the front points of one run from the front of the other, a
                              ///< line through its points; both directions averaged [m]
  double kink_angle = 0;      ///< root mean square difference between the kink angle of a front point that
                              ///< moves and that of the nearest one that moves in the other run [rad]
};

/// Frames both runs have front points in, ascending.
std::vector<FrameComparison> compare_frames(const RunData& a, const RunData& b);

}  // namespace conchoid

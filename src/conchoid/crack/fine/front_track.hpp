#pragma once

#include <vector>

#include "conchoid/crack/fine/marker_curve.hpp"

namespace conchoid {

/// Where one front smoothed over r̄ passed during a frame: what a finer front along it is held against.
class FrontTrack {
 public:
  /// The front as it stands at a time later than those before. An empty curve adds nothing.
  /// @param time      share of the frame, in [0, 1]
  /// @param smoothed  per marker of the curve
  void add(double time, const MarkerCurve& curve, const std::vector<Vec3>& smoothed,
           std::size_t coarse_nodes);

  bool empty() const { return rows_.empty(); }
  /// Point of the front, linear between the markers and the times it knows. Not of an empty track.
  /// @param parameter  see Marker
  Vec3 at(double parameter, double time) const;

 private:
  struct Row {
    double time;
    std::vector<double> parameter;  // rising
    std::vector<Vec3> position;
  };
  Vec3 point(const Row& row, double parameter) const;

  std::vector<Row> rows_;
  double period_ = 0;  // of the parameter; 0: the front is open
};

}  // namespace conchoid

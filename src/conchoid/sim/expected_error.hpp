#pragma once

#include <cmath>
#include <unordered_map>
#include <vector>

#include "conchoid/sim/opening_source.hpp"

namespace conchoid {

/// How far the surface of a predicted crack is expected to lie from the one that boundary elements would make.
///
/// At every front point a prediction states how uncertain its kink angle is, s (stated_angle_error). It is
/// multiplied by a scale a, which is kFirstScale until a frame of this fracture was solved that had been
/// predicted too; then a² is Σ(true error)² / Σs² along the front, averaged over the frames that were compared,
/// later ones counting more. So a predictor that meets a body or a load unlike its training is found out at the
/// first comparison, whatever its spread says.
/// The front advances by up to r̄. With the error θ of its direction and its distances e and D from the solved
/// front, all carried from a point to the one that grows from it,
///   θ ← θ + a s,   e ← e + r̄ sin min(θ, π/2)     predicted: errors of one stretch of frames have one sense
///   θ ← 0,   D ← √(D² + e²),   e ← 0             solved: the crack turns back by what it feels, from where it is;
///                                                 errors of different stretches know nothing of each other
/// d = √(D² + e²) is what is expected. A frame's strip of new surface counts with the mean of d before and after,
/// the surface with the mean of its strips by their numbers of points. Everything is over the body's diagonal.
/// Calibrated on whole runs: docs/hybrid.md.
class ExpectedError {
 public:
  /// @param diagonal  of the body [m]; @param crack_edge  r̄ [m]
  ExpectedError(const ElasticConstants& m, double diagonal, double crack_edge)
      : m_(m), diagonal_(diagonal), crack_edge_(crack_edge) {}

  /// Mean of d along the front that the crack would have, if it advanced by these predictions. Strips that follow
  /// are off by that much at least.
  double of_next_front(const CrackState& crack, const std::vector<FrontOpening>& predicted) const;
  /// The crack advances by these predictions.
  void advance_predicted(const CrackState& crack, const std::vector<FrontOpening>& predicted);
  /// The crack advances as solved. @param predicted  for the same front; empty: nothing was predicted
  void advance_solved(const CrackState& crack, const std::vector<FrontOpening>& solved,
                      const std::vector<FrontOpening>& predicted);
  /// Mean over the surface made so far; 0 before.
  double of_surface() const { return points_ > 0 ? sum_ / points_ / diagonal_ : 0; }
  /// a, as last compared.
  double scale() const { return scale_; }

  static constexpr double kFirstScale = 4;

 private:
  struct Deviation {
    double angle = 0, stretch = 0, earlier = 0;  ///< θ [rad], e, D [m]
    double distance() const { return std::hypot(stretch, earlier); }
  };
  struct Advance {
    Deviation before, after;
    double of_strip() const { return 0.5 * (before.distance() + after.distance()); }
  };
  Deviation deviation(const FrontPoint& point) const;
  std::vector<Advance> predicted_advances(const CrackState& crack,
                                          const std::vector<FrontOpening>& predicted) const;
  void compare(const std::vector<FrontOpening>& solved, const std::vector<FrontOpening>& predicted);
  void advance(const CrackState& crack, const std::vector<Advance>& advances);

  ElasticConstants m_;
  double diagonal_, crack_edge_;
  double scale_ = kFirstScale;
  bool compared_ = false;
  std::unordered_map<NodeId, Advance> at_;  // by front node of the sheet
  double sum_ = 0, points_ = 0;
};

/// Standard deviation of the kink angle that a prediction stands for [rad]: of kink_angle() at K ± its spread;
/// where it states no spread, the angle itself, by which a closed form that is wrong turns the front again and
/// again; none where the front goes straight through a ligament (opens_beyond_elasticity). At least
/// kLeastAngleError, and kOutsideAngleError beyond the training.
/// @param crack_edge  r̄ [m]
double stated_angle_error(const FrontOpening& predicted, double crack_edge, const ElasticConstants& m);

inline constexpr double kLeastAngleError = 0.01;   ///< [rad]
inline constexpr double kOutsideAngleError = 0.2;  ///< [rad]

}  // namespace conchoid

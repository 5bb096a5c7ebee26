#pragma once

#include <cmath>
#include <optional>
#include <unordered_map>
#include <vector>

#include "conchoid/sim/opening_source.hpp"

namespace conchoid {

/// How far the surface of a predicted crack is expected to lie from the one that boundary elements would make.
///
/// At every front point a prediction states how uncertain its kink angle is, s (stated_angle_error). It is
/// multiplied by a scale a, which has a first value until a frame of this fracture was solved that had been
/// predicted too; then a² is Σ(true error)² / Σs² along the front, averaged over the frames that were compared,
/// later ones counting more. So a predictor that meets a body or a load unlike its training is found out at the
/// first comparison, whatever its spread says.
/// The front advances by up to r̄. Its direction has the error θ, it lies e off the solved front since a frame was
/// last solved, and D by what was predicted before; σ_θ² and σ_e² are variances, κ the covariance, all carried from a
/// point to the one that grows from it. A predicted frame adds an error of deviation ε = a b f s to θ, with the
/// correlation c to the θ that is there:
///   κ ← κ (1 + c ε/σ_θ),   σ_θ² ← σ_θ² + 2 c ε σ_θ + ε²
///   σ_e² ← σ_e² + 2 g κ + g² σ_θ²,   κ ← κ + g σ_θ²,   with g σ_θ = r̄ sin min(σ_θ, π/2)
/// A solved frame turns the crack back by what it feels, from where it is: D² ← D² + σ_e², and σ_θ, κ, σ_e are zero.
/// d = √(D² + σ_e²) is what is expected. A frame's strip of new surface counts with the mean of d before and after,
/// the surface with the mean of its strips by their numbers of points. Everything is over the body's diagonal.
/// b is what a front of n points leaves of its points' errors, which it averages: b² is the variance of the mean of n
/// numbers with correlation ρᵏ between those k places apart (deviation_of_mean); f is the mean amount of what has
/// deviation 1. What ρ, c, f and the first a are depends on what is stated (Statement), found on whole runs: docs/hybrid.md.
class ExpectedError {
 public:
  /// How s is to be taken.
  struct Statement {
    double first_scale;  ///< a, before there is a comparison
    bool is_compared;    ///< whether that counts as one
    double correlation;  ///< ρ, of errors between neighbours on a front
    double persistence;  ///< c
    double amount;       ///< f
  };
  /// Errors of a closed form have one sense, frame after frame, and the spread between trees is less than theirs.
  static constexpr Statement kUnknown{4, false, 1, 1, 1};
  /// Compared with errors on runs that the predictor has not seen: those are scatter, hardly correlated from frame to
  /// frame. The means of fronts of two to twenty points are as for ρ = 0.25. √(2/π): as if they were normal.
  static constexpr Statement kCalibrated{1, true, 0.25, 0, 0.7978845608028654};

  /// @param diagonal  of the body [m]; @param crack_edge  r̄ [m]
  ExpectedError(const ElasticConstants& m, double diagonal, double crack_edge,
                const Statement& statement = kUnknown)
      : m_(m),
        diagonal_(diagonal),
        crack_edge_(crack_edge),
        statement_(statement),
        scale_(statement.first_scale),
        compared_(statement.is_compared) {}

  /// Of the whole surface in the end, if the crack advanced by these predictions and by others that state as much until
  /// it is through. @param frames  per point how often it will advance still, this time included: 1 …
  double at_the_end(const CrackState& crack, const std::vector<FrontOpening>& predicted,
                    const std::vector<int>& frames) const;
  /// The crack advances by these predictions.
  void advance_predicted(const CrackState& crack, const std::vector<FrontOpening>& predicted);
  /// The crack advances as solved. @param predicted  for the same front; empty: nothing was predicted
  void advance_solved(const CrackState& crack, const std::vector<FrontOpening>& solved,
                      const std::vector<FrontOpening>& predicted);
  /// Mean over the surface made so far; 0 before.
  double of_surface() const { return points_ > 0 ? sum_ / points_ / diagonal_ : 0; }
  /// a, as last compared.
  double scale() const { return scale_; }

 private:
  struct Deviation {
    double angle = 0;    ///< σ_θ [rad]
    double both = 0;     ///< κ [m]
    double stretch = 0;  ///< σ_e [m]
    double earlier = 0;  ///< D [m]
    double distance() const { return std::hypot(stretch, earlier); }
  };
  struct Advance {
    Deviation before, after;
    double of_strip() const { return 0.5 * (before.distance() + after.distance()); }
  };
  // Of a point that was on the front before, or grew from one that was.
  std::optional<Deviation> known(const FrontPoint& point) const;
  static Deviation mean(const std::vector<Deviation>& all);  // nothing of none
  // Mean over the last front on a connected part of the sheet; none on a crack that is new.
  Deviation last_on(const std::vector<int>& parts, int part) const;
  // Of all points; those not known have the mean of their front, a front without any that of the last one of its crack.
  std::vector<Deviation> deviations(const CrackState& crack) const;
  Deviation after_error(const Deviation& before, double error) const;
  // ε of every point.
  std::vector<double> errors(const CrackState& crack, const std::vector<FrontOpening>& predicted) const;
  void compare(const std::vector<FrontOpening>& solved, const std::vector<FrontOpening>& predicted);
  void advance(const CrackState& crack, const std::vector<Advance>& advances);

  ElasticConstants m_;
  double diagonal_, crack_edge_;
  Statement statement_;
  double scale_;
  bool compared_;
  std::unordered_map<NodeId, Advance> at_;  // by front node of the sheet
  std::vector<NodeId> front_;               // the last one
  double sum_ = 0, points_ = 0;
};

/// Standard deviation of the kink angle that a prediction stands for [rad]: of kink_angle() at K ± its spread;
/// where it states no spread, the angle itself, by which a closed form that is wrong turns the front again and
/// again; none where the front goes straight through a ligament (opens_beyond_elasticity). At least
/// kLeastAngleError, and kOutsideAngleError beyond the training.
/// @param crack_edge  r̄ [m]
double stated_angle_error(const FrontOpening& predicted, double crack_edge, const ElasticConstants& m);

/// Standard deviation of the mean of n numbers of deviation 1, correlated by ρᵏ over k places:
/// √((1 + 2 Σ_{k=1}^{n−1} (1 − k/n) ρᵏ)/n).
double deviation_of_mean(std::size_t n, double correlation);

inline constexpr double kLeastAngleError = 0.01;   ///< [rad]
inline constexpr double kOutsideAngleError = 0.2;  ///< [rad]

}  // namespace conchoid

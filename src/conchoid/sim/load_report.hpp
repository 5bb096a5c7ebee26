#pragma once

#include <optional>
#include <string>
#include <vector>

#include "conchoid/sim/fracture.hpp"

namespace conchoid {

/// × what starts or moves a crack: beyond it a load is said to be an overload. Cracks would start all over the
/// body at once, and a few that do one after the other say little.
inline constexpr double kOverload = 20;

/// How the load of a body compares with what breaks it, and how the end of its run is to be understood.
class LoadReport : public FractureObserver {
 public:
  void on_opening(const Fracture& fracture) override;
  void on_step(const Fracture& fracture, const StepReport& step) override;

  /// Largest σ1 / S_c where a crack could start, before anything moved: without a crack, or with those that
  /// were there. None if that was not solved, and for the infinite body.
  std::optional<double> stress_over_strength() const;
  /// Largest K_eff / K_c in the last frame of each body that did not come apart; if all did, in the last frame.
  /// None without a front.
  std::optional<double> largest_K_over_Kc() const;

  /// That the load is an overload, or that a crack has cut through and left the body in one piece.
  std::vector<std::string> warnings(StopReason stop, const RunSpec& run) const;
  /// What belongs to `stop`: largest stress over the strength and where, or K over K_c.
  std::string details(StopReason stop, const RunSpec& run) const;

 private:
  struct Peak {
    double ratio;
    Vec3 position;  // in the body's coordinates
  };
  static std::optional<Peak> peak(const Fracture& fracture, const StressPeak& stress);
  static std::string text(const Peak& peak);
  bool all_cracks_used(const RunSpec& run) const;

  std::optional<Peak> stress_;       // before anything moved
  std::optional<Peak> stress_left_;  // of the body that was arrested last
  std::optional<double> first_K_;    // of cracks that were there
  std::optional<double> last_K_, resting_K_;
  bool apart_ = false;        // the last body
  bool cut_through_ = false;  // it is arrested, and no crack in it has a front
  std::size_t new_cracks_ = 0;
};

}  // namespace conchoid

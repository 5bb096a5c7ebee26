#pragma once

#include <functional>
#include <memory>

#include "conchoid/core/vec.hpp"

namespace conchoid {

/// When, where to and how far a front point moves: one value that the fracture and both fronts ask. It has
/// no state; share it freely, also between threads. K = (K_I, K_II, K_III) [Pa·√m] in the front frame e1
/// normal, e2 forward, e3 tangent, as stress_intensities() gives it: untreated, K_I < 0 under compression;
/// what closed faces do to it is the law's to say.
class GrowthLaw {
 public:
  virtual ~GrowthLaw() = default;

  /// Intensity that drives the point [Pa·√m], ≥ 0, in the sense that it moves where this reaches K_c. Of pure
  /// opening, (K_I, 0, 0) with K_I ≥ 0, it is K_I.
  virtual double drive(const Vec3& K) const = 0;

  /// Direction in which it goes: θ from e2 towards e1 [rad], within ±π/2.
  virtual double direction(const Vec3& K) const = 0;

  /// How far it goes in one frame of Δt = r̄/c_R [m], between 0 and r̄, and 0 for drive < toughness.
  /// @param resolution  r̄ [m]
  virtual double length(double drive, double toughness, double resolution) const = 0;

  /// Further turn of its direction towards falling toughness [rad], of the sign of `fall`.
  /// @param fall  s = −(r̄/2πK_c) ∂K_c/∂n across the direction, > 0 where it falls towards growing angles;
  ///              docs/theory.md (S8)
  virtual double deflection(double fall, double drive, double toughness) const = 0;
};

/// Toughness at a point.
struct Toughness {
  double value = 0;              ///< K_c [Pa·√m]
  Vec3 gradient = Vec3::Zero();  ///< of K_c [Pa/√m]
};
using ToughnessField = std::function<Toughness(const Vec3&)>;

/// How a material breaks: the law and the toughness it is held against. Neither may be empty.
struct GrowthModel {
  std::shared_ptr<const GrowthLaw> law;
  ToughnessField toughness;
};

}  // namespace conchoid

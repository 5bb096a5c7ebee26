#pragma once

#include "conchoid/sim/predicted_opening.hpp"
#include "conchoid/sim/uncracked_stress.hpp"

namespace conchoid {

/// K of a front point from the stress that acts there in the uncracked body, as if the crack were plane, of
/// its own area A, and alone in an even stress (after Hahn & Wojtan, ACM TOG 35(4), 2016). With the radius
/// a = √(A/π) and the principal stress s whose direction v lies nearest to the crack normal e1,
///   K = Y |s| √(πa) (sign of s),
///   K_III from the angle of v to the plane of e1 and e2: sin² = K_III² / ((1−ν) K²), sign of v·e3,
///   K_II/K_I⁺ = −sinθ / (3 cosθ − 1), by which the greatest hoop stress turns the front by θ, until its normal
///   lies along v; θ measured from e2 towards e1, K_I⁺² = K_I² + K_III²/(1−ν), K_I⁺² + K_II² = K².
/// The principal direction takes the place of the local traction σ·e1, with which paths oscillate; |s| is at
/// least |σ·e1|. θ beyond 70.53° (pure mode II) gives K_I = 0.
/// @param stress  σ of the uncracked body [Pa]
/// @param area    A [m²], > 0
/// @param factor  Y: kEmbeddedFactor or kSurfaceFactor
/// @return (K_I, K_II, K_III) [Pa√m]; a penny crack under even tension gets its exact 2σ√(a/π)
Vec3 intensity_from_stress(const Mat3& stress, const FrontFrame& frame, double area, double factor,
                           double poisson_ratio);

inline constexpr double kEmbeddedFactor = 0.63661977236758134;  ///< 2/π: penny crack in an infinite body
inline constexpr double kSurfaceFactor = 1.1215;  ///< edge crack in a half plane (Gross & Seelig, table 4.1)

/// Frame 1 by boundary elements, then K from the stress of the uncracked body (intensity_from_stress), which
/// is solved once. The stress is smoothed along the front. Each crack has its own area; the factor is that of
/// a crack at the surface where its front ends there. Linear in the number of front points, each of them
/// with an integral over the body's surface.
class StressOpening : public PredictedOpening {
 public:
  explicit StressOpening(const PredictionContext& context);
  std::string name() const override { return "stress"; }

 private:
  std::vector<FrontOpening> predict(const CrackState& crack) const override;

  mutable UncrackedStress uncracked_;
};

}  // namespace conchoid

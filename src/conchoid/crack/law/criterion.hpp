#pragma once

#include <array>

#include "conchoid/core/vec.hpp"
#include "conchoid/elastic/constants.hpp"

namespace conchoid {

/// When, where to and how far a front point moves. K = (K_I, K_II, K_III) [Pa·√m] in the front frame e1
/// normal, e2 forward, e3 tangent, as stress_intensity() gives it. docs/theory.md (S4)

/// K with closed faces: K_I < 0 does not open the crack (K_I = 0); it may still slide.
Vec3 with_closed_faces(const Vec3& K);

/// K_eff = √(K_I² + K_II² + K_III²/(1−ν)), K_I < 0 counted as 0.
double effective_intensity(const Vec3& K, const ElasticConstants& m);

/// Direction of greatest hoop tension (Erdogan & Sih 1963): θ = 2 atan( (K_I⁺ − √(K_I⁺² + 8 K_II²)) / (4
/// K_II) ) with K_I⁺ = √(K_I² + K_III²/(1−ν)) and K_I < 0 counted as 0; θ = 0 for K_II = 0. Measured from e2
/// towards e1, |θ| ≤ arccos(1/3): the crack turns away from e1 (θ < 0) for K_II > 0.
/// @return θ [rad]
double kink_angle(const Vec3& K, const ElasticConstants& m);

/// The K under which a front turns by θ, an inverse of kink_angle(): (K_I⁺, K_II) of size 1, (3 cos θ − 1, −sin θ)
/// over its norm; pure mode II beyond ± arccos(1/3).
std::array<double, 2> kinking_intensity(double angle);

/// Hoop intensity at angle θ, σ_θθ √(2πr) = cos(θ/2) ( K_I cos²(θ/2) − 3/2 K_II sin θ ) [Pa·√m].
double hoop_intensity(const Vec3& K, double angle);

/// The published criterion for compression: where the most compressive hoop intensity exceeds the most
/// tensile one more than `factor` times (factor ≥ 1: compressive over tensile strength), −K / factor takes
/// the place of K.
Vec3 with_compressive_factor(const Vec3& K, double factor);

/// exact: root of the characteristic equation (2−ξ²)² = 4 √(1−ξ²) √(1−η ξ²), ξ = c_R/c_S, η = (1−2ν)/(2−2ν).
/// published: 0.9 √(μ/ρ).
enum class RayleighFormula { exact, published };
/// Rayleigh wave speed [m/s]. @param density [kg/m³], > 0
double rayleigh_speed(const ElasticConstants& m, double density,
                      RayleighFormula formula = RayleighFormula::exact);

/// Deflection of a front point towards falling toughness (after Hahn & Wojtan 2015): within the angles
/// at which the hoop intensity, taken as K_eff cos³(δ/2) around the hoop direction, still reaches K_c, by the
/// share s/√(1+s²) of them, s the relative fall of K_c over r̄/2π across the direction (of a wave of
/// wavelength r̄: its amplitude):
///     δ = s/√(1+s²) · min(2 arccos (K_c/K_eff)^⅓, arccos ⅓),  s = −(r̄/2πK_c) ∂K_c/∂n
/// docs/theory.md (S8)
/// @param fall  s > 0: towards growing angles
/// @return δ [rad], 0 for K_eff ≤ K_c
double toughness_deflection(double fall, double effective_intensity, double toughness);

/// Length by which a front point advances in one frame of Δt = r̄/c_R:  r̄ max(0.1, 1 − K_c²/K_eff²) if K_eff ≥
/// K_c, else 0 [m].
/// @param resolution  r̄ [m]
double advance_length(double effective_intensity, double toughness, double resolution);

}  // namespace conchoid

#pragma once

#include <vector>

#include "conchoid/crack/front.hpp"
#include "conchoid/elastic/constants.hpp"

namespace conchoid {

/// full_opening: K from Δu = u⁺ − u⁻, the correct one. half_opening: the published eq. (3), which returns twice K for the full opening.
enum class SifConvention { full_opening, half_opening };
/// one_point: the correlation node alone (raw). two_point: bias-reduced, from the first two rings of nodes behind the front.
enum class SifMethod { one_point, two_point };

/// Stress intensity factors from one opening sample (displacement correlation).
/// K_I = μ√(2π) Δu_I / (4(1−ν)√r), likewise II; K_III = μ√(2π) Δu_III / (4√r)               docs/theory.md (S3)
/// @param opening  Δu = u⁺ − u⁻, the full opening [m], in the front frame (I along e1, II along e2, III along e3)
/// @param r        distance from the front [m], > 0
/// @return (K_I, K_II, K_III) [Pa·√m]
Vec3 stress_intensity(const Vec3& opening, double r, const ElasticConstants& m,
                      SifConvention convention = SifConvention::full_opening);
/// Its inverse: the opening [m] in the front frame at distance r that belongs to K.
Vec3 opening_from_intensity(const Vec3& K, double r, const ElasticConstants& m,
                            SifConvention convention = SifConvention::full_opening);

struct SifSettings {
  SifMethod method = SifMethod::two_point;
  SifConvention convention = SifConvention::full_opening;
};

/// K at every node of a front from the openings of the crack mesh (one Δu per node [m], world axes; zero on the front).
std::vector<Vec3> stress_intensities(const TriMesh& crack, const Front& front, const IdVector<NodeId, Vec3>& opening,
                                     const ElasticConstants& m, const SifSettings& settings);

}  // namespace conchoid

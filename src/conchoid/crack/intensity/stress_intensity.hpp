#pragma once

#include <vector>

#include "conchoid/crack/front/front.hpp"
#include "conchoid/elastic/constants.hpp"

namespace conchoid {

/// full_opening: K from Δu = u⁺ − u⁻, the correct one. half_opening: the published eq. (3), which returns
/// twice K for the full opening.
enum class SifConvention { full_opening, half_opening };
/// one_point: the correlation node alone (raw). two_point: bias-reduced, from the first rings of nodes behind
/// the front.
enum class SifMethod { one_point, two_point };

/// Stress intensity factors from one opening sample (displacement correlation).
/// K_I = μ√(2π) Δu_I / (4(1−ν)√r), likewise II; K_III = μ√(2π) Δu_III / (4√r)               docs/theory.md
/// (S3)
/// @param opening  Δu = u⁺ − u⁻, the full opening [m], in the front frame (I along e1, II along e2, III along
/// e3)
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
  /// The openings are those of a piecewise linear Galerkin solution, whose known deviation near the front is
  /// taken out by two_point (kFrontShift and kFirstRowExcess in length_factors.hpp). false: they are exact
  /// values of the opening.
  bool galerkin_openings = true;
};

/// K at every node of a front from the openings of the crack mesh (one Δu per node [m], world axes; zero on
/// the front). one_point: each triangle that carries a front edge gives one K, from its interior node (the
/// correlation node) at distance r from the front; a front node takes the mean of its two edges. two_point:
/// around each front node, Δu(r, s) = √r (A + A' s + A" s²) + B r^{3/2} is fitted to the rows of nodes behind
/// it by weighted least squares (s along the front; rows nearer than 0.4 local edge lengths, as a slow front
/// leaves behind, count little); K from A. docs/theory.md (S7) A front node with nothing behind it, and the
/// ends of an open front, take the value of the nearest front node that has one; a front with nothing behind
/// it at all (a crack one row of triangles wide) has K = 0.
std::vector<Vec3> stress_intensities(const TriMesh& crack, const Front& front,
                                     const IdVector<NodeId, Vec3>& opening, const ElasticConstants& m,
                                     const SifSettings& settings);

}  // namespace conchoid

#pragma once

#include <vector>

#include "conchoid/crack/front/front.hpp"
#include "conchoid/crack/intensity/intensity_fit.hpp"

namespace conchoid {

/// How the sheet turns behind a front, as seen from one of its nodes. Both are 0 on a flat sheet.
struct KinkBehind {
  double turn = 0;  ///< largest angle between the sheet's normal at the front and anywhere between front and
                    ///< node [rad], ≥ 0
  double kink =
      0;  ///< θ by which the sheet kinks at the node itself: from its direction behind to that ahead,
          ///< from e2 towards e1 [rad]
};

/// Per node of the crack; of use for those with a row. @param rows  of rows_behind()
std::vector<KinkBehind> kinks_behind(const TriMesh& crack, const NodeLinks& links, const Front& front,
                                     const std::vector<int>& rows);

/// Share with which an opening counts from where the sheet has turned: 1 on a smooth surface, 0 behind a kink.
double share_behind_turn(double turn);

/// Rate Δu/√r that a straight crack of the same K has in place of that at a kink of angle θ, r = b in front of
/// which the front lies:  Δu(b)/√b = M(θ) (K's rate),
///     M = | 1 + 0.071 θ⁴    −0.21 θ³       0              |
///         | −0.10 θ³        1 + 0.31 θ²    0              |      docs/theory.md (S10)
///         | 0               0              (1 − θ²/π²)^−½ |
/// No smooth law reaches beyond a kink, but at the kink itself its own size, the length b of what is in front
/// of it, is the only one there is, so that M depends on θ alone as long as b is small against the crack.
/// @param rate  in the front frame (I, II, III)  @param kink  θ [rad]; up to kSmoothSurfaceTurn it is none
Vec3 without_kink(const Vec3& rate, double kink);

}  // namespace conchoid

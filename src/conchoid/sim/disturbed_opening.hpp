#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "conchoid/core/random.hpp"
#include "conchoid/sim/opening_source.hpp"

namespace conchoid {

/// Solves every frame, but moves the fronts by K that are wrong as a prediction's would be: for training. The solved path
/// alone never shows what follows a wrong turn, so that a regressor trained on nothing else knows no way back once its own
/// errors have led it off (Laskey et al., DART: Noise injection for robust imitation learning, CoRL 2017).
///
/// With w = (K_I, K_II, K_III/√(1−ν))/S of the solved K (learn/versatile_features.hpp) and x the place over the body's half
/// diagonal, from its centre,
///   w_II += δ_2(x),  w_III += δ_3(x),  back to length 1,  S *= exp(2 δ_1(x)),  δ_i(x) = a_i + b_i·x,
/// so that it varies smoothly along fronts. All coefficients have the standard deviation σ; from frame to frame each keeps
/// half of itself. The first frame is as solved, as where predictions start. What was solved is kept beside it (exact()):
/// the labels of samples.
class DisturbedOpening : public OpeningSource {
 public:
  /// @param bem   must outlive the source
  /// @param size  σ ≥ 0, of components of w
  DisturbedOpening(BemOpening& bem, const PreparedBody& body, double size, std::uint64_t seed);
  std::string name() const override { return bem_.name(); }
  std::vector<FrontOpening> open(const CrackState& crack) override;
  bool solved() const override { return true; }
  bool solves(int /*frame*/) const override { return true; }
  const std::vector<FrontOpening>* exact() const override { return &exact_; }

 private:
  // a and b of one δ.
  struct Field {
    double constant = 0;
    Vec3 slope = Vec3::Zero();
  };
  void next_fields();
  Vec3 disturbed(const Vec3& K, const Vec3& place) const;

  BemOpening& bem_;
  double poisson_ratio_, half_diagonal_;
  Vec3 center_;
  double size_;
  Random random_;
  std::array<Field, 3> fields_;  // of S, w_II, w_III
  std::vector<FrontOpening> exact_;
};

}  // namespace conchoid

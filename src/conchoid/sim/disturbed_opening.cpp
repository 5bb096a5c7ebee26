#include "conchoid/sim/disturbed_opening.hpp"

#include <cmath>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {
namespace {

constexpr double kKept = 0.5;  // of itself, from frame to frame
constexpr double kGrowth = 2;  // × σ: standard deviation of ln S, at the centre
constexpr double kMostShear = 0.7;

}  // namespace

DisturbedOpening::DisturbedOpening(BemOpening& bem, const PreparedBody& body, double size, std::uint64_t seed)
    : bem_(bem), poisson_ratio_(body.material.poisson_ratio), size_(size), random_(seed) {
  const Box box = bounding_box(body.surface);
  half_diagonal_ = box.diagonal() / 2;
  center_ = box.center();
}

void DisturbedOpening::next_fields() {
  const double fresh = size_ * std::sqrt(1 - kKept * kKept);
  for (Field& f : fields_) {
    f.constant = kKept * f.constant + fresh * random_.normal();
    for (int k = 0; k < 3; ++k)
      f.slope[k] = kKept * f.slope[k] + fresh * random_.normal();
  }
}

Vec3 DisturbedOpening::disturbed(const Vec3& K, const Vec3& place) const {
  const Vec3 x = (place - center_) / half_diagonal_;
  const auto at = [&](std::size_t i) { return fields_[i].constant + fields_[i].slope.dot(x); };
  const double h = std::sqrt(1 - poisson_ratio_);
  Vec3 w(K[0], K[1], K[2] / h);
  const double S = w.norm();
  if (!(S > 0)) return K;
  w /= S;
  const double opens = w[0] < 0 ? -1 : 1;
  for (int mode = 1; mode < 3; ++mode)
    w[mode] += at(static_cast<std::size_t>(mode));
  if (const double shear = std::hypot(w[1], w[2]); shear > kMostShear) {
    w[1] *= kMostShear / shear;
    w[2] *= kMostShear / shear;
  }
  w[0] = opens * std::sqrt(1 - w[1] * w[1] - w[2] * w[2]);
  w *= S * std::exp(kGrowth * at(0));
  return {w[0], w[1], w[2] * h};
}

std::vector<FrontOpening> DisturbedOpening::open(const CrackState& crack) {
  exact_ = bem_.open(crack);
  std::vector<FrontOpening> out = exact_;
  if (crack.sheet.frame == 0) return out;
  next_fields();
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Vec3& place = crack.sheet.mesh.positions[crack.points[i].node];
    out[i].intensity = disturbed(out[i].intensity, place);
    out[i].node_intensity = disturbed(out[i].node_intensity, place);
  }
  return out;
}

}  // namespace conchoid

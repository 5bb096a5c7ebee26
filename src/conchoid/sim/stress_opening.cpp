#include "conchoid/sim/stress_opening.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/crack/law/criterion.hpp"
#include "conchoid/sim/crack_sizes.hpp"
#include "conchoid/sim/front_gaps.hpp"

namespace conchoid {
namespace {

constexpr double kShear = 1.0 / 3;   // cosine of the largest kink, 70.53° of pure mode II
constexpr int kSmoothingPasses = 2;  // of ¼, ½, ¼ along the front
constexpr double kNoStress = 1e-12;  // share of the largest principal stress that is none

// Of the principal directions that lie within acos(1/3) of e1 that of the greatest stress, else the nearest.
struct Pull {
  double stress;
  Vec3 direction;  // in the frame, first component ≥ 0
};

Pull principal_pull(const Mat3& stress, const FrontFrame& frame) {
  Mat3 axes;
  axes << frame.e1, frame.e2, frame.e3;
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(axes.transpose() * stress * axes);
  int best = -1, nearest = 0;
  for (int k = 2; k >= 0; --k) {
    const double along = std::abs(eigen.eigenvectors()(0, k));
    if (best < 0 && along >= kShear) best = k;
    if (along > std::abs(eigen.eigenvectors()(0, nearest))) nearest = k;
  }
  Vec3 v = eigen.eigenvectors().col(best < 0 ? nearest : best);
  if (v[0] < 0) v = -v;
  return {eigen.eigenvalues()[best < 0 ? nearest : best], v};
}

void smooth(const std::vector<PointChain>& chains, std::vector<Mat3>& stress) {
  for (int pass = 0; pass < kSmoothingPasses; ++pass) {
    const std::vector<Mat3> before = stress;
    for (const PointChain& chain : chains) {
      const std::size_t n = chain.points.size();
      for (std::size_t i = 0; i < n; ++i)
        stress[chain.points[i]] = 0.5 * before[chain.points[i]] +
                                  0.25 * before[chain.points[previous_index(i, n, chain.closed)]] +
                                  0.25 * before[chain.points[next_index(i, n, chain.closed)]];
    }
  }
}

}  // namespace

Vec3 intensity_from_stress(const Mat3& stress, const FrontFrame& frame, double area, double factor,
                           double poisson_ratio) {
  const auto [principal, v] = principal_pull(stress, frame);
  const double size = std::max(std::abs(principal), (stress * frame.e1).norm());
  if (!(size > kNoStress * stress.norm())) return Vec3::Zero();
  const double a = std::sqrt(area / std::numbers::pi);
  const double K = factor * std::copysign(size, principal) * std::sqrt(std::numbers::pi * a);
  // Turn within the plane of e1 and e2, until e1 cosθ − e2 sinθ is along v.
  const double theta = std::atan2(-v[1], v[0]);
  if (std::cos(theta) <= kShear) return {0, std::copysign(1.0, -theta) * std::abs(K), 0};
  const auto [opened, slid] = kinking_intensity(theta);  // of K_I⁺ and K_II
  const double sine = v[2];
  return K * Vec3(opened * std::sqrt(std::max(0.0, 1 - sine * sine)), slid,
                  sine * opened * std::sqrt(1 - poisson_ratio));
}

StressOpening::StressOpening(const PredictionContext& context)
    : PredictedOpening(context), uncracked_(context.body) {}

std::vector<FrontOpening> StressOpening::predict(const CrackState& crack) const {
  std::vector<FrontOpening> out(crack.points.size());
  std::vector<Mat3> stress = uncracked_.at_points(point_positions(crack), bem().body().load(), bem().loads());
  smooth(point_chains(crack), stress);
  const std::vector<CrackSize> sizes = crack_sizes(crack);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const FrontPoint& point = crack.points[i];
    const CrackSize& size = sizes[i];
    out[i].known = size.area > 0;
    if (!out[i].known) continue;
    const double factor = size.at_surface ? kSurfaceFactor : kEmbeddedFactor;
    set_intensity(point,
                  intensity_from_stress(stress[i], point.frame, size.area, factor, material().poisson_ratio),
                  out[i]);
  }
  return out;
}

}  // namespace conchoid

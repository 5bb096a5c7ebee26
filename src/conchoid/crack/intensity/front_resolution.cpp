#include "conchoid/crack/intensity/front_resolution.hpp"

#include <algorithm>
#include <cmath>

#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/crack/law/criterion.hpp"
#include "conchoid/crack/length_factors.hpp"

namespace conchoid {

namespace {

double size_of(const Vec3& K, const ElasticConstants& m) {
  return std::sqrt(K[0] * K[0] + K[1] * K[1] + K[2] * K[2] / (1 - m.poisson_ratio));
}

double sliding_of(const Vec3& K, const ElasticConstants& m) {
  return std::sqrt(K[1] * K[1] + K[2] * K[2] / (1 - m.poisson_ratio));
}

struct FrontValues {
  const std::vector<double>& toughness;
  bool closed;
  const ElasticConstants& m;

  /// u_i.
  double change(const std::vector<Vec3>& K, std::size_t i) const {
    double most = 0;
    for (const std::size_t j : {previous_index(i, K.size(), closed), next_index(i, K.size(), closed)}) {
      const double size = std::max({size_of(K[i], m), size_of(K[j], m), toughness[i]});
      if (size > 0) most = std::max(most, size_of(K[i] - K[j], m) / size);
    }
    return most;
  }

  std::vector<Vec3> smoothed(const std::vector<Vec3>& K) const {
    std::vector<Vec3> out = K;
    for (std::size_t i = 0; i < K.size(); ++i) {
      const double share =
          std::clamp((change(K, i) - kResolvedChange) / (kUnresolvedChange - kResolvedChange), 0.0, 1.0);
      if (share == 0) continue;
      const Vec3 mean = 0.5 * (K[previous_index(i, K.size(), closed)] + K[next_index(i, K.size(), closed)]);
      out[i] += 0.5 * share * (mean - K[i]);
    }
    return out;
  }
};

}  // namespace

double greatest_hoop_intensity(const Vec3& K, const ElasticConstants& m) {
  const double sliding = sliding_of(K, m);
  const Vec3 plane(K[0], sliding, 0);
  const double root = std::sqrt(K[0] * K[0] + 8 * sliding * sliding);
  if (!(K[0] + root > 0)) return 0;
  return hoop_intensity(plane, 2 * std::atan(-2 * sliding / (K[0] + root)));
}

std::vector<FrontResolution> resolve_along_front(const std::vector<Vec3>& K,
                                                 const std::vector<double>& toughness, bool closed,
                                                 const ElasticConstants& m) {
  const FrontValues values{toughness, closed, m};
  std::vector<Vec3> smooth = K;
  for (int pass = 0; pass < kIntensityPasses; ++pass)
    smooth = values.smoothed(smooth);
  double largest = 0;
  for (const Vec3& k : smooth)
    largest = std::max(largest, size_of(k, m));
  std::vector<FrontResolution> out(K.size());
  for (std::size_t i = 0; i < K.size(); ++i) {
    const double size = size_of(smooth[i], m);
    if (const double error = std::max(kTellingShare * largest, size_of(K[i] - smooth[i], m)); size < error)
      out[i].turn = std::pow(size / error, 2);
    out[i].intensity = smooth[i];
    out[i].step = 1 - (1 - kLeastUnresolvedStep) * std::clamp(values.change(smooth, i) - 1, 0.0, 1.0);
    out[i].pressed = smooth[i][0] < 0 && (-smooth[i][0] > sliding_of(smooth[i], m) ||
                                          greatest_hoop_intensity(smooth[i], m) < toughness[i]);
  }
  return out;
}

}  // namespace conchoid

#pragma once

#include <cmath>
#include <random>

#include "conchoid/learn/features.hpp"
#include "conchoid/learn/sample.hpp"
#include "temporary_folder.hpp"

namespace conchoid::test {

/// Portable number in [0, 1).
inline double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1.0p-53;
}

/// Samples of runs in which K changes from frame to frame by known relative amounts: K_I grows by `growth`
/// per frame, K_II falls to `kink` of itself, K_III stays. With growth = 1 and kink = 1 the steady prediction
/// is exact.
inline SampleSet synthetic_run(int run, int frames, int nodes, double growth, double kink, double scale = 1) {
  std::mt19937_64 random(static_cast<std::uint64_t>(run) + 1000);
  SampleSet set;
  const double load = 1 + 20 * uniform(random);
  for (int frame = 2; frame <= frames; ++frame)
    for (int node = 0; node < nodes; ++node) {
      Sample s;
      s.run = run;
      s.frame = frame;
      s.node = node;
      s.youngs_modulus = 3.1e9;
      s.poisson_ratio = 0.327;
      s.toughness = 1e6;
      s.resolution = 0.1 * scale;
      s.distance_before = s.resolution * (0.1 + 0.9 * uniform(random));
      s.distance_after = s.resolution * (0.1 + 0.9 * uniform(random));
      s.travelled = 0.1 * (frame - 1) * scale;
      s.surface_distance = 0.5 * scale;
      s.K = s.toughness * load *
            Vec3(0.5 + uniform(random), 0.6 * (uniform(random) - 0.5), 0.6 * (uniform(random) - 0.5));
      s.front_curvature = 2 / scale;
      s.traction = {2e6, 1e5, -1e5};
      Sample next = s;
      next.K = s.K.cwiseProduct(Vec3(growth, kink, 1));
      s.opening = steady_opening(next);
      set.add(s);
    }
  return set;
}

inline SampleSet synthetic_runs(int runs, double growth, double kink) {
  SampleSet set;
  for (int run = 0; run < runs; ++run)
    set.append(synthetic_run(run, 8, 10, growth, kink));
  return set;
}

}  // namespace conchoid::test

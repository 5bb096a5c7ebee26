#include "conchoid/material/voxels.hpp"

#include <algorithm>
#include <cmath>

namespace conchoid {

namespace {

/// The three voxels that count along an axis, their B-spline weights and slopes.
struct Taps {
  std::array<int, 3> index;
  std::array<double, 3> weight, slope;

  Taps(double x, int size, Outside outside) {
    if (outside == Outside::periodic) x -= size * std::floor(x / size);
    x = std::clamp(x, -2.0, size + 1.0);  // farther out nothing changes, and no integer overflows
    const double middle = std::floor(x + 0.5), t = x - middle;
    weight = {0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t)};
    slope = {t - 0.5, -2 * t, t + 0.5};
    for (int k = 0; k < 3; ++k) {
      const int i = static_cast<int>(middle) + k - 1;
      index[k] = outside == Outside::periodic ? (i % size + size) % size : std::clamp(i, 0, size - 1);
    }
  }
};

}  // namespace

FieldSample Voxels::at(const Vec3& x) const {
  const Vec3 index = grid->to_index * (x / scale) + grid->offset;
  const Taps tx(index[0], grid->size[0], outside), ty(index[1], grid->size[1], outside),
      tz(index[2], grid->size[2], outside);
  double value = 0;
  Vec3 slope = Vec3::Zero();
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const double v = grid->at(tx.index[i], ty.index[j], tz.index[k]);
        value += v * tx.weight[i] * ty.weight[j] * tz.weight[k];
        slope +=
            v * Vec3(tx.slope[i] * ty.weight[j] * tz.weight[k], tx.weight[i] * ty.slope[j] * tz.weight[k],
                     tx.weight[i] * ty.weight[j] * tz.slope[k]);
      }
  return {value, grid->to_index.transpose() * slope / scale};
}

}  // namespace conchoid

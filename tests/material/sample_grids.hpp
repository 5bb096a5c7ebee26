#pragma once

#include <memory>

#include "conchoid/core/random.hpp"
#include "conchoid/material/voxels.hpp"

namespace conchoid::test {

inline constexpr double kGridVoxel = 0.25;

/// 7 × 5 × 6 voxels of random factors from 0.5 to 1.5, edge 0.25, the box around the origin.
inline std::shared_ptr<const VoxelGrid> random_grid() {
  auto grid = std::make_shared<VoxelGrid>();
  grid->size = {7, 5, 6};
  Random random(1);
  for (int n = 0; n < 7 * 5 * 6; ++n)
    grid->values.push_back(static_cast<float>(random.uniform(0.5, 1.5)));
  grid->to_index = Mat3::Identity() / kGridVoxel;
  grid->offset = Vec3(3, 2, 2.5);
  return grid;
}

}  // namespace conchoid::test

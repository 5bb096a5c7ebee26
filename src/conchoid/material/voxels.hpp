#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "conchoid/material/field_sample.hpp"

namespace conchoid {

/// A box of voxels and its place in the grid's own coordinates.
struct VoxelGrid {
  std::array<int, 3> size = {0, 0, 0};  ///< voxels along x, y, z
  std::vector<float> values;            ///< x fastest
  Mat3 to_index = Mat3::Identity();     ///< index = to_index · x + offset; index (0, 0, 0) is the centre …
  Vec3 offset = Vec3::Zero();           ///< … of the first voxel

  float at(int i, int j, int k) const {
    return values[static_cast<std::size_t>(i) +
                  static_cast<std::size_t>(size[0]) *
                      (static_cast<std::size_t>(j) +
                       static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(k))];
  }
};

/// The box of active voxels of a grid of a .vdb file, inactive voxels in it with the background's value.
/// Numbers of type float, double or half. @param grid  name; empty: the file's only such grid
/// Throws InputError: no such file or grid, no .vdb, several grids and none named, a map that is not affine,
/// values that are not positive, more than 2²⁷ voxels.
std::shared_ptr<const VoxelGrid> read_vdb(const std::filesystem::path& file, const std::string& grid);

enum class Outside { clamped, periodic };

/// A grid as a field: quadratic B-spline through the voxels as control points (C¹; between the least and the
/// largest voxel around; smooths over one voxel). Beyond the box the outermost voxels go on, or the box
/// repeats.
struct Voxels {
  std::shared_ptr<const VoxelGrid> grid;
  double scale = 1;  ///< [m] per unit of the grid's own coordinates
  Outside outside = Outside::clamped;

  FieldSample at(const Vec3& x) const;
};

}  // namespace conchoid

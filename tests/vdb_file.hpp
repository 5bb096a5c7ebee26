#pragma once

#include <openvdb/openvdb.h>

#include <filesystem>
#include <functional>
#include <string>

#include "conchoid/core/vec.hpp"

// Fields as .vdb files, written by OpenVDB itself.
namespace conchoid::test {

/// Voxels of the box low … high (indices, both included) with the values that `factor` has at their centres,
/// in the grid's own coordinates: voxel · index.
inline openvdb::FloatGrid::Ptr sampled_grid(const std::string& name, double voxel, const openvdb::Coord& low,
                                            const openvdb::Coord& high,
                                            const std::function<double(const Vec3&)>& factor) {
  openvdb::initialize();
  auto grid = openvdb::FloatGrid::create(1.0f);
  grid->setName(name);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(voxel));
  auto write = grid->getAccessor();
  for (int i = low.x(); i <= high.x(); ++i)
    for (int j = low.y(); j <= high.y(); ++j)
      for (int k = low.z(); k <= high.z(); ++k)
        write.setValue({i, j, k}, static_cast<float>(factor(voxel * Vec3(i, j, k))));
  return grid;
}

inline void write_vdb(const std::filesystem::path& path, const openvdb::GridPtrVec& grids) {
  openvdb::io::File file(path.string());
  file.write(grids);
  file.close();
}

}  // namespace conchoid::test

// In place of read_vdb.cpp where CONCHOID_WITH_VDB is off.
#include "conchoid/core/build_options.hpp"
#include "conchoid/material/voxels.hpp"

namespace conchoid {

std::shared_ptr<const VoxelGrid> read_vdb(const std::filesystem::path& path, const std::string&) {
  throw_built_without(path.string() + ": cannot be read", "OpenVDB", "CONCHOID_WITH_VDB");
}

}  // namespace conchoid

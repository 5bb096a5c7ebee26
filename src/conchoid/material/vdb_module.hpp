#pragma once

#include "conchoid/core/module.hpp"
#include "conchoid/material/voxels.hpp"

namespace conchoid {

constexpr Module kVdbModule{"conchoid_read_vdb", "OpenVDB", "CONCHOID_WITH_VDB"};

/// read_vdb(), inside the module.
using ReadVdb = void(const std::filesystem::path& file, const std::string& grid, VoxelGrid& out);

}  // namespace conchoid

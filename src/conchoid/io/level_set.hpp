#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "conchoid/surface/fragments.hpp"

namespace conchoid {

/// The fragments as level sets in one OpenVDB file: a float grid "fragment_000" … each, distance to the
/// piece's surface [m], negative inside, three voxels to either side of it; world coordinates are the body's.
/// Same fragments, same bytes.
/// @param voxel  edge of a voxel [m], > 0
/// @throws ComputationError where a piece would be more than 10⁶ voxels long
void write_fragments_vdb(const std::filesystem::path& path, const std::vector<Fragment>& fragments,
                         double voxel);

/// Throws InputError that begins with `where` in a build without OpenVDB: known before a run, not after it.
void require_level_sets(const std::string& where);

}  // namespace conchoid

#pragma once

#include <cstddef>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Makes one body of every set of closed parts that pass through or touch each other: they are cut along the
/// curves where they meet, and what lies inside of another is dropped. Nodes off these curves stay where they
/// are. Parts that are closed, oriented outward and no cavities are united; all others stay as they are, and
/// so do those that stay two (they touch in points) or cannot be cut (one passes through itself).
/// @return how many bodies became part of another
std::size_t unite_bodies(TriMesh& mesh);

}  // namespace conchoid

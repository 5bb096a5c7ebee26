#pragma once

#include <cstddef>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Drops triangles that divide nothing, where a surface has edges with more than two of them: walls inside of a
/// body and fins outside of it. Space is divided into cells, which see each other around the edges; a cell is
/// outside if its boundary encloses no volume, or if it is all looked into (a cavity). What has the inside or
/// the outside on both sides goes, the rest is oriented outward. Parts without such edges, and parts that
/// leave holes between the cells, stay as they are.
/// @return how many triangles are gone
std::size_t drop_inner_walls(TriMesh& mesh);

}  // namespace conchoid

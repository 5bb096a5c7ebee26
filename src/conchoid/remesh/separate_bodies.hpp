#pragma once

#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// The bodies that a surface bounds, each as its triangles with those of the cavities directly inside of it, in
/// the order of their first triangles. A body inside of another's cavity is one of its own.
/// @param mesh  without defects (find_defects)
std::vector<std::vector<TriId>> separate_bodies(const TriMesh& mesh);

}  // namespace conchoid

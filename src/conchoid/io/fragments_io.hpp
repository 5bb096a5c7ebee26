#pragma once

#include <filesystem>
#include <vector>

#include "conchoid/surface/fragments.hpp"

namespace conchoid {

/// One fragment as binary PLY in double precision: triangles share nodes (the file is as watertight as the
/// fragment), each face carries its colour, its kind (0 original, 1 fracture) and its source triangle.
/// Coordinates are the body's.
void write_fragment_ply(const std::filesystem::path& path, const Fragment& fragment);

/// One fragment as Wavefront OBJ with two groups, "original" and "fracture", and a material file beside it
/// (same name, .mtl). Nodes are shared; normals are per corner, so that rims and edges shade sharply.
void write_fragment_obj(const std::filesystem::path& path, const Fragment& fragment);

/// All fragments as one binary glTF 2.0 file: one node per fragment at its centre of mass, below a root that
/// turns our z-up into glTF's y-up; two materials, "original" and "fracture". A node's extras hold mass [kg],
/// volume [m³], inertia [kg m²] about the centre of mass (xx, yy, zz, yz, xz, xy) and watertight. Vertices
/// are split where the kind or the shading normal changes; single precision.
void write_fragments_glb(const std::filesystem::path& path, const std::vector<Fragment>& fragments);

}  // namespace conchoid

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "conchoid/surface/contacts.hpp"

namespace conchoid {

/// The files that pieces are written as. Names, as in scenes and on the command line: ply, obj, glb, stl, vdb
/// (level sets), hulls (convex collision proxies).
struct FragmentFormats {
  bool ply = true, obj = true, glb = true, stl = false, vdb = false, hulls = false;
};
/// Names that formats_from_names() knows, in the order of the documentation.
std::vector<std::string> fragment_format_names();
/// @throws InputError "WHERE: …" for a name that is not known
FragmentFormats formats_from_names(const std::vector<std::string>& names, const std::string& where);

/// One fragment as binary PLY in double precision: triangles share nodes (the file is as watertight as the
/// fragment) and therefore have one normal each, see node_normals(); each face carries its colour, its kind
/// (0 original, 1 fracture), its source triangle, the normals of its corners (list normals), which
/// read_surface() prefers, and, where the fragment has attributes, its material id and the texture coordinates of
/// its corners (list texcoord). Coordinates are the body's.
void write_fragment_ply(const std::filesystem::path& path, const Fragment& fragment);

/// One fragment as Wavefront OBJ with a group per material ("original" and "fracture", or the materials of
/// the input and "fracture") and a material file beside it (same name, .mtl). Nodes are shared; normals and
/// texture coordinates are per corner, so that rims and edges shade sharply and seams stay open.
void write_fragment_obj(const std::filesystem::path& path, const Fragment& fragment);

/// All fragments as one binary glTF 2.0 file: one node per fragment at its centre of mass, below a root that
/// turns our z-up into glTF's y-up; a material per material of the fragments, the last one "fracture". A
/// node's extras hold mass [kg], volume [m³], inertia [kg m²] about the centre of mass (xx, yy, zz, yz, xz,
/// xy), watertight, and contacts: the other fragments it lies against, with the area [m²]. Vertices are split
/// where material, shading normal or texture coordinates change; single precision.
void write_fragments_glb(const std::filesystem::path& path, const std::vector<Fragment>& fragments,
                         const std::vector<FragmentContact>& contacts = {});

/// The convex hulls of the fragments as one OBJ file, an object "fragment_000" … each, in place; for rigid
/// body programs.
void write_hulls_obj(const std::filesystem::path& path, const std::vector<Fragment>& fragments);

/// "fragment_007".
std::string fragment_name(std::size_t i);

/// The attributes of the fragment; plain normals and the two materials "original" and "fracture" where it has
/// none.
SurfaceAttributes written_attributes(const Fragment& fragment);

}  // namespace conchoid

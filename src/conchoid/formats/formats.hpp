#pragma once

#include <filesystem>

#include "conchoid/mesh/surface_attributes.hpp"

namespace conchoid {

/// Reads a surface; the format follows from the name's ending, in any case of letters:
///   .ply  ascii, binary of both byte orders; faces and triangle strips
///   .obj  lines may go on after a backslash
///   .stl  ascii in any case of letters, binary; vertices with equal coordinates are merged
///   .off  ascii
///   .glb  binary glTF 2.0: triangles, strips and fans of the default scene, placed by their nodes, in the
///         file's own axes (y is up there); vertices with equal coordinates are merged
/// Polygons are divided by polygon_triangles.hpp. What bounds no area (faces of two vertices, lines, points) is
/// skipped with a warning. Numbers are taken as metres. Whether the surface is closed or any good is not
/// checked here (see validate.hpp). Throws InputError that names file, line or element, and remedy: missing,
/// truncated or foreign files, numbers that are not finite, indices out of range. Never allocates more than a
/// small multiple of the file's size.
TriMesh read_mesh(const std::filesystem::path& path);
/// Likewise, with what the file says besides: normals, texture coordinates and materials of .obj (vn, vt,
/// usemtl), .glb and .ply (vertices: nx ny nz; s t, u v or texture_u texture_v; faces: lists texcoord and normals
/// with two and three numbers per corner, which count before those of vertices; material_index or material).
AttributedMesh read_surface(const std::filesystem::path& path);

/// Writes a surface in the format of the name's ending: .ply (binary little endian, double coordinates: read
/// back bit for bit), .obj and .off (shortest text that reads back bit for bit), .stl (binary, single
/// precision). The file appears complete or not at all. Throws InputError where the path cannot be written to
/// or its ending is unknown, ComputationError where writing fails.
void write_mesh(const std::filesystem::path& path, const TriMesh& mesh);

/// Likewise with its attributes, where the format holds them: .ply (normals, texture coordinates, materials as
/// their indices). The others keep the shape alone.
void write_surface(const std::filesystem::path& path, const AttributedMesh& surface);

}  // namespace conchoid

#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string_view>
#include <vector>

#include "conchoid/mesh/surface_attributes.hpp"

namespace conchoid {

/// A triangle mesh with all that a PLY file of ours can say about it. Every list is empty or as long as the
/// mesh has triangles (node_normal: nodes). The mesh may be open and may be empty: a crack surface is.
struct PlyMesh {
  TriMesh mesh;                        ///< double precision [m]
  SurfaceAttributes attributes;        ///< lists "normals" and "texcoord" (single precision), "material"
  IdVector<NodeId, Vec3> node_normal;  ///< "nx", "ny", "nz", single precision
  std::vector<std::array<std::uint8_t, 3>> color;  ///< "red", "green", "blue": written, not read
  std::vector<int> kind;                           ///< "kind", 0…255: 0 original surface, 1 fracture
  std::vector<int> source;  ///< "source": id of the triangle this one was cut from, −1: none
  std::vector<int> frame;   ///< "frame": the one in which the triangle appeared
};

/// Binary little endian, coordinates read back bit for bit. Materials are written as their indices.
void write_ply(std::ostream& out, const PlyMesh& ply);
/// Likewise to a file, which appears complete or not at all.
void write_ply(const std::filesystem::path& path, const PlyMesh& ply);

/// Reads ascii and binary PLY of both byte orders, properties in any order; unknown ones are skipped,
/// polygons and strips become triangles. Corners without values of their own take those of their vertices
/// (nx ny nz; s t, u v, texture_u texture_v or texture_s texture_t); a material index (material_index or
/// material) becomes the material named "material_INDEX".
/// @param file  its name, for messages
/// @throws InputError that names file, line or element, and remedy
PlyMesh read_ply(std::string_view bytes, const std::string& file);
PlyMesh read_ply(const std::filesystem::path& path);

}  // namespace conchoid

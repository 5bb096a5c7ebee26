#pragma once

#include <filesystem>
#include <vector>

#include "conchoid/surface/fragments.hpp"

namespace conchoid {

/// A triangle mesh as the run folder keeps it. Every list is empty or as long as the mesh.
struct PlyMesh {
  TriMesh mesh;                              ///< coordinates in double precision [m]
  std::vector<FaceKind> face_kind;           ///< property "kind": 0 original surface, 1 fracture
  std::vector<TriId> source;                 ///< property "source"
  std::vector<int> frame;                    ///< property "frame": the frame in which the triangle appeared
  std::vector<int> material = {};            ///< property "material"; written, not read
  std::vector<std::array<Vec2, 3>> uv = {};  ///< list "texcoord", single precision; written, not read
  IdVector<NodeId, Vec3> normal = {};        ///< "nx", "ny", "nz", single precision; written, not read
  std::vector<std::array<Vec3, 3>> corner_normal = {};  ///< list "normals", likewise
};

/// Binary little-endian PLY, complete or not at all. Faces with a kind also carry a colour (red, green,
/// blue).
void write_ply(const std::filesystem::path& path, const PlyMesh& mesh);

/// Reads a PLY of triangles (ascii or binary little-endian), any property order; unknown properties are
/// skipped. The mesh may be open: a crack surface is. Throws InputError (file, line or element, remedy).
PlyMesh read_ply(const std::filesystem::path& path);

}  // namespace conchoid

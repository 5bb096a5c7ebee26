#pragma once

#include <string>
#include <vector>

#include "conchoid/mesh/regions.hpp"
#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// A body that comes with the program: surface, named regions and, for some, an initial crack.
struct BodyModel {
  TriMesh mesh;                 ///< closed, oriented outward; empty for the infinite body [m]
  std::vector<Region> regions;  ///< every triangle in exactly one of them
  TriMesh crack;  ///< open sheet, empty where the model has none; its edges on the surface are the mouth
};

/// The built-in bodies, in metres, centred at the origin:
///   cube             edge 1, 120 triangles, its own image in the three coordinate planes and when x, y, z
///                    are exchanged in cyclic order; regions x- x+ y- y+ z- z+
///   cylinder         diameter 1, height 1, axis z, 192 triangles, its own image in the coordinate planes;
///                    regions top bottom side
///   bar              0.2 × 0.04 × 0.05 (length x, width y, height z), V-notch 14 mm wide and 10 mm deep
///                    across the middle of the bottom, 416 triangles, its own image in x = 0 and y = 0;
///                    regions support-left support-right (strips on the bottom, 12.5 to 25 mm from the ends), load (25 mm in the
///                    middle of the top), notch, bottom, top (the rest of them), x- x+ y- y+
///   edge-crack-cube  edge 1, 192 triangles, regions as the cube; crack: the plane z = 0 from the face x-
///                    inward to its straight front at x = −0.2, normal z, 116 triangles. Mouth: its edges on x-, y- and y+
///   infinite         no surface
/// Throws InputError for any other name.
BodyModel built_in_model(const std::string& name);

/// The names above.
const std::vector<std::string>& built_in_model_names();

/// Surface of a box centred at the origin, nx × ny × nz cells of two triangles (4 (nx ny + ny nz + nz nx)
/// triangles); the diagonals alternate, so that the mesh is its own image in a coordinate plane if the number
/// of cells across it is even.
TriMesh box_mesh(const Vec3& size, int nx, int ny, int nz);

/// Regions x- x+ y- y+ z- z+: triangles that lie exactly in that side of the bounding box.
std::vector<Region> box_regions(const TriMesh& mesh);

/// Sphere about the origin from the icosahedron, every triangle divided in four `subdivisions` times: 20·4^s
/// triangles, nodes on the sphere.
TriMesh icosphere(double radius, int subdivisions);

}  // namespace conchoid

#pragma once

#include <string>
#include <vector>

#include "conchoid/bem/boundary.hpp"
#include "conchoid/mesh/regions.hpp"
#include "conchoid/mesh/surface_attributes.hpp"
#include "conchoid/sim/scene.hpp"

namespace conchoid {

/// A scene made ready to compute: meshes, data and cracks, moved so that the body is centred at the origin
/// (no figures are lost however far away it lies).
struct BodySetup {
  Vec3 origin = Vec3::Zero();              ///< add to every position to come back to the scene's coordinates
  TriMesh surface;                         ///< boundary element mesh; empty for the infinite body
  TriMesh detailed;                        ///< surface that the fragments show; the same unless remeshed
  IdVector<NodeId, Vec3> scene_positions;  ///< nodes of `detailed` in the scene's coordinates, bit for bit
  SurfaceAttributes attributes;  ///< of `detailed`: normals, texture coordinates and materials of the file
  std::vector<Region> regions;   ///< of `surface`
  BoundaryData data;
  AmbientField ambient;         ///< stress at infinity, or that of inertia relief
  std::vector<TriMesh> cracks;  ///< initial crack sheets; those that end on the surface stick out of it
  MaterialField toughness;      ///< factor on the material's toughness, at centred points
  MaterialField strength;       ///< factor on its strength
  double crack_edge = 0;        ///< r̄ [m]
  double surface_edge = 0;      ///< h [m]

  bool infinite() const { return surface.corners.empty(); }
};

/// Builds meshes and data. Throws InputError, with the place in the scene file, for everything that is wrong
/// with them: a mesh that is no body, regions without triangles, loads out of balance with nothing held,
/// cracks outside of the body.
BodySetup set_up_body(const Scene& scene);

/// The boundary element mesh alone.
TriMesh scene_mesh(const Scene& scene);

}  // namespace conchoid

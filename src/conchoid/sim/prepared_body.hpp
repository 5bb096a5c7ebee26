#pragma once

#include <memory>
#include <string>
#include <vector>

#include "conchoid/bem/body_operator.hpp"
#include "conchoid/bem/load_case.hpp"
#include "conchoid/bem/quadratic_body.hpp"
#include "conchoid/sim/body.hpp"
#include "conchoid/sim/scene.hpp"

namespace conchoid {

/// A body made ready to compute, for any number of runs under loads of the same kinds: meshes and cracks,
/// moved so that the body is centred at the origin (no figures are lost however far away it lies), and the
/// boundary element operator, assembled and factored once.
struct PreparedBody {
  Vec3 origin = Vec3::Zero();              ///< add to every position to come back to the body's coordinates
  TriMesh surface;                         ///< boundary element mesh; empty for the infinite body
  TriMesh detailed;                        ///< surface that the fragments show
  IdVector<NodeId, Vec3> scene_positions;  ///< nodes of `detailed` in the body's coordinates, bit for bit
  SurfaceAttributes attributes;            ///< of `detailed`
  std::vector<Region> regions;             ///< of `surface`
  std::vector<char> quiet;                 ///< per triangle of `surface`: no crack starts there
  std::vector<TriMesh> cracks;  ///< initial crack sheets; those that end on the surface stick out of it
  MaterialSpec material;        ///< constants
  MaterialField toughness;      ///< factor on the material's toughness, at centred points
  MaterialField strength;       ///< factor on its strength
  MaterialFrame pieces;         ///< of the pieces, as long as they are not moved
  double crack_edge = 0;        ///< r̄ [m]
  double surface_edge = 0;      ///< h [m]
  std::shared_ptr<const BodyOperator> elastic;  ///< of `surface`, for the kinds of the conditions
  /// The same with quadratic displacements, in which loads are then solved and cracks open; empty: linear elements.
  std::shared_ptr<const QuadraticBody> quadratic;

  bool infinite() const { return surface.corners.empty(); }
  /// Whether the fragments show the boundary elements themselves.
  bool same_mesh() const {
    return surface.corners == detailed.corners && surface.positions == detailed.positions;
  }
};

/// The body that the scene names: from its file, or a model. Throws InputError with the place in the scene.
Body scene_body(const Scene& scene);

/// A body under the conditions, material, resolution and cracks of the scene. Throws InputError, with the
/// place in the scene file, for everything that is wrong with them: regions without triangles, contradictory
/// conditions, loads out of balance with nothing held, several bodies, cracks outside of the body; and
/// ComputationError when the body's system is singular.
PreparedBody prepare(const Scene& scene, Body body);
PreparedBody prepare(const Scene& scene);

/// The scene's conditions as values on the prepared body. Throws InputError as prepare() does, and for
/// conditions of other kinds than those it was prepared for. On a body of quadratic elements that is their solution,
/// as a field (as_elements_take).
LoadCase load_of(const Scene& scene, const PreparedBody& body);

/// Which components of the displacement the scene prescribes on each triangle of the boundary elements. Throws as prepare() does.
std::vector<BoundaryKind> kinds_of(const Scene& scene, const PreparedBody& body);

}  // namespace conchoid

#pragma once

#include <optional>

#include "conchoid/surface/fragments.hpp"

namespace conchoid {

/// How texture coordinates are laid on fracture faces.
enum class Projection {
  box,    ///< each triangle along the coordinate axis nearest to its normal: facing pieces match
  planar  ///< each piece along the one direction that its fracture faces look in most
};

struct DressSettings {
  Projection projection = Projection::box;
  double texture_size = 1;    ///< length that one unit of u or v covers [m]
  double crease_angle = 0.6;  ///< normals are smoothed over edges that bend less [rad]
};

/// Fills in Fragment::attributes: normals, texture coordinates, material ids.
///
/// Original faces take over what the surface has: its own nodes keep their values bit for bit, new nodes on
/// cut edges get values in between. What it has not is made: smooth normals, texture coordinates as on
/// fracture faces, one material "original". Fracture faces get smooth normals that never mix with those of
/// original faces, projected texture coordinates and the last material, "fracture".
/// @param surface  that the fragments were cut from, in their coordinates; attributes: of it
void dress_fragments(std::vector<Fragment>& fragments, const TriMesh& surface,
                     const SurfaceAttributes& attributes, const DressSettings& settings);

/// Moves a piece by `shift`; those of its nodes that are nodes of the surface it was cut from go exactly
/// where `positions` says instead: no bit of the input is lost to a detour through other coordinates.
void move_fragment(Fragment& fragment, const Vec3& shift, const TriMesh& surface,
                   const IdVector<NodeId, Vec3>& positions);

}  // namespace conchoid

#pragma once

#include "conchoid/surface/fragments.hpp"

namespace conchoid {

/// How texture coordinates are laid on fracture faces.
enum class Projection {
  box,    ///< each triangle along the coordinate axis nearest to its normal: facing pieces match
  planar  ///< each piece along the one direction that its fracture faces look in most
};

struct AttributeSettings {
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
void transfer_attributes(std::vector<Fragment>& fragments, const TriMesh& surface,
                         const SurfaceAttributes& attributes, const AttributeSettings& settings);

}  // namespace conchoid

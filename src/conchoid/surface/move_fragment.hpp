#pragma once

#include "conchoid/surface/fragments.hpp"

namespace conchoid {

/// Moves a piece by `shift`; those of its nodes that are nodes of the surface it was cut from go exactly
/// where `positions` says instead: no bit of the input is lost to a detour through other coordinates.
void move_fragment(Fragment& fragment, const Vec3& shift, const TriMesh& surface,
                   const IdVector<NodeId, Vec3>& positions);

}  // namespace conchoid

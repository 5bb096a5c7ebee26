#pragma once

#include "conchoid/surface/fragments.hpp"

namespace conchoid {

/// Draws the two faces of every crack that does not cut through apart, by `width` [m] in its middle and by
/// nothing at its front, so that a piece does not touch itself and programs that mend meshes leave the crack
/// alone. Only nodes of crack faces move, into the material; at the mouth they stay in the surface. Where
/// that would make faces cross (a slit in a sharp corner, two slits closer than their width), less or nothing
/// is done. Mass, volume and centre of mass are left as they were: a slit has no volume.
/// @return  whether none of its faces crosses or touches any face now
bool open_slits(Fragment& fragment, double width);

}  // namespace conchoid

#pragma once

#include "conchoid/surface/fragments.hpp"

namespace conchoid {

/// × volume of a piece: what mending it may take or add; and where nothing else will do and somebody is told.
inline constexpr double kMendedVolume = 1e-6, kRoughlyMendedVolume = 1e-3;

/// Whether a piece is closed and passes nowhere through itself.
bool is_solid(const Fragment& fragment);

/// A piece whose nodes, rounded where it was cut before, fold it over itself by less than can be seen: mended
/// there (remesh/mend.hpp), and triangles without area taken out, with and without its slits, what its faces are taken
/// from the old ones nearest to them. Mass and volume stay as they were. Left as it is where that does not make it a solid, or where it would take more of its volume than
/// that. @param most  × volume
void mend_fragment(Fragment& fragment, double most = kMendedVolume);

/// The same where a sliver, as cuts leave them, passes through a triangle at one of its nodes, folded over by round-off. Nothing
/// else is looked at.
void mend_folded_slivers(Fragment& fragment);

}  // namespace conchoid

#pragma once

#include <optional>

#include "conchoid/sim/fracture.hpp"
#include "conchoid/sim/pieces.hpp"

namespace conchoid {

/// What a piece that broke further is cut into, all solids.
struct SolidParts {
  Pieces parts;
  double most_mended;  ///< × volume of a part: what mending it may have taken or added
};

/// Ways are tried in turn: as the cracks lie; moved along their normal by up to a twentieth of the surface's edge; and with rough
/// mending (mended_fragment.hpp). None where each of them leaves a part that is no solid, or a piece that came apart
/// in one.
std::optional<SolidParts> cut_piece(const Fracture& fracture, const OutputSpec& output);

}  // namespace conchoid

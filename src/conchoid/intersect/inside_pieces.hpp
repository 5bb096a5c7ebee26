#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "conchoid/mesh/corners.hpp"
#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// An edge where a sheet passes through the surface of a body, and whether the body's inside lies to the left
/// of a → b as the sheet's normal looks on.
using MouthSide = std::pair<Edge, bool>;

/// Which of some nodes lie inside of a body.
using InsideTest = std::function<std::vector<bool>(const std::vector<NodeId>&)>;

/// Which pieces of a sheet lie inside of the body that its mouth cuts out of it. Pieces joined by a node or an edge off
/// the mouth lie on the same side, which the mouth edges around them tell (by majority, where the surface or
/// the sheet passes through itself). Parts without a mouth are asked about with one of their nodes.
/// @throws ComputationError for an edge off the mouth, between nodes on it, with more than two pieces
std::vector<bool> inside_pieces(const std::vector<Corners>& pieces, std::vector<MouthSide> mouth,
                                const InsideTest& are_inside);

}  // namespace conchoid

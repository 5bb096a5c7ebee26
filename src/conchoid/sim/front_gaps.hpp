#pragma once

#include <cstddef>
#include <unordered_map>
#include <vector>

#include "conchoid/sim/opening_source.hpp"

namespace conchoid {

/// Points that follow each other on one connected front inside the body. A front of the sheet that passes out
/// of the body and in again is several of these: what happens at one says nothing about the next.
struct PointChain {
  std::vector<std::size_t> points;  ///< indices into CrackState::points, in the order of the front
  bool closed = false;              ///< a ring: its last point is next to its first
};

std::vector<PointChain> point_chains(const CrackState& crack);

/// Index into CrackState::points by node of the cut, as fronts have them; their ends at the surface are no points.
std::unordered_map<NodeId, std::size_t> points_by_cut_node(const CrackState& crack);

/// For points that are not known the nearest of their chain that are, one to each side, counted in points; empty for known
/// ones, and where none of the chain is.
std::vector<std::vector<std::size_t>> nearest_known(const std::vector<PointChain>& chains,
                                                    const std::vector<char>& known);

/// Gives every point without a K of its own (known = false) the mean K of the nearest points of its chain
/// that have one, one to each side, counted in points. Where no point of the chain has one they stay unknown,
/// with K = 0: they do not move.
void fill_gaps(const std::vector<PointChain>& chains, std::vector<FrontOpening>& openings);

}  // namespace conchoid

#pragma once

#include <optional>
#include <vector>

#include "conchoid/crack/front/sheet.hpp"

namespace conchoid {

/// Two stretches of fronts that face each other across a ligament narrow enough to break at once. Both in the
/// order of their fronts (along e3), so that first.front() lies opposite second.back() and first.back()
/// opposite second.front(). Where the stretches belong to one front and nearly meet at an end they share
/// their node there.
struct FrontJoint {
  std::vector<NodeId> first, second;
};

/// How far the front opens at place i, where the sheet surrounds it: the angle in front of it [rad] between
/// its two edges, below π. π where the front is convex or ends.
double opening_angle(const CrackSheet& sheet, const SheetFront& front, const FrontFrame& frame,
                     std::size_t i);

/// The longest pair of stretches that the motions bring together (front_touches): the ligament between is
/// nowhere wider than 1.4 target_edge, the two sheets are oriented alike, and triangles between their nodes
/// neither fold nor stand across them. At the body's surface a stretch goes on to the first node outside.
/// Where no such pair is left: a last ligament at the body's surface, a few nodes inside between two outside;
/// then the two edges at a node where the front opens by less than 75°. Else none.
std::optional<FrontJoint> find_joint(const CrackSheet& sheet, const std::vector<FrontMotion>& motions,
                                     double target_edge);

/// Fronts of a sheet as they were before they were joined; one and the same for two stretches of one.
struct JoinedFronts {
  std::size_t first = 0, second = 0;
};

/// Breaks the ligament: appends the triangles between the two stretches — no nodes — and joins what is left
/// of their fronts. The fronts involved are removed from the list, their remains follow at its end: none, one
/// or two.
JoinedFronts join_fronts(CrackSheet& sheet, const FrontJoint& joint);

/// Nodes along a front, by any numbering.
struct FrontChain {
  std::vector<std::size_t> nodes;
  bool closed = false;
};

/// What is left of chains when nodes are taken out and others linked: from → to. Open ones first, in the
/// order of the chains; rings of fewer than three nodes are dropped.
std::vector<FrontChain> relinked(const std::vector<FrontChain>& chains,
                                 const std::vector<std::size_t>& removed,
                                 const std::vector<std::pair<std::size_t, std::size_t>>& links);

}  // namespace conchoid

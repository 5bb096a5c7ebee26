#pragma once

#include <string>
#include <vector>

#include "conchoid/crack/fine/fine_front.hpp"

namespace conchoid {

/// What holds between the frames of a growing crack (docs/fronts.md): between the sheet and its coarse fronts,
/// and between these and the markers of a fine front. Each function returns what is broken, one sentence with
/// its place each; nothing where all is well. Their cost is that of sorting the edges of the meshes.

/// The sheet: every attribute has one value per node or triangle; births do not decrease and lie in the past;
/// no edge is walked twice in one direction. Its fronts: three nodes or more on a ring, which starts at its
/// smallest id, two or more on an open one; each node on one front only, once; each edge on the boundary, walked
/// in the front's direction by the triangle behind it. Nodes of a front: an older correlation node other than
/// the node itself, or none; a finite way travelled.
std::vector<std::string> sheet_violations(const CrackSheet& sheet);

/// The surface a fine front has swept: a birth for each triangle, as in the sheet; no edge walked twice in one
/// direction.
std::vector<std::string> surface_violations(const TriMesh& surface, const IdVector<TriId, int>& birth,
                                            int frame);

/// The markers along one coarse front, unless they have closed before it: a ring where the front is one; coarse
/// nodes of this front attached, each to one marker, in the order of the front, no farther off than r̄;
/// parameters that do not fall along the curve, but once on a ring; their last nodes on the boundary of the fine surface, in order,
/// no farther apart than `longest` and the markers no farther ahead of them than the next row.
/// @param h        spacing of the markers [m]
/// @param longest  FineFront::longest_spacing() [m]
std::vector<std::string> curve_violations(const CrackSheet& sheet, const SheetFront& front,
                                          const MarkerCurve& curve, const TriMesh& surface, double resolution,
                                          double h, double longest);

/// All of these, and one curve for each front. For tests, and for builds without NDEBUG, where advance_fronts()
/// calls it after every frame. @throws std::logic_error  all that is broken
void validate(const CrackSheet& sheet, const FineFront& fine);

}  // namespace conchoid

#pragma once

#include "conchoid/intersect/corefine.hpp"

namespace conchoid {

/// Takes the triangles out of a cut that are lower than `smallest` (height over the longest edge [m]): a
/// sheet that runs along edges of the surface, or almost through its nodes, leaves many, with no area at all
/// in the worst case. Short edges are collapsed; a corner that almost lies on the edge opposite is drawn into
/// it.
///
/// Nodes of the surface stay where they are, bit for bit, and so do its planes: a node that is moved stays in
/// every triangle of `surface` it lies in. Surface, sheet, mouth and front keep their connections (link
/// condition of Dey, Edelsbrunner, Guha & Nekhayev, Topology preserving edge contraction, 1999); where that,
/// or a triangle that would turn over, forbids a step, the sliver stays.
/// @param surface, sheet  what was cut
void remove_slivers(CutComplex& cut, const TriMesh& surface, const TriMesh& sheet, double smallest);

}  // namespace conchoid

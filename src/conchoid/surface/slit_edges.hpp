#pragma once

#include "conchoid/intersect/corefine.hpp"

namespace conchoid {

/// The two sides of a slit share the nodes of its front. An edge between two such nodes that is not itself
/// part of the front would be one edge for both sides, with four triangles: it is halved, and with it the
/// triangles along it. A sheet piece with nothing but front around it opens nothing and is left out.
void split_edges_between_front_nodes(CutComplex& cut);

}  // namespace conchoid

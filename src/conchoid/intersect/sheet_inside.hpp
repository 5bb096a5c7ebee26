#pragma once

#include "conchoid/intersect/corefine.hpp"

namespace conchoid {

/// The part of the sheet inside of the surface as a mesh of its own: nodes that no triangle uses are dropped.
TriMesh sheet_inside(const CutComplex& cut);

}  // namespace conchoid

#pragma once

#include <vector>

#include "conchoid/crack/front/sheet.hpp"
#include "conchoid/surface/fragments.hpp"

namespace conchoid {

/// Cracks that go on in a piece.
struct GoingOn {
  std::vector<TriMesh> sheets;
  int unclear = 0;  ///< others of which it cannot be told
};

/// What of the boundary element cracks goes on inside a piece: the parts of the sheet that lie in it, not
/// along the faces that cut it free, have an area of r̄² or more there, and a front inside that lies somewhere deeper than r̄ below
/// those faces (nearer ones are shavings of what has come apart) and r̄/2 below any (whose K no element resolves). They stick out of the piece
/// by up to a triangle where they meet its surface, lifted off those faces. All in one frame of coordinates.
/// What of a part lies in the piece cannot be told where the piece's surface touches itself along an edge: such parts are left
/// out, and counted.
/// @param crack_edge  r̄ [m]
/// @param stands_for  [m], so near to those faces all of the sheet is along them, whatever its normal (BodyCut)
GoingOn unfinished_cracks(const CrackSheet& sheet, const Fragment& piece, double crack_edge,
                          double stands_for = 0);

}  // namespace conchoid

#pragma once

#include <vector>

#include "conchoid/bem/enrichment.hpp"
#include "conchoid/crack/front/front.hpp"
#include "conchoid/crack/front/sheet.hpp"
#include "conchoid/intersect/corefine.hpp"

namespace conchoid {

/// A coarse front node inside the body, as SIFs are wanted there.
struct FrontPoint {
  NodeId node;          ///< of the sheet
  NodeId correlation;   ///< of the sheet: the node right behind it; may be invalid
  FrontFrame frame;     ///< of the sheet's front at the node
  double distance = 0;  ///< r of the correlation node from the front [m], 0 without one
  int front = 0;        ///< number of its front in the sheet
};

/// The cracks of a body as they stand: the sheet as it grows, and what of it lies inside.
struct CrackState {
  CrackSheet sheet;
  CutComplex cut;             ///< of the boundary element mesh
  TriMesh trimmed;            ///< the sheet's part inside, nodes of `cut`
  std::vector<Front> fronts;  ///< of `trimmed`
  IdVector<NodeId, NodeId>
      node_in_cut;                 ///< per sheet node: its node in `cut`; invalid outside and on the surface
  std::vector<FrontPoint> points;  ///< all coarse front nodes inside
  CutDivision division = {};       ///< of the surface before the cut
  double displacement = 0;         ///< × r̄, of the sheet along its normals as it was cut
};

/// Whether the surface is divided near the cracks before it is cut: only a solution by boundary elements needs that.
enum class NearCracks : unsigned char { divided, as_it_is };

/// Trims the sheet by the surface (empty: infinite body), marks its front nodes active or outside, lists the
/// points inside. What was displaced for the last cut is tried with the same displacement first, so that the
/// elements which stay where they are stay the same to the last bit.
/// @param crack_edge  r̄ [m]
void update_crack(CrackState& state, const TriMesh& surface, double crack_edge,
                  NearCracks near = NearCracks::divided);

/// Lets hang on what the cracks part from the boundary elements if it is below `volume`: there the sheet is left out of
/// the cut, as a part that nothing holds has no equilibrium. Whether there was such a crumb.
/// @param volume  [m³]
bool hold_crumbs(CrackState& state, double volume);

/// Of all points.
std::vector<Vec3> point_positions(const CrackState& state);

/// Ends of front edges whose nodes lie outside of the body on both sides but which still cross it: the last
/// ligaments at corners, narrower than a triangle. They have no node inside to read SIFs at, and run through.
std::vector<FrontPoint> ligament_points(const CrackState& state);

/// Share of an edge's length within which mouth nodes are merged for the boundary elements.
inline constexpr double kMouthMerge = 0.1;
/// The same across the crack: a node that left its plane would bend it, and open it in sliding.
inline constexpr double kMouthBend = 0.02;

}  // namespace conchoid

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "conchoid/crack/closing/last_ligament.hpp"
#include "conchoid/sim/prepared_body.hpp"
#include "conchoid/surface/fragments.hpp"

namespace conchoid {

/// The detailed body, cut by the visible crack surface.
struct BodyCut {
  std::vector<TriMesh> sheets;      ///< that cut it
  TriMesh ligament;                 ///< the surface along which the last ligament broke; mostly empty
  std::vector<Fragment> fragments;  ///< largest first, in the prepared body's coordinates
  std::optional<TriMesh>
      inside;  ///< of the sheets: their part inside of the body; none where it was not found
  std::vector<IdVector<NodeId, Vec3>>
      opened;  ///< the fragments' nodes with slits open; empty where that was not tried
  double stands_for =
      0;  ///< [m], beyond 0: a surface of its own has cut, for all cracks so near to it; what ends in
          ///< the fragments they do not show then
  std::vector<std::string> warnings;
  bool parted() const { return fragments.size() > 1; }
};

/// Width to which the faces of cracks that end in a piece are drawn apart [m]: far below what can be seen, far above
/// what single precision rounds away.
double slit_width(const PreparedBody& body);

/// Cuts the body by the sheets as they are. Where they are folded beyond repair the body is left whole, with a
/// warning. Pieces are as small and as many as the run's settings allow.
BodyCut cut_body(const PreparedBody& body, const RunSpec& run, std::vector<TriMesh> sheets);

/// Goes on with a cut that leaves one piece: along the first of what is left to break of the detailed body between these
/// sheets that parts it; of the ways to lay its surface over the cracks,
/// one whose pieces do not cross themselves once their slits are open, if there is one; else along all of the surface
/// between its two sides, which stands for the sheets near it, where no less than run.smallest_body comes off.
void cut_ligament(BodyCut& cut, const PreparedBody& body, const RunSpec& run,
                  const std::vector<LastLigament>& ligaments);

/// What may break of a body that its cracks have not cut quite.
struct WhatBreaks {
  LigamentsOf of = LigamentsOf::each;
  std::function<bool(const LastLigament&)> breaks;  ///< of the detailed body
  std::optional<LastLigament> broken;  ///< of the boundary elements; none: they are apart already
};

/// Cuts the body by the sheets and, where that does not part it, along what is left to break; where nothing that is left
/// would break of the detailed body, along what has broken of its boundary elements.
/// @param sheets       as they are seen
/// @param of_elements  as they have moved
BodyCut cut_or_break(const PreparedBody& body, const RunSpec& run, const std::vector<TriMesh>& sheets,
                     const TriMesh& of_elements, const WhatBreaks& what);

}  // namespace conchoid

#pragma once

#include <limits>
#include <optional>

#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/sim/body_cut.hpp"
#include "conchoid/sim/ligament_rule.hpp"
#include "conchoid/sim/swept_sheets.hpp"

namespace conchoid {

/// When a body comes apart, and into what: where its boundary elements are cut through, or what still holds it
/// together cannot hold, the detailed body is cut. The more often that was in vain the longer it waits for more to
/// have cracked: what cannot be cut cleanly stays so for a while, and each try costs as much as many frames.
class Parting {
 public:
  /// Both must outlive this.
  Parting(const PreparedBody& body, const RunSpec& settings);

  /// Where more than this volume [m³] comes off the boundary elements, nothing is cut to believe it.
  void cut_below(double volume) { cut_below_ = volume; }

  /// By the cut of the boundary elements, and of the detailed body, which the markers may not have crossed quite.
  bool by_cracks(const CrackState& crack, const SweptSheets& sheets, int frame);
  /// Whether what still holds the body together breaks at once: driven beyond what it bears, and too narrow for
  /// the elements, or, at_end, where no front can go on, whatever is left. To be asked once a frame, and at the end.
  bool by_ligament(const FrontReadings& front, const SweptSheets& sheets, int frame, bool at_end);

  /// The detailed body as it was cut; null before, and where it was not.
  const BodyCut* cut() const { return cut_ ? &*cut_ : nullptr; }
  /// Of what has come off, all but the largest piece [m³]; 0 before.
  double volume_off() const;

 private:
  bool is_told(double volume);
  bool parts(const SweptSheets& sheets, int frame, bool at_end, const WhatBreaks& what);

  const PreparedBody& body_;
  const RunSpec& settings_;
  ClosestPointTree surface_;  // of the boundary elements
  double cut_below_ = std::numeric_limits<double>::infinity();
  std::optional<BodyCut> cut_;
  double uncut_volume_ = 0;    // of what has come off when nothing was cut [m³]
  int vain_cuts_ = 0;          // that did not part the body
  int cut_again_ = 0;          // the first frame in which it is worth another try
  int unresolved_frames_ = 0;  // in a row
};

}  // namespace conchoid

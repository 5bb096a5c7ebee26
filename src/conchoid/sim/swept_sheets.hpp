#pragma once

#include <optional>
#include <vector>

#include "conchoid/crack/fine/fine_front.hpp"

namespace conchoid {

/// The surfaces that the cracks of a body have swept: one whose markers move the coarse fronts, of the same spacing whatever is
/// to be seen, and one as fine as what is to be seen, which follows it and moves nothing.
class SweptSheets {
 public:
  /// @param sheet         of the boundary elements; must outlive this, at its place
  /// @param crack_edge    r̄ [m]
  /// @param surface_edge  of what is to be seen [m]
  SweptSheets(CrackSheet& sheet, double crack_edge, double surface_edge);

  /// Takes in the cracks that were appended to the sheet.
  void append_parts();
  /// One frame of all fronts, the coarse ones among them (advance_fronts()).
  void advance(const std::vector<FrontStep>& steps, const GrowthModel& growth);

  /// As the markers that move the fronts have swept it.
  const TriMesh& driving() const { return driving_.surface(); }
  /// What is to be seen, with the last row of the markers that are ahead of it: it may be folded or pass through itself.
  TriMesh swept() const;
  /// The same unfolded, one for each crack; made when first asked for since the fronts moved.
  const std::vector<TriMesh>& visible() const;

 private:
  CrackSheet& sheet_;
  double crack_edge_;
  FineFront driving_;
  std::optional<FineFront> following_;  // none: the driving one is what is to be seen
  mutable std::optional<std::vector<TriMesh>> visible_;
};

}  // namespace conchoid

#pragma once

#include <memory>
#include <optional>

#include "conchoid/crack/closing/minimal_cut.hpp"

namespace conchoid {

/// What still holds a body together that cracks have nearly divided: the cut with the least new surface that
/// completes one of them, whichever way the cracks face, and whether it lies between two of them, between two
/// parts of one front, or between a front and a surface.
struct LastLigament {
  std::shared_ptr<const CellGrid> grid;
  CellPartition partition;
  std::vector<Vec3> faces;  ///< middles of the cells' faces that it breaks
  double half_width = 0;    ///< largest distance of one of these from a crack or the body's surface [m]
  double smaller_part = 0;  ///< volume of the smaller side [m³]
};

/// Of which cracks ligaments are looked for: what is left may be much to each of several, but little to all.
enum class LigamentsOf { each, each_and_all };

/// The ligaments of each connected crack, the others being walls, or of all together as well, those with the smallest
/// half width first. They lie within kLigamentBand of the cracks' fronts: a crack that has farther to go has none, nor has
/// one whose cut would leave less of it than is to be broken (minimal_cut), or a part of a few cells only. Cells have
/// 1/kCellsPerEdge of `target_edge`, or more where the body would have more than kMostCells.
/// @param body    closed, outward
/// @param sheets  all cracks, as fine as they are known; may stick out of the body
std::vector<LastLigament> find_last_ligaments(const TriMesh& body, const TriMesh& sheets, double target_edge,
                                              LigamentsOf of = LigamentsOf::each);

/// The same ligament in another body, or with other sheets: what lies beyond kLigamentBand of the cracks' fronts keeps the
/// side it has `elsewhere`, however much is left between. For a detailed body whose boundary elements have come apart:
/// where they are coarse beside a slender part, they leave out much of it. None where nothing would part it.
std::optional<LastLigament> find_same_ligament(const TriMesh& body, const TriMesh& sheets, double target_edge,
                                               const LastLigament& elsewhere);

/// How a ligament's surface lies over the cracks it joins.
struct LigamentOverlap {
  double cells = 3.5;    ///< beyond a crack's end
  double offset = 0.25;  ///< × cell, from the crack towards the upper side; beyond the crack at its own rim
};

/// How the whole surface between the two sides is made. Neither smoothed nor halved it does not cross itself.
struct DividingSurface {
  int smoothing = 0;    ///< passes
  bool halved = false;  ///< triangles of half the size, which lie on the cracks more closely
};

/// The ligament's broken surface, ready to cut the body together with the sheets: smoothed between the cracks it
/// joins, laid over what is near their fronts, crossing their faces once behind them and the body's surface, so
/// that nothing leaks between, unless the cracks are uneven within a cell; then another overlap may do. What of it
/// lies between two parts of one piece is not meant to be cut.
TriMesh ligament_surface(const LastLigament& ligament, const TriMesh& sheets,
                         const LigamentOverlap& overlap = {});

/// The same for several overlaps: what they have in common is found once.
class LigamentSurfaces {
 public:
  /// Both arguments have to stay.
  LigamentSurfaces(const LastLigament& ligament, const TriMesh& sheets);
  TriMesh with(const LigamentOverlap& overlap) const;
  /// All of the surface between the two sides, along the cracks as far as cells tell, so that it parts the body
  /// without them: for cracks too ragged to be joined.
  TriMesh between_sides(const DividingSurface& how) const;

 private:
  const LastLigament& ligament_;
  const TriMesh& sheets_;
  std::vector<std::int8_t> side_;  ///< per cell, also of those around the body
};

}  // namespace conchoid

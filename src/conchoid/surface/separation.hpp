#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "conchoid/core/union_find.hpp"
#include "conchoid/intersect/corefine.hpp"

namespace conchoid {

/// The faces of a cut body — surface pieces, then sheet pieces, then sheet pieces turned round — glued into
/// closed shells.
///
/// Every edge joins two faces: across a mouth edge, a surface piece continues on the side of the sheet it
/// sees; at the sheet's own boundary inside the body (the crack front) one side continues on the other. Only
/// corners that are joined across edges share a vertex, so both sides of a crack get vertices of their own,
/// up to the front.
struct Shells {
  std::size_t surface_faces = 0, sheet_faces = 0;  ///< faces: surface_faces + 2·sheet_faces
  std::vector<std::array<NodeId, 3>>
      corners;                ///< per face: nodes of the complex, outward (out of the material)
  std::vector<bool> present;  ///< per face: false for sheet pieces left out
  std::vector<std::array<std::int32_t, 3>> vertex;  ///< per face: glued vertices, numbered from 0
  std::vector<std::int32_t> solid;  ///< per face: which piece of the body it bounds; −1 if not present
  std::size_t vertex_count = 0;
  std::size_t overlaps = 0;    ///< edges where surface and sheet pass through each other without a joint
  std::vector<double> volume;  ///< per solid [m³]

  /// The other side of a sheet face.
  std::size_t opposite(std::size_t face) const {
    return face < surface_faces + sheet_faces ? face + sheet_faces : face - sheet_faces;
  }
};

/// Glues the complex, which has to outlive it, as often as wanted: what hangs together anyway, around nodes off the sheet,
/// and what lies along each of the other edges is found once.
class Gluer {
 public:
  explicit Gluer(const CutComplex& cut);

  /// Sheet pieces marked in `left_out` (empty: none) are treated as uncut material.
  /// Shells that enclose no material of their own (cavities, cracks that reach no surface) belong to the solid
  /// around them.
  /// Where round-off has made parts of the surface overlap, the sheet may lie inside on both sides of a mouth
  /// edge; there it passes through (`overlaps`): the shells stay closed, but some that should be apart may hang
  /// together.
  /// @throws ComputationError if an edge does not have two surface pieces or none
  Shells glue(const std::vector<bool>& left_out = {}) const;

  /// Edge of a face, with its direction there.
  struct HalfEdge {
    Edge edge;
    std::uint32_t face;
    std::uint16_t corner;
    bool along;  ///< from edge.a to edge.b
  };

 private:
  const CutComplex& cut_;
  std::vector<std::uint32_t>
      corners_;  ///< three of each face, sheet pieces turned round among them: numbered, as one
                 ///< at a node that is whole: off the sheet, with one fan of triangles around it
  std::size_t corner_count_ = 0;
  UnionFind faces_;               ///< joined at nodes that are whole
  std::vector<HalfEdge> halves_;  ///< of edges with another node, by edge, then by face
};

inline Shells glue(const CutComplex& cut) {
  return Gluer(cut).glue();
}

/// Number of pieces the sheet divides the body into (1: it does not separate).
std::size_t count_pieces(const CutComplex& cut);

/// Whether the sheet divides the body.
inline bool separates(const CutComplex& cut) {
  return count_pieces(cut) > 1;
}

}  // namespace conchoid

#pragma once

#include <vector>

#include "conchoid/bem/boundary.hpp"
#include "conchoid/intersect/corefine.hpp"
#include "conchoid/mesh/longest_edge_bisection.hpp"
#include "conchoid/quadrature/pair_integrals.hpp"

namespace conchoid {

/// What a crack adds to the displacement space (its enrichment). One density w describes surface and crack:
/// w = u on the surface, w = −Δu on a crack whose normal is that of u⁺ (the two enter the representation
/// formula with opposite signs).                                                       docs/theory.md (M1)
///   crack  hat function of a node inside the crack, Δu = 1 there
///   mouth  at a node where the crack opens at the surface: Δu = 1 on the crack, u = ±½ on the two sides of
///          the surface, so that the surface's displacement jumps by exactly the opening
///   hat    continuous hat function of a mouth node on the cut surface: lets the mean of the two sides bend at
///          the mouth; and of the middle of an edge where the surface was divided before the cut, on the four halves
///          which that made, whatever divides or cuts these again: nothing changes it any more
enum class EnrichmentKind : unsigned char { crack, mouth, hat };

/// Values of a shape function w at the three corners of one panel of its support.
struct PanelValues {
  std::size_t panel;
  std::array<double, 3> w;
};

struct EnrichmentFunction {
  EnrichmentKind kind;
  NodeId node;  ///< of the cut complex
  std::vector<PanelValues> support;
  std::vector<double> key;       ///< geometry and values of the support: equal keys, equal functions
  Mat3 free = Mat3::Identity();  ///< projection onto the directions in which its coefficient is unknown
  bool carries_opening() const { return kind != EnrichmentKind::hat; }
};

/// The surface after the cut and the crack as panels, and the functions that the cut adds.
struct EnrichedSpace {
  std::vector<Panel> panels;      ///< surface pieces, then crack
  std::size_t surface_count = 0;  ///< how many are surface pieces
  std::vector<TriId> parent;      ///< per surface piece: triangle of the uncut surface
  /// Per surface piece: at its corner k, the values of the parent's three corner functions.
  std::vector<std::array<Vec3, 3>> parent_values;
  std::vector<EnrichmentFunction> functions;  ///< ordered by node
};

/// How the surface was divided before it was cut (mesh/longest_edge_bisection.hpp).
struct CutDivision {
  std::vector<HalfTriangle> halves;
  std::vector<std::size_t> half;  ///< per piece of the cut surface: the half it lies in, or kNoHalf
};

/// Nodes on the front (Δu = 0), and where more than two mouth edges meet carry no opening; nodes on a part of the
/// surface that is held carry none in its held directions.
/// @param division  empty: the surface was cut as it is
EnrichedSpace make_enriched_space(const CutComplex& cut, const TriMesh& surface,
                                  const std::vector<BoundaryKind>& kinds, const CutDivision& division = {});

/// A cut complex for a crack in an unbounded body: the sheet alone.
CutComplex uncut_sheet(const TriMesh& sheet);
/// A cut complex without a crack.
CutComplex whole_surface(const TriMesh& surface);

}  // namespace conchoid

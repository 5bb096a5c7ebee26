#pragma once

#include <vector>

#include "conchoid/bem/boundary.hpp"
#include "conchoid/intersect/corefine.hpp"
#include "conchoid/quadrature/pair_integrals.hpp"

namespace conchoid {

/// What a crack adds to the displacement space. One density w describes both: w = u on the surface, w = −Δu
/// on a crack whose normal is that of u⁺ (the two enter the representation formula with opposite signs).
///   crack  : hat function of a node inside the crack, Δu = 1 there
///   mouth  : at a node where the crack opens at the surface: Δu = 1 on the crack, u = ±½ on the two sides of
///   the surface,
///            so that the surface's displacement jumps by exactly the opening                docs/theory.md
///            (M1)
///   ripple : hat function of a mouth node on the cut surface, continuous: lets the mean of the two sides
///   bend at the mouth
enum class CutFunctionKind : unsigned char { crack, mouth, ripple };

/// Values of a shape function w at the three corners of one panel of its support.
struct PanelValues {
  std::size_t panel;
  std::array<double, 3> w;
};

struct CutFunction {
  CutFunctionKind kind;
  NodeId node;  ///< of the cut complex
  std::vector<PanelValues> support;
  std::vector<double> key;  ///< geometry and values of the support: equal keys, equal functions
  bool carries_opening() const { return kind != CutFunctionKind::ripple; }
};

/// The surface after the cut and the crack as panels, and the functions that the cut adds.
struct CutSpace {
  std::vector<Panel> panels;      ///< surface pieces, then crack
  std::size_t surface_count = 0;  ///< how many are surface pieces
  std::vector<TriId> parent;      ///< per surface piece: triangle of the uncut surface
  std::vector<std::array<Vec3, 3>>
      parent_values;  ///< per surface piece: at its corner k, the parent's three corner functions
  std::vector<CutFunction> functions;  ///< ordered by node
};

/// Nodes on the front (Δu = 0), on the displacement boundary, and where more than two mouth edges meet carry
/// no opening.
CutSpace make_cut_space(const CutComplex& cut, const TriMesh& surface,
                        const std::vector<BoundaryKind>& kinds);

}  // namespace conchoid

#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Linear elements are too stiff in bending: of the stress in a bent wall they show about 1 / (1 + 0.08 r² + c r⁴) with
/// r = h/t, h the root of the mean square of the elements' edges, t the thickness. c = 0 where the nodes of the two
/// sides lie opposite each other, as in a regular mesh; else 0.006: sides that are interpolated differently press the wall
/// together. Fitted to cantilevers and panes, r 0.6 … 10 (docs/verification.md). What is stretched is not touched.
/// @param paired  the nodes lie opposite each other
double shown_bending(double edge_over_thickness, bool paired);

/// The same for quadratic displacements with straight edges: about 1 / (1 + 6e-7 r⁵), fitted to panes of one element
/// through the thickness, r 9 … 32. Where curvature is the same all over, nothing is missing.
double shown_bending_by_quadratic(double edge_over_thickness);

/// × thickness: edges that show nine tenths of the bending stress, with a margin for elements that differ.
inline constexpr double wall_edge_share = 1;
/// Less than this is worth a warning.
inline constexpr double least_shown = 0.9;
/// Boundary elements that are advised at most: the dense solver takes 37 n² bytes, here 10 GB.
inline constexpr std::size_t most_advised_elements = 16000;

/// Walls that the boundary elements are too coarse for.
struct CoarseWalls {
  double share = 0;                  ///< of the surface
  double edge = 0, thickness = 0;    ///< in the middle of that part, by area [m]
  bool paired = false;               ///< its nodes lie opposite each other
  double shown = 0;                  ///< of the bending stress, there
  double wanted_edge = 0;            ///< that would show least_shown all over [m]
  std::size_t wanted_triangles = 0;  ///< with edges that follow the thickness
  double bytes() const {
    return 37.0 * static_cast<double>(wanted_triangles) * static_cast<double>(wanted_triangles);
  }
  bool affordable() const { return wanted_triangles <= most_advised_elements; }
  /// Shown by most_advised_elements in place of the wanted ones.
  double shown_by_most() const;
  /// "elements of 0.05 m on a wall of 0.01 m (98 % of the surface) show about 29 % of the bending stress; …": what
  /// would do.
  std::string text() const;
};

/// None where less than 5 % of the surface would show less than least_shown: slivers at an edge are no walls.
/// @param elements  closed, oriented outward
std::optional<CoarseWalls> coarse_walls(const TriMesh& elements);

/// The thickness of which so much of the surface, 5 %, has less [m]; none if that is more than `reach`.
std::optional<double> thinnest_wall(const TriMesh& body, double reach);

/// Triangles of a body whose boundary elements have edges of `edge`, shorter on thin walls.
double triangles_with_edges(const TriMesh& body, double edge);

}  // namespace conchoid

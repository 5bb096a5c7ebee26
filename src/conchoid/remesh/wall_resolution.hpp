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
inline constexpr double wall_edge_share = 1, quadratic_wall_edge_share = 8;
/// Less than this is worth a warning.
inline constexpr double least_shown = 0.9;
/// Linear elements that are advised at most: the dense solver takes 37 n² bytes, here 10 GB.
inline constexpr std::size_t most_advised_elements = 16000;

/// Memory of the factors of so many quadratic elements, nothing of them held.
constexpr double quadratic_bytes(double triangles) {
  return 144 * triangles * triangles;
}
/// Triangles beyond which quadratic elements are not chosen by themselves: 2.3 GB.
inline constexpr std::size_t most_quadratic_elements = 4000;
/// Fewer are not advised: curved walls want them, and they take a minute.
inline constexpr std::size_t least_quadratic_elements = 2000;

/// Walls that linear boundary elements are too coarse for.
struct CoarseWalls {
  double share = 0;                     ///< of the surface
  double edge = 0, thickness = 0;       ///< in the middle of that part, by area [m]
  bool paired = false;                  ///< its nodes lie opposite each other
  double shown = 0;                     ///< of the bending stress, there
  double wanted_edge = 0;               ///< of linear elements that would show least_shown all over [m]
  std::size_t wanted_triangles = 0;     ///< of these, with edges that follow the thickness
  std::size_t triangles = 0;            ///< that there are
  double quadratic_edge = 0;            ///< wanted_edge of quadratic elements [m]
  std::size_t quadratic_triangles = 0;  ///< as many of these, at least least_quadratic_elements
  /// Whether linear elements are.
  bool affordable() const { return wanted_triangles <= most_advised_elements; }
  /// Whether run.elements = "auto" takes quadratic elements.
  bool quadratic_by_themselves() const { return triangles <= most_quadratic_elements; }
  double shown_by_quadratic() const { return shown_bending_by_quadratic(edge / thickness); }
  /// Linear elements are used: "elements of 0.05 m on a wall of 0.01 m (98 % of the surface) show about 29 % of the
  /// bending stress as linear ones, …": what would do.
  std::string text() const;
  /// run.elements = "auto" decides: the same, or what the quadratic ones show.
  std::string text_of_auto() const;
  /// Triangles that a run with run.elements = "auto" wants; none where it shows least_shown with those there are.
  std::optional<std::size_t> advised_triangles() const;

 private:
  std::string here() const;
  std::string quadratic_remedy() const;
};

/// None where less than 5 % of the surface would show less than least_shown: slivers at an edge are no walls.
/// @param elements  closed, oriented outward
std::optional<CoarseWalls> coarse_walls(const TriMesh& elements);

/// The thickness of which so much of the surface, 5 %, has less [m]; none if that is more than `reach`.
std::optional<double> thinnest_wall(const TriMesh& body, double reach);

/// Triangles of a body whose boundary elements have edges of `edge`, shorter on thin walls.
double triangles_with_edges(const TriMesh& body, double edge);

}  // namespace conchoid

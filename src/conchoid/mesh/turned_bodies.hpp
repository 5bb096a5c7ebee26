#pragma once

#include <array>
#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Point of an outline in the half plane of positive radius: (radius, height) [m].
using OutlinePoint = std::array<double, 2>;

/// Whether an outline is closed (a tube, a ring), or begins at the bottom of the axis and ends at its top.
enum class OutlineKind { on_axis, ring };

/// Surface of a body turned on a lathe about the z axis: closed, oriented outward.
/// @param outline  counter-clockwise about the material; @param around  nodes on each circle, ≥ 3
TriMesh turned_body(const std::vector<OutlinePoint>& outline, int around, OutlineKind kind);

/// Straight pieces of an outline divided into `parts` each.
std::vector<OutlinePoint> divided_outline(const std::vector<OutlinePoint>& corners,
                                          const std::vector<int>& parts, OutlineKind kind);

/// The same, in pieces no longer than `edge` [m].
std::vector<OutlinePoint> divided_outline(const std::vector<OutlinePoint>& corners, double edge,
                                          OutlineKind kind);

}  // namespace conchoid

#pragma once

#include <array>
#include <functional>
#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Three places in a polygon: corners of a triangle, oriented like the polygon.
using PolygonTriangle = std::array<std::size_t, 3>;

/// Divides a polygon in space into n − 2 triangles without new nodes; it may be concave, bent, or run along a
/// slit or bridge twice. A fan about the first corner where that is right (convex there, no triangle flat).
/// Else the triangulation of best shapes in the plane of the polygon's area vector ½ Σ xᵢ × xᵢ₊₁ (Newell);
/// where it covers itself when seen along that vector, the one of least area, and for more than
/// `longest_for_least_area` corners the fan.
/// @param joined  pairs of nodes that must not become a diagonal, because they are joined by an edge already
std::vector<PolygonTriangle> polygon_triangles(const IdVector<NodeId, Vec3>& positions,
                                               const std::vector<NodeId>& polygon,
                                               const std::function<bool(NodeId, NodeId)>& joined = {});

inline constexpr std::size_t longest_for_least_area = 150;

/// The triangulation of least area (Barequet & Sharir 1995, O(n³)). Where `joined` leaves none, without regard
/// to it.
std::vector<PolygonTriangle> least_area_triangles(const IdVector<NodeId, Vec3>& positions,
                                                  const std::vector<NodeId>& polygon,
                                                  const std::function<bool(NodeId, NodeId)>& joined = {});

}  // namespace conchoid

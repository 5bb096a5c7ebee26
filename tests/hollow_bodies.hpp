#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "conchoid/mesh/models.hpp"
#include "conchoid/mesh/tri_mesh.hpp"
#include "conchoid/mesh/turned_bodies.hpp"

// Bodies with holes and cavities, and what else is broken in tests.
namespace conchoid::shapes {

/// @param ring  the outline is closed (a tube, a ring); else it begins at the bottom of the axis and ends at its
/// top
inline TriMesh turned(const std::vector<OutlinePoint>& outline, int around, bool ring) {
  return turned_body(outline, around, ring ? OutlineKind::ring : OutlineKind::on_axis);
}

/// Straight pieces of an outline divided into `parts` each.
inline std::vector<OutlinePoint> divided(const std::vector<OutlinePoint>& corners,
                                         const std::vector<int>& parts, bool ring) {
  return divided_outline(corners, parts, ring ? OutlineKind::ring : OutlineKind::on_axis);
}

inline TriMesh tube(double outer, double inner, double length, int along, int around = 20) {
  const double h = length / 2;
  return turned(divided({{outer, -h}, {outer, h}, {inner, h}, {inner, -h}}, {along, 1, along, 1}, true),
                around, true);
}

/// Radius 0.2, 2 high.
inline TriMesh column(int sides) {
  return turned(divided({{0, -1}, {0.2, -1}, {0.2, 1}, {0, 1}}, {2, 20, 2}, false), sides, false);
}

/// Open at the top; outer radius 1, wall 0.4, 4 high.
inline TriMesh cup(int around = 20) {
  return turned(divided({{0, -2}, {1, -2}, {1, 2}, {0.6, 2}, {0.6, -1.5}, {0, -1.5}}, {2, 6, 1, 5, 2}, false),
                around, false);
}

inline TriMesh torus(double radius, double thickness, int along, int around) {
  std::vector<std::array<double, 2>> outline;
  for (int j = 0; j < around; ++j) {
    const double a = 2 * std::numbers::pi * j / around;
    outline.push_back({radius + thickness * std::cos(a), thickness * std::sin(a)});
  }
  TriMesh mesh = turned(outline, along, true);
  for (Vec3& x : mesh.positions)
    x = {x.x(), -x.z(), x.y()};  // stands upright
  return mesh;
}

/// A cube of the given side with a spherical hole in its middle.
inline TriMesh block_with_cavity(double side, double radius, int cells) {
  TriMesh mesh = box_mesh(Vec3::Constant(side), cells, cells, cells);
  const Vec3 middle = bounding_box(mesh).center();
  const TriMesh ball = icosphere(radius, 1);
  const std::size_t first = mesh.node_count();
  for (const Vec3& x : ball.positions)
    mesh.positions.push_back(middle + x);
  for (const auto& c : ball.corners)
    mesh.corners.push_back(
        {NodeId(c[0].index() + first), NodeId(c[2].index() + first), NodeId(c[1].index() + first)});
  return mesh;
}

}  // namespace conchoid::shapes

#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "conchoid/mesh/models.hpp"
#include "conchoid/mesh/tri_mesh.hpp"

// Bodies with holes and cavities, and what else is broken in tests.
namespace conchoid::shapes {

/// Turned on a lathe about the z axis: outline (radius, height), counter-clockwise about the material in the
/// half plane of positive radius. @param ring  the outline is closed (a tube, a ring); else it begins at the
/// bottom of the axis and ends at its top
inline TriMesh turned(const std::vector<std::array<double, 2>>& outline, int around, bool ring) {
  TriMesh mesh;
  const auto circle = [&](const std::array<double, 2>& p) {
    std::vector<NodeId> nodes;
    for (int j = 0; j < around; ++j) {
      const double a = 2 * std::numbers::pi * j / around;
      nodes.push_back(mesh.positions.add({p[0] * std::cos(a), p[0] * std::sin(a), p[1]}));
    }
    return nodes;
  };
  const auto band = [&](const std::vector<NodeId>& low, const std::vector<NodeId>& high) {
    for (std::size_t j = 0; j < low.size(); ++j) {
      const std::size_t k = (j + 1) % low.size();
      if (j % 2 == 0) {
        mesh.corners.push_back({low[j], low[k], high[k]});
        mesh.corners.push_back({low[j], high[k], high[j]});
      } else {
        mesh.corners.push_back({low[j], low[k], high[j]});
        mesh.corners.push_back({low[k], high[k], high[j]});
      }
    }
  };
  std::vector<std::vector<NodeId>> circles;
  const std::size_t skip = ring ? 0 : 1;
  for (std::size_t i = skip; i + skip < outline.size(); ++i)
    circles.push_back(circle(outline[i]));
  for (std::size_t i = 0; i + 1 < circles.size(); ++i)
    band(circles[i], circles[i + 1]);
  if (ring) {
    band(circles.back(), circles.front());
    return mesh;
  }
  const NodeId bottom = mesh.positions.add({0, 0, outline.front()[1]});
  const NodeId top = mesh.positions.add({0, 0, outline.back()[1]});
  for (int j = 0; j < around; ++j) {
    const int k = (j + 1) % around;
    mesh.corners.push_back({bottom, circles.front()[k], circles.front()[j]});
    mesh.corners.push_back({top, circles.back()[j], circles.back()[k]});
  }
  return mesh;
}

/// Straight pieces of an outline divided into `parts` each.
inline std::vector<std::array<double, 2>> divided(const std::vector<std::array<double, 2>>& corners,
                                                  const std::vector<int>& parts, bool ring) {
  std::vector<std::array<double, 2>> out;
  for (std::size_t i = 0; i + (ring ? 0 : 1) < corners.size(); ++i) {
    const auto &a = corners[i], &b = corners[(i + 1) % corners.size()];
    for (int k = 0; k < parts[i]; ++k) {
      const double s = static_cast<double>(k) / parts[i];
      out.push_back({(1 - s) * a[0] + s * b[0], (1 - s) * a[1] + s * b[1]});
    }
  }
  if (!ring) out.push_back(corners.back());
  return out;
}

inline TriMesh tube(double outer, double inner, double length, int along, int around = 20) {
  const double h = length / 2;
  return turned(divided({{outer, -h}, {outer, h}, {inner, h}, {inner, -h}}, {along, 1, along, 1}, true),
                around, true);
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

#include "conchoid/mesh/turned_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace conchoid {

TriMesh turned_body(const std::vector<OutlinePoint>& outline, int around, OutlineKind kind) {
  const bool ring = kind == OutlineKind::ring;
  TriMesh mesh;
  const auto circle = [&](const OutlinePoint& p) {
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

std::vector<OutlinePoint> divided_outline(const std::vector<OutlinePoint>& corners,
                                          const std::vector<int>& parts, OutlineKind kind) {
  const bool ring = kind == OutlineKind::ring;
  std::vector<OutlinePoint> out;
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

std::vector<OutlinePoint> divided_outline(const std::vector<OutlinePoint>& corners, double edge,
                                          OutlineKind kind) {
  std::vector<int> parts;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    parts.push_back(std::max(1, static_cast<int>(std::ceil(length / edge - 1e-9))));
  }
  return divided_outline(corners, parts, kind);
}

}  // namespace conchoid

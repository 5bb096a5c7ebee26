#include "conchoid/quadrature/graded.hpp"

#include <numbers>

namespace conchoid {

namespace {

using Polygon = std::vector<Vec3>;

/// The part of a convex polygon where side·value ≥ 0, value given at the corners and affine between.
Polygon clip(const Polygon& polygon, const std::vector<double>& value, double side) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t j = (i + 1) % polygon.size();
    const double a = side * value[i], b = side * value[j];
    if (a >= 0) kept.push_back(polygon[i]);
    if ((a > 0 && b < 0) || (a < 0 && b > 0))
      kept.push_back(polygon[i] + (a / (a - b)) * (polygon[j] - polygon[i]));
  }
  return kept.size() >= 3 ? kept : Polygon{};
}

/// Gauss–Legendre nodes on [0, 1], by Newton's iteration.
std::vector<GradedNode> gauss_legendre(int n) {
  std::vector<GradedNode> rule(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 20; ++iteration) {
      double before = 1, now = x;
      for (int k = 1; k < n; ++k) {
        const double next = ((2 * k + 1) * x * now - k * before) / (k + 1);
        before = now;
        now = next;
      }
      slope = n * (x * now - before) / (x * x - 1);
      x -= now / slope;
    }
    rule[static_cast<std::size_t>(n - 1 - i)] = {(1 + x) / 2, 1 / ((1 - x * x) * slope * slope)};
  }
  return rule;
}

}  // namespace

std::vector<GradedPiece> cut_along_edges(const Triangle& outer, const PanelPotential& source) {
  std::vector<Polygon> polygons = {{outer[0], outer[1], outer[2]}};
  for (int e = 0; e < 3; ++e) {
    std::vector<Polygon> cut;
    for (const Polygon& polygon : polygons) {
      std::vector<double> value;
      for (const Vec3& p : polygon)
        value.push_back(source.edge_normal(e).dot(source.corner(e) - p));
      for (double side : {1.0, -1.0}) {
        Polygon part = clip(polygon, value, side);
        if (!part.empty()) cut.push_back(std::move(part));
      }
    }
    polygons = std::move(cut);
  }
  std::vector<GradedPiece> pieces;
  for (const Polygon& polygon : polygons) {
    Vec3 center = Vec3::Zero();
    for (const Vec3& p : polygon)
      center += p;
    center /= static_cast<double>(polygon.size());
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      pieces.push_back({{a, b, center}, area_vector2(a, b, center).norm()});
    }
  }
  return pieces;
}

std::vector<GradedNode> graded_toward_start(int levels, int order) {
  const std::vector<GradedNode> gauss = gauss_legendre(order);
  std::vector<GradedNode> nodes;
  for (int k = 0; k <= levels; ++k) {
    const double high = std::ldexp(1.0, -2 * k), low = k == levels ? 0.0 : high / 4;
    for (const GradedNode& g : gauss)
      nodes.push_back({low + (high - low) * g.t, (high - low) * g.weight});
  }
  return nodes;
}

std::vector<GradedNode> graded_toward_ends(int levels, int order) {
  std::vector<GradedNode> nodes;
  for (const GradedNode& g : graded_toward_start(levels, order)) {
    nodes.push_back({g.t / 2, g.weight / 2});
    nodes.push_back({1 - g.t / 2, g.weight / 2});
  }
  return nodes;
}

}  // namespace conchoid

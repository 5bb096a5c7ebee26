#include "conchoid/mesh/circle_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace conchoid {
namespace {

constexpr double pi = std::numbers::pi;

/// Arc length of the ellipse from parameter 0 to θ, by composite Gauss–Legendre (5 points on 16 pieces: exact
/// to rounding for the aspect ratios cracks have).
double arc_length(double theta, double a, double b) {
  static constexpr std::array<double, 3> x = {0.0, 0.5384693101056831, 0.9061798459386640};
  static constexpr std::array<double, 3> w = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  auto speed = [&](double t) { return std::hypot(a * std::sin(t), b * std::cos(t)); };
  constexpr int pieces = 16;
  const double half = theta / (2 * pieces);
  double sum = 0;
  for (int p = 0; p < pieces; ++p) {
    const double middle = half * (2 * p + 1);
    sum += w[0] * speed(middle);
    for (int i = 1; i < 3; ++i)
      sum += w[i] * (speed(middle - half * x[i]) + speed(middle + half * x[i]));
  }
  return half * sum;
}

/// Point of the first quarter of the unit circle, at the share i/n of it.
Vec2 quarter_circle_point(int i, int n) {
  if (2 * i == n) return {std::numbers::sqrt2 / 2, std::numbers::sqrt2 / 2};
  if (2 * i > n) {
    const Vec2 p = quarter_circle_point(n - i, n);
    return {p.y(), p.x()};
  }
  const double angle = 0.5 * pi * i / n;
  return {std::cos(angle), std::sin(angle)};
}

/// The point whose arc length from (a, 0) is the share i/n of a quarter.
Vec2 quarter_point(int i, int n, double a, double b) {
  if (i == 0) return {a, 0};
  if (i == n) return {0, b};
  if (a == b) return a * quarter_circle_point(i, n);
  const double wanted = arc_length(0.5 * pi, a, b) * i / n;
  double low = 0, high = 0.5 * pi;
  while (true) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (arc_length(middle, a, b) < wanted ? low : high) = middle;
  }
  return {a * std::cos(low), b * std::sin(low)};
}

}  // namespace

Vec2 ellipse_point(int j, int n, double a, double b) {
  j = (j % n + n) % n;
  if (4 * j <= n) return quarter_point(4 * j, n, a, b);
  if (2 * j <= n) {
    const Vec2 p = quarter_point(2 * n - 4 * j, n, a, b);
    return {-p.x(), p.y()};
  }
  if (4 * j <= 3 * n) return -quarter_point(4 * j - 2 * n, n, a, b);
  const Vec2 p = quarter_point(4 * n - 4 * j, n, a, b);
  return {p.x(), -p.y()};
}

double ellipse_perimeter(double a, double b) {
  return a == b ? 2 * pi * a : 4 * arc_length(0.5 * pi, a, b);
}

}  // namespace conchoid

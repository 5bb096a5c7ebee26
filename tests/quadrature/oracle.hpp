#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "conchoid/quadrature/pair_integrals.hpp"
#include "conchoid/quadrature/potentials.hpp"
#include "conchoid/quadrature/segment_quadrature.hpp"

/// Slow integrals that share nothing with the product but the point potentials (tested on their own against
/// kernels only).
namespace conchoid::oracle {

inline Panel panel(const Triangle& t, int a, int b, int c) {
  return make_panel(t, {NodeId(a), NodeId(b), NodeId(c)});
}
inline Panel panel(const Triangle& t) {
  return make_panel(t, {NodeId(), NodeId(), NodeId()});
}

inline Family family(const SingleLayerPair& p) {
  Family f;
  f << p.laplace, p.tensor[0], p.tensor[1], p.tensor[2], p.tensor[3], p.tensor[4], p.tensor[5];
  return f;
}
inline Vec3 vector(const DoubleLayerPair& p) {
  return {p[0], p[1], p[2]};
}

inline Family kernel(const Vec3& r) {
  const double d = r.norm();
  Family f;
  f << 1 / d, symmetric_product(r, r, 1 / (d * d * d));
  return f;
}

/// ∫ f over a triangle: adaptive Gauss–Kronrod along rays from corner 0, inside adaptive Gauss–Kronrod across
/// them.
template <int N, class F>
Eigen::Matrix<double, N, 1> over_triangle(const Triangle& t, double tolerance, const F& f) {
  using Vector = Eigen::Matrix<double, N, 1>;
  const double double_area = area_vector2(t[0], t[1], t[2]).norm();
  return double_area * integrate_segment<N>(
                           [&](double v) {
                             const Vec3 far = (1 - v) * t[1] + v * t[2];
                             return Vector(integrate_segment<N>(
                                 [&](double u) { return Vector(u * f((1 - u) * t[0] + u * far)); }, 0, 1,
                                 tolerance / double_area));
                           },
                           0, 1, tolerance / double_area);
}

/// Parts of a triangle cut along lines p + s·d in its plane (normal to `across`), for integrands with kinks
/// there.
inline std::vector<Triangle> cut(const std::vector<Triangle>& parts, const Vec3& p, const Vec3& across) {
  std::vector<Triangle> result;
  for (const Triangle& t : parts) {
    double reach = 0;
    for (const Vec3& corner : t)
      reach = std::max(reach, std::abs(across.dot(corner - p)));
    if (reach < 1e-14 * across.norm()) {  // lies in the cutting plane
      result.push_back(t);
      continue;
    }
    for (double side : {1.0, -1.0}) {
      std::vector<Vec3> kept;
      for (int i = 0; i < 3; ++i) {
        const Vec3 &a = t[i], &b = t[(i + 1) % 3];
        const double va = side * across.dot(a - p), vb = side * across.dot(b - p);
        if (va >= 0) kept.push_back(a);
        if (va * vb < 0) kept.push_back(a + va / (va - vb) * (b - a));
      }
      for (std::size_t i = 2; i < kept.size(); ++i) {
        const Triangle piece = {kept[0], kept[i - 1], kept[i]};
        if (area_vector2(piece[0], piece[1], piece[2]).norm() > 1e-18) result.push_back(piece);
      }
    }
  }
  return result;
}

/// X cut along the edges of Y seen down its normal, and along the plane of Y.
inline std::vector<Triangle> cut_by(const Panel& x, const Panel& y) {
  std::vector<Triangle> parts = {x.x};
  for (int i = 0; i < 3; ++i)
    parts = cut(parts, y.x[i], cross(y.x[(i + 1) % 3] - y.x[i], y.normal));
  return cut(parts, y.x[0], y.normal);
}

inline Family single_layer(const Panel& x, const Panel& y, double relative) {
  const double scale = x.area * y.area / ((x.center - y.center).norm() + x.radius + y.radius);
  const Triangle local = {y.x[0] - x.center, y.x[1] - x.center, y.x[2] - x.center};
  const PanelPotential potential(local, y.normal, 0);
  Family sum = Family::Zero();
  for (const Triangle& t : cut_by(x, y)) {
    sum += over_triangle<7>(t, relative * scale,
                            [&](const Vec3& p) { return potential.single_layer(p - x.center); });
  }
  return sum;
}

inline Vec3 double_layer(const Panel& x, const Panel& y, double relative) {
  const double d = (x.center - y.center).norm() + x.radius + y.radius;
  const Triangle local = {y.x[0] - x.center, y.x[1] - x.center, y.x[2] - x.center};
  const PanelPotential potential(local, y.normal, 0);
  Vec3 sum = Vec3::Zero();
  for (const Triangle& t : cut_by(x, y)) {
    sum += over_triangle<3>(t, relative * x.area * y.area / (d * d),
                            [&](const Vec3& p) { return potential.double_layer(p - x.center); });
  }
  return sum;
}

/// |a − b| / |b|∞
template <class V>
double relative_error(const V& a, const V& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

/// Error of a double layer against the size of ∫∫ 1/R², at least area·area / (largest distance)².
inline double double_layer_error(const Panel& x, const Panel& y, const Vec3& a, const Vec3& b) {
  const double d = (x.center - y.center).norm() + x.radius + y.radius;
  return (a - b).cwiseAbs().maxCoeff() / std::max(x.area * y.area / (d * d), b.cwiseAbs().maxCoeff());
}

}  // namespace conchoid::oracle

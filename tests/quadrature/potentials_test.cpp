#include <gtest/gtest.h>

#include <numbers>

#include "oracle.hpp"

namespace conchoid {
namespace {

using oracle::panel;
constexpr double pi = std::numbers::pi;

const Triangle fat = {Vec3(0.1, -0.2, 0.3), Vec3(1.1, 0.1, 0.2), Vec3(0.4, 0.8, 0.7)};
const Triangle slim = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.7, 0.02, 0.01)};  // smallest angle 1.8°

/// ∫_Y of the kernel by rays from the foot of x: signed triangles (foot, edge), each smooth in polar fashion.
Family brute_force(const Vec3& x, const Panel& y) {
  const Vec3 height = y.normal.dot(x - y.x[0]) * y.normal, foot = x - height;
  Family sum = Family::Zero();
  for (int i = 0; i < 3; ++i) {
    const Triangle t = {Vec3::Zero(), y.x[i] - foot, y.x[(i + 1) % 3] - foot};
    const double signed_area = area_vector2(t[0], t[1], t[2]).dot(y.normal);
    if (std::abs(signed_area) < 1e-15) continue;
    sum += std::copysign(1.0, signed_area) * oracle::over_triangle<7>(t, 1e-13 * y.area, [&](const Vec3& p) {
             return oracle::kernel(height - p);
           });
  }
  return sum;
}

Vec3 brute_force_double(const Vec3& x, const Panel& y) {
  const PanelPotential corners(y.x, y.normal, 0);
  Vec3 sum = Vec3::Zero();
  for (const Triangle& t : {Triangle{y.center, y.x[0], y.x[1]}, Triangle{y.center, y.x[1], y.x[2]},
                            Triangle{y.center, y.x[2], y.x[0]}}) {
    sum += oracle::over_triangle<3>(t, 1e-13, [&](const Vec3& p) {
      const Vec3 r = x - p;
      return Vec3(corners.corner_functions(p) * (y.normal.dot(r) / std::pow(r.norm(), 3)));
    });
  }
  return sum;
}

std::vector<Vec3> points_around(const Panel& y) {
  const Vec3 n = y.normal;
  const Vec3 mid = 0.5 * (y.x[0] + y.x[1]), beyond = 2 * y.x[1] - y.x[0];
  std::vector<Vec3> points = {y.center, y.x[0], y.x[2], mid,
                              beyond};  // inside, on corners, on an edge, on its extension
  for (double h : {1e-6, -0.03, 0.4, 5.0}) {
    for (int i = 0; i < 5; ++i)
      points.push_back(points[static_cast<std::size_t>(i)] + h * n);
  }
  points.push_back(y.center + Vec3(3, -2, 1));
  return points;
}

TEST(PanelPotential, SingleLayerMatchesTheKernelAtAnyPoint) {
  for (const Triangle& t : {fat, slim}) {
    const Panel y = panel(t);
    for (const Vec3& x : points_around(y)) {
      EXPECT_LT(oracle::relative_error(oracle::family(single_layer_potential(x, y)), brute_force(x, y)),
                3e-11)
          << x.transpose();
    }
  }
}

TEST(PanelPotential, DoubleLayerMatchesTheKernelOffThePanel) {
  for (const Triangle& t : {fat, slim}) {
    const Panel y = panel(t);
    for (const Vec3& x : {Vec3(y.center + 0.3 * y.normal), Vec3(y.x[1] - 0.1 * y.normal), Vec3(3, -2, 1)}) {
      const Vec3 exact = brute_force_double(x, y);
      EXPECT_LT(oracle::relative_error(oracle::vector(double_layer_potential(x, y)), exact), 1e-10);
    }
  }
}

TEST(PanelPotential, TheGradientIsTheSlopeOfThePotential) {
  const PanelPotential y(fat, panel(fat).normal, 0);
  for (const Vec3& x : {Vec3(0.5, 0.2, 0.9), Vec3(-1, 0.3, 0.2)}) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 step = 1e-5 * Vec3::Unit(k);
      const double slope = (y.single_layer(x + step)[0] - y.single_layer(x - step)[0]) / 2e-5;
      EXPECT_NEAR(y.gradient(x)[k], slope, 1e-8);
    }
  }
}

TEST(PanelPotential, TheTraceOfTheTensorIsTheLaplacePotential) {
  for (const Triangle& t : {fat, slim}) {
    for (const Vec3& x : points_around(panel(t))) {
      const SingleLayerPair p = single_layer_potential(x, panel(t));
      EXPECT_NEAR(p.tensor[0] + p.tensor[1] + p.tensor[2], p.laplace, 1e-12 * p.laplace);
    }
  }
}

TEST(PanelPotential, ClosedFormAndFarRuleMeet) {
  for (const Triangle& t : {fat, slim}) {
    const Panel y = panel(t);
    const Vec3 direction = Vec3(0.3, -0.8, 0.5).normalized();
    const Vec3 inside = y.center + 39.999999 * y.radius * direction,
               outside = y.center + 40.000001 * y.radius * direction;
    const double step = 40 * 2e-6 / 40;  // the potential itself falls by about that share between the two
    EXPECT_NEAR(single_layer_potential(inside, y).laplace / single_layer_potential(outside, y).laplace,
                1 + step / 40, 1e-9);
    EXPECT_NEAR(double_layer_potential(inside, y)[1] / double_layer_potential(outside, y)[1],
                1 + 2 * step / 40, 1e-8);
  }
}

TEST(PanelPotential, IsContinuousWhereThePanelIsApproached) {
  for (const Triangle& t : {fat, slim}) {
    const Panel y = panel(t);
    for (const Vec3& at : {y.center, y.x[1], Vec3(0.5 * (y.x[1] + y.x[2]))}) {
      const Family limit = oracle::family(single_layer_potential(at, y));
      for (double h : {1e-3, 1e-6, 1e-9, 1e-12}) {
        const Family above = oracle::family(single_layer_potential(at + h * y.normal, y));
        EXPECT_LT((above - limit).cwiseAbs().maxCoeff(), 2 * h * (5 - std::log(h)) + 1e-14) << "height " << h;
      }
    }
  }
}

/// Unit cube of 12 triangles seen from outside.
std::vector<Panel> cube() {
  std::vector<Panel> panels;
  for (int axis = 0; axis < 3; ++axis) {
    for (double side : {0.0, 1.0}) {
      const Vec3 u = Vec3::Unit((axis + 1) % 3), v = Vec3::Unit((axis + 2) % 3), o = side * Vec3::Unit(axis);
      const std::array<Vec3, 4> q = {o, o + u, o + u + v, o + v};
      if (side == 1.0) {
        panels.push_back(panel({q[0], q[1], q[2]}));
        panels.push_back(panel({q[0], q[2], q[3]}));
      } else {
        panels.push_back(panel({q[0], q[2], q[1]}));
        panels.push_back(panel({q[0], q[3], q[2]}));
      }
    }
  }
  return panels;
}

double solid_angle(const Vec3& x) {
  double sum = 0;
  for (const Panel& y : cube()) {
    for (double part : double_layer_potential(x, y))
      sum += part;
  }
  return sum;
}

TEST(PanelPotential, DoubleLayerOfAClosedBodyIsTheSolidAngle) {
  EXPECT_NEAR(solid_angle({0.5, 0.5, 0.5}), -4 * pi, 1e-13);
  EXPECT_NEAR(solid_angle({0.01, 0.999, 0.3}), -4 * pi, 1e-12);
  EXPECT_NEAR(solid_angle({1e-9, 0.4, 0.3}), -4 * pi, 1e-6);
  EXPECT_NEAR(solid_angle({1.3, 0.5, -0.2}), 0, 1e-13);
  EXPECT_NEAR(solid_angle({-1e-9, 0.4, 0.3}), 0, 1e-6);
  EXPECT_NEAR(solid_angle({0, 0.4, 0.3}), -2 * pi, 1e-13);
  EXPECT_NEAR(solid_angle({0.7, 0.4, 1}), -2 * pi, 1e-13);
  EXPECT_NEAR(solid_angle({1, 0.5, 0.5}), -2 * pi, 1e-13) << "on the diagonal of a face";
  EXPECT_NEAR(solid_angle({0, 0, 0.3}), -pi, 1e-13) << "on an edge";
  EXPECT_NEAR(solid_angle({1, 1, 1}), -pi / 2, 1e-13) << "on a corner";
}

TEST(PanelPotential, APowerOfTwoScalesTheBits) {
  const Panel y = panel(fat);
  for (int k : {-30, 7, 40}) {
    const double s = std::ldexp(1.0, k);
    const Panel ys = panel({s * fat[0], s * fat[1], s * fat[2]});
    for (const Vec3& x : points_around(y)) {
      EXPECT_EQ(single_layer_potential(s * x, ys).laplace, s * single_layer_potential(x, y).laplace);
      EXPECT_EQ(double_layer_potential(s * x, ys), double_layer_potential(x, y));
    }
  }
}

TEST(LinePotential, MatchesTheKernel) {
  const Vec3 a(0.1, 0.2, 0.3), b(0.9, -0.4, 0.5);
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(0.5, -0.1, 0.41), Vec3(3, 1, -2), Vec3(2 * b - a)}) {
    const double length = (b - a).norm();
    const Family sum =
        length *
        integrate_segment<7>([&](double s) { return oracle::kernel(x - (1 - s) * a - s * b); }, 0, 1, 1e-13);
    EXPECT_LT(oracle::relative_error(line_single_layer(x, a, b), sum), 1e-12);
    const auto field = [&](double s) {
      const Vec3 r = x - (1 - s) * a - s * b;
      return Vec3(r * (length / std::pow(r.norm(), 3)));
    };
    const LineField line = line_field(x, a, b);
    const Vec3 total = integrate_segment<3>(field, 0, 1, 1e-12);
    const Vec3 weighted = integrate_segment<3>([&](double s) { return Vec3(s * field(s)); }, 0, 1, 1e-12);
    EXPECT_LT(oracle::relative_error(line.total, total), 1e-11);
    EXPECT_LT(oracle::relative_error(line.toward_b, weighted), 1e-11);
  }
}

}  // namespace
}  // namespace conchoid

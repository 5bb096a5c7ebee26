#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "conchoid/quadrature/lanes.hpp"
#include "conchoid/quadrature/point_potentials.hpp"
#include "oracle.hpp"

namespace conchoid {
namespace {

class RandomPoints {
 public:
  Vec3 operator()() { return {normal_(random_), normal_(random_), normal_(random_)}; }
  double number() { return normal_(random_); }

 private:
  std::mt19937_64 random_{5};
  std::normal_distribution<double> normal_;
};

Points arrays(const std::vector<Vec3>& points) {
  Points result;
  for (int i = 0; i < Points::most; ++i)
    for (int k = 0; k < 3; ++k)
      result.at[k][i] = points[static_cast<std::size_t>(i)][k];
  return result;
}

template <int N>
Eigen::Matrix<double, N, 1> at(const PointValues<N>& values, int i) {
  Eigen::Matrix<double, N, 1> result;
  for (int k = 0; k < N; ++k)
    result[k] = values.of[k][i];
  return result;
}

// Points everywhere around a triangle: in its plane, on its edges and corners, just above it, some sizes away.
std::vector<Vec3> points_around(const Triangle& t, const Vec3& normal, RandomPoints& random) {
  std::vector<Vec3> points = {t[0], 0.5 * (t[0] + t[1]), (t[0] + t[1] + t[2]) / 3, 2 * t[1] - t[0]};
  while (points.size() < Points::most) {
    const double h = std::pow(10.0, -static_cast<double>(points.size() % 4) * 3) * random.number();
    points.push_back(t[0] + random.number() * (t[1] - t[0]) + random.number() * (t[2] - t[0]) +
                     5 * h * normal);
  }
  return points;
}

TEST(PointPotentials, AreThoseOfOnePoint) {
  RandomPoints random;
  for (int round = 0; round < 200; ++round) {
    const Triangle t = {random(), random(), random()};
    const Vec3 normal = area_vector2(t[0], t[1], t[2]).normalized(), a = random();
    const PanelPotential panel(t, normal, 1e-13);
    const PointPotentials together(panel);
    const std::vector<Vec3> points = points_around(t, normal, random);
    const Points x = arrays(points);
    PointValues<7> single, line;
    PointValues<3> dbl;
    PointValues<1> gradient;
    together.single_layer(x, single);
    together.double_layer(x, dbl);
    together.gradient_along(a, x, gradient);
    line_single_layer(x, t[0], t[1], line);
    for (int i = 0; i < Points::most; ++i) {
      const Vec3& p = points[static_cast<std::size_t>(i)];
      // Seen from afar or in thin triangles the terms cancel.
      const double loss =
          (t[0] - t[1]).squaredNorm() + (t[0] - t[2]).squaredNorm() + (p - t[0]).squaredNorm();
      const double rounding = 1e-14 * loss / panel.double_area() * (1 + (p - t[0]).norm());
      const Family expected = panel.single_layer(p);
      EXPECT_LE((together.in_space(at(single, i)) - expected).cwiseAbs().maxCoeff(), rounding);
      EXPECT_LE((at(dbl, i) - panel.double_layer(p)).cwiseAbs().maxCoeff(),
                10 * rounding * loss / panel.double_area());
      if (i > 3) {  // the gradient is infinite on edges, and so is the potential of a segment on itself
        EXPECT_NEAR(gradient.of[0][i], a.dot(panel.gradient(p)), 100 * rounding * a.norm());
        const Family of_line = line_single_layer(p, t[0], t[1]);
        EXPECT_LE((at(line, i) - of_line).cwiseAbs().maxCoeff(), 1e-12 * of_line.cwiseAbs().maxCoeff());
      }
    }
  }
}

TEST(PointPotentials, ContourTermsAreIntegralsAlongTheEdges) {
  const Triangle t = {Vec3(0, 0, 0), Vec3(1.1, 0, 0), Vec3(0.3, 0.8, 0)};
  const PanelPotential panel(t, Vec3::UnitZ(), 0);
  const PointPotentials together(panel);
  const double D = 1.7;
  RandomPoints random;
  std::vector<Vec3> points;
  for (int i = 0; i < Points::most; ++i)
    points.push_back(Vec3(random.number(), random.number(), i % 3 == 0 ? 0.01 : random.number()));
  PointValues<6> values;
  together.contour(arrays(points), D, values);
  for (int i = 0; i < Points::most; ++i) {
    const Vec3& p = points[static_cast<std::size_t>(i)];
    const double h = std::abs(p.z());
    Eigen::Matrix<double, 6, 1> expected = Eigen::Matrix<double, 6, 1>::Zero();
    for (int e = 0; e < 3; ++e) {
      const Vec3 a = t[static_cast<std::size_t>(e)], b = t[static_cast<std::size_t>((e + 1) % 3)];
      const Eigen::Vector2d of = integrate_segment<2>(
          [&](double s) {
            const double r = ((1 - s) * a + s * b - p).norm();
            return Eigen::Vector2d(r, std::log((r + h) / D));
          },
          0, 1, 1e-13);
      const Vec3 m = together.axes().transpose() * panel.edge_normal(e) * (b - a).norm();
      expected.head<2>() += of[0] * m.head<2>();
      expected.segment<2>(2) += of[1] * m.head<2>();
    }
    expected[4] = panel.single_layer(p)[0];
    const auto log_of_distance = [&](const Vec3& y) {
      return Eigen::Matrix<double, 1, 1>(std::log(((y - p).norm() + h) / D));
    };
    expected[5] = oracle::over_triangle<1>(t, 1e-10, log_of_distance)[0];
    EXPECT_LE((at(values, i) - expected).cwiseAbs().maxCoeff(), 1e-9) << p.transpose();
  }
}

TEST(Lanes, LogarithmsAndAnglesAreExactToRounding) {
  RandomPoints random;
  for (int round = 0; round < 5000; ++round) {
    alignas(32) double y[lanes], x[lanes], over[lanes], under[lanes], angle[lanes], ratio[lanes];
    for (int l = 0; l < lanes; ++l) {
      y[l] = round == 0 && l % 2 == 0 ? 0.0 : random.number() * std::exp(5 * random.number());
      x[l] = round == 0 && l < 2 ? 0.0 : random.number();
      over[l] = std::exp(20 * random.number());
      under[l] =
          round % 2 == 0 ? std::exp(20 * random.number()) : over[l] * (1 + 0.3 * std::abs(std::sin(x[l])));
    }
    Lanes a, r;
    const Lanes none = {};
    angle_of(*reinterpret_cast<Lanes*>(y), *reinterpret_cast<Lanes*>(x), a);
    log_of_ratio(*reinterpret_cast<Lanes*>(over), *reinterpret_cast<Lanes*>(under), IntLanes{}, none,
                 none + 1.0, r);
    *reinterpret_cast<Lanes*>(angle) = a;
    *reinterpret_cast<Lanes*>(ratio) = r;
    for (int l = 0; l < lanes; ++l) {
      EXPECT_NEAR(angle[l], std::atan2(y[l], x[l]), 5e-16 * (1 + std::abs(angle[l])));
      EXPECT_NEAR(ratio[l], std::log(over[l] / under[l]), 1e-15 * (1 + std::abs(ratio[l])));
    }
  }
}

}  // namespace
}  // namespace conchoid

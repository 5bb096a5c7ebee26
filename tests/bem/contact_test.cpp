#include "conchoid/bem/contact.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cstdint>

#include "conchoid/bem/cracked_body.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "stops.hpp"

namespace conchoid {
namespace {

// Three nodes in a row; the middle one is pulled apart, which pushes its neighbours together.
struct Row {
  Eigen::MatrixXd S;
  Eigen::VectorXd f;
  std::vector<OpeningConstraint> constraints;

  Row() : S(4 * Eigen::MatrixXd::Identity(9, 9)), f(9) {
    for (Eigen::Index i = 0; i + 3 < 9; ++i)
      S(i, i + 3) = S(i + 3, i) = 1.5;
    f << 0, 0, -1, 0, 0, 1, 0, 0, 0.2;
    for (std::size_t i = 0; i < 3; ++i)
      constraints.push_back({3 * i, Vec3::UnitZ()});
  }
  void solve(double* b, std::size_t count) const {
    Eigen::Map<Eigen::MatrixXd> x(b, 9, static_cast<Eigen::Index>(count));
    x = S.llt().solve(x.eval());
  }
  ContactReport close(std::vector<double>& x, int sweeps) const {
    x.assign(f.begin(), f.end());
    solve(x.data(), 1);
    return close_penetrating_faces(
        x, constraints, [&](double* b, std::size_t count) { solve(b, count); }, sweeps);
  }
};

// Nodes whose normal openings z are coupled by `normal`, under forces f along z.
struct Nodes {
  Eigen::MatrixXd normal;
  Eigen::VectorXd f;

  ContactReport close(Eigen::VectorXd& z) const {
    const Eigen::Index n = f.size();
    std::vector<OpeningConstraint> constraints;
    for (Eigen::Index i = 0; i < n; ++i)
      constraints.push_back({static_cast<std::size_t>(3 * i), Vec3::UnitZ()});
    const auto solve = [&](double* b, std::size_t count) {
      for (std::size_t c = 0; c < count; ++c) {
        Eigen::Map<Eigen::VectorXd, 0, Eigen::InnerStride<3>> along(b + 3 * n * c + 2, n);
        along = normal.llt().solve(Eigen::VectorXd(along));
      }
    };
    std::vector<double> x(3 * n, 0.0);
    for (Eigen::Index i = 0; i < n; ++i)
      x[3 * i + 2] = f[i];
    solve(x.data(), 1);
    const ContactReport report = close_penetrating_faces(x, constraints, solve);
    z.resize(n);
    for (Eigen::Index i = 0; i < n; ++i)
      z[i] = x[3 * i + 2];
    return report;
  }

  void expect_closed() const {
    Eigen::VectorXd z;
    const ContactReport report = close(z);
    ASSERT_TRUE(report.converged) << report.penetration / report.largest_opening;
    const Eigen::VectorXd force = normal * z - f;
    const double tolerance = 2e-6 * report.largest_opening;
    for (Eigen::Index i = 0; i < z.size(); ++i) {
      EXPECT_GE(z[i], -tolerance);
      EXPECT_GE(force[i], -1e-7 * force.cwiseAbs().maxCoeff());
      EXPECT_NEAR(z[i] * force[i], 0, tolerance * force.cwiseAbs().maxCoeff());
    }
  }
};

}  // namespace

// Adding all nodes that pass through and releasing all that pull goes round in circles here.
TEST(Contact, SetsOfTouchingNodesDoNotCycle) {
  Nodes nodes{Eigen::MatrixXd(6, 6), Eigen::VectorXd(6)};
  nodes.normal << 15.01, 10, 6, 6, 2, 0, 10, 8.01, 4, 3, 3, -3, 6, 4, 18.01, -2, 2, 0, 6, 3, -2, 10.01, 2, 6,
      2, 3, 2, 2, 6.01, 0, 0, -3, 0, 6, 0, 11.01;
  nodes.f << 3, 3, 3, 2, 1, -1;
  nodes.expect_closed();
}

// Coupled by forces of both signs as strongly as can be, as on a crack that is rolled up.
TEST(Contact, EveryStiffnessComesToAnEnd) {
  std::uint32_t state = 1;
  const auto draw = [&](int below) {
    state = 1664525u * state + 1013904223u;
    return static_cast<int>((state >> 16) % static_cast<std::uint32_t>(below));
  };
  for (int n : {5, 20, 60})
    for (int repeat = 0; repeat < 20; ++repeat) {
      Eigen::MatrixXd factor(n, n);
      Nodes nodes{Eigen::MatrixXd(), Eigen::VectorXd(n)};
      for (Eigen::Index i = 0; i < n; ++i) {
        nodes.f[i] = draw(9) - 4;
        for (Eigen::Index j = 0; j < n; ++j)
          factor(i, j) = draw(5) - 2;
      }
      nodes.normal = factor * factor.transpose() + 0.1 * Eigen::MatrixXd::Identity(n, n);
      nodes.expect_closed();
    }
}

TEST(Contact, ClosedFacesCarryPressureAndOpenOnesNone) {
  const Row row;
  std::vector<double> x;
  const ContactReport report = row.close(x, kContactSweeps);
  EXPECT_TRUE(report.converged);
  EXPECT_GT(report.sweeps, 0);
  const Eigen::VectorXd pressure = row.S * Eigen::Map<Eigen::VectorXd>(x.data(), 9) - row.f;
  for (Eigen::Index i = 0; i < 3; ++i) {
    EXPECT_GE(x[3 * i + 2], -1e-12);
    EXPECT_GE(pressure[3 * i + 2], -1e-12);
    EXPECT_NEAR(x[3 * i + 2] * pressure[3 * i + 2], 0, 1e-12);
  }
}

TEST(Contact, GivingUpIsSaidWithWhatIsLeft) {
  const Row row;
  std::vector<double> x;
  const ContactReport report = row.close(x, 0);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.sweeps, 0);
  EXPECT_DOUBLE_EQ(report.penetration, -x[2]);
  EXPECT_GT(report.penetration, 0);
  const std::string text = contact_warning({60, false, 2.5e-6, 1e-3});
  EXPECT_NE(text.find("60 sweeps"), std::string::npos) << text;
  EXPECT_NE(text.find("2.5e-06 m"), std::string::npos) << text;
  EXPECT_NE(text.find("0.0025 of"), std::string::npos) << text;
}

// A crack under pressure across it stays closed; the body reports that this went well.
TEST(Contact, PressedCrackStaysClosed) {
  const ElasticConstants glassy{3.1e9, 0.327};
  Mat3 stress = Mat3::Zero();
  stress(2, 2) = -1e6;
  stress(0, 2) = stress(2, 0) = 2e5;
  CrackedBody body =
      make_cracked_body({}, {}, glassy, uniform_stress(stress, glassy.youngs_modulus, glassy.poisson_ratio));
  body.set_crack(uncut_sheet(disc_crack(Vec3::Zero(), Vec3::UnitZ(), 0.5, {.triangles = 96})));
  body.solve();
  EXPECT_TRUE(body.contact().converged);
  EXPECT_GT(body.contact().sweeps, 0);
  double slip = 0;
  for (const Vec3& opening : body.opening()) {
    EXPECT_NEAR(opening.z(), 0, 1e-6 * body.contact().largest_opening);
    slip = std::max(slip, opening.head<2>().norm());
  }
  EXPECT_GT(slip, 1e-5);
}

// Released energy ½ ∫ σ Δu of a penny crack: 8 (1−ν²) σ² a³ / 3E (Sneddon 1946).
TEST(CrackedBody, EnergyOfAPennyCrack) {
  const ElasticConstants glassy{3.1e9, 0.327};
  const double a = 0.5, sigma = 1e6;
  Mat3 stress = Mat3::Zero();
  stress(2, 2) = sigma;
  CrackedBody body =
      make_cracked_body({}, {}, glassy, uniform_stress(stress, glassy.youngs_modulus, glassy.poisson_ratio));
  body.set_crack(uncut_sheet(disc_crack(Vec3::Zero(), Vec3::UnitZ(), a, {.triangles = 384})));
  body.solve();
  const double exact = 8 * (1 - glassy.poisson_ratio * glassy.poisson_ratio) * sigma * sigma * a * a * a /
                       (3 * glassy.youngs_modulus);
  EXPECT_NEAR(body.energy() / exact, 1, 0.05);
}

TEST(Contact, HearsRequestsToStop) {
  test::expect_stop("contact", [] {
    std::vector<double> x;
    Row().close(x, 100);
  });
}

}  // namespace conchoid

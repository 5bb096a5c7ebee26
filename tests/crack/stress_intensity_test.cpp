#include "conchoid/crack/intensity/stress_intensity.hpp"

#include <gtest/gtest.h>

#include "conchoid/crack/intensity/kinks_behind.hpp"
#include "conchoid/crack/length_factors.hpp"
#include "crack_samples.hpp"

using namespace conchoid;
using namespace conchoid::testing;

namespace {

/// The openings put in are values of exact solutions.
SifSettings exact(SifMethod method = SifMethod::two_point) {
  return {method, SifConvention::full_opening, false};
}

const ElasticConstants kGlass{7e10, 0.22};

/// Exact opening of a penny crack (centre 0, normal z) under tension σ [Pa] and shear τ along x [Pa].
/// Δu_z = 4(1−ν)σ/(πμ) √(a²−ρ²), Δu_x = 8(1−ν)τ/(π(2−ν)μ) √(a²−ρ²).
IdVector<NodeId, Vec3> penny_opening(const TriMesh& mesh, double a, double tension, double shear) {
  const double nu = kGlass.poisson_ratio, mu = kGlass.shear_modulus(), pi = std::numbers::pi;
  const Vec3 amplitude(8 * (1 - nu) * shear / (pi * (2 - nu) * mu), 0, 4 * (1 - nu) * tension / (pi * mu));
  IdVector<NodeId, Vec3> opening;
  for (const Vec3& x : mesh.positions) {
    const double rest = a * a - x.squaredNorm();
    opening.push_back(rest > 1e-9 * a * a ? Vec3(amplitude * std::sqrt(rest)) : Vec3::Zero());
  }
  return opening;
}

double exact_tension_intensity(double a, double sigma) {
  return 2 * sigma * std::sqrt(a / std::numbers::pi);
}

/// Inner nodes shaken in the plane by up to `share` of the edge length.
TriMesh shaken_disc(double a, int rings, double share) {
  TriMesh mesh = disc(a, rings);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (std::size_t i = 0; i < mesh.node_count() - 6 * static_cast<std::size_t>(rings); ++i)
    mesh.positions[NodeId(i)] += share * a / rings * Vec3(any(random), any(random), 0);
  return mesh;
}

/// A disc whose outer row of nodes lies `thin` edge lengths inside the front, as after a frame of slow
/// growth.
TriMesh disc_with_thin_strip(double a, int rings, double thin) {
  const double edge = a / rings;
  return disc_with_radii(rings, [=](int k) {
    if (k == rings) return a;
    return (a - thin * edge) * k / (rings - 1);
  });
}

void expect_uniform(const TriMesh& mesh, double a, SifMethod method, double tolerance) {
  SCOPED_TRACE(mesh.triangle_count());
  const auto fronts = find_fronts(mesh, {});
  const auto K = stress_intensities(mesh, fronts[0], penny_opening(mesh, a, 1e6, 0), kGlass, exact(method));
  const double exact = exact_tension_intensity(a, 1e6);
  for (const Vec3& k : K) {
    EXPECT_NEAR(k[0] / exact, 1, tolerance);
    EXPECT_NEAR(k[1] / exact, 0, tolerance);
    EXPECT_NEAR(k[2] / exact, 0, tolerance);
  }
}

}  // namespace

TEST(StressIntensity, InverseOfForwardIsIdentity) {
  for (auto convention : {SifConvention::full_opening, SifConvention::half_opening}) {
    const Vec3 K(1.3e6, -0.4e6, 2.2e5);
    const Vec3 opening = opening_from_intensity(K, 0.017, kGlass, convention);
    EXPECT_LT((stress_intensity(opening, 0.017, kGlass, convention) - K).norm(), 1e-9 * K.norm());
  }
}

TEST(StressIntensity, TheHalfOpeningFormulaGivesTwice) {
  const Vec3 opening(1e-6, 2e-6, -3e-6);
  EXPECT_EQ(stress_intensity(opening, 0.01, kGlass, SifConvention::half_opening),
            2 * stress_intensity(opening, 0.01, kGlass, SifConvention::full_opening));
}

TEST(StressIntensity, PlaneStrainFieldOfUnitIntensity) {
  const double nu = kGlass.poisson_ratio, mu = kGlass.shear_modulus(), r = 0.02;
  const double root = std::sqrt(r / (2 * std::numbers::pi));
  const Vec3 K =
      stress_intensity({4 * (1 - nu) / mu * root, 4 * (1 - nu) / mu * root, 4 / mu * root}, r, kGlass);
  EXPECT_LT((K - Vec3::Ones()).norm(), 1e-13);
}

TEST(StressIntensities, TwoPointIsWithinOnePercentOnThePennyCrack) {
  for (int rings : {4, 6, 8, 12})
    expect_uniform(disc(0.3, rings), 0.3, SifMethod::two_point, 0.01);
}

TEST(StressIntensities, TwoPointIsWithinOnePercentOnAnIrregularMesh) {
  for (int rings : {6, 8, 12})
    expect_uniform(shaken_disc(0.3, rings, 0.2), 0.3, SifMethod::two_point, 0.01);
}

TEST(StressIntensities, TwoPointIsWithinOnePercentBehindAThinStrip) {
  for (double thin : {0.1, 0.2, 0.4, 0.7})
    expect_uniform(disc_with_thin_strip(0.3, 10, thin), 0.3, SifMethod::two_point, 0.01);
}

TEST(StressIntensities, OnePointIsLowByTheCurvatureOfTheProfile) {
  // √(2ar − r²) against √(2ar): √(1 − r/2a), r = a/8 → −3 %.
  expect_uniform(disc(0.3, 8), 0.3, SifMethod::one_point, 0.045);
}

TEST(StressIntensities, ShearedPennyHasTheExactModesAllAround) {
  const double a = 1.0, tau = 1e6, nu = kGlass.poisson_ratio;
  for (int rings : {8, 12}) {
    const TriMesh mesh = disc(a, rings);
    const auto front = find_fronts(mesh, {})[0];
    const auto K = stress_intensities(mesh, front, penny_opening(mesh, a, 0, tau), kGlass, exact());
    const double root = std::sqrt(a / std::numbers::pi);
    const double K2 = 4 * tau * root / (2 - nu), K3 = 4 * (1 - nu) * tau * root / (2 - nu);
    for (std::size_t i = 0; i < front.nodes.size(); ++i) {
      const Vec3 x = mesh.positions[front.nodes[i]] / a;  // e2 = x, e3 = z × x
      EXPECT_NEAR(K[i][1], K2 * x.x(), 0.01 * K2);
      EXPECT_NEAR(K[i][2], -K3 * x.y(), 0.01 * K3);
      EXPECT_NEAR(K[i][0], 0, 1e-6 * K2);
    }
  }
}

TEST(StressIntensities, RotationAndScaleDoNotMatter) {
  const TriMesh mesh = shaken_disc(0.3, 6, 0.2);
  const auto opening = penny_opening(mesh, 0.3, 1e6, 0.7e6);
  const Mat3 turn = some_rotation();
  const double s = 1024;  // lengths; openings scale alike, K by √s
  TriMesh moved = transformed(mesh, s * turn);
  IdVector<NodeId, Vec3> moved_opening;
  for (const Vec3& u : opening)
    moved_opening.push_back(s * turn * u);
  for (auto method : {SifMethod::one_point, SifMethod::two_point}) {
    const auto K = stress_intensities(mesh, find_fronts(mesh, {})[0], opening, kGlass, exact(method));
    const auto M = stress_intensities(moved, find_fronts(moved, {})[0], moved_opening, kGlass, exact(method));
    for (std::size_t i = 0; i < K.size(); ++i)
      EXPECT_LT((M[i] / std::sqrt(s) - K[i]).norm(), 1e-10 * K[i].norm());
  }
}

TEST(StressIntensities, ScalingByAPowerOfFourKeepsTheBits) {
  const TriMesh mesh = shaken_disc(0.3, 6, 0.2);
  auto opening = penny_opening(mesh, 0.3, 1e6, 0.7e6);
  const auto K = stress_intensities(mesh, find_fronts(mesh, {})[0], opening, kGlass, exact());
  const TriMesh big = transformed(mesh, 64 * Mat3::Identity());
  for (Vec3& u : opening)
    u *= 8;  // Δu ∝ √r: the same K
  const auto M = stress_intensities(big, find_fronts(big, {})[0], opening, kGlass, exact());
  for (std::size_t i = 0; i < K.size(); ++i)
    EXPECT_EQ(M[i], K[i]);
}

TEST(StressIntensities, AStraightOpenFrontKeepsALinearVariation) {
  // Front x = 2, 0 ≤ y ≤ 4, mouth on the other three sides; K_I(y) = 1 + y/8.
  const TriMesh mesh = rectangle(2, 4, 8, 16);
  std::vector<Edge> mouth;
  const auto node = [](int i, int j) { return NodeId(j * 9 + i); };
  for (int i = 0; i < 8; ++i)
    mouth.insert(mouth.end(), {Edge(node(i, 0), node(i + 1, 0)), Edge(node(i, 16), node(i + 1, 16))});
  for (int j = 0; j < 16; ++j)
    mouth.emplace_back(node(0, j), node(0, j + 1));
  std::sort(mouth.begin(), mouth.end());
  const auto fronts = find_fronts(mesh, mouth);
  ASSERT_EQ(fronts.size(), 1u);
  IdVector<NodeId, Vec3> opening;
  for (const Vec3& x : mesh.positions) {
    const double r = 2 - x.x();
    opening.push_back(r > 0
                          ? Vec3(opening_from_intensity({1 + x.y() / 8, 0, 0}, r, kGlass)[0] * Vec3::UnitZ())
                          : Vec3::Zero());
  }
  for (auto method : {SifMethod::one_point, SifMethod::two_point}) {
    const auto K = stress_intensities(mesh, fronts[0], opening, kGlass, exact(method));
    for (std::size_t i = 0; i < K.size(); ++i) {
      const double exact = 1 + mesh.positions[fronts[0].nodes[i]].y() / 8;
      const bool end = i == 0 || i + 1 == K.size();
      EXPECT_NEAR(K[i][0], exact, end || method == SifMethod::one_point ? 0.05 : 1e-3) << i;
    }
  }
}

TEST(StressIntensities, ACrackOneRowWideHasNothingToReadFrom) {
  const TriMesh mesh = rectangle(6, 1, 6, 1);
  const auto front = find_fronts(mesh, {})[0];
  const IdVector<NodeId, Vec3> opening(mesh.node_count(), Vec3::Zero());
  for (auto method : {SifMethod::one_point, SifMethod::two_point})
    for (const Vec3& k : stress_intensities(mesh, front, opening, kGlass, exact(method)))
      EXPECT_EQ(k, Vec3::Zero());
}

TEST(StressIntensities, CornersWithoutAnInteriorNodeInheritFromTheirNeighbours) {
  const TriMesh mesh = rectangle(4, 4, 4, 4);
  const auto front = find_fronts(mesh, {})[0];
  IdVector<NodeId, Vec3> opening;
  for (const Vec3& x : mesh.positions) {
    const double r = std::min({x.x(), x.y(), 4 - x.x(), 4 - x.y()});
    opening.push_back(std::sqrt(r) * Vec3::UnitZ());
  }
  for (auto method : {SifMethod::one_point, SifMethod::two_point})
    for (const Vec3& k : stress_intensities(mesh, front, opening, kGlass, exact(method)))
      EXPECT_GT(k[0], 0);
}

// A small front with a mouth, shaken, with openings that have nothing to do with any solution: what is read
// may not depend on which way the front is walked.
TEST(StressIntensities, MirroredCracksHaveMirroredIntensities) {
  for (int rows : {2, 3, 5}) {
    SCOPED_TRACE(rows);
    TriMesh mesh = rectangle(4, rows, 4, rows);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(-1, 1);
    IdVector<NodeId, Vec3> opening, mirrored_opening;
    for (Vec3& x : mesh.positions) {
      x += 0.25 * Vec3(any(random), any(random), 0.2 * any(random));
      opening.push_back(Vec3(any(random), any(random), any(random)));
      mirrored_opening.push_back(Vec3(-opening.end()[-1].x(), opening.end()[-1].y(), opening.end()[-1].z()));
    }
    std::vector<Edge> mouth;
    for (int j = 0; j < rows; ++j)
      mouth.emplace_back(NodeId(5 * j), NodeId(5 * (j + 1)));
    std::sort(mouth.begin(), mouth.end());
    const TriMesh image = mirrored(mesh);
    const Front front = find_fronts(mesh, mouth)[0], walked_back = find_fronts(image, mouth)[0];
    const std::size_t n = front.nodes.size();
    for (auto method : {SifMethod::one_point, SifMethod::two_point}) {
      const auto K = stress_intensities(mesh, front, opening, kGlass, exact(method));
      const auto M = stress_intensities(image, walked_back, mirrored_opening, kGlass, exact(method));
      for (std::size_t i = 0; i < n; ++i) {
        ASSERT_EQ(walked_back.nodes[n - 1 - i], front.nodes[i]);
        EXPECT_LT((M[n - 1 - i] - Vec3(K[i][0], K[i][1], -K[i][2])).norm(), 1e-9 * K[i].norm()) << i;
      }
    }
  }
}

namespace {

/// Mouth of a rectangle of n × 13 nodes whose front is its last column.
std::vector<Edge> all_but_the_end(int n) {
  std::vector<Edge> mouth;
  for (int i = 0; i + 1 < n; ++i)
    mouth.insert(mouth.end(),
                 {Edge(NodeId(i), NodeId(i + 1)), Edge(NodeId(12 * n + i), NodeId(12 * n + i + 1))});
  for (int j = 0; j < 12; ++j)
    mouth.emplace_back(NodeId(j * n), NodeId((j + 1) * n));
  std::sort(mouth.begin(), mouth.end());
  return mouth;
}

/// A sheet of 12 × `arm` + 6 rows of unit cells, its last `arm` rows turned by the angle from e2 towards e1; K
/// in front of the kink, at it what a kink makes of K, behind it openings of no meaning.
std::vector<Vec3> intensities_of_kinked_sheet(int arm, double angle, const Vec3& K, double behind) {
  TriMesh mesh = rectangle(6 + arm, 12, 6 + arm, 12);
  const Vec3 e2(std::cos(angle), 0, std::sin(angle)), e1(-std::sin(angle), 0, std::cos(angle));
  const Vec3 straight = opening_from_intensity(K, 1, kGlass);
  const double a = std::abs(angle), s = angle < 0 ? -1 : 1;
  const double m11 = 1 + kKinkRates[0] * std::pow(a, 4), m12 = -s * kKinkRates[1] * std::pow(a, 3);
  const double m21 = -s * kKinkRates[2] * std::pow(a, 3), m22 = 1 + kKinkRates[3] * a * a;
  const Vec3 at_kink(m11 * straight[0] + m12 * straight[1], m21 * straight[0] + m22 * straight[1], 0);
  IdVector<NodeId, Vec3> opening;
  for (Vec3& x : mesh.positions) {
    const double beyond = x.x() - 6, r = arm - beyond;
    if (beyond > 0) x = Vec3(6, x.y(), 0) + beyond * e2;
    const Vec3 rate = beyond > 0 ? straight : at_kink;
    const Vec3 inside = std::sqrt(r) * (rate[0] * e1 + rate[1] * e2);
    opening.push_back(beyond < 0 ? Vec3(behind * inside) : inside);
  }
  const auto fronts = find_fronts(mesh, all_but_the_end(7 + arm));
  EXPECT_EQ(fronts.size(), 1u);
  return stress_intensities(mesh, fronts[0], opening, kGlass, exact());
}

}  // namespace

TEST(StressIntensities, DoNotRememberWhatLiesBehindAKink) {
  const Vec3 K(1, -0.3, 0);
  for (int arm : {1, 2, 3})
    for (double angle : {-1.2, -0.6, 0.4, 0.9})
      for (double behind : {0.5, 2.0})
        for (const Vec3& k : intensities_of_kinked_sheet(arm, angle, K, behind)) {
          EXPECT_NEAR(k[0], K[0], 1e-3) << arm << " rows, " << angle;
          EXPECT_NEAR(k[1], K[1], 1e-3) << arm << " rows, " << angle;
        }
}

TEST(StressIntensities, ASmoothTurnIsNoKink) {
  EXPECT_EQ(share_behind_turn(kSmoothSurfaceTurn), 1);
  EXPECT_EQ(share_behind_turn(2 * kSmoothSurfaceTurn), 0);
  const Vec3 rate(1, 2, 3);
  EXPECT_EQ(without_kink(rate, kSmoothSurfaceTurn), rate);
  EXPECT_EQ(without_kink(rate, 0), rate);
}

// Openings of elements along the end of a flat sheet: the first row 5 % too high, sliding that grows with the third
// power of √r, as where K_II was another one three rows ago.
TEST(StressIntensities, TheFirstRowSaysInWhichDirectionButNotHowMuch) {
  const int n = 9;
  const TriMesh mesh = rectangle(n - 1, 12, n - 1, 12);
  const Vec3 mode_I = opening_from_intensity({1, 0, 0}, 1, kGlass);
  IdVector<NodeId, Vec3> opening;
  for (const Vec3& x : mesh.positions) {
    const double r = n - 1 - x.x();
    const double seen = r < 0.5 ? 0 : r < 1.5 ? kFirstRowExcess * 1.05 : std::sqrt(r - kFrontShift);
    opening.push_back(seen * mode_I[0] * Vec3(0.02 * r * r, 0, 1));
  }
  const auto fronts = find_fronts(mesh, all_but_the_end(n));
  ASSERT_EQ(fronts.size(), 1u);
  const auto K = stress_intensities(mesh, fronts[0], opening, kGlass, SifSettings());
  for (std::size_t i = 3; i + 3 < K.size(); ++i) {
    EXPECT_NEAR(K[i][0], 1, 0.025);
    EXPECT_LT(std::abs(K[i][1]), 0.06);  // of the rows behind it alone: 0.094
  }
}

// Antiplane shear: the kinked half-plane is mapped by (t − 1 + m)^(1−m) (t + 1 + m)^(1+m), m = θ/π.
TEST(StressIntensities, AKinkUnderAntiplaneShearIsThatOfTheMap) {
  for (double m : {0.2, 0.35}) {
    const double length = std::pow(1 - m, 1 - m) * std::pow(1 + m, 1 + m), curvature = length / (1 - m * m);
    const double opening = 2, straight = 2 * std::sqrt(length / curvature);
    const Vec3 rate = without_kink({0, 0, opening / straight}, m * std::numbers::pi);
    EXPECT_NEAR(rate[2], 1, 1e-12);
  }
}

// Front edges of 1 and ½: two edges to either side are shorter than what is fitted.
TEST(StressIntensities, UnevenFrontEdgesDoNotMisplaceTheSamples) {
  TriMesh mesh = rectangle(6, 16, 6, 16);
  std::vector<double> y{0};
  for (int j = 0; j < 16; ++j)
    y.push_back(y.back() + (j == 7 || j == 8 ? 1.0 : 0.4));
  IdVector<NodeId, Vec3> opening;
  for (std::size_t i = 0; i < mesh.node_count(); ++i) {
    Vec3& x = mesh.positions[NodeId(i)];
    x.y() = y[i / 7];
    opening.push_back(opening_from_intensity({1, 0, 0}, 6 - x.x(), kGlass)[0] * Vec3::UnitZ());
  }
  std::vector<Edge> mouth;
  for (int i = 0; i < 6; ++i)
    mouth.insert(mouth.end(), {Edge(NodeId(i), NodeId(i + 1)), Edge(NodeId(112 + i), NodeId(112 + i + 1))});
  for (int j = 0; j < 16; ++j)
    mouth.emplace_back(NodeId(7 * j), NodeId(7 * j + 7));
  std::sort(mouth.begin(), mouth.end());
  for (const Vec3& k : stress_intensities(mesh, find_fronts(mesh, mouth)[0], opening, kGlass, exact()))
    EXPECT_NEAR(k[0], 1, 1e-3);
}

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "conchoid/mesh/models.hpp"
#include "conchoid/sim/reports.hpp"
#include "scenes.hpp"

// Bodies under their weight, and turning.
namespace conchoid {
namespace {

constexpr double kDensity = 2500, kGravity = 9.81;

std::string material(double nu) {
  return test::material_text({.nu = nu}) + fmt::format("density = {}\n", kDensity);
}

StressReport stress(const std::string& text) {
  return compute_stress(test::scene_from_text(text));
}

// A column of height 4 that hangs from `region`: σ1 = ρ g (height below the point) on its sides.
double column_error(double nu, const std::string& support, double from, double to) {
  const test::TemporaryFolder folder;
  const auto report =
      stress(test::mesh_body_text(test::write_mesh_in(folder, "column.obj", box_mesh({1, 1, 4}, 4, 4, 16))) +
             material(nu) + test::region_text("top", "[0, 0, 1, 1.99]") +
             test::region_text("foot", "[0, 0, -1, 1.99]") + support +
             fmt::format("[body_force]\ngravity = [0, 0, {}]\n", -kGravity));
  double error = 0;
  for (const auto& t : report.triangles)
    if (const double z = t.centroid.z(); z > from && z < to && std::abs(z) < 1.99) {
      const bool hangs = support.find("top") != std::string::npos;
      const double exact = kDensity * kGravity * (hangs ? z + 2 : z - 2);
      error = std::max(error, std::abs(t.principal[hangs ? 0 : 2] - exact) / (4 * kDensity * kGravity));
    }
  return error;
}

// A disc of the given radius and thickness: `rings` × `sectors` on each face.
TriMesh disc_mesh(double radius, double thickness, int rings, int sectors) {
  TriMesh mesh;
  const auto ring_node = [&](int side, int ring, int k) {
    return NodeId(static_cast<std::size_t>(side * (1 + rings * sectors) +
                                           (ring == 0 ? 0 : 1 + (ring - 1) * sectors + k % sectors)));
  };
  for (const double z : {-0.5 * thickness, 0.5 * thickness}) {
    mesh.positions.push_back({0, 0, z});
    for (int ring = 1; ring <= rings; ++ring)
      for (int k = 0; k < sectors; ++k) {
        const double angle = 2 * std::numbers::pi * (k + 0.5 * (ring % 2)) / sectors,
                     r = radius * ring / rings;
        mesh.positions.push_back({r * std::cos(angle), r * std::sin(angle), z});
      }
  }
  const auto add = [&](bool turn, NodeId a, NodeId b, NodeId c) {
    if (turn)
      mesh.corners.push_back({a, c, b});
    else
      mesh.corners.push_back({a, b, c});
  };
  for (int side = 0; side < 2; ++side)
    for (int ring = 0; ring < rings; ++ring)
      for (int k = 0; k < sectors; ++k) {
        const int ahead = ring % 2;  // the outer ring lags half a sector behind where this one is ahead
        if (ring == 0) {
          add(side == 0, ring_node(side, 0, 0), ring_node(side, 1, k), ring_node(side, 1, k + 1));
          continue;
        }
        add(side == 0, ring_node(side, ring, k), ring_node(side, ring + 1, k + ahead),
            ring_node(side, ring, k + 1));
        add(side == 0, ring_node(side, ring, k + 1 - ahead), ring_node(side, ring + 1, k),
            ring_node(side, ring + 1, k + 1));
      }
  for (int k = 0; k < sectors; ++k) {
    add(false, ring_node(0, rings, k), ring_node(0, rings, k + 1), ring_node(1, rings, k));
    add(false, ring_node(1, rings, k), ring_node(0, rings, k + 1), ring_node(1, rings, k + 1));
  }
  return mesh;
}

}  // namespace

TEST(Gravity, AColumnHangsOrStandsUnderItsWeight) {
  const std::string hung = "[[boundary]]\nregion = 'top'\n", stood = "[[boundary]]\nregion = 'foot'\n";
  const std::string roller = "displacement = ['free', 'free', 0.0]\n", fixed = "fixed = true\n";
  EXPECT_LT(column_error(0, hung + roller, -2, 2), 1e-4);
  EXPECT_LT(column_error(0, stood + roller, -2, 2), 1e-4);
  EXPECT_LT(column_error(0, hung + fixed, -2, 2), 1e-4);
  // A support that keeps its plane is felt nearby where the column contracts.
  EXPECT_LT(column_error(0.3, stood + roller, -0.5, 2), 0.01);
  const double hangs = column_error(0.3, hung + fixed, -2, 0.5),
               stands = column_error(0.3, stood + fixed, -0.5, 2);
  EXPECT_LT(hangs, 0.01);
  EXPECT_LT(stands, 0.01);
  RecordProperty("error", test::text(std::max(hangs, stands)));
}

// A small crack across a column feels the weight below it as it feels a pull of that size.
TEST(Gravity, ACrackOpensUnderTheWeightBelowIt) {
  const test::TemporaryFolder folder;
  const std::string body =
      test::mesh_body_text(test::write_mesh_in(folder, "column.obj", box_mesh({1, 1, 4}, 4, 4, 16))) +
      material(0.3) + test::region_text("top", "[0, 0, 1, 1.99]") +
      test::region_text("foot", "[0, 0, -1, 1.99]") +
      "[[boundary]]\nregion = 'top'\nfixed = true\n[[crack]]\nkind = 'disc'\ncenter = [0, 0, 0]\nnormal = "
      "[0, 0, "
      "1]\nradius = 0.15\ntriangles = 200\n";
  const auto mean = [](const SifReport& report) {
    double sum = 0, count = 0;
    for (const auto& node : report.fronts.at(0).nodes) {
      sum += node.intensity[0];
      count += 1;
    }
    return sum / count;
  };
  const double weight = mean(compute_sifs(
      test::scene_from_text(body + fmt::format("[body_force]\ngravity = [0, 0, {}]\n", -kGravity))));
  const double pull = mean(compute_sifs(test::scene_from_text(
      body + test::boundary_text("foot", "traction", {0, 0, -2 * kDensity * kGravity}))));
  EXPECT_GT(pull, 0);
  EXPECT_NEAR(weight / pull, 1, 0.01);
  RecordProperty("ratio", test::text(weight / pull));
}

// σ_r and σ_θ on the faces z = ±c of a disc of radius R (Timoshenko & Goodier, art. 134).
TEST(Spin, ATurningDiscIsStressedAsInTheClosedForm) {
  const test::TemporaryFolder folder;
  const double R = 1, c = 0.05, nu = 0.3, omega = 100;
  const auto report = stress(
      test::mesh_body_text(test::write_mesh_in(folder, "disc.obj", disc_mesh(R, 2 * c, 6, 36))) +
      material(nu) + fmt::format("[body_force]\nspin = [0, 0, {}]\naxis_through = [0, 0, 0]\n", omega));
  const double load = kDensity * omega * omega, largest = (3 + nu) / 8 * load * R * R;
  const double thick = nu * (1 + nu) / (6 * (1 - nu)) * (c * c - 3 * c * c);
  double error = 0;
  for (const auto& t : report.triangles) {
    const double r = std::hypot(t.centroid.x(), t.centroid.y());
    if (r > 0.9 * R) continue;
    const double radial = load * ((3 + nu) / 8 * (R * R - r * r) + thick),
                 hoop = load * ((3 + nu) / 8 * R * R - (1 + 3 * nu) / 8 * r * r + thick);
    error = std::max({error, std::abs(t.principal[0] - hoop) / largest,
                      std::abs(t.principal[1] - radial) / largest, std::abs(t.principal[2]) / largest});
  }
  EXPECT_LT(error, 0.01);
  RecordProperty("error", test::text(error));
}

}  // namespace conchoid

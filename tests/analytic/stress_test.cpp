#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "conchoid/mesh/models.hpp"
#include "conchoid/sim/reports.hpp"
#include "scenes.hpp"

namespace conchoid {
namespace {

constexpr double kStress = 1e6;

std::string cube_text(double nu, const std::string& boundary) {
  return "[body]\nmodel = 'cube'\n" + test::material_text({.nu = nu}) + boundary;
}
const std::string kPull = test::boundary_text("z+", "traction", {0, 0, kStress}) +
                          test::boundary_text("z-", "traction", {0, 0, -kStress});

StressReport stress(const std::string& text) {
  return compute_stress(test::scene_from_text(text));
}

TEST(CubeStress, UniaxialTensionIsUniform) {
  const StressReport report = stress(cube_text(0.327, kPull));
  ASSERT_EQ(report.triangles.size(), 120u);
  double error = 0;
  for (const auto& t : report.triangles) {
    EXPECT_NEAR(t.principal[0] / kStress, 1, 0.01) << t.region;
    EXPECT_NEAR(t.principal[1] / kStress, 0, 0.01) << t.region;
    EXPECT_NEAR(t.principal[2] / kStress, 0, 0.01) << t.region;
    error = std::max(error, (t.principal / kStress - Vec3::UnitX()).norm());
  }
  EXPECT_NEAR(report.max_principal / kStress, 1, 0.01);
  RecordProperty("error", test::text(error));
}

// Without lateral contraction a held face takes nothing away from uniaxial tension.
TEST(CubeStress, HeldAndPulledAgreeWithoutContraction) {
  const std::string held = "[[boundary]]\nregion = 'z-'\nfixed = true\n";
  const auto free = stress(cube_text(0, kPull)).triangles;
  const auto mixed =
      stress(cube_text(0, held + test::boundary_text("z+", "traction", {0, 0, kStress}))).triangles;
  const auto moved =
      stress(cube_text(0, held + test::boundary_text("z+", "displacement", {0, 0, kStress / 3.1e9})))
          .triangles;
  double error = 0;
  for (std::size_t t = 0; t < free.size(); ++t) {
    error = std::max(error, (mixed[t].principal - free[t].principal).norm() / kStress);
    error = std::max(error, (moved[t].principal - free[t].principal).norm() / kStress);
  }
  EXPECT_LT(error, 0.01);
  RecordProperty("error", test::text(error));
}

// Far from the held face contraction plays no part either (Saint-Venant).
TEST(BarStress, HeldEndIsForgottenTwoWidthsAway) {
  const test::TemporaryFolder folder;
  const std::string body =
      test::mesh_body_text(test::write_mesh_in(folder, "bar.obj", box_mesh({1, 1, 4}, 4, 4, 16))) +
      test::material_text() + test::region_text("top", "[0, 0, 1, 1.99]") +
      test::region_text("bottom", "[0, 0, -1, 1.99]");
  const std::string top = test::boundary_text("top", "traction", {0, 0, kStress});
  const auto free = stress(body + top + test::boundary_text("bottom", "traction", {0, 0, -kStress}));
  const auto held = stress(body + top + "[[boundary]]\nregion = 'bottom'\nfixed = true\n");
  double error = 0;
  for (std::size_t t = 0; t < free.triangles.size(); ++t)
    if (free.triangles[t].centroid.z() > 0)
      error = std::max(error, (held.triangles[t].principal - free.triangles[t].principal).norm() / kStress);
  EXPECT_LT(error, 0.01);
  RecordProperty("error", test::text(error));
}

// One region per triangle: the triangles whose plane this is, by a half space that holds nothing else of a
// convex body. Pressure p > 0 pulls outward.
std::string pressure_text(const TriMesh& mesh, std::size_t begin, std::size_t end, double sign,
                          double pressure, const std::string& box) {
  std::string text;
  for (std::size_t t = begin; t < end; ++t) {
    const Vec3 outward = sign * unit_normal(mesh, TriId(t));
    const double d = outward.dot(mesh.positions[mesh.corners[TriId(t)][0]]);
    const std::string name = fmt::format("t{}", t);
    text += test::region_text(name, test::half_space_text(outward, d - 1e-9) + box) +
            test::boundary_text(name, "traction", pressure * outward);
  }
  return text;
}

TEST(SphereStress, PulledFromAllSidesIsHydrostatic) {
  const test::TemporaryFolder folder;
  const TriMesh sphere = icosphere(1, 3);
  ASSERT_EQ(sphere.triangle_count(), 1280u);
  const StressReport report =
      stress(test::mesh_body_text(test::write_mesh_in(folder, "sphere.obj", sphere)) + test::material_text() +
             pressure_text(sphere, 0, sphere.triangle_count(), 1, kStress, ""));
  double error = 0;
  for (const auto& t : report.triangles)
    error = std::max(error, (t.principal / kStress - Vec3::Ones()).cwiseAbs().maxCoeff());
  EXPECT_LT(error, 0.01);
  RecordProperty("error", test::text(error));
}

// Lamé: inner radius a, outer radius b, pressure p inside:
// hoop stress p a³/(b³ − a³) (1 + b³/(2r³)).
TEST(SphereStress, HollowSphereUnderInnerPressure) {
  const test::TemporaryFolder folder;
  const double a = 1, b = 2;
  TriMesh body = icosphere(b, 2);
  const TriMesh inner = icosphere(a, 2);
  const std::size_t outer_triangles = body.triangle_count(), nodes = body.node_count();
  for (const Vec3& x : inner.positions)
    body.positions.add(x);
  for (const auto& c : inner.corners)
    body.corners.add(
        {NodeId(c[0].index() + nodes), NodeId(c[2].index() + nodes), NodeId(c[1].index() + nodes)});
  const std::string box =
      ", [1, 0, 0, -1.01], [-1, 0, 0, -1.01], [0, 1, 0, -1.01], [0, -1, 0, -1.01], [0, 0, 1, -1.01], "
      "[0, 0, -1, -1.01]";
  const StressReport report =
      stress(test::mesh_body_text(test::write_mesh_in(folder, "hollow.obj", body)) + test::material_text() +
             pressure_text(body, outer_triangles, body.triangle_count(), -1, kStress, box));
  const auto hoop = [&](double r) {
    return kStress * a * a * a / (b * b * b - a * a * a) * (1 + b * b * b / (2 * r * r * r));
  };
  double inside = 0, outside = 0;
  for (std::size_t t = 0; t < report.triangles.size(); ++t) {
    double& sum = t < outer_triangles ? outside : inside;
    sum += report.triangles[t].principal[0] / hoop(t < outer_triangles ? b : a) /
           static_cast<double>(outer_triangles);
    if (t >= outer_triangles) {
      EXPECT_NEAR(report.triangles[t].principal[2] / kStress, -1, 1e-6);
    }
  }
  EXPECT_NEAR(inside, 1, 0.05);
  EXPECT_NEAR(outside, 1, 0.05);
  RecordProperty("inside", test::text(inside));
  RecordProperty("outside", test::text(outside));
}

}  // namespace
}  // namespace conchoid

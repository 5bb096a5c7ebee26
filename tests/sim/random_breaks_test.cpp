#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "conchoid/core/random.hpp"
#include "conchoid/intersect/self_intersection.hpp"
#include "conchoid/mesh/surface_parts.hpp"
#include "conchoid/sim/opening_source.hpp"
#include "conchoid/sim/prepared_body.hpp"
#include "conchoid/sim/run.hpp"
#include "hollow_bodies.hpp"
#include "scans.hpp"
#include "scenes.hpp"

// Whatever is pulled, bent, twisted or pressed beyond its strength comes apart, or its cracks stop where nothing drives
// them. All 300 scenes run where CONCHOID_ALL_SCENES is set: in the ordinary run of the tests some of each kind.
namespace conchoid {
namespace {

struct Body {
  TriMesh mesh;
  double crack_edge;
  double end = 0;      ///< share of the height that is held and loaded; 0: the plane ends alone
  double section = 0;  ///< across a convex body [m²]
  int elements = 0;    ///< it is remeshed to; 0: it is not
};

TriMesh centred(TriMesh mesh) {
  const Vec3 middle = bounding_box(mesh).center();
  for (Vec3& x : mesh.positions)
    x -= middle;
  return mesh;
}

Body draw_body(std::size_t kind) {
  switch (kind) {
    case 0:
      return {centred(box_mesh(Vec3::Constant(2), 8, 8, 8)), 0.2, 0, 4};
    case 1:
      return {
          shapes::turned(shapes::divided({{0, -2}, {1, -2}, {1, 2}, {0, 2}}, {4, 8, 4}, false), 20, false),
          0.25, 0, std::numbers::pi};
    case 2:
      return {centred(box_mesh({1, 1, 5}, 4, 4, 18)), 0.18, 0, 1};
    case 3:
      return {shapes::torus(2, 0.7, 24, 10), 0.25, 0.12};
    case 4:
      return {shapes::tube(1, 0.6, 4, 9), 0.2};
    case 5:
      return {centred(shapes::block_with_cavity(4, 0.9, 6)), 0.35};
    case 6:
      return {shapes::cup(), 0.2};
    default:
      return {centred(read_mesh(test::scans()[0].file)), 5, 0.2, 0, 1200};
  }
}

std::string conditions(std::size_t kind, double angle, const Body& body) {
  const Box box = bounding_box(body.mesh);
  const double low = box.low.z(), high = box.high.z();
  const double e = body.end * (high - low) + 1e-6 * (high - low);
  const std::string up = test::half_space_text(Vec3::UnitZ(), high - e);
  const std::string held = test::region_text("low", test::half_space_text(-Vec3::UnitZ(), -low - e)) +
                           "[[boundary]]\nregion = 'low'\nfixed = true\n";
  const auto loaded = [&](const Vec3& t) {
    return test::region_text("high", up) + held + test::boundary_text("high", "traction", t);
  };
  double left = box.high.x(), right = box.low.x();
  for (const Vec3& x : body.mesh.positions)
    if (x.z() >= high - e) left = std::min(left, x.x()), right = std::max(right, x.x());
  const double middle = 0.5 * (left + right) + 1e-3;
  switch (kind) {
    case 0:
      return loaded({0, 0, 1e6});
    case 1:
      return loaded({1e6 * std::cos(angle), 1e6 * std::sin(angle), 0});
    case 2:  // two halves of the upper end against each other
      return test::region_text("right", up + ", " + test::half_space_text(Vec3::UnitX(), middle)) +
             test::region_text("left", up) + held + test::boundary_text("right", "traction", {0, 1e6, 0}) +
             test::boundary_text("left", "traction", {0, -1e6, 0});
    default:
      return loaded({3e5 * std::cos(angle), 3e5 * std::sin(angle), -1e6});
  }
}

/// Largest tension on the surface of the scene's body [Pa].
double largest_tension(const Scene& scene) {
  const auto body = std::make_shared<const PreparedBody>(prepare(scene));
  BemOpening bem(body->elastic, load_of(scene, *body), sif_settings(scene.run));
  bem.solve(whole_surface(body->surface));
  const auto kinds = kinds_of(scene, *body);
  double largest = 0;
  const auto stress = bem.body().surface_stress();
  for (std::size_t t = 0; t < stress.size(); ++t) {
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(stress[t]);
    const Vec3 across = eigen.eigenvectors().col(2);
    const bool along_normal = std::abs(across.dot(unit_normal(body->surface, TriId(t)))) > 0.9;
    if (kinds[t] != BoundaryKind::displacement && !along_normal)
      largest = std::max(largest, eigen.eigenvalues()[2]);
  }
  return largest;
}

// Pieces break one after the other: those of a block with a cavity, twisted apart into seventeen, take 69 frames together.
constexpr int kFrames = 120;

struct DrawnScene {
  std::string text;
  int cracks = 0;
  double section = 0;  ///< Body::section
};

DrawnScene draw_scene(int seed, const std::filesystem::path& folder) {
  Random random(static_cast<std::uint64_t>(seed));
  const Body body = draw_body(static_cast<std::size_t>(seed) % 8);
  const int cracks = 1 + static_cast<int>(random.index(6));
  const double factor = random.uniform(1.1, 4);
  const std::string file = (folder / fmt::format("body-{}.ply", seed)).string();
  write_mesh(file, body.mesh);
  const std::string rest = test::mesh_body_text(file) +
                           (body.elements > 0 ? fmt::format("remesh = {}\n", body.elements) : "") +
                           test::resolution_text(body.crack_edge, body.crack_edge / 8) +
                           conditions(static_cast<std::size_t>(seed) / 8 % 4, random.uniform(0, 6.28), body);
  const auto text = [&](double strength, int most) {
    return rest +
           test::material_text({.E = 7e10,
                                .nu = 0.22,
                                .strength = strength,
                                .toughness = 0.5 * strength * std::sqrt(body.crack_edge)}) +
           fmt::format("[run]\nframes = {}\nmax_cracks = {}\n", kFrames, most);
  };
  return {text(largest_tension(test::scene_from_text(text(1e6, 0))) / factor, cracks), cracks, body.section};
}

/// Largest K_I of a point that could move, over K_c, in the last frame.
double largest_drive(const RunResult& result, double toughness) {
  double largest = 0;
  for (const FrontRow& row : result.front)
    if (row.frame == result.document.frames) largest = std::max(largest, row.intensity[0] / toughness);
  return largest;
}

/// Time of the slowest frame over that of a usual one.
double slowest_frame(const std::vector<FrameRecord>& frames) {
  std::vector<double> seconds;
  for (const FrameRecord& f : frames)
    seconds.push_back(f.opening_seconds + f.fracture_seconds + f.other_seconds);
  if (seconds.empty()) return 1;
  std::sort(seconds.begin(), seconds.end());
  return seconds.back() / seconds[seconds.size() / 2];
}

/// Scenes stay in the folder that CONCHOID_KEEP_SCENES names, to be run by hand.
class RandomBreaks : public testing::TestWithParam<int> {
 protected:
  DrawnScene draw() const {
    const char* kept = std::getenv("CONCHOID_KEEP_SCENES");
    const std::filesystem::path folder = kept != nullptr ? std::filesystem::path(kept) : temporary_.path();
    DrawnScene drawn = draw_scene(GetParam(), folder);
    std::ofstream(folder / fmt::format("scene-{}.toml", GetParam())) << drawn.text;
    return drawn;
  }

 private:
  test::TemporaryFolder temporary_;
};

TEST_P(RandomBreaks, EndInPiecesOrAtRest) {
  RunOptions options;
  options.progress = false;
  const auto [text, cracks, section] = draw();
  const Scene scene = test::scene_from_text(text);
  const RunResult result = run_scene(scene, options);
  const StopReason stop = result.document.stop;
  ASSERT_TRUE(stop == StopReason::separated || stop == StopReason::arrested) << name(stop) << "\n" << text;
  EXPECT_EQ(stop == StopReason::separated, result.fragments.size() > 1) << text;
  if (stop == StopReason::arrested) {
    EXPECT_LE(largest_drive(result, scene.material.toughness), 1) << text;
  }
  for (std::size_t i = 0; i < result.document.timings.size(); ++i)
    ASSERT_EQ(result.document.timings[i].frame, static_cast<int>(i) + 1) << text;
  double volume = 0;
  for (const Fragment& f : result.fragments) {
    EXPECT_TRUE(f.watertight) << text;
    EXPECT_TRUE(self_intersections(f.mesh, 1).empty()) << text;
    volume += f.volume;
  }
  EXPECT_NEAR(volume, result.document.body_volume, 1e-9 * result.document.body_volume) << text;
  if (section > 0) {
    const double sections = surface_area(result.crack) / section;
    RecordProperty("sections", test::text(sections));
    EXPECT_LE(sections, cracks + 1) << text;
  }
  RecordProperty("K over K_c", test::text(result.document.largest_K_over_Kc.value_or(0)));
  RecordProperty("slowest frame over median", test::text(slowest_frame(result.document.timings)));
  RecordProperty("stop", std::string(name(stop)));
  RecordProperty("pieces", static_cast<int>(result.fragments.size()));
}

int scenes() {
  return std::getenv("CONCHOID_ALL_SCENES") != nullptr ? 300 : 16;
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomBreaks, testing::Range(0, scenes()));

}  // namespace
}  // namespace conchoid

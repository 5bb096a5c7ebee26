#include "conchoid/sim/breakup.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <set>

#include "conchoid/core/error.hpp"
#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/sim/piece_scene.hpp"
#include "conchoid/sim/recorders.hpp"
#include "conchoid/sim/run.hpp"
#include "run_text.hpp"
#include "scenes.hpp"

// What happens after a body has come apart.
namespace conchoid {
namespace {

constexpr double kCut = -0.231;  // z of the plane that cuts the cube from the start

std::string through(double z) {
  return "[[crack]]\nkind = 'rectangle'\ncenter = [0.0, 0.0, " + test::text(z) +
         "]\nedges = [[1.4, 0.0, 0.0], [0.0, 1.4, 0.0]]\n";
}

/// Held below, pulled above, and cut from the start: the upper part is accelerated by what pulls it.
std::string cut_cube(double stress, const std::string& run = {}) {
  return "[body]\nmodel = 'cube'\n" + test::material_text() + test::resolution_text(0.1, 0.02) +
         through(kCut) + "[[boundary]]\nregion = 'z-'\nfixed = true\n" +
         test::boundary_text("z+", "traction", {0, 0, stress}) + "[run]\n" + run;
}

double total_volume(const std::vector<Fragment>& fragments) {
  double sum = 0;
  for (const Fragment& f : fragments)
    sum += f.volume;
  return sum;
}

}  // namespace

TEST(Breakup, ThePartThatIsPulledBreaksAgain) {
  const RunResult result = test::run_text(cut_cube(1.5e8));
  EXPECT_EQ(result.document.stop, StopReason::separated);
  ASSERT_GE(result.fragments.size(), 3u);
  EXPECT_NEAR(total_volume(result.fragments), 1, 1e-9);
  double largest = 1;
  for (const Fragment& f : result.fragments) {
    EXPECT_TRUE(f.watertight);
    EXPECT_LE(f.volume, largest) << "largest first";
    largest = f.volume;
  }
  EXPECT_GE(result.cracks, 2)
      << "the one that was there, and one that started in the piece; chips do not count";
  std::set<int> frames;
  for (const FrontRow& row : result.front) {
    frames.insert(row.frame);
    EXPECT_GT(row.position.z(), kCut) << "nothing strains the part that is held";
  }
  ASSERT_EQ(frames.size(), static_cast<std::size_t>(result.document.frames));
  EXPECT_EQ(*frames.begin(), 1);
  EXPECT_EQ(*frames.rbegin(), result.document.frames);
}

TEST(Breakup, AFullDiskIsNoFaultOfAPiece) {
  struct FullDisk : FractureObserver {
    const PreparedBody* whole = nullptr;
    void on_opening(const Fracture& fracture) override {
      if (&fracture.body() != whole) throw WriteError("the disk is full");
    }
  } disk;
  const Scene scene = test::scene_from_text(cut_cube(1.5e8));
  const auto body = std::make_shared<const PreparedBody>(prepare(scene));
  disk.whole = body.get();
  Breakup breakup(scene, body);
  breakup.add_observer(disk);
  EXPECT_THROW(breakup.run(40), WriteError);
}

TEST(Breakup, FacesOfAllPiecesLeadBackToTheBody) {
  const RunResult result = test::run_text(cut_cube(1.5e8));
  const TriMesh cube = built_in_model("cube").mesh;
  double fracture = 0, shared = 0;
  for (const Fragment& f : result.fragments) {
    for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t) {
      const Vec3 x = centroid(f.mesh, TriId(t));
      const double area = area_vector(f.mesh, TriId(t)).norm();
      const bool on_cube = std::abs(x.cwiseAbs().maxCoeff() - 0.5) < 1e-6;  // slits are open by 4e-6
      if (area > 1e-6) {  // slivers at a mouth lie within the slit's width of the surface
        EXPECT_EQ(f.face_kind[t] == FaceKind::original, on_cube);
      }
      if (f.face_kind[t] == FaceKind::fracture) {
        fracture += area;
        continue;
      }
      ASSERT_LT(f.source[t].index(), cube.triangle_count());
      EXPECT_LT((closest_point_on_triangle(cube.triangle(f.source[t]), x) - x).norm(), 1e-6);
    }
    ASSERT_EQ(f.attributes.materials.size(), 2u) << "original and fracture, however often it broke";
    EXPECT_EQ(f.attributes.material.size(), f.mesh.triangle_count());
  }
  for (const FragmentContact& c : result.document.contacts)
    shared += c.area;
  EXPECT_LT(2 * shared, 1.001 * fracture) << "what is broken lies on what it broke from";
  EXPECT_GT(shared, 1.02) << "at least the crack that was there and a little; the rest are slits";
  EXPECT_NEAR(result.document.crack_area, 0.5 * fracture, 0.01 * fracture) << "no part of it counts twice";
}

TEST(Breakup, StopsAtTheFirstSeparationWhenTold) {
  const std::string pulled = test::pulled_cube_text();
  const Scene scene = test::scene_from_text(pulled + "max_cracks = 3\nafter_separation = 'stop'\n");
  RunOptions options;
  options.progress = false;
  const RunResult stopped = run_scene(scene, options);
  const auto body = std::make_shared<const PreparedBody>(prepare(scene));
  Fracture fracture(body, load_of(scene, *body), scene.run);
  FrontRecorder front;
  fracture.add_observer(front);
  EXPECT_EQ(run_frames(fracture, 30), stopped.document.stop);
  EXPECT_EQ(fracture.frame(), stopped.document.frames);
  const Pieces pieces = cut_into_pieces(fracture);
  EXPECT_EQ(pieces.crack.positions, stopped.crack.positions);
  ASSERT_EQ(pieces.fragments.size(), stopped.fragments.size());
  for (std::size_t i = 0; i < pieces.fragments.size(); ++i)
    EXPECT_EQ(pieces.fragments[i].mesh.positions, stopped.fragments[i].mesh.positions);
  ASSERT_EQ(front.rows().size(), stopped.front.size());
}

TEST(Breakup, WithoutCracksLeftNothingIsAdded) {
  const std::string once =
      "[body]\nmodel = 'cube'\n" + test::material_text() + test::resolution_text(0.1, 0.02) +
      test::boundary_text("z+", "traction", {0, 0, 9e7}) +
      test::boundary_text("z-", "traction", {0, 0, -9e7}) + "[run]\ninertia_relief = true\n";
  const RunResult on = test::run_text(once), stopped = test::run_text(once + "after_separation = 'stop'\n");
  ASSERT_EQ(on.document.stop, StopReason::separated);
  EXPECT_EQ(on.document.hash, stopped.document.hash);
  EXPECT_EQ(test::run_text(cut_cube(5e7)).document.frames, 0) << "the pull is below the strength";
  EXPECT_EQ(test::run_text(cut_cube(1.5e8, "max_cracks = 0\n")).document.frames, 0);
}

TEST(Breakup, EndsAtTheNumberAndTheSizeOfPiecesAsked) {
  EXPECT_EQ(test::run_text(cut_cube(1.5e8, "max_fragments = 2\n")).document.frames, 0);
  EXPECT_EQ(test::run_text(cut_cube(1.5e8, "smallest_body = 0.8\n")).document.frames, 0);
  EXPECT_GT(test::run_text(cut_cube(1.5e8, "smallest_body = 0.7\n")).document.frames, 0);
}

TEST(Breakup, GoesOnInAPieceFromItsFrameLimit) {
  const test::TemporaryFolder folder;
  RunOptions options;
  options.folder = folder / "run";
  options.frames = 1;
  const RunResult limited = test::run_text(cut_cube(1.5e8), options);
  EXPECT_EQ(limited.document.stop, StopReason::frame_limit);
  EXPECT_NEAR(total_volume(limited.fragments), 1, 1e-9);
  options.frames.reset();
  options.resume = true;
  const RunResult resumed = test::run_text(cut_cube(1.5e8), options);
  EXPECT_EQ(resumed.document.resumed_after, 1);
  EXPECT_EQ(resumed.document.hash, test::run_text(cut_cube(1.5e8)).document.hash);
}

// The upper part's new face lies in the half space of the region that is held, and is free all the same.
TEST(PieceScene, LoadsGoOverByTheFacesTheyActOn) {
  const Scene scene = test::scene_from_text(
      "[body]\nmodel = 'cube'\n" + test::material_text() + test::resolution_text(0.1, 0.02) + through(kCut) +
      test::region_text("low", "[0, 0, -1, 0.2]") + "[[boundary]]\nregion = 'low'\nfixed = true\n" +
      test::boundary_text("z+", "force", {0, 0, 3e6}));
  const auto body = std::make_shared<const PreparedBody>(prepare(scene));
  Fracture fracture(body, load_of(scene, *body), scene.run);
  ASSERT_EQ(fracture.step().stop, StopReason::separated);
  const Pieces pieces = cut_into_pieces(fracture);
  ASSERT_EQ(pieces.fragments.size(), 2u);
  const PieceScene upper = scene_of_piece(scene, *body, pieces.fragments[0]);
  const PieceScene lower = scene_of_piece(scene, *body, pieces.fragments[1]);
  ASSERT_EQ(upper.scene.boundary.size(), 1u);
  EXPECT_EQ(upper.scene.boundary[0].kind, ConditionKind::traction);
  EXPECT_NEAR((upper.scene.boundary[0].value - Vec3(0, 0, 3e6)).norm(), 0, 1e-6) << "N over 1 m²";
  EXPECT_TRUE(is_loaded(upper.scene));
  for (const TriId t : find_region(upper.body.regions, "z+")->triangles)
    EXPECT_NEAR(centroid(upper.body.surface, t).z(), 0.5, 1e-6);
  EXPECT_EQ(find_region(upper.body.regions, "low"), nullptr);
  ASSERT_EQ(lower.scene.boundary.size(), 1u);
  EXPECT_FALSE(is_loaded(lower.scene));
  double held = 0, before = 0;
  for (const TriId t : find_region(body->regions, "low")->triangles)
    before += area_vector(body->surface, t).norm();
  for (const TriId t : find_region(lower.body.regions, "low")->triangles) {
    held += area_vector(lower.body.surface, t).norm();
    EXPECT_LT(centroid(lower.body.surface, t).z(), kCut - 0.01) << "the new face is free";
  }
  EXPECT_NEAR(held, before, 0.1 * before);
  const PreparedBody prepared = prepare(upper.scene, upper.body);
  EXPECT_GT(load_of(upper.scene, prepared).ambient.stress(Vec3::Zero()).norm(), 0) << "it is accelerated";
}

// A corner of 0.5 % is cut off from the start; what matters is the crack in the middle.
TEST(Breakup, AChipIsNoSeparation) {
  const std::string text =
      "[body]\nmodel = 'cube'\n" + test::material_text() + test::resolution_text(0.1, 0.02) +
      "[[crack]]\nkind = 'disc'\ncenter = [0.405, 0.403, 0.392]\nnormal = [1, 1, 1]\n"
      "radius = 0.45\n[[crack]]\nkind = 'disc'\ncenter = [0.0, 0.0, -0.1]\n"
      "normal = [0, 0, 1]\nradius = 0.2\n" +
      test::boundary_text("z+", "traction", {0, 0, 1e7}) +
      test::boundary_text("z-", "traction", {0, 0, -1e7}) + "[run]\nmax_cracks = 0\ninertia_relief = true\n";
  const Scene scene = test::scene_from_text(text);
  const auto body = std::make_shared<const PreparedBody>(prepare(scene));
  Fracture alone(body, load_of(scene, *body), scene.run);
  ASSERT_EQ(alone.step().stop, StopReason::separated) << "the chip is off";
  Breakup database(scene, body, {BreakupSettings::After::chips});
  EXPECT_EQ(database.run(30), StopReason::separated);
  EXPECT_GT(database.frame(), 3) << "not before the body itself has come apart";
  const RunResult run = test::run_text(text);
  EXPECT_EQ(run.document.frames, database.frame());
  ASSERT_GE(run.fragments.size(), 3u);
  EXPECT_GT(run.fragments[1].volume, 0.1);
  EXPECT_NEAR(total_volume(run.fragments), 1, 1e-9);
}

TEST(Breakup, SeveralCracksStartInOneFrameAndFeelEachOther) {
  const Scene scene =
      test::scene_from_text(test::pulled_cube_text() + "max_cracks = 4\nmax_cracks_per_frame = 2\n");
  const auto body = std::make_shared<const PreparedBody>(prepare(scene));
  Fracture fracture(body, load_of(scene, *body), scene.run);
  const StepReport first = fracture.step();
  EXPECT_EQ(first.new_cracks, 4u) << "two to start with, two after the frame";
  EXPECT_GT(first.start.ratio, 1);
}

TEST(LoadReport, AnIntactBodyNamesItsLargestStress) {
  const std::string text = "[body]\nmodel = 'cube'\n" + test::material_text() +
                           test::resolution_text(0.1, 0.02) +
                           test::boundary_text("z+", "traction", {0, 0, 3.8e7}) +
                           test::boundary_text("z-", "traction", {0, 0, -3.8e7});
  const RunDocument doc = test::run_text(text).document;
  EXPECT_EQ(doc.stop, StopReason::intact);
  ASSERT_TRUE(doc.stress_over_strength);
  EXPECT_NEAR(*doc.stress_over_strength, 0.5, 0.02);
  EXPECT_NE(doc.stop_details.find("times the strength, at ("), std::string::npos) << doc.stop_details;
  EXPECT_FALSE(doc.largest_K_over_Kc);
  EXPECT_TRUE(doc.warnings.empty());
}

TEST(LoadReport, AnArrestedFrontNamesItsK) {
  const RunDocument doc =
      test::run_text("[body]\nmodel = 'edge-crack-cube'\n" + test::material_text() +
                     test::resolution_text(0.1, 0.02) + test::boundary_text("z+", "traction", {0, 0, 1e5}) +
                     test::boundary_text("z-", "traction", {0, 0, -1e5}))
          .document;
  EXPECT_EQ(doc.stop, StopReason::arrested);
  ASSERT_TRUE(doc.largest_K_over_Kc);
  EXPECT_GT(*doc.largest_K_over_Kc, 0.05);
  EXPECT_LT(*doc.largest_K_over_Kc, 1);
  EXPECT_NE(doc.stop_details.find("times K_c"), std::string::npos) << doc.stop_details;
}

TEST(LoadReport, AnOverloadIsSaid) {
  const RunDocument doc = test::run_text(cut_cube(25 * 7.6e7, "frames = 1\n")).document;
  ASSERT_TRUE(doc.stress_over_strength);
  ASSERT_FALSE(doc.warnings.empty());
  EXPECT_NE(doc.warnings.back().find("overload"), std::string::npos);
}

}  // namespace conchoid

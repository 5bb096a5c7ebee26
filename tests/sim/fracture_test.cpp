#include "conchoid/sim/fracture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "conchoid/core/error.hpp"
#include "conchoid/sim/recorders.hpp"
#include "conchoid/sim/run.hpp"
#include "scenes.hpp"

// A program steps through a fracture itself.
namespace conchoid {
namespace {

Scene cube(double stress = 9e7, const std::string& more = {}) {
  return test::scene_from_text("[body]\nmodel = 'cube'\n" + test::material_text() +
                               test::resolution_text(0.1, 0.02) +
                               test::boundary_text("z+", "traction", {0.3 * stress, 0, stress}) +
                               test::boundary_text("z-", "traction", {-0.3 * stress, 0, -stress}) +
                               "[run]\ninertia_relief = true\n" + more);
}

Fracture fracture_of(const Scene& scene) {
  const auto body = std::make_shared<const PreparedBody>(prepare(scene));
  return {body, load_of(scene, *body), scene.run};
}

double crack_area(const Fracture& fracture) {
  return surface_area(fracture.crack().trimmed);
}

class Calls : public FractureObserver {
 public:
  void on_frame(const Fracture&, int frame) override { log += "f" + std::to_string(frame); }
  void on_opening(const Fracture& fracture) override { log += "o" + std::to_string(fracture.frame()); }
  void on_step(const Fracture&, const StepReport& step) override { log += "s" + std::to_string(step.frame); }
  std::string log;
};

/// Nothing drives a front.
class Unbreakable : public GrowthLaw {
 public:
  double drive(const Vec3&) const override { return 0; }
  double direction(const Vec3&) const override { return 0; }
  double length(double, double, double) const override { return 0; }
  double deflection(double, double, double) const override { return 0; }
};

/// Solves, but for one frame, of which it says what is wrong.
class FailsInFrame : public OpeningSource {
 public:
  FailsInFrame(BemOpening& bem, int frame) : bem_(bem), frame_(frame) {}
  std::string name() const override { return "fails"; }
  std::vector<FrontOpening> open(const CrackState& crack) override {
    if (--frame_ == 0) throw ComputationError("edges have lost their way");
    return bem_.open(crack);
  }
  bool solved() const override { return true; }
  bool solves(int) const override { return true; }

 private:
  BemOpening& bem_;
  int frame_;
};

Fracture failing_in(int frame) {
  const Scene scene = cube();
  const auto body = std::make_shared<const PreparedBody>(prepare(scene));
  return {body, load_of(scene, *body), scene.run,
          [frame](BemOpening& bem) { return std::make_unique<FailsInFrame>(bem, frame); }};
}

class FullDisk : public FractureObserver {
 public:
  void on_opening(const Fracture& fracture) override {
    if (fracture.frame() == 2) throw ComputationError("the disk is full");
  }
};

}  // namespace

TEST(Fracture, StepsAreTheFramesOfARun) {
  Scene scene = cube();
  scene.run.after_separation = AfterSeparation::stop;
  RunOptions options;
  options.progress = false;
  const RunResult run = run_scene(scene, options);
  Fracture fracture = fracture_of(scene);
  FrontRecorder front;
  fracture.add_observer(front);
  int frames = 0;
  double area = 0;
  for (StepReport step; (step = fracture.step()).moving;) {
    EXPECT_EQ(step.frame, ++frames);
    EXPECT_FALSE(step.stop);
    EXPECT_GT(crack_area(fracture), area);
    area = crack_area(fracture);
    EXPECT_EQ(step.source, "bem");
    EXPECT_GT(step.largest_intensity, scene.material.toughness);
    ASSERT_EQ(fracture.openings().size(), fracture.decisions().size());
  }
  EXPECT_EQ(fracture.stop(), run.document.stop);
  EXPECT_EQ(fracture.frame(), run.document.frames);
  ASSERT_EQ(front.rows().size(), run.front.size());
  for (std::size_t i = 0; i < run.front.size(); ++i) {
    EXPECT_EQ(front.rows()[i].intensity, run.front[i].intensity);
    EXPECT_EQ(front.rows()[i].position, run.front[i].position);
  }
}

TEST(Fracture, MovingTheObjectChangesNothing) {
  const Scene scene = cube();
  Fracture whole = fracture_of(scene);
  run_frames(whole, 4);
  std::vector<Fracture> parts;
  parts.push_back(fracture_of(scene));
  for (int i = 0; i < 4; ++i) {
    parts.back().step();
    Fracture moved = std::move(parts.back());
    parts.clear();
    parts.push_back(std::move(moved));
  }
  EXPECT_EQ(parts.back().crack().sheet.mesh.positions, whole.crack().sheet.mesh.positions);
}

TEST(Fracture, OneBodyServesManyRuns) {
  const Scene scene = cube(), other = cube(1.2e8);
  const auto body = std::make_shared<const PreparedBody>(prepare(scene));
  Fracture first(body, load_of(scene, *body), scene.run);
  Fracture second(body, load_of(other, *body), other.run);
  run_frames(first, 3);
  run_frames(second, 3);
  Fracture alone = fracture_of(other);
  run_frames(alone, 3);
  EXPECT_EQ(second.crack().sheet.mesh.positions, alone.crack().sheet.mesh.positions);
  EXPECT_NE(first.crack().sheet.mesh.positions, alone.crack().sheet.mesh.positions);
}

TEST(Fracture, ObserversSeeEveryFrameInOrder) {
  Fracture fracture = fracture_of(cube());
  Calls calls;
  fracture.add_observer(calls);
  run_frames(fracture, 2);
  EXPECT_EQ(calls.log, "f1o1s1f2o2s2");
}

TEST(Fracture, AFullDiskIsNoPhysicalOutcome) {
  Fracture fracture = fracture_of(cube());
  FullDisk disk;
  fracture.add_observer(disk);
  fracture.step();
  EXPECT_THROW(fracture.step(), ComputationError);
  EXPECT_FALSE(fracture.stop());
}

TEST(Fracture, ALaterFrameThatCannotBeComputedEndsTheRunAndKeepsTheOnesBefore) {
  EXPECT_THROW(failing_in(1).step(), ComputationError);
  Fracture fracture = failing_in(3), good = fracture_of(cube());
  run_frames(good, 2);
  fracture.step();
  fracture.step();
  const StepReport third = fracture.step();
  EXPECT_EQ(third.stop, StopReason::singular);
  ASSERT_EQ(third.warnings.size(), 1u);
  EXPECT_NE(third.warnings[0].find("frame 3: edges have lost their way"), std::string::npos)
      << third.warnings[0];
  EXPECT_EQ(fracture.frame(), 2);
  EXPECT_EQ(fracture.crack().sheet.mesh.positions, good.crack().sheet.mesh.positions);
}

TEST(Fracture, AnIntactBodySaysSoAndStaysSo) {
  Fracture fracture = fracture_of(cube(1e6));
  const StepReport first = fracture.step();
  EXPECT_EQ(first.stop, StopReason::intact);
  EXPECT_EQ(first.frame, 0);
  EXPECT_FALSE(first.moving);
  EXPECT_EQ(fracture.step().stop, StopReason::intact);
  EXPECT_TRUE(fracture.visible_sheets().empty());
}

TEST(Fracture, AFrameLimitIsTheCallersAndTheFractureGoesOn) {
  const Scene scene = cube();
  Fracture whole = fracture_of(scene), halves = fracture_of(scene);
  run_frames(whole, 4);
  EXPECT_EQ(run_frames(halves, 2), StopReason::frame_limit);
  EXPECT_FALSE(halves.visible_sheets().empty());
  EXPECT_EQ(run_frames(halves, 4), StopReason::frame_limit);
  EXPECT_EQ(halves.crack().sheet.mesh.positions, whole.crack().sheet.mesh.positions);
}

TEST(Fracture, ALoadCanChangeBetweenSteps) {
  const Scene weak = cube(1e5), strong = cube();
  Fracture fracture = fracture_of(weak);
  EXPECT_EQ(fracture.step().stop, StopReason::intact);
  fracture.set_load(load_of(strong, fracture.body()));
  EXPECT_EQ(run_frames(fracture, 3), StopReason::frame_limit);
  Fracture under_strong = fracture_of(strong);
  run_frames(under_strong, 3);
  EXPECT_EQ(fracture.crack().sheet.mesh.positions, under_strong.crack().sheet.mesh.positions)
      << "what the weak load left is an intact body";

  fracture.set_load(load_of(weak, fracture.body()));
  EXPECT_EQ(run_frames(fracture, 10), StopReason::arrested);
  const double area = crack_area(fracture);
  fracture.set_load(load_of(strong, fracture.body()));
  fracture.step();
  EXPECT_GT(crack_area(fracture), area) << "an arrested crack goes on";
}

TEST(Fracture, ALoadOfOtherKindsIsRefused) {
  Fracture fracture = fracture_of(cube());
  Scene held = cube();
  held.boundary[1].kind = ConditionKind::displacement;
  held.boundary[1].value = Vec3::Zero();
  EXPECT_THROW(load_of(held, fracture.body()), InputError);
}

TEST(Fracture, ObeysTheGrowthLawItIsGiven) {
  const Scene scene = cube();
  const auto body = std::make_shared<const PreparedBody>(prepare(scene));
  Fracture fracture(body, load_of(scene, *body), scene.run, {}, std::make_shared<Unbreakable>());
  const StepReport step = fracture.step();
  EXPECT_EQ(step.new_cracks, 1u);
  EXPECT_EQ(step.stop, StopReason::arrested);
  EXPECT_EQ(step.largest_intensity, 0);
  EXPECT_EQ(fracture.cracks(), 1u);
}

}  // namespace conchoid

#include "conchoid/sim/led_opening.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>

#include "conchoid/learn/opening_predictor.hpp"
#include "conchoid/sim/fracture.hpp"
#include "conchoid/sim/make_runs.hpp"
#include "conchoid/sim/predicted_opening.hpp"
#include "conchoid/sim/recorders.hpp"
#include "refusal.hpp"
#include "scenes.hpp"
#include "temporary_folder.hpp"

// Fronts that go by predictions while every frame is solved beside them.
namespace conchoid {
namespace {

using Source = std::unique_ptr<OpeningSource>;

Source steady(BemOpening& bem, const PreparedBody& body, const Scene& scene) {
  return std::make_unique<OpeningByPredictor>(
      PredictionContext{bem, body.material, body, sif_settings(scene.run)}, steady_predictor());
}

struct Pulled {
  Scene scene = test::scene_from_text(test::pulled_cube_text());
  std::shared_ptr<const PreparedBody> body = std::make_shared<const PreparedBody>(prepare(scene));
  Fracture predicted() const {
    return Fracture(body, load_of(scene, *body), scene.run,
                    [this](BemOpening& bem) { return steady(bem, *body, scene); });
  }
  Fracture led() const {
    return Fracture(body, load_of(scene, *body), scene.run, [this](BemOpening& bem) -> Source {
      return std::make_unique<LedOpening>(bem, steady(bem, *body, scene));
    });
  }
};

TEST(LedOpening, FrontsGoAsWithoutIt) {
  const Pulled pulled;
  Fracture predicted = pulled.predicted(), led = pulled.led();
  for (int frame = 1; frame <= 5; ++frame) {
    predicted.step();
    EXPECT_EQ(led.step().source, frame == 1 ? "bem" : "steady");
    EXPECT_EQ(led.crack().sheet.mesh.positions, predicted.crack().sheet.mesh.positions) << frame;
    EXPECT_EQ(predicted.truth(), nullptr);
  }
}

// What is told beside is what a solution from nothing says of the crack as it stands.
class Comparison : public FractureObserver {
 public:
  explicit Comparison(const Scene& scene) : sif_(sif_settings(scene.run)) {}
  void on_opening(const Fracture& fracture) override {
    ASSERT_NE(fracture.truth(), nullptr);
    const std::vector<FrontOpening>& truth = *fracture.truth();
    BemOpening fresh(fracture.body().elastic, fracture.load(), sif_);
    const std::vector<FrontOpening> solved = fresh.open(fracture.crack());
    double largest = 0, apart = 0, wrong = 0;
    for (std::size_t i = 0; i < solved.size(); ++i) {
      largest = std::max(largest, solved[i].intensity.norm());
      apart = std::max(apart, (truth[i].intensity - solved[i].intensity).norm());
      wrong = std::max(wrong, (fracture.openings()[i].intensity - solved[i].intensity).norm());
    }
    EXPECT_LT(apart, 1e-5 * largest) << fracture.frame();
    if (fracture.frame() > 2) {
      EXPECT_GT(wrong, 0.02 * largest) << fracture.frame();
    }
    frames = fracture.frame();
  }
  int frames = 0;

 private:
  SifSettings sif_;
};

TEST(LedOpening, TruthIsTheSolutionOfTheCrackAsItStands) {
  const Pulled pulled;
  Fracture led = pulled.led();
  Comparison comparison(pulled.scene);
  led.add_observer(comparison);
  run_frames(led, 5);
  EXPECT_GE(comparison.frames, 4);
}

// Labels are what is solved; what a sample starts from is what was predicted the frame before.
TEST(LedOpening, SamplesStartFromPredictionsAndEndInSolutions) {
  const Pulled pulled;
  Fracture led = pulled.led(), predicted = pulled.predicted();
  SampleRecorder of_led(SampleRecorder::Fields::all), of_predicted(SampleRecorder::Fields::all);
  led.add_observer(of_led);
  predicted.add_observer(of_predicted);
  run_frames(led, 5);
  run_frames(predicted, 5);
  EXPECT_TRUE(of_predicted.take().empty());
  const SampleSet samples = of_led.take();
  ASSERT_GT(samples.size(), 30u);
  // K of `steady` keeps its size in space, so that of a driving K in frame 3 is one that frame 1 had.
  std::vector<double> first, third, solved;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample s = samples[i];
    if (s.frame == 2) first.push_back(s.driving.norm());
    if (s.frame == 4) third.push_back(s.driving.norm());
    if (s.frame == 4) solved.push_back(s.driving_after.norm());
  }
  ASSERT_FALSE(third.empty());
  const double largest = *std::max_element(first.begin(), first.end());
  EXPECT_LE(*std::max_element(third.begin(), third.end()), 1.2 * largest);
  EXPECT_GT(*std::max_element(solved.begin(), solved.end()), 1.5 * largest);
}

const char* const kSmallWorld =
    "[world]\nclasses = ['box', 'rod']\nruns_per_body = 1\nelements = 120\n[database]\nruns = 2\nframes = "
    "6\n";

std::vector<RunPart> made(const DatabaseSpec& spec) {
  std::vector<RunPart> parts;
  std::mutex mutex;
  const std::vector<std::int32_t> runs{0, 1};
  make_runs(spec, runs, [&](RunPart part) {
    const std::scoped_lock lock(mutex);
    parts.push_back(std::move(part));
  });
  std::sort(parts.begin(), parts.end(),
            [](const RunPart& a, const RunPart& b) { return a.record.id < b.record.id; });
  return parts;
}

TEST(LedDatabase, TheRegressorLeadsAndIsAmongItsFiles) {
  const DatabaseSpec solved = parse_database_spec(kSmallWorld, "world.toml", ".");
  const DatabaseSpec led =
      parse_database_spec(std::string(kSmallWorld) + "led_by = 'versatile'\n", "world.toml", ".");
  ASSERT_NE(led.led_by, nullptr);
  ASSERT_EQ(led.files.size(), 1u);
  EXPECT_EQ(led.files[0].filename(), "versatile.network");
  const std::vector<RunPart> by_itself = made(solved), by_network = made(led);
  ASSERT_EQ(by_network.size(), 2u);
  bool differ = false;
  for (std::size_t i = 0; i < 2; ++i) {
    const SampleSet &a = by_itself[i].samples, &b = by_network[i].samples;
    EXPECT_FALSE(b.empty());
    for (std::size_t s = 0; s < std::min(a.size(), b.size()); ++s)
      if (a[s].frame == 2 && b[s].frame == 2 && a[s].node == b[s].node) {
        EXPECT_EQ(a[s].driving, b[s].driving);  // frame 1 is solved either way
      }
    differ = differ || a.size() != b.size();
    for (std::size_t s = 0; s < std::min(a.size(), b.size()); ++s)
      differ = differ || a[s].driving != b[s].driving;
  }
  EXPECT_TRUE(differ);
}

TEST(LedDatabase, WhatLeadsMustBeThere) {
  const std::string text = std::string(kSmallWorld) + "led_by = 'no-such.network'\n";
  const std::string said = test::refusal([&] { parse_database_spec(text, "world.toml", "."); });
  EXPECT_NE(said.find("world.toml:8"), std::string::npos) << said;
  EXPECT_NE(said.find("led_by"), std::string::npos) << said;
  EXPECT_NE(said.find("no-such.network"), std::string::npos) << said;
  const test::TemporaryFolder folder;
  std::ofstream(folder / "broken.network") << "not a regressor";
  const std::string broken = std::string(kSmallWorld) + "led_by = 'broken.network'\n";
  EXPECT_NE(
      test::refusal([&] { parse_database_spec(broken, "world.toml", folder.path()); }).find("broken.network"),
      std::string::npos);
}

}  // namespace
}  // namespace conchoid

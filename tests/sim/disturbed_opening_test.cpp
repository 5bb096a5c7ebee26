#include "conchoid/sim/disturbed_opening.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "conchoid/learn/database.hpp"
#include "conchoid/sim/breakup.hpp"
#include "conchoid/sim/database_spec.hpp"
#include "conchoid/sim/generate.hpp"
#include "conchoid/sim/make_runs.hpp"
#include "refusal.hpp"
#include "temporary_folder.hpp"

// Runs whose fronts are moved by K with errors, and whose solved K are learned from.
namespace conchoid {
namespace {

const std::string kBoxes =
    "[world]\nclasses = ['box']\nruns_per_body = 1\nelements = 100\n[database]\nruns = 3\nseed = 5\nframes = "
    "7\n";

DatabaseSpec parse(const std::string& text) {
  return parse_database_spec(text, "world.toml", ".");
}

// Component of w = (K_I, K_II, K_III/√(1−ν))/S.
Vec3 direction(const Vec3& K, double nu) {
  return Vec3(K[0], K[1], K[2] / std::sqrt(1 - nu)).normalized();
}

// What moved the fronts against what was solved.
class Differences : public FractureObserver {
 public:
  void on_opening(const Fracture& fracture) override {
    const std::vector<FrontOpening>* exact = fracture.solved_openings();
    ASSERT_NE(exact, nullptr);
    const double nu = fracture.body().material.poisson_ratio;
    for (std::size_t i = 0; i < exact->size(); ++i) {
      const Vec3 K = (*exact)[i].intensity, moves = fracture.openings()[i].intensity;
      const Vec3 turned = direction(moves, nu) - direction(K, nu);
      (fracture.frame() == 1 ? first : later).push_back(std::hypot(turned[1], turned[2]));
      EXPECT_TRUE(moves.allFinite());
    }
  }
  std::vector<double> first, later;
};

TEST(DisturbedOpening, FirstFrameIsSolvedAndLaterOnesAreOffByAboutItsSize) {
  const PreparedRun run = prepare_run(parse(kBoxes), nullptr, 0);
  for (const double size : {0.05, 0.1}) {
    double sum = 0;
    std::size_t count = 0;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      Differences seen;
      Breakup breakup(run.scene, run.body, {BreakupSettings::After::stop, [&](const PreparedBody& body) {
                                              return [&](BemOpening& bem) {
                                                return std::make_unique<DisturbedOpening>(bem, body, size,
                                                                                          seed);
                                              };
                                            }});
      breakup.add_observer(seen);
      breakup.run(5);
      ASSERT_FALSE(seen.first.empty());
      for (const double d : seen.first)
        EXPECT_EQ(d, 0);
      for (const double d : seen.later)
        sum += d * d;
      count += seen.later.size();
    }
    ASSERT_GT(count, 50u);
    const double deviation = std::sqrt(sum / static_cast<double>(count));  // of two components, and slopes
    EXPECT_GT(deviation, 0.7 * size);
    EXPECT_LT(deviation, 4 * size);
  }
}

// A sample's K is what moved its front, so that of the frame after the one before it; its label is solved.
TEST(DisturbedOpening, LabelsAreSolvedAndFeaturesAreNot) {
  const test::TemporaryFolder folder;
  const DatabaseSpec calm = parse(kBoxes), disturbed = parse(kBoxes + "disturbance = 0.1\n");
  generate_database(calm, {.out = folder / "calm.h5"});
  generate_database(disturbed, {.out = folder / "one.h5"});
  generate_database(disturbed, {.out = folder / "two.h5"});
  const Database a = read_database(folder / "calm.h5"), b = read_database(folder / "one.h5");
  EXPECT_EQ(b.hash(), read_database(folder / "two.h5").hash());
  std::size_t alike = 0, other = 0;
  for (std::size_t i = 0; i < b.samples.size(); ++i) {
    const Sample s = b.samples[i];
    for (std::size_t j = 0; j < a.samples.size(); ++j) {
      const Sample t = a.samples[j];
      if (t.run != s.run || t.frame != s.frame || t.node != s.node || s.frame > 2) continue;
      // Solved at the first frame, and solved at the second: the same crack in both.
      alike += s.driving == t.driving && s.driving_after == t.driving_after;
      other += !(s.driving == t.driving && s.driving_after == t.driving_after);
    }
  }
  EXPECT_GT(alike, 0u);
  EXPECT_EQ(other, 0u);
  // From the third frame on what moves a front is no longer the label of the frame before.
  const auto chained = [](const SampleSet& samples) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < samples.size(); ++i)
      for (std::size_t j = 0; j < samples.size(); ++j)
        n += samples[i].run == samples[j].run && samples[i].frame + 1 == samples[j].frame &&
             samples[i].driving_after == samples[j].driving;
    return n;
  };
  EXPECT_GT(chained(a.samples), 0u);
  EXPECT_EQ(chained(b.samples), 0u);
}

TEST(DisturbedOpening, TooLargeOnesAreRefused) {
  EXPECT_NE(test::refusal([] { parse(kBoxes + "disturbance = 0.9\n"); }).find("disturbance"),
            std::string::npos);
}

}  // namespace
}  // namespace conchoid

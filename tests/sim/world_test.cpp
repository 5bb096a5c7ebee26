#include "conchoid/sim/world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <set>
#include <vector>

#include "conchoid/core/context.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/interrupt.hpp"
#include "conchoid/formats/formats.hpp"
#include "conchoid/remesh/remesh.hpp"
#include "conchoid/remesh/validate.hpp"
#include "conchoid/sim/fracture.hpp"
#include "conchoid/sim/generate.hpp"
#include "conchoid/sim/make_runs.hpp"
#include "conchoid/sim/world_bodies.hpp"
#include "refusal.hpp"
#include "scans.hpp"
#include "temporary_folder.hpp"

namespace conchoid {
namespace {

DatabaseSpec parse(const std::string& text) {
  return parse_database_spec(text, "world.toml", ".");
}

std::string error_of(const std::string& text) {
  return test::refusal([&] { parse(text); });
}

class BodyClasses : public testing::TestWithParam<std::string_view> {};

TEST_P(BodyClasses, GiveSolidsThatTheSeedTells) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Random one(seed), same(seed);
    const RandomBody body = random_body(GetParam(), 150, one), again = random_body(GetParam(), 150, same);
    EXPECT_NO_THROW(require_valid_body(body.surface, "body"));
    EXPECT_GT(enclosed_volume(body.surface), 0.001);
    const double size = bounding_box(body.surface).diagonal();
    EXPECT_GT(size, 0.5);
    EXPECT_LT(size, 2.5);
    EXPECT_GT(body.thickness, 0.05);
    EXPECT_NEAR(body.axis.norm(), 1, 1e-12);
    EXPECT_GE(body.surface.triangle_count(), 60u);
    EXPECT_LE(body.surface.triangle_count(), 450u);
    EXPECT_EQ(body.surface.positions, again.surface.positions);
    EXPECT_EQ(body.surface.corners, again.surface.corners);
  }
}

INSTANTIATE_TEST_SUITE_P(All, BodyClasses, testing::ValuesIn(body_class_names()),
                         [](const auto& info) { return std::string(info.param); });

TEST(World, LoadsStartACrackOrDriveTheOneThereIs) {
  const WorldSpec world{{"box", "cylinder", "rod"}, 2, 120, 0.5};
  int loads = 0;
  for (int body = 0; body < 9; ++body) {
    const WorldBody drawn = draw_world_body(world, 5, body);
    EXPECT_EQ(drawn.body_class, world.classes[static_cast<std::size_t>(body) % 3]);
    const auto prepared = prepare(drawn);
    for (int run = 2 * body; run < 2 * body + 2; ++run) {
      WorldLoad load;
      try {
        load = draw_world_load(drawn, *prepared, 5, run);
      } catch (const ComputationError&) {  // a load that closes the crack
        continue;
      }
      ++loads;
      Fracture fracture(prepared, load_of(loaded_scene(drawn, load), *prepared), drawn.scene.run);
      const StepReport first = fracture.step();
      if (drawn.scene.cracks.empty()) {
        EXPECT_NE(first.stop, StopReason::intact) << "body " << body << ", " << load.kind;
      } else {
        EXPECT_GT(first.largest_intensity, 0.3 * prepared->material.toughness);
      }
    }
  }
  EXPECT_GT(loads, 12);
}

TEST(World, ARunIsTheSameWhateverElseIsDrawn) {
  const std::string text =
      "[world]\nclasses = ['blob', 'box']\nruns_per_body = 2\nelements = 100\n[database]\n";
  const DatabaseSpec few = parse(text + "runs = 4\n"), many = parse(text + "runs = 400\n");
  const PreparedRun a = prepare_run(few, nullptr, 3), b = prepare_run(many, nullptr, 3);
  EXPECT_EQ(a.record, b.record);
  EXPECT_EQ(a.record.body, 1);
  EXPECT_EQ(a.record.body_class, "box");
  EXPECT_EQ(a.body->surface.positions, b.body->surface.positions);
  EXPECT_EQ(prepare_run(few, nullptr, 2).body->surface.positions, a.body->surface.positions);
}

TEST(World, ItsDatabaseNamesClassesAndRegeneratesBitForBit) {
  const test::TemporaryFolder folder;
  const DatabaseSpec spec = parse(
      "[world]\nclasses = ['cylinder', 'box']\nruns_per_body = 2\nelements = 100\n"
      "[database]\nruns = 4\nseed = 3\nframes = 6\n");
  generate_database(spec, {.out = folder / "one.h5"});
  generate_database(spec, {.out = folder / "two.h5"});
  const Database one = read_database(folder / "one.h5");
  EXPECT_EQ(one.hash(), read_database(folder / "two.h5").hash());
  EXPECT_TRUE(one.complete());
  EXPECT_EQ(one.body_classes(), (std::set<std::string>{"box", "cylinder"}));
  for (const RunRecord& run : one.runs) {
    EXPECT_EQ(run.body, run.id / 2);
    EXPECT_EQ(run.excluded, !run.reason.empty());
    EXPECT_FALSE(run.load.empty() && !run.excluded);
  }
  const SampleSet boxes = one.training_samples({.end_game = true, .only = {"box"}, .without = {}}),
                  others = one.training_samples({.end_game = true, .only = {}, .without = {"box"}});
  EXPECT_EQ(boxes.size() + others.size(),
            one.training_samples({.end_game = true, .only = {}, .without = {}}).size());
}

TEST(World, ADatabaseCanBeClosedEarly) {
  const test::TemporaryFolder folder;
  const std::string text =
      "[world]\nclasses = ['box']\nruns_per_body = 1\nelements = 80\n[database]\nframes = 3\n";
  const DatabaseSpec spec = parse(text + "runs = 1000\n");
  generate_database(spec, {.out = folder / "a.h5", .close = true});
  {
    DatabaseWriter writer(folder / "a.h5", read_database(folder / "a.h5").header, true);
    RunRecord record;
    record.id = 17;
    writer.add(record, {});
  }
  generate_database(spec, {.out = folder / "a.h5", .resume = true, .close = true});
  const Database closed = read_database(folder / "a.h5");
  EXPECT_FALSE(closed.complete());
  ASSERT_EQ(closed.runs.size(), 1u);
  EXPECT_EQ(closed.runs[0].id, 17);
}

TEST(World, WhatDoesNotGoWithItIsRefused) {
  const std::string world = "[world]\n[database]\nruns = 2\n";
  EXPECT_NE(error_of(world + "[body]\nmodel = 'cube'\n").find("[body] does not go with [world]"),
            std::string::npos);
  EXPECT_NE(error_of(world + "magnitude = [1.0, 2.0]\n").find("database.magnitude does not go with [world]"),
            std::string::npos);
  EXPECT_NE(error_of("[world]\nclasses = ['teapot']\n[database]\n").find("world.toml:2"), std::string::npos);
}

const std::filesystem::path kSmallScan = test::scans().front().file;

// Meshes beside the specification: a scan, and with it all other classes where none are named.
class WorldOfScans : public testing::Test {
 protected:
  WorldOfScans() { std::filesystem::copy_file(kSmallScan, folder / "statue.ply"); }
  DatabaseSpec parse(const std::string& text) const {
    return parse_database_spec(text, "world.toml", folder.path());
  }
  std::string error_of(const std::string& text) const {
    return test::refusal([&] { parse(text); });
  }
  test::TemporaryFolder folder;
};

TEST_F(WorldOfScans, BodiesAreDecimatedAndDrawnOut) {
  const WorldSpec world = *parse("[world]\nscans = ['statue.ply']\nelements = 150\n[database]\n").world;
  EXPECT_EQ(world.classes.size(), body_class_names().size() + 1);
  EXPECT_EQ(world.classes.back(), "scan");
  ASSERT_EQ(world.scans.size(), 1u);
  EXPECT_LE(world.scans[0].triangle_count(), 3300u);
  std::set<double> volumes;
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    Random one(seed), same(seed);
    const RandomBody body = random_scan(world.scans, 150, one), again = random_scan(world.scans, 150, same);
    EXPECT_EQ(body.surface.positions, again.surface.positions);
    EXPECT_NO_THROW(require_valid_body(body.surface, "scan"));
    EXPECT_GT(body.surface.triangle_count(), 130u);
    EXPECT_LT(body.surface.triangle_count(), 2000u);
    const Box box = bounding_box(body.surface);
    EXPECT_GT((box.high - box.low).maxCoeff(), 0.75);
    EXPECT_LT((box.high - box.low).maxCoeff(), 1.3);
    EXPECT_GT(body.thickness, 0.01);
    EXPECT_LT(body.thickness, 0.5);
    volumes.insert(enclosed_volume(body.surface));
  }
  EXPECT_EQ(volumes.size(), 2u);
}

TEST_F(WorldOfScans, ADatabaseIsOfTheScansItWasBegunWith) {
  const std::string text =
      "[world]\nclasses = ['scan']\nscans = ['statue.ply']\nruns_per_body = 2\nelements = 100\n"
      "[database]\nruns = 2\nseed = 3\nframes = 3\n";
  generate_database(parse(text), {.out = folder / "one.h5"});
  generate_database(parse(text), {.out = folder / "two.h5"});
  const Database one = read_database(folder / "one.h5");
  EXPECT_EQ(one.hash(), read_database(folder / "two.h5").hash());
  EXPECT_EQ(one.body_classes(), std::set<std::string>{"scan"});
  EXPECT_NE(one.header.files, 0u);
  EXPECT_TRUE(std::any_of(one.runs.begin(), one.runs.end(), [](const RunRecord& r) { return r.frames > 0; }));

  TriMesh other = read_surface(kSmallScan).mesh;
  for (Vec3& x : other.positions)
    x.z() *= 1.01;
  write_mesh(folder / "statue.ply", other);
  const std::string refused =
      test::refusal([&] { generate_database(parse(text), {.out = folder / "one.h5", .resume = true}); });
  EXPECT_NE(refused.find("another specification or files that it names"), std::string::npos) << refused;
}

TEST_F(WorldOfScans, ScansAndTheirClassGoTogether) {
  EXPECT_NE(error_of("[world]\nclasses = ['scan']\n[database]\n").find("world.toml:2"), std::string::npos);
  EXPECT_NE(error_of("[world]\nclasses = ['box']\nscans = ['statue.ply']\n[database]\n").find("add \"scan\""),
            std::string::npos);
  EXPECT_NE(error_of("[world]\nscans = ['vase.ply']\n[database]\n").find("vase.ply"), std::string::npos);
  TriMesh open = read_surface(kSmallScan).mesh;
  open.corners.pop_back();
  write_mesh(folder / "open.ply", open);
  EXPECT_NE(error_of("[world]\nscans = ['open.ply']\n[database]\n").find("open.ply"), std::string::npos);
}

// A database that is closed early holds the first runs, whatever the number of threads, not some of each thread's share.
TEST(World, RunsAreBegunInTheirOrder) {
  const DatabaseSpec spec = parse(
      "[world]\nclasses = [\"box\"]\nruns_per_body = 1\nelements = 60\n"
      "[database]\nruns = 400\nseed = 5\nframes = 2\n");
  std::vector<std::int32_t> runs(400);
  std::iota(runs.begin(), runs.end(), 0);
  for (const int threads : {1, 2}) {
    ExecutionContext context(threads);
    std::mutex mutex;
    std::vector<std::int32_t> kept;
    const auto keep = [&](const RunPart& part) {
      const std::scoped_lock lock(mutex);
      kept.push_back(part.record.id);
      if (kept.size() == 5) context.request_stop();
    };
    EXPECT_THROW(context.run([&] { make_runs(spec, runs, keep); }), Interrupted);
    ASSERT_GE(kept.size(), 5u);
    EXPECT_LT(*std::max_element(kept.begin(), kept.end()), 20) << threads;
  }
}

}  // namespace
}  // namespace conchoid

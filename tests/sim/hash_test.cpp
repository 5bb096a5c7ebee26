#include <gtest/gtest.h>

#include "conchoid/core/parallel.hpp"
#include "conchoid/sim/run.hpp"
#include "scenes.hpp"

// Same scene, same bits.
namespace conchoid {
namespace {

Scene cube() {
  return test::scene_from_text(test::pulled_cube_text());
}

RunResult run(RunOptions options) {
  options.progress = false;
  return run_scene(cube(), options);
}

TEST(Hash, SameForOneThreadAndForTwo) {
  set_thread_count(1);
  const RunResult one = run({});
  set_thread_count(2);
  const RunResult two = run({});
  set_thread_count(0);
  EXPECT_EQ(one.document.stop, "separated");
  EXPECT_EQ(one.document.hash, two.document.hash);
  EXPECT_EQ(one.document.frames, two.document.frames);
}

TEST(Hash, SameWithAFolderWrittenAndWithout) {
  const test::TemporaryFolder folder;
  RunOptions options;
  options.folder = folder.path() / "run";
  const RunResult written = run(options);
  EXPECT_EQ(run({}).document.hash, written.document.hash);
  const RunData read = read_run(*options.folder);
  EXPECT_EQ(read.document.hash, written.document.hash);
  EXPECT_EQ(read.crack.positions.size(), written.crack.positions.size());
  EXPECT_EQ(read.fragments.size(), written.fragments.size());
}

TEST(Hash, AnotherLoadGivesAnother) {
  Scene other = cube();
  other.boundary[0].value *= 1.001;
  other.boundary[1].value *= 1.001;
  RunOptions options;
  options.progress = false;
  EXPECT_NE(run_scene(other, options).document.hash, run({}).document.hash);
}

}  // namespace
}  // namespace conchoid

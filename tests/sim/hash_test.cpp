#include <gtest/gtest.h>

#include "conchoid/core/context.hpp"
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
  const RunResult one = ExecutionContext(1).run([] { return run({}); });
  const RunResult two = ExecutionContext(2).run([] { return run({}); });
  EXPECT_EQ(one.document.stop, StopReason::separated);
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

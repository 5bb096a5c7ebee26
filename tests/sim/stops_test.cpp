// A run that is asked to stop anywhere ends within a second and returns what it has.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>

#include "conchoid/core/context.hpp"
#include "conchoid/sim/run.hpp"
#include "scenes.hpp"
#include "stops.hpp"

namespace conchoid {
namespace {

RunResult stopped_run(const std::string& label) {
  const Scene scene = test::scene_from_text(test::cracked_cube_text("", 0.1, 0.02));
  const auto sink = std::make_shared<test::StopsAt>(label);
  ExecutionContext context(1, sink);
  sink->context = &context;
  RunOptions options;
  options.progress = true;
  RunResult result = context.run([&] { return run_scene(scene, options); });
  EXPECT_TRUE(sink->asked) << label;
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - sink->asked_at).count(), 1.0)
      << label;
  return result;
}

}  // namespace

TEST(Stops, ARunStoppedInAFrameKeepsTheCrack) {
  for (const char* label : {"contact", "frames", "sheets cut"}) {
    SCOPED_TRACE(label);
    const RunResult result = stopped_run(label);
    EXPECT_EQ(result.document.stop, StopReason::interrupted);
    EXPECT_GT(result.crack.triangle_count(), 0u);
    EXPECT_TRUE(result.fragments.empty());
    EXPECT_TRUE(std::any_of(result.document.warnings.begin(), result.document.warnings.end(),
                            [](const std::string& text) { return text.find("no pieces") != text.npos; }));
  }
}

TEST(Stops, BeforeTheFirstFrameThereIsNothingToKeep) {
  const Scene scene = test::scene_from_text(test::cracked_cube_text("", 0.1, 0.02));
  test::expect_stop("steps of a cut", [&] { run_scene(scene, {}); });
}

}  // namespace conchoid

// What the program does with signals, without a run to wait for.

#include "signals.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

using namespace conchoid;

namespace {

[[noreturn]] void signal_oneself_and_report() {
  ExecutionContext context(1);
  const StopOnSignals stop_on_signals(context);
  const bool before = context.stop_requested();
  std::raise(SIGINT);
  std::_Exit(!before && context.stop_requested() ? 130 : 0);
}

void signal_oneself_twice() {
  ExecutionContext context(1);
  const StopOnSignals stop_on_signals(context);
  std::raise(SIGINT);
  std::raise(SIGINT);
}

}  // namespace

TEST(SignalsDeathTest, TheFirstAsksTheContextToStop) {
  EXPECT_EXIT(signal_oneself_and_report(), testing::ExitedWithCode(130), "");
}

TEST(SignalsDeathTest, TheSecondEndsTheProgram) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "the thread sanitizer hands signals on later than they are raised";
#endif
  EXPECT_EXIT(signal_oneself_twice(), testing::KilledBySignal(SIGINT), "");
}

#include "conchoid/core/interrupt.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

#include "conchoid/core/error.hpp"

using namespace conchoid;

namespace {

[[noreturn]] void signal_oneself_and_report() {
  catch_interrupts();
  throw_if_interrupted();
  std::raise(SIGINT);
  try {
    throw_if_interrupted();
  } catch (const Interrupted&) {
    std::exit(130);
  }
  std::exit(0);
}

void signal_oneself_twice() {
  catch_interrupts();
  std::raise(SIGINT);
  std::raise(SIGINT);
}

}  // namespace

TEST(InterruptDeathTest, TheFirstSignalBecomesAnException) {
  EXPECT_EXIT(signal_oneself_and_report(), testing::ExitedWithCode(130), "");
}

TEST(InterruptDeathTest, TheSecondSignalEndsTheProgram) {
  EXPECT_EXIT(signal_oneself_twice(), testing::KilledBySignal(SIGINT), "");
}

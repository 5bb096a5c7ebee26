#include "conchoid/core/context.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "conchoid/core/error.hpp"
#include "conchoid/core/interrupt.hpp"
#include "conchoid/core/log.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/core/progress.hpp"

using namespace conchoid;

namespace {

/// Keeps what it hears.
class Recorder : public MessageSink {
 public:
  void message(std::string_view text) override { add("message " + std::string(text)); }
  void warning(std::string_view text) override { add("warning " + std::string(text)); }
  void progress_begin(const ProgressReport& r) override { add("begin " + text(r)); }
  void progress_advance(const ProgressReport& r) override { add("advance " + text(r)); }
  void progress_end(const ProgressReport& r) noexcept override { add("end " + text(r)); }

  std::vector<std::string> heard;

 private:
  static std::string text(const ProgressReport& r) {
    return std::string(r.label) + " " + std::to_string(r.done) + "/" + std::to_string(r.total);
  }
  void add(const std::string& line) {
    const std::lock_guard lock(mutex_);
    heard.push_back(line);
  }
  std::mutex mutex_;
};

using Lines = std::vector<std::string>;

}  // namespace

TEST(Context, ItsSinkHearsWhatIsSaidInsideAndNothingElse) {
  const auto recorder = std::make_shared<Recorder>();
  const ExecutionContext context(1, recorder);
  message("before");
  const int answer = context.run([] {
    message("one");
    warning("two");
    return 42;
  });
  warning("after");
  EXPECT_EQ(answer, 42);
  EXPECT_EQ(recorder->heard, (Lines{"message one", "warning two"}));
}

TEST(Context, WithoutASinkNothingIsWrittenAnywhere) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  const auto talk = [] {
    message("a message");
    warning("a warning");
    Progress progress("steps", 2);
    progress.advance(2);
  };
  talk();
  ExecutionContext().run(talk);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(Context, TheInnermostCounts) {
  const auto outer = std::make_shared<Recorder>(), inner = std::make_shared<Recorder>();
  ExecutionContext(2, outer).run([&] {
    ExecutionContext(1, inner).run([] { message("inner"); });
    message("outer");
  });
  EXPECT_EQ(outer->heard, Lines{"message outer"});
  EXPECT_EQ(inner->heard, Lines{"message inner"});
}

TEST(Context, LoopsInsideLoopsInheritIt) {
  const auto recorder = std::make_shared<Recorder>();
  const ExecutionContext context(2, recorder);
  context.run([&] {
    parallel_for(20, 1, [&](std::size_t, std::size_t) {
      EXPECT_EQ(ExecutionContext::current(), &context);
      parallel_for(20, 1, [&](std::size_t, std::size_t) {
        EXPECT_EQ(ExecutionContext::current(), &context);
        message("x");
      });
    });
  });
  EXPECT_EQ(recorder->heard.size(), 400u);
  EXPECT_EQ(ExecutionContext::current(), nullptr);
}

TEST(Context, TwoAtATimeDoNotMix) {
  const auto speak = [](const std::string& word) {
    const auto recorder = std::make_shared<Recorder>();
    ExecutionContext(2, recorder).run([&] {
      parallel_for(200, 1, [&](std::size_t, std::size_t) { message(word); });
    });
    return recorder->heard;
  };
  Lines a, b;
  std::thread other([&] { a = speak("a"); });
  b = speak("b");
  other.join();
  EXPECT_EQ(a, Lines(200, "message a"));
  EXPECT_EQ(b, Lines(200, "message b"));
}

TEST(Context, NoMoreThreadsWorkThanItHas) {
  const ExecutionContext one(1);
  EXPECT_EQ(one.threads(), 1);
  EXPECT_GE(ExecutionContext().threads(), 1);
  std::mutex mutex;
  std::set<std::thread::id> workers;
  one.run([&] {
    parallel_for(1000, 1, [&](std::size_t, std::size_t) {
      const std::lock_guard lock(mutex);
      workers.insert(std::this_thread::get_id());
    });
  });
  EXPECT_EQ(workers, std::set<std::thread::id>{std::this_thread::get_id()});
}

TEST(Context, AnExceptionLeavesItBehind) {
  const ExecutionContext context(2);
  EXPECT_THROW(context.run([] { throw InputError("x"); }), InputError);
  EXPECT_EQ(ExecutionContext::current(), nullptr);
}

TEST(Context, ARequestToStopIsSeenInsideOfItOnly) {
  ExecutionContext context(2);
  const ExecutionContext other;
  context.run(throw_if_interrupted);
  context.request_stop();
  EXPECT_FALSE(interrupted());
  EXPECT_FALSE(other.run(interrupted));
  EXPECT_TRUE(context.run(interrupted));
  EXPECT_THROW(
      context.run([] { parallel_for(10, 1, [](std::size_t, std::size_t) { throw_if_interrupted(); }); }),
      Interrupted);
}

TEST(Progress, TellsTheSinkAndNeverPassesItsTotal) {
  const auto recorder = std::make_shared<Recorder>();
  ExecutionContext(1, recorder).run([] {
    Progress progress("runs", 3);
    progress.advance(2);
    progress.advance(2);
    EXPECT_EQ(progress.done(), 3u);
  });
  EXPECT_EQ(recorder->heard,
            (Lines{"begin runs 0/3", "advance runs 2/3", "advance runs 3/3", "end runs 3/3"}));
}

#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include "conchoid/core/context.hpp"
#include "conchoid/core/error.hpp"

namespace conchoid::test {

/// Stops its context as soon as a loop of that name has done a step.
class StopsAt : public MessageSink {
 public:
  explicit StopsAt(std::string label) : label_(std::move(label)) {}
  void message(std::string_view) override {}
  void warning(std::string_view) override {}
  void progress_begin(const ProgressReport& report) override { look(report, 0); }
  void progress_advance(const ProgressReport& report) override { look(report, 1); }

  ExecutionContext* context = nullptr;
  std::chrono::steady_clock::time_point asked_at;
  bool asked = false;

 private:
  void look(const ProgressReport& report, std::size_t least) {
    const std::lock_guard lock(mutex_);
    if (asked || report.label.find(label_) == std::string_view::npos || report.done < least) return;
    asked = true;
    asked_at = std::chrono::steady_clock::now();
    context->request_stop();
  }
  std::string label_;
  std::mutex mutex_;
};

/// The work is asked to stop when its loop of that name has done a step, and throws Interrupted within a second.
inline void expect_stop(const std::string& label, const std::function<void()>& work) {
  SCOPED_TRACE(label);
  const auto sink = std::make_shared<StopsAt>(label);
  ExecutionContext context(1, sink);
  sink->context = &context;
  EXPECT_THROW(context.run(work), Interrupted);
  ASSERT_TRUE(sink->asked) << "it tells how far it is";
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - sink->asked_at).count(), 1.0);
}

}  // namespace conchoid::test

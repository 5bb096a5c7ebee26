#include "conchoid/core/terminal_sink.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

using namespace conchoid;

namespace {

/// What a sink writes to a file that is no terminal.
std::string written(bool quiet) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), std::fclose);
  TerminalSink sink(quiet, file.get());
  sink.message("a message");
  sink.progress_begin({"runs", 0, 3, 0});
  sink.progress_advance({"runs", 1, 3, 1});
  sink.warning("a warning");
  sink.progress_end({"runs", 3, 3, 3});
  std::rewind(file.get());
  std::string text(1000, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file.get()));
  return text;
}

}  // namespace

TEST(TerminalSink, EstimatesTheTimeLeft) {
  EXPECT_EQ(progress_line({"runs", 0, 300, 0}), "runs  0/300  0 %");
  EXPECT_EQ(progress_line({"runs", 100, 300, 20}), "runs  100/300  33 %  about 40 s left");
  EXPECT_EQ(progress_line({"runs", 1, 300, 2}), "runs  1/300  0 %  about 10 min left");
  EXPECT_EQ(progress_line({"runs", 300, 300, 60}), "runs  300/300  100 %");
}

TEST(TerminalSink, ShowsNoProgressWhereNobodyWatches) {
  EXPECT_EQ(written(false), "a message\nwarning: a warning\n");
}

TEST(TerminalSink, QuietLeavesWarnings) {
  EXPECT_EQ(written(true), "warning: a warning\n");
}

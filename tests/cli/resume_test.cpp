// A run that was stopped goes on where it was and ends in the same bits.

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/program.hpp"
#include "cli/signalled.hpp"

namespace conchoid::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kHead = "[material]\nyoungs_modulus = 3.1e9\npoisson_ratio = 0.327\n";
const std::string kCube = "[body]\nmodel = \"cube\"\n" + kHead +
                          "[resolution]\ncrack = 0.1\nsurface = 0.02\n"
                          "[[boundary]]\nregion = \"z+\"\ntraction = [2e7, 0, 9e7]\n"
                          "[[boundary]]\nregion = \"z-\"\nfixed = true\n";
const std::string kTwoCracks = kCube + "[run]\nmax_cracks = 2\n";

std::vector<std::string> arguments(const std::vector<std::string>& more = {}) {
  std::vector<std::string> all = {"run", "scene.toml", "--out", "run"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

json report(const TemporaryFolder& folder, std::vector<std::string> call) {
  call.push_back("--json");
  const Outcome outcome = run_program(call, folder.path());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return json::parse(outcome.out, nullptr, false);
}

fs::path rows_file(const TemporaryFolder& folder, int frame) {
  return folder.path() / "run/resume" / ("frame_000" + std::to_string(frame) + ".rows");
}

/// Files of a run folder with their content, but for run.json, which holds times.
std::vector<std::pair<fs::path, std::string>> contents(const TemporaryFolder& folder) {
  std::vector<std::pair<fs::path, std::string>> all;
  for (const fs::path& file : files_below(folder / "run"))
    if (file.filename() != "run.json")
      all.emplace_back(fs::relative(file, folder.path()), folder.read(fs::relative(file, folder.path())));
  std::sort(all.begin(), all.end());
  return all;
}

/// Kills a run as soon as it has written that frame.
void kill_after(const TemporaryFolder& folder, int frame, std::vector<std::string> more = {}) {
  more.insert(more.end(), {"--threads", "1"});  // one that waits for others enters the kernel all the time
  const int status = run_and_signal_at_once(
      arguments(more), folder, [&] { return fs::exists(rows_file(folder, frame)); }, SIGKILL);
  ASSERT_EQ(status, 128 + SIGKILL);
  ASSERT_TRUE(fs::exists(rows_file(folder, frame)));
  ASSERT_FALSE(fs::exists(rows_file(folder, frame + 1)));
}

}  // namespace

TEST(Resume, AKilledRunGoesOnToTheSameBits) {
  for (const std::string& scene : {kCube, kTwoCracks}) {
    const TemporaryFolder whole, killed;
    whole.write("scene.toml", scene);
    killed.write("scene.toml", scene);
    const json expected = report(whole, arguments());
    ASSERT_GT(expected["frames"], 5);
    for (int frame : {1, 3, 4})
      kill_after(killed, frame, {"--resume"});
    const json resumed = report(killed, arguments({"--resume"}));
    EXPECT_EQ(resumed["hash"], expected["hash"]);
    EXPECT_EQ(resumed["frames"], expected["frames"]);
    EXPECT_EQ(resumed["stop"], expected["stop"]);
    EXPECT_EQ(resumed["resumed_after"], 4);
    EXPECT_EQ(contents(killed), contents(whole)) << "every file of the run, and no other";
  }
}

TEST(Resume, ARunGoesOnFromItsFrameLimit) {
  const TemporaryFolder whole, limited;
  for (const TemporaryFolder* folder : {&whole, &limited})
    folder->write("scene.toml", kCube);
  const json expected = report(whole, arguments({"--frames", "6"}));
  const json first = report(limited, arguments({"--frames", "2"}));
  EXPECT_EQ(first["stop"], "frame-limit");
  EXPECT_NE(first["hash"], expected["hash"]);
  const json second = report(limited, arguments({"--frames", "6", "--resume"}));
  EXPECT_EQ(second["resumed_after"], 2);
  EXPECT_EQ(second["hash"], expected["hash"]);
  const json fewer = report(limited, arguments({"--frames", "2", "--resume"}));
  EXPECT_EQ(fewer["hash"], first["hash"]);
  EXPECT_FALSE(fs::exists(limited / "run/frames/frame_0003.vtu"));
}

TEST(Resume, APredictedRunGoesOnToTheSameBits) {
  const TemporaryFolder whole, limited;
  for (const TemporaryFolder* folder : {&whole, &limited})
    folder->write("scene.toml", kCube);
  const json expected = report(whole, arguments({"--method", "steady"}));
  report(limited, arguments({"--method", "steady", "--frames", "2"}));
  const json resumed = report(limited, arguments({"--method", "steady", "--resume"}));
  EXPECT_EQ(resumed["resumed_after"], 2);
  EXPECT_EQ(resumed["hash"], expected["hash"]);
}

TEST(Resume, WithoutAFolderToGoOnWithTheRunBeginsAtTheBeginning) {
  const TemporaryFolder folder;
  folder.write("scene.toml", kCube);
  const json made = report(folder, arguments({"--frames", "1", "--resume"}));
  EXPECT_EQ(made["frames"], 1);
  EXPECT_FALSE(made.contains("resumed_after"));
}

TEST(Resume, AnotherBodyOfTheSameNameIsAnotherScene) {
  const TemporaryFolder folder;
  const std::string body = "[body]\nmesh = \"body.ply\"\n" + kHead;
  std::string scene = kCube;
  scene.replace(0, scene.find("[resolution]"),
                body + "[[region]]\nname = \"z+\"\nhalf_spaces = [[0, 0, 1, 0.49]]\n" +
                    "[[region]]\nname = \"z-\"\nhalf_spaces = [[0, 0, -1, 0.49]]\n");
  folder.write("scene.toml", scene);
  folder.write("cube.toml", kCube);
  folder.write("bar.toml", "[body]\nmodel = \"cylinder\"\n" + kHead + "[resolution]\ncrack = 0.3\n");
  report(folder, {"mesh", "cube.toml", "--out", "body.ply"});
  const json first = report(folder, arguments({"--frames", "1"}));
  EXPECT_EQ(first["stop"], "frame-limit");
  EXPECT_EQ(report(folder, arguments({"--frames", "2", "--resume"}))["resumed_after"], 1);
  report(folder, {"mesh", "bar.toml", "--out", "body.ply"});
  const Outcome outcome = run_program(arguments({"--frames", "3", "--resume"}), folder.path());
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("another scene"), std::string::npos) << outcome.err;
}

TEST(Resume, AnythingElseIsRefusedAndLeftAsItIs) {
  const TemporaryFolder folder;
  folder.write("scene.toml", kCube);
  kill_after(folder, 2);
  const std::string rows = folder.read("run/resume/frame_0002.rows");
  const auto refused = [&](const std::vector<std::string>& more, const std::string& why) {
    std::vector<std::string> call = arguments(more);
    call.push_back("--resume");
    const Outcome outcome = run_program(call, folder.path());
    EXPECT_EQ(outcome.status, 2) << why;
    EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("--resume"), std::string::npos) << "the remedy: " << outcome.err;
  };
  refused({"--method", "steady"}, "another scene or method");
  folder.write("scene.toml", kTwoCracks);
  refused({}, "another scene or method");
  folder.write("scene.toml", kCube);
  for (std::size_t length : {std::size_t(20), rows.size() / 2, rows.size() - 1}) {
    folder.write("run/resume/frame_0002.rows", rows.substr(0, length));
    refused({}, "cut short or damaged");
  }
  std::string changed = rows;
  changed[rows.size() / 2] ^= 1;
  folder.write("run/resume/frame_0002.rows", changed);
  refused({}, "cut short or damaged");
  folder.write("run/resume/frame_0002.rows", "not ours");
  refused({}, "frame_0002.rows");
  EXPECT_EQ(folder.read("run/resume/frame_0002.rows"), "not ours");
  folder.write("run/resume/frame_0002.rows", rows);
  EXPECT_EQ(report(folder, arguments({"--resume"}))["stop"], "separated");
}

}  // namespace conchoid::test

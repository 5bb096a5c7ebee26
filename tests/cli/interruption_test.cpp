// What is left when the program is stopped from outside.

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>

#include "cli/program.hpp"
#include "cli/signalled.hpp"

using namespace conchoid::test;
using nlohmann::json;

namespace {

const std::string kSpec =
    "[body]\nmodel = \"cube\"\n[material]\nyoungs_modulus = 3.1e9\npoisson_ratio = 0.327\n"
    "[resolution]\ncrack = 0.2\nsurface = 0.1\n"
    "[database]\nregions = [\"z+\", \"z-\"]\nmagnitude = [8e7, 1e8]\nslope = [0, 30]\nruns = 6\n";

const std::vector<std::string> kGenerate = {"database", "generate", "spec.toml",
                                            "--out",    "cube.h5",  "--resume"};

json generated(const TemporaryFolder& folder) {
  std::vector<std::string> arguments = kGenerate;
  arguments.push_back("--json");
  const Outcome outcome = run_program(arguments, folder.path());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return json::parse(outcome.out, nullptr, false);
}

}  // namespace

TEST(Interruption, AKilledGenerationResumesToTheSameDatabase) {
  TemporaryFolder whole, killed;
  whole.write("spec.toml", kSpec);
  killed.write("spec.toml", kSpec);
  const auto start = std::chrono::steady_clock::now();
  const json expected = generated(whole);
  const std::chrono::duration<double> full = std::chrono::steady_clock::now() - start;
  ASSERT_EQ(expected["runs"], 6);

  for (double share : {0.2, 0.35, 0.5}) {  // of the time that the whole takes
    const auto deadline = std::chrono::steady_clock::now() + share * full;
    run_and_signal(
        kGenerate, killed, [&] { return std::chrono::steady_clock::now() > deadline; }, SIGKILL);
  }
  const json resumed = generated(killed);
  EXPECT_EQ(resumed["runs"], expected["runs"]);
  EXPECT_EQ(resumed["samples"], expected["samples"]);
  EXPECT_EQ(resumed["hash"], expected["hash"]);
  EXPECT_EQ(files_below(killed.path()).size(), 2u) << "the specification and the database";
}

TEST(Interruption, CtrlCIsAFailureThatKeepsFinishedRuns) {
  const TemporaryFolder folder;
  folder.write("spec.toml", kSpec);
  EXPECT_EQ(run_and_signal(
                kGenerate, folder, [&] { return std::filesystem::exists(folder / "cube.h5.parts"); }, SIGINT),
            1);
  EXPECT_FALSE(std::filesystem::exists(folder / "cube.h5"));
  EXPECT_EQ(generated(folder)["runs"], 6);
}

TEST(Interruption, AnInterruptedRunWritesWhatItHas) {
  const TemporaryFolder folder;
  folder.write("cube.toml",
               "[body]\nmodel = \"cube\"\n[material]\nyoungs_modulus = 3.1e9\npoisson_ratio = 0.327\n"
               "[resolution]\ncrack = 0.1\nsurface = 0.02\n"
               "[[boundary]]\nregion = \"z+\"\ntraction = [0, 0, 9e7]\n"
               "[[boundary]]\nregion = \"z-\"\nfixed = true\n");
  const int status = run_and_signal_at_once(
      {"run", "cube.toml", "--out", "run"}, folder,
      [&] { return std::filesystem::exists(folder / "run/frames/frame_0002.vtu"); }, SIGINT);
  EXPECT_EQ(status, 1);
  const json report = json::parse(folder.read("run/run.json"), nullptr, false);
  ASSERT_TRUE(report.is_object());
  EXPECT_EQ(report["stop"], "interrupted");
  EXPECT_TRUE(std::filesystem::exists(folder / "run/crack.ply"));
  EXPECT_FALSE(std::filesystem::exists(folder / "run/frames/frame_0004.vtu"));
}

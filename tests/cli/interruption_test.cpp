// What is left when the program is stopped from outside.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/program.hpp"

using namespace conchoid::test;
using nlohmann::json;

namespace {

using Milliseconds = std::chrono::milliseconds;

const std::string kSpec =
    "[body]\nmodel = \"cube\"\n[material]\nyoungs_modulus = 3.1e9\npoisson_ratio = 0.327\n"
    "[resolution]\ncrack = 0.2\nsurface = 0.1\n"
    "[database]\nregions = [\"z+\", \"z-\"]\nmagnitude = [8e7, 1e8]\nslope = [0, 30]\nruns = 6\n";

/// Starts the program in a folder, waits until `ready` says so (at most a minute), then sends it a signal.
/// Returns its exit status, or 128 + the signal that ended it.
int run_and_signal(const std::vector<std::string>& arguments, const TemporaryFolder& folder,
                   const std::function<bool()>& ready, int signal) {
  const pid_t child = ::fork();
  if (child == 0) {
    std::vector<char*> argv = {const_cast<char*>(CONCHOID_BINARY)};
    for (const std::string& argument : arguments)
      argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    const int nowhere = ::open("/dev/null", O_RDWR);
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
    if (::chdir(folder.path().c_str()) == 0) ::execv(CONCHOID_BINARY, argv.data());
    ::_exit(127);
  }
  for (int wait = 0; wait < 6000 && !ready(); ++wait)
    std::this_thread::sleep_for(Milliseconds(10));
  ::kill(child, signal);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

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
               "[resolution]\ncrack = 0.04\nsurface = 0.02\n"
               "[[boundary]]\nregion = \"z+\"\ntraction = [0, 0, 9e7]\n"
               "[[boundary]]\nregion = \"z-\"\nfixed = true\n");
  const int status = run_and_signal(
      {"run", "cube.toml", "--out", "run"}, folder, [&] { return std::filesystem::exists(folder / "run"); },
      SIGINT);
  const json report = json::parse(folder.read("run/run.json"), nullptr, false);
  ASSERT_TRUE(report.is_object());
  if (report["stop"] != "interrupted") GTEST_SKIP() << "the run had finished before the signal came";
  EXPECT_EQ(status, 1);
}

// Databases made by several processes of one job.

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "cli/program.hpp"

using namespace conchoid::test;
using nlohmann::json;

namespace fs = std::filesystem;

namespace {

const std::string kSpec =
    "[body]\nmodel = \"cube\"\n[material]\nyoungs_modulus = 3.1e9\npoisson_ratio = 0.327\n"
    "[resolution]\ncrack = 0.2\nsurface = 0.1\n"
    "[database]\nregions = [\"z+\", \"z-\"]\nmagnitude = [8e7, 1e8]\nslope = [0, 30]\nruns = 10\n";

const std::vector<std::string> kGenerate = {"database", "generate", "spec.toml", "--out",
                                            "cube.h5",  "--resume", "--json"};

Outcome generate(const TemporaryFolder& folder, int ranks) {
  if (ranks == 1) return run_program(kGenerate, folder.path());
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 1);
  setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 1);  // containers forbid reading another process
  std::vector<std::string> words{CONCHOID_MPIEXEC, "-n", std::to_string(ranks), CONCHOID_BINARY};
  words.insert(words.end(), kGenerate.begin(), kGenerate.end());
  return run_command(words, folder.path());
}

json database(const TemporaryFolder& folder, int ranks) {
  const Outcome outcome = generate(folder, ranks);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return json::parse(outcome.out, nullptr, false);
}

// The process that is rank 1 of a job in this folder; 0 if there is none.
pid_t rank_one(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::error_code error;
    if (fs::read_symlink(entry.path() / "cwd", error) != fs::canonical(folder) || error) continue;
    std::ifstream in(entry.path() / "environ");
    std::stringstream environment;
    environment << in.rdbuf();
    if (environment.str().find("OMPI_COMM_WORLD_RANK=1") != std::string::npos)
      return static_cast<pid_t>(std::atoi(entry.path().filename().c_str()));
  }
  return 0;
}

void expect_same(const json& made, const json& expected) {
  for (const char* key : {"runs", "samples", "hash"})
    EXPECT_EQ(made[key], expected[key]) << key;
}

}  // namespace

TEST(Ranks, MakeTheSameDatabaseTogether) {
  TemporaryFolder alone, together;
  alone.write("spec.toml", kSpec);
  together.write("spec.toml", kSpec);
  const json expected = database(alone, 1);
  ASSERT_EQ(expected["runs"], 10);
  expect_same(database(together, 2), expected);
  EXPECT_EQ(files_below(together.path()).size(), 2u) << "the specification and the database";
}

TEST(Ranks, WhatIsDoneStaysWhenOneIsKilled) {
  TemporaryFolder alone, together;
  alone.write("spec.toml", kSpec);
  together.write("spec.toml", kSpec);
  std::thread killer([&] {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (std::chrono::steady_clock::now() < deadline) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      if (!fs::exists(together / "cube.h5.parts/run-00000000.bin")) continue;
      if (const pid_t process = rank_one(together.path()); process > 0) kill(process, SIGKILL);
      return;
    }
  });
  const Outcome killed = generate(together, 2);
  killer.join();
  EXPECT_NE(killed.status, 0);
  EXPECT_FALSE(fs::exists(together / "cube.h5"));
  EXPECT_TRUE(fs::exists(together / "cube.h5.parts/run-00000000.bin"));
  expect_same(database(together, 2), database(alone, 1));
}

TEST(Ranks, AMistakeIsToldAndEndsTheJob) {
  const TemporaryFolder folder;
  folder.write("spec.toml", kSpec + "nonsense = 1\n");
  const Outcome outcome = generate(folder, 2);
  EXPECT_NE(outcome.status, 0);
  EXPECT_NE(outcome.err.find("nonsense"), std::string::npos) << outcome.err;
}

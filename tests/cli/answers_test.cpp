// Answers at once: help, units, regions that miss the body, Ctrl-C.

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <string>

#include "cli/program.hpp"
#include "cli/signalled.hpp"
#include "conchoid/formats/formats.hpp"
#include "conchoid/mesh/models.hpp"
#include "mesh/mesh_checks.hpp"

using namespace conchoid;
using namespace conchoid::test;

namespace {

const std::string kMaterial = "[material]\nyoungs_modulus = 3e9\npoisson_ratio = 0.3\n";

void expect_in(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << part << " in:\n" << text;
}

}  // namespace

TEST(Answers, HelpNamesEveryCommand) {
  const TemporaryFolder folder;
  const Outcome help = run_program({"help"}, folder.path());
  EXPECT_EQ(help.status, 0) << help.err;
  expect_in(help.out, {"run", "check", "picture", "materials", "help-scene"});
  const Outcome run = run_program({"help", "run"}, folder.path());
  EXPECT_EQ(run.status, 0) << run.err;
  expect_in(run.out, {"SCENE", "--frames"});
  const Outcome none = run_program({"help", "nonsense"}, folder.path());
  EXPECT_EQ(none.status, 2);
  expect_in(none.err, {"nonsense", "conchoid help"});
}

TEST(Answers, AMeshInMillimetresIsWarnedOfWhereNoScaleIsGiven) {
  const TemporaryFolder folder;
  write_mesh(folder / "cube.off", box_mesh(Vec3(50, 50, 50), 2, 2, 2));
  const auto warned = [&](const std::string& more) {
    folder.write("scene.toml", "[body]\nmesh = \"cube.off\"\n" + more + kMaterial +
                                   "[[region]]\nname = \"a\"\nhalf_spaces = [[0, 0, 1, 0]]\n"
                                   "[[boundary]]\nregion = \"a\"\nfixed = true\n");
    const Outcome run = run_program({"run", "scene.toml", "--json"}, folder.path());
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err.find("body.scale") == std::string::npos,
              run.out.find("body.scale") == std::string::npos)
        << "the report has it, too";
    return run.err.find("set body.scale = 0.001") != std::string::npos;
  };
  EXPECT_TRUE(warned(""));
  EXPECT_FALSE(warned("scale = 0.001\n"));
  EXPECT_FALSE(warned("scale = 1.0\n"));
}

TEST(Answers, ARegionThatMissesTheBodyIsToldHowFarItReaches) {
  const TemporaryFolder folder;
  folder.write("scene.toml", "[body]\nmodel = \"cube\"\n" + kMaterial +
                                 "[[region]]\nname = \"a\"\nhalf_spaces = [[0, 0, 2, 1.25]]\n"
                                 "[[boundary]]\nregion = \"a\"\nfixed = true\n");
  const Outcome run = run_program({"run", "scene.toml"}, folder.path());
  EXPECT_EQ(run.status, 2);
  expect_in(run.err, {"has no triangles", "along (0, 0, 2)", "from -1 to 1", "begins at 1.25"});
}

TEST(Answers, CtrlCEndsARepairWithinASecond) {
  const TemporaryFolder folder;
  TriMesh mesh = icosphere(1, 6);
  append(mesh, icosphere(1, 6), Vec3(1.02, 0.03, 0.05));
  write_mesh(folder / "two.ply", mesh);
  const auto start = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point asked;
  const int status = run_and_signal(
      {"check", "two.ply", "--repair", "--out", "one.ply", "--voxel", "0.004"}, folder,
      [&] {
        asked = std::chrono::steady_clock::now();
        return asked - start > std::chrono::milliseconds(1500);
      },
      SIGINT);
  EXPECT_EQ(status, 1) << "stopped, not killed";
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - asked).count(), 1.5);
  EXPECT_EQ(files_below(folder.path()).size(), 1u) << "nothing half written";
}

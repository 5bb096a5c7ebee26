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

namespace {

/// Something long, and when it has come to what Ctrl-C shall interrupt.
struct LongWork {
  std::string name;
  std::vector<std::string> arguments;
  std::string scene;
  double seconds = 0;     ///< after the start of the program
  std::string file = "";  ///< or after this file is there
};

void PrintTo(const LongWork& work, std::ostream* out) {
  *out << work.name;
}

class LongWorkTest : public testing::TestWithParam<LongWork> {};

const std::string kPullsAtBothEnds =
    "[[boundary]]\nregion = \"z+\"\ntraction = [0.0, 0.0, 2e6]\n"
    "[[boundary]]\nregion = \"z-\"\ntraction = [0.0, 0.0, -2e6]\n[run]\nmax_cracks = 0\n";
const std::string kPushedTogether =
    "[[boundary]]\nregion = \"z+\"\ntraction = [1e7, 0.0, -2e7]\n"
    "[[boundary]]\nregion = \"z-\"\nfixed = true\n[run]\nmax_cracks = 0\n";

}  // namespace

TEST_P(LongWorkTest, CtrlCEndsItWithinASecondAndLeavesNothingHalfWritten) {
  const LongWork& work = GetParam();
  const TemporaryFolder folder;
  if (work.scene.empty()) {
    TriMesh mesh = icosphere(1, 6);
    append(mesh, icosphere(1, 6), Vec3(1.02, 0.03, 0.05));
    write_mesh(folder / "two.ply", mesh);
  }
  if (work.scene.find("ball.ply") != std::string::npos) write_mesh(folder / "ball.ply", icosphere(1, 7));
  if (work.scene.find("shot.ply") != std::string::npos) write_mesh(folder / "shot.ply", icosphere(1, 4));
  folder.write("scene.toml", kMaterial + work.scene);
  const auto start = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point asked;
  const int status = run_and_signal(
      work.arguments, folder,
      [&] {
        asked = std::chrono::steady_clock::now();
        return work.file.empty() ? asked - start > std::chrono::duration<double>(work.seconds)
                                 : std::filesystem::exists(folder / work.file);
      },
      SIGINT);
  EXPECT_EQ(status, 1) << "stopped, neither killed nor done";
  // A second, and half of one for a machine that does something else as well.
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - asked).count(), 1.5);
  for (const auto& file : files_below(folder.path()))
    EXPECT_EQ(file.string().find(".tmp"), std::string::npos) << file;
  for (const char* output : {"one.ply", "bem.ply", "run/fragment_000.obj"})
    EXPECT_FALSE(std::filesystem::exists(folder / output)) << output;
}

INSTANTIATE_TEST_SUITE_P(
    Answers, LongWorkTest,
    testing::Values(
        LongWork{.name = "Repair",
                 .arguments = {"check", "two.ply", "--repair", "--out", "one.ply", "--voxel", "0.004"},
                 .scene = "",
                 .seconds = 1.5},
        LongWork{.name = "Remeshing",
                 .arguments = {"mesh", "scene.toml", "--out", "bem.ply"},
                 .scene = "[body]\nmesh = \"ball.ply\"\nremesh = 20000\n",
                 .seconds = 1.5},
        LongWork{
            .name = "Assembling",
            .arguments = {"stress", "scene.toml"},
            .scene =
                "[body]\nmesh = \"shot.ply\"\n[[boundary]]\nregion = \"z+\"\npressure = 1e5\n"
                "[[region]]\nname = \"z+\"\nhalf_spaces = [[0, 0, 1, 0.5]]\n[run]\ninertia_relief = true\n",
            .seconds = 2},
        LongWork{
            .name = "Cutting",
            .arguments = {"run", "scene.toml", "--out", "run"},
            .scene = "[body]\nmodel = \"edge-crack-cube\"\n[resolution]\ncrack = 0.2\nsurface = 0.0015\n" +
                     kPullsAtBothEnds,
            .file = "run/frames/frame_0003.vtu"},
        LongWork{
            .name = "Contact",
            .arguments = {"run", "scene.toml", "--out", "run"},
            .scene = "[body]\nmodel = \"edge-crack-cube\"\n[resolution]\ncrack = 0.04\nsurface = 0.01\n" +
                     kPushedTogether,
            .seconds = 2}),
    [](const testing::TestParamInfo<LongWork>& info) { return info.param.name; });

// conchoid check on files as people have them: exit status, messages, JSON, and what --repair writes.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "cli/program.hpp"
#include "conchoid/formats/formats.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/remesh/validate.hpp"
#include "mesh/mesh_checks.hpp"

using namespace conchoid;
using namespace conchoid::test;
using nlohmann::json;

namespace {

TriMesh cube() {
  return box_mesh(Vec3(1, 1, 1), 2, 2, 2);
}

TriMesh cube_with_hole() {
  TriMesh mesh = cube();
  mesh.corners.pop_back();
  return mesh;
}

void expect_parts(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << part << " in:\n" << text;
}

}  // namespace

TEST(Check, AGoodMeshIsUsableAsItIs) {
  const TemporaryFolder folder;
  write_mesh(folder / "cube.off", cube());
  const Outcome outcome = run_program({"check", "cube.off"}, folder.path());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  expect_parts(outcome.out, {"cube.off: 48 triangles, 26 nodes", "extent 1 × 1 × 1", "probably m", "volume 1",
                             "holes: 0", "can use it as it is", "change nothing", "crack = 0.1"});
}

TEST(Check, AHoleIsReportedWithStatus1) {
  const TemporaryFolder folder;
  write_mesh(folder / "cube.ply", cube_with_hole());
  const Outcome outcome = run_program({"check", "cube.ply"}, folder.path());
  EXPECT_EQ(outcome.status, 1);
  expect_parts(outcome.out,
               {"holes: 1", "3 edges", "3 open edges", "mend it where it is bad", "close the holes"});
  expect_parts(outcome.err, {"cube.ply", "--repair"});
  EXPECT_EQ(files_below(folder.path()).size(), 1u);

  const Outcome as_json = run_program({"check", "cube.ply", "--json"}, folder.path());
  EXPECT_EQ(as_json.status, 1);
  const json report = json::parse(as_json.out);
  EXPECT_FALSE(report["usable"].get<bool>());
  EXPECT_EQ(report["holes"][0]["edges"], 3);
  EXPECT_EQ(report["defects"]["open edges"], 3);
  EXPECT_EQ(report["repair"]["method"], "mending");
  EXPECT_TRUE(report["parts"][0]["volume"].is_null());
}

TEST(Check, TheRepairedFilePassesTheCheck) {
  const TemporaryFolder folder;
  write_mesh(folder / "cube.ply", cube_with_hole());
  for (const char* out : {"fixed.ply", "fixed.obj", "fixed.stl"}) {
    const Outcome outcome = run_program(
        {"check", "cube.ply", "--repair", "--out", out, "--voxel", "0.05", "--json"}, folder.path());
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const json repair = json::parse(outcome.out)["repair"];
    EXPECT_EQ(repair["voxel"], 0.05);
    EXPECT_EQ(repair["filled_holes"], 1);
    EXPECT_NEAR(repair["volume_after"].get<double>(), 1, 0.03);
    EXPECT_LT(repair["moved"].get<double>(), 0.05);
    EXPECT_EQ(run_program({"check", out}, folder.path()).status, 0) << out;
  }
}

TEST(Check, WhatIsBadIsMendedWhereItIs) {
  const TemporaryFolder folder;
  write_mesh(folder / "cube.ply", cube_with_hole());
  const Outcome outcome = run_program({"check", "cube.ply", "--repair", "--out", "fixed.ply"}, folder.path());
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  expect_parts(outcome.out, {"mended where it was bad: 1 holes closed", "48 triangles"});
  EXPECT_EQ(run_program({"check", "fixed.ply"}, folder.path()).status, 0);
}

TEST(Check, LooseSeamsAreWeldedAndSaidSo) {
  const TemporaryFolder folder;
  const TriMesh good = cube();
  TriMesh loose;
  for (std::size_t t = 0; t < good.triangle_count(); ++t) {
    std::array<NodeId, 3> own;
    for (std::size_t k = 0; k < 3; ++k)
      own[k] =
          loose.positions.add(good.triangle(TriId(t))[k] +
                              2e-7 * Vec3(static_cast<double>(t % 3), static_cast<double>(t % 5) / 5, 0));
    loose.corners.push_back(own);
  }
  write_mesh(folder / "loose.ply", loose);
  const Outcome check = run_program({"check", "loose.ply"}, folder.path());
  EXPECT_EQ(check.status, 0) << check.err;
  expect_parts(check.out, {"nodes welded", "0.0001 of the edges", "can use it as it is"});
  folder.write("scene.toml",
               "[body]\nmesh = \"loose.ply\"\n[material]\nyoungs_modulus = 3e9\npoisson_ratio = 0.3\n");
  const Outcome mesh = run_program({"mesh", "scene.toml", "--out", "m.ply", "--json"}, folder.path());
  EXPECT_EQ(mesh.status, 0) << "a scene thinks the same of it: " << mesh.err;
  expect_parts(mesh.err, {"welded"});
  EXPECT_EQ(json::parse(mesh.out)["nodes"], 26);
}

TEST(Check, SeveralBodiesAreRefusedAndWrittenApart) {
  const TemporaryFolder folder;
  TriMesh hollow = icosphere(1, 2);
  append(hollow, flipped(icosphere(0.5, 1)));
  TriMesh mesh = hollow;
  append(mesh, cube(), Vec3(3, 0, 0));
  write_mesh(folder / "two.obj", mesh);
  folder.write("scene.toml",
               "[body]\nmesh = \"two.obj\"\n[material]\nyoungs_modulus = 3e9\n"
               "poisson_ratio = 0.3\n[[boundary]]\nregion = \"a\"\nfixed = true\n"
               "[[region]]\nname = \"a\"\nhalf_spaces = [[0, 0, -1, 0.2]]\n");
  const Outcome check = run_program({"check", "two.obj"}, folder.path());
  EXPECT_EQ(check.status, 1) << "as a run refuses it, too";
  expect_parts(check.out, {"2 separate bodies"});
  expect_parts(check.err, {"--split"});
  const Outcome run = run_program({"run", "scene.toml"}, folder.path());
  EXPECT_EQ(run.status, 2);
  expect_parts(run.err, {"2 separate bodies", "--split"});

  const Outcome split = run_program({"check", "two.obj", "--split", "parts", "--json"}, folder.path());
  EXPECT_EQ(split.status, 0) << split.err;
  ASSERT_EQ(json::parse(split.out)["split"].size(), 2u);
  EXPECT_EQ(read_mesh(folder / "parts/two_0.obj").triangle_count(), hollow.triangle_count())
      << "the cavity stays with its body";
  EXPECT_NEAR(enclosed_volume(read_mesh(folder / "parts/two_1.obj")), 1, 1e-12);
  EXPECT_EQ(run_program({"check", "parts/two_0.obj"}, folder.path()).status, 0);

  folder.write("taken", "");  // no folder
  const Outcome refused = run_program({"check", "two.obj", "--split", "taken"}, folder.path());
  EXPECT_EQ(refused.status, 2);
  expect_parts(refused.err, {"taken", "--split"});
}

TEST(Check, WhatIsGoodOrOnlyUntidyIsNotMoved) {
  const TemporaryFolder folder;
  write_mesh(folder / "good.obj", cube());
  TriMesh turned = cube();
  std::swap(turned.corners[TriId(5)][0], turned.corners[TriId(5)][1]);
  write_mesh(folder / "turned.ply", turned);
  const Outcome good = run_program({"check", "good.obj", "--repair", "--out", "same.obj"}, folder.path());
  EXPECT_EQ(good.status, 0) << good.err;
  expect_parts(good.out, {"same.obj: unchanged"});
  EXPECT_EQ(folder.read("same.obj"), folder.read("good.obj"));

  EXPECT_EQ(run_program({"check", "turned.ply"}, folder.path()).status, 1);
  const Outcome tidied = run_program({"check", "turned.ply", "--repair", "--out", "t.ply"}, folder.path());
  EXPECT_EQ(tidied.status, 0) << tidied.err;
  expect_parts(tidied.out, {"1 turned", "no point has moved"});
  EXPECT_EQ(read_mesh(folder / "t.ply").positions, turned.positions);
}

TEST(Check, BadUsageAndUnreadableFilesAreStatus2) {
  const TemporaryFolder folder;
  write_mesh(folder / "cube.ply", cube_with_hole());
  folder.write("broken.off", "OFF\n3 1 0\n0 0 0\n1 0\n");
  folder.write("cube.xyz", "");
  const std::vector<std::vector<std::string>> calls = {
      {"check"},
      {"check", "nowhere.ply"},
      {"check", "broken.off"},
      {"check", "cube.xyz"},
      {"check", "cube.ply", "--repair"},
      {"check", "cube.ply", "--voxel", "0.1"},
      {"check", "cube.ply", "--out", "fixed.ply"},
      {"check", "cube.ply", "--repair", "--out", "fixed.ply", "--voxel", "-1"},
      {"check", "cube.ply", "--repair", "--out", "fixed.ply", "--voxel", "1e-4"},
      {"check", "cube.ply", "--repair", "--out", "fixed.abc", "--voxel", "0.1"}};
  for (std::size_t i = 0; i < calls.size(); ++i) {
    const Outcome outcome = run_program(calls[i], folder.path());
    EXPECT_EQ(outcome.status, 2) << i;
    EXPECT_EQ(outcome.out, "") << i;
    EXPECT_NE(outcome.err, "") << i;
  }
  EXPECT_EQ(files_below(folder.path()).size(), 3u) << "nothing is left behind";
}

TEST(Check, NoVolumeCannotBeRepaired) {
  const TemporaryFolder folder;
  folder.write("sheet.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const Outcome outcome =
      run_program({"check", "sheet.off", "--repair", "--out", "fixed.ply"}, folder.path());
  EXPECT_EQ(outcome.status, 1);
  expect_parts(outcome.err, {"no volume"});
  EXPECT_EQ(files_below(folder.path()).size(), 1u);
}

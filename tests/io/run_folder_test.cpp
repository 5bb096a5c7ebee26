#include "conchoid/io/run_folder.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "conchoid/core/error.hpp"
#include "io/samples.hpp"
#include "refusal.hpp"

using namespace conchoid;
namespace fs = std::filesystem;

namespace {

std::vector<FrontRow> two_rows() {
  FrontRow a;
  a.frame = 1;
  a.node = 7;
  a.position = {0.1, 1.0 / 3.0, -2e-300};
  a.intensity = {1.234567890123e6, -5, 0};
  a.opening = {1e-9, 2e-9, 3e-9};
  a.speed = 931.7;
  a.kink_angle = -1.2309594173407747;
  FrontRow b = a;
  b.frame = 2;
  b.front = 1;
  return {a, b};
}

RunDocument document_of(const std::vector<Fragment>& fragments) {
  RunDocument d;
  d.scene_file = "cube.toml";
  d.scene_text = "[body]\nmodel = \"cube\"  # \"quoted\" \\ and µ\n";
  d.method = "bem";
  d.stop = StopReason::separated;
  d.frames = 17;
  d.initial_triangles = 120;
  d.final_triangles = 540;
  d.total_seconds = 2.5;
  d.opening_seconds = 1.25;
  d.fracture_seconds = 0.75;
  d.other_seconds = 0.5;
  d.opening_seconds_per_frame = 1.25 / 17;
  d.body = Box{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};
  d.body_volume = 1;
  d.settings = {{"run.frames", std::int64_t{30}},
                {"resolution.crack", 0.1},
                {"run.inertia", true},
                {"run.method", std::string("bem")}};
  d.versions = {{"conchoid", std::string("0.1.0")}};
  d.warnings = {"a warning"};
  d.timings = {{1, "bem", 24, 18, 0, 1.5e6, 0.1, 0.2, 0.3}};
  d.timings[0].expected_error = 0.004;
  d.solved_frames = 9;
  d.expected_error = 0.0045;
  for (const Fragment& f : fragments)
    d.fragments.push_back(fragment_record(f));
  d.contacts = {{0, 1, 1.0}};
  d.hash = "0123456789abcdef";
  return d;
}

FrameData frame_data() {
  FrameData data;
  data.time = 1e-5;
  data.body = box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  data.displacement.resize(8, Vec3(0, 0, 1e-4));
  data.traction.resize(12, Vec3(0, 0, 5e6));
  data.crack = sheet(2, 0);
  data.opening.resize(9, Vec3(0, 0, 1e-5));
  return data;
}

void write_whole_run(const fs::path& path) {
  RunFolder folder(path);
  folder.write_frame(1, frame_data());
  folder.write_frame(2, frame_data());
  folder.write_front_csv(two_rows());
  folder.write_crack(sheet(8, 0.1));
  folder.write_fragments(broken_cube(0.1));
  folder.write_run_json(document_of(broken_cube(0.1)));
}

}  // namespace

TEST(FrontCsv, RoundTripIsExact) {
  const TemporaryFolder folder;
  write_front_csv(folder / "front.csv", two_rows());
  const std::string text = file_content(folder / "front.csv");
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "frame,front,node,x,y,z,K_I,K_II,K_III,opening_I,opening_II,opening_III,speed,kink_angle");
  const auto back = read_front_csv(folder / "front.csv"), rows = two_rows();
  ASSERT_EQ(back.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back[i].frame, rows[i].frame);
    EXPECT_EQ(back[i].front, rows[i].front);
    EXPECT_EQ(back[i].node, rows[i].node);
    EXPECT_EQ(back[i].position, rows[i].position);
    EXPECT_EQ(back[i].intensity, rows[i].intensity);
    EXPECT_EQ(back[i].opening, rows[i].opening);
    EXPECT_EQ(back[i].speed, rows[i].speed);
    EXPECT_EQ(back[i].kink_angle, rows[i].kink_angle);
  }
}

TEST(FrontCsv, DamageIsNamedWithItsLine) {
  const TemporaryFolder folder;
  write_front_csv(folder / "front.csv", two_rows());
  const std::string text = file_content(folder / "front.csv");
  std::ofstream(folder / "cut.csv") << text.substr(0, text.size() - 30);
  EXPECT_NE(test::refusal([&] { read_front_csv(folder / "cut.csv"); }).find("line 3"), std::string::npos);
  std::ofstream(folder / "foreign.csv") << "a,b\n1,2\n";
  EXPECT_NE(test::refusal([&] { read_front_csv(folder / "foreign.csv"); }).find("'frame' is missing"),
            std::string::npos);
}

TEST(RunFolder, WhatWasWrittenComesBack) {
  const TemporaryFolder scratch;
  write_whole_run(scratch / "a/b/run");
  const RunData run = read_run(scratch / "a/b/run");
  EXPECT_EQ(run.document.scene_text, document_of({}).scene_text);
  EXPECT_EQ(run.document.stop, StopReason::separated);
  EXPECT_EQ(run.document.frames, 17);
  EXPECT_EQ(run.document.hash, "0123456789abcdef");
  ASSERT_TRUE(run.document.body.has_value());
  EXPECT_DOUBLE_EQ(run.document.body->diagonal(), std::sqrt(3.0));
  ASSERT_EQ(run.document.settings.size(), 4u);
  EXPECT_EQ(std::get<std::int64_t>(run.document.settings[0].value), 30);
  EXPECT_EQ(std::get<bool>(run.document.settings[2].value), true);
  ASSERT_EQ(run.document.timings.size(), 1u);
  EXPECT_EQ(run.document.timings[0].front_nodes, 18u);
  EXPECT_EQ(run.document.timings[0].expected_error, 0.004);
  EXPECT_EQ(run.document.solved_frames, 9);
  EXPECT_EQ(run.document.expected_error, 0.0045);
  EXPECT_EQ(run.crack.positions, sheet(8, 0.1).positions);
  EXPECT_EQ(run.front.size(), 2u);
  ASSERT_EQ(run.fragments.size(), 2u);
  EXPECT_DOUBLE_EQ(run.fragments[0].mass, 600);
  EXPECT_EQ(run.fragments[1].face_kind[0], FaceKind::fracture);
  EXPECT_EQ(run.fragments[1].inertia(1, 1), 2);
  for (const char* name : {"run.pvd", "frames/frame_0001.vtu", "frames/frame_0002.vtu",
                           "fragments/fragment_001.obj", "fragments.glb"})
    EXPECT_TRUE(fs::exists(scratch / "a/b/run" / name)) << name;
}

TEST(RunFolder, JsonOfTheCommandLineHasTheContractsKeys) {
  const auto json = nlohmann::json::parse(run_json(document_of(broken_cube(0.1)), RunJson::report));
  EXPECT_EQ(json["frames"], 17);
  EXPECT_EQ(json["stop"], "separated");
  EXPECT_EQ(json["triangles"]["final"], 540);
  EXPECT_EQ(json["seconds"]["opening"], 1.25);
  EXPECT_TRUE(json["opening_seconds_per_frame"].is_number());
  EXPECT_DOUBLE_EQ(json["fragments"][0]["volume"], 0.6);
  EXPECT_EQ(json["fragments"][0]["watertight"], true);
  EXPECT_DOUBLE_EQ(json["fragments"][0]["fracture_area"], 1.0);
  EXPECT_EQ(json["hash"], "0123456789abcdef");
  EXPECT_FALSE(json.contains("scene"));
}

TEST(RunFolder, EarlierRunIsReplacedButForeignFilesAreSafe) {
  const TemporaryFolder scratch;
  write_whole_run(scratch / "run");
  std::ofstream(scratch / "run/notes.txt") << "mine";
  RunFolder again(scratch / "run");
  EXPECT_FALSE(fs::exists(scratch / "run/run.json"));
  EXPECT_TRUE(fs::is_empty(scratch / "run/frames"));
  EXPECT_TRUE(fs::is_empty(scratch / "run/fragments"));
  EXPECT_EQ(file_content(scratch / "run/notes.txt"), "mine");

  fs::create_directory(scratch / "thesis");
  std::ofstream(scratch / "thesis/chapter.tex") << "x";
  EXPECT_NE(test::refusal([&] { RunFolder(scratch / "thesis"); }).find("new folder"), std::string::npos);
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch / "thesis"), fs::directory_iterator()), 1);
  std::ofstream(scratch / "file") << "x";
  EXPECT_NE(test::refusal([&] { RunFolder(scratch / "file"); }).find("is a file"), std::string::npos);
  EXPECT_NE(test::refusal([&] { RunFolder(scratch / "file/below"); }).find("cannot be written"),
            std::string::npos);
}

TEST(RunFolder, WhatAKilledRunLeftIsReplaced) {
  const TemporaryFolder scratch;
  const fs::path run = scratch / "run";
  fs::create_directories(run);
  std::ofstream(run / "run.pvd.tmp-1-0") << "half";
  { RunFolder first(run); }
  std::ofstream(run / "crack.ply.tmp-1-7") << "half";
  std::ofstream(run / "frames/frame_0003.vtu.tmp-1-8") << "half";
  RunFolder again(run);
  EXPECT_FALSE(fs::exists(run / "crack.ply.tmp-1-7"));
  EXPECT_TRUE(fs::is_empty(run / "frames"));
  EXPECT_EQ(file_content(run / "run.pvd").find("frame_"), std::string::npos);
}

TEST(RunFolder, HalfAndForeignFoldersAreRefusedByName) {
  const TemporaryFolder scratch;
  EXPECT_NE(test::refusal([&] { read_run(scratch / "none"); }).find("not a folder"), std::string::npos);
  for (const char* name : {"run.json", "crack.ply", "front.csv", "fragments/fragment_001.ply"}) {
    const fs::path path = scratch / "run";
    fs::remove_all(path);
    write_whole_run(path);
    fs::remove(path / name);
    EXPECT_NE(test::refusal([&] { read_run(path); }).find(name), std::string::npos) << name;
  }
  const fs::path path = scratch / "run";
  write_whole_run(path);
  for (const char* text :
       {"", "{", "[]", "{\"format\":\"other\"}", "{\"format\":\"conchoid-run\",\"version\":99}",
        "{\"format\":\"conchoid-run\",\"version\":1,\"frames\":\"many\"}"}) {
    std::ofstream(path / "run.json") << text;
    EXPECT_NE(test::refusal([&] { read_run(path); }).find("run.json"), std::string::npos) << text;
  }
}

TEST(RunFolder, ExaggeratedFramesShowTheOpenCrack) {
  const TemporaryFolder scratch;
  RunFolder folder(scratch / "run");
  FrameData data = frame_data();
  folder.write_frame(1, data);
  data.exaggeration = 1000;
  data.stress.resize(12, Mat3::Identity());
  folder.write_frame(2, data);
  const VtuMesh plain = read_vtu(scratch / "run/frames/frame_0001.vtu"),
                apart = read_vtu(scratch / "run/frames/frame_0002.vtu");
  ASSERT_EQ(plain.mesh.node_count(), 8u + 9u);
  ASSERT_EQ(apart.mesh.node_count(), 8u + 2 * 9u);
  EXPECT_EQ(apart.mesh.triangle_count(), 12u + 2 * 8u);
  EXPECT_NEAR(apart.mesh.positions[NodeId(0)].z(), -0.5 + 1000 * 1e-4, 1e-12);  // the body's displacement
  EXPECT_NEAR(apart.mesh.positions[NodeId(8)].z(), 500 * 1e-5, 1e-12);  // half the opening to each side
  EXPECT_NEAR(apart.mesh.positions[NodeId(17)].z(), -500 * 1e-5, 1e-12);
  const std::vector<double>& part = find_field(apart.triangle_fields, "part")->values;
  EXPECT_EQ(std::count(part.begin(), part.end(), 1.0), 8);
  EXPECT_EQ(std::count(part.begin(), part.end(), 2.0), 8);
  // the faces look at each other
  EXPECT_NEAR((unit_normal(apart.mesh, TriId(12)) + unit_normal(apart.mesh, TriId(20))).norm(), 0, 1e-12);
  EXPECT_EQ(find_field(apart.triangle_fields, "stress")->components, 6);
  EXPECT_EQ(find_field(plain.triangle_fields, "stress"), nullptr);
}

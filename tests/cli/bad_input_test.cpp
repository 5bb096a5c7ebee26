// Broken input given to the real program: exit status 2 (or 1), a message that names place and remedy,
// nothing on stdout, and no file left behind.

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <sstream>

#include "cli/program.hpp"
#include "conchoid/formats/formats.hpp"
#include "conchoid/learn/database.hpp"
#include "conchoid/learn/forest.hpp"
#include "conchoid/learn/ridge.hpp"
#include "conchoid/mesh/models.hpp"

using namespace conchoid;
using namespace conchoid::test;

namespace {

const std::string kMaterial = "[material]\nyoungs_modulus = 3.1e9\npoisson_ratio = 0.327\n";
const std::string kCube = "[body]\nmodel = \"cube\"\n" + kMaterial;
const std::string kHeld = "[[boundary]]\nregion = \"z-\"\nfixed = true\n";
const std::string kPulled = "[[boundary]]\nregion = \"z+\"\ntraction = [0.0, 0.0, 1e6]\n";
const std::string kPushedAside = "[[boundary]]\nregion = \"z+\"\ntraction = [1e6, 0.0, 0.0]\n";
const std::string kDisc = "[[crack]]\nkind = \"disc\"\nnormal = [0.0, 0.0, 1.0]\nradius = 0.2\n";
const std::string kMeshScene = "[body]\nmesh = \"body.off\"\n" + kMaterial;

/// A cube of 48 triangles, for tests that break it.
TriMesh cube() {
  return box_mesh(Vec3(1, 1, 1), 2, 2, 2);
}

std::string off_text(const TriMesh& mesh) {
  std::ostringstream text;
  text.precision(17);
  text << "OFF\n" << mesh.node_count() << ' ' << mesh.triangle_count() << " 0\n";
  for (const Vec3& x : mesh.positions)
    text << x.x() << ' ' << x.y() << ' ' << x.z() << '\n';
  for (const auto& c : mesh.corners)
    text << "3 " << c[0].value << ' ' << c[1].value << ' ' << c[2].value << '\n';
  return text.str();
}

std::string changed(const std::function<void(TriMesh&)>& change) {
  TriMesh mesh = cube();
  change(mesh);
  return off_text(mesh);
}

/// Samples that make sense to no one but pass every check.
Database small_database() {
  Database database;
  database.header.models = {"cube"};
  database.header.material = {3.1e9, 0.327, 1200, 7.6e7, 1e6, 3};
  database.header.resolution = 0.1;
  database.header.planned_runs = 4;
  for (int run = 0; run < 4; ++run) {
    RunRecord record;
    record.id = run;
    record.frames = 2;
    record.stop = "separated";
    record.samples = 10;
    for (int node = 0; node < 10; ++node) {
      Sample sample;
      sample.run = run;
      sample.frame = 2;
      sample.node = node;
      sample.K = Vec3(1e6 + 1e5 * node, 1e4 * run, 1e3 * node);
      sample.toughness = 1e6;
      sample.resolution = sample.distance_before = sample.distance_after = 0.1;
      sample.youngs_modulus = 3.1e9;
      sample.opening = Vec3(1e-5 * (node + 1), 1e-6 * run, 0);
      database.samples.add(sample);
    }
    database.runs.push_back(record);
  }
  return database;
}

void write_small_database(const std::filesystem::path& file) {
  write_database(file, small_database());
}

void write_small_forest(const std::filesystem::path& file) {
  RegressionForest::train(small_database().samples, {.trees = 2, .depth = 3}).save(file);
}

void write_small_ridge(const std::filesystem::path& file) {
  RidgeRegression::train(small_database().samples, {}).save(file);
}

std::string front_part(const std::string& text, double share) {
  return text.substr(0, static_cast<std::size_t>(share * static_cast<double>(text.size())));
}

std::string with_flipped_byte(std::string text, double where) {
  text[static_cast<std::size_t>(where * static_cast<double>(text.size()))] ^= 0x5a;
  return text;
}

using Files = std::function<void(const TemporaryFolder&)>;

Files scene(const std::string& text) {
  return [text](const TemporaryFolder& folder) { folder.write("scene.toml", text); };
}

Files mesh_scene(const std::string& body, const std::string& more = "") {
  return [body, more](const TemporaryFolder& folder) {
    folder.write("body.off", body);
    folder.write("scene.toml", kMeshScene + more);
  };
}

Files crack_scene(const std::string& sheet) {
  return [sheet](const TemporaryFolder& folder) {
    folder.write("sheet.off", sheet);
    folder.write("scene.toml",
                 kCube + kHeld + kPulled + "[[crack]]\nkind = \"mesh\"\nfile = \"sheet.off\"\n");
  };
}

/// A forest file, changed.
Files broken_forest(const std::function<std::string(const std::string&)>& change) {
  return [change](const TemporaryFolder& folder) {
    write_small_forest(folder / "good.forest");
    folder.write("broken.forest", change(folder.read("good.forest")));
    folder.write("scene.toml", kCube + kHeld + kPulled);
  };
}

Files broken_database(const std::function<std::string(const std::string&)>& change) {
  return [change](const TemporaryFolder& folder) {
    write_small_database(folder / "good.h5");
    folder.write("broken.h5", change(folder.read("good.h5")));
  };
}

void nothing(const TemporaryFolder&) {}

struct BadInput {
  const char* name;
  Files files;                         ///< written before
  std::vector<std::string> arguments;  ///< the program runs beside the files; results go to the folder out
  std::vector<const char*> said;       ///< parts of the message
  int status = 2;
};

void PrintTo(const BadInput& input, std::ostream* out) {
  *out << input.name;
}

const std::vector<std::string> kRun = {"run", "scene.toml", "--out", "out/run"};
const std::vector<std::string> kMesh = {"mesh", "scene.toml", "--out", "out/mesh.ply"};
const std::vector<std::string> kSif = {"sif", "scene.toml", "--json"};
const std::vector<std::string> kStress = {"stress", "scene.toml", "--json"};
const std::vector<std::string> kTrain = {"forest", "train", "broken.h5", "--out", "out/forest"};

const std::vector<BadInput> kBadInputs = {
    // usage
    {"no_command", nothing, {}, {"command is missing", "run"}},
    {"no_database_command", nothing, {"database"}, {"command is missing", "generate"}},
    {"unknown_command", nothing, {"rune", "scene.toml"}, {"rune"}},
    {"unknown_option", scene(kCube), {"run", "scene.toml", "--metod", "bem"}, {"--metod"}},
    {"missing_scene_argument", nothing, {"run"}, {"SCENE"}},
    {"negative_threads", scene(kCube), {"run", "scene.toml", "--threads", "-1"}, {"--threads"}},
    {"threads_text", scene(kCube), {"run", "scene.toml", "--threads", "two"}, {"--threads"}},
    {"zero_frames", scene(kCube), {"run", "scene.toml", "--frames", "0"}, {"--frames"}},
    {"unknown_method", scene(kCube), {"run", "scene.toml", "--method", "magic"}, {"--method"}},
    {"ridge_without_file", scene(kCube), {"run", "scene.toml", "--method", "ridge"}, {"--database FILE"}},
    {"database_of_unknown_name",
     scene(kCube),
     {"run", "scene.toml", "--method", "forest", "--database", "teapot"},
     {"teapot", "cube, cylinder, bar, edge-crack, armadillo, versatile", "forest train"}},
    {"bem_with_forest",
     broken_forest([](auto& f) { return f; }),
     {"run", "scene.toml", "--database", "good.forest"},
     {"--method forest"}},
    {"resume_without_out", scene(kCube + kHeld + kPulled), {"run", "scene.toml", "--resume"}, {"--out"}},
    {"hidden_feature_unknown",
     nothing,
     {"forest", "train", "a.h5", "--out", "out/f", "--hide", "wall*"},
     {"paper-4", "wall*", "K_c"}},
    {"depth_99", nothing, {"forest", "train", "a.h5", "--out", "out/f", "--depth", "99"}, {"--depth"}},
    {"unknown_features",
     nothing,
     {"forest", "train", "a.h5", "--out", "out/f", "--features", "all"},
     {"--features"}},
    {"evaluate_without_samples", nothing, {"forest", "evaluate", "f.forest"}, {"--samples"}},

    // scenes
    {"scene_missing", nothing, {"run", "nowhere.toml"}, {"nowhere.toml", "check the name"}},
    {"scene_is_folder", nothing, {"run", "out"}, {"out", "folder"}},
    {"scene_not_toml", scene("<xml/>"), kRun, {"scene.toml:1", "TOML"}},
    {"unknown_key", scene(kCube + "tougness = 1.0\n"), kRun, {"scene.toml:6", "did you mean toughness"}},
    {"wrong_type", scene(kCube + "toughness = \"high\"\n"), kRun, {"scene.toml:6", "number in Pa√m"}},
    {"nan_toughness", scene(kCube + "toughness = nan\n"), kRun, {"scene.toml:6", "finite"}},
    {"unknown_region",
     scene(kCube + "[[boundary]]\nregion = \"top\"\nfixed = true\n"),
     kRun,
     {"scene.toml:7", "z+"}},
    {"empty_region",
     scene(kCube + kHeld + "[[region]]\nname = \"sky\"\nhalf_spaces = [[0.0, 0.0, 1.0, 9.0]]\n"),
     kRun,
     {"scene.toml:9", "sky", "half spaces"}},
    {"two_conditions",
     scene(kCube + kHeld + "[[boundary]]\nregion = \"z-\"\ntraction = [0, 0, 1]\n"),
     kRun,
     {"scene.toml:10", "scene.toml:6"}},
    {"contradicting_displacements",
     scene(kCube + kHeld + "[[boundary]]\nregion = \"x-\"\ndisplacement = [0.0, 0.0, 1.0]\n"),
     kRun,
     {"scene.toml:9", "contradicts", "scene.toml:6"}},
    {"unbalanced_force", scene(kCube + kPulled), kRun, {"scene.toml:6", "balance", "inertia_relief"}},
    {"unbalanced_moment",
     scene(kCube + kPushedAside + "[[boundary]]\nregion = \"z-\"\ntraction = [-1e6, 0.0, 0.0]\n"),
     kStress,
     {"scene.toml:6", "balance", "moment"}},
    {"crack_outside",
     scene(kCube + kHeld + kPulled + kDisc + "center = [0.0, 0.0, 5.0]\n"),
     kSif,
     {"scene.toml:12", "outside"}},
    {"sif_without_crack", scene(kCube + kHeld + kPulled), kSif, {"scene.toml", "[[crack]]"}},
    {"infinite_without_crack", scene("[body]\nmodel = \"infinite\"\n" + kMaterial), kRun, {"[[crack]]"}},
    {"stress_of_infinite",
     scene("[body]\nmodel = \"infinite\"\n" + kMaterial + kDisc + "center = [0, 0, 0]\n"),
     kStress,
     {"scene.toml:1", "surface"}},
    {"mesh_of_infinite",
     scene("[body]\nmodel = \"infinite\"\n" + kMaterial + kDisc + "center = [0, 0, 0]\n"),
     kMesh,
     {"scene.toml:1", "surface"}},

    {"field_unknown_kind",
     scene(kCube + "[material.toughness_field]\nkind = \"wood\"\n"),
     kRun,
     {"scene.toml:7", "grains"}},
    {"field_without_size",
     scene(kCube + "[material.strength_field]\nkind = \"grains\"\n"),
     kRun,
     {"scene.toml:6", "size"}},
    {"field_foreign_vdb",
     [](const TemporaryFolder& folder) {
       folder.write("grains.vdb", "no voxels here");
       folder.write("scene.toml",
                    kCube + "[material.toughness_field]\nkind = \"vdb\"\nfile = \"grains.vdb\"\n");
     },
     kRun,
     {"scene.toml:8", "grains.vdb", "write it again"}},
    {"field_is_a_list_of_numbers",
     scene(kCube + "toughness_field = [1.0, 2.0]\n"),
     kRun,
     {"scene.toml:6", "[[material.toughness_field]]"}},

    // meshes
    {"mesh_missing", scene(kMeshScene), kMesh, {"scene.toml:2", "body.off"}},
    {"mesh_hole", mesh_scene(changed([](TriMesh& m) { m.corners.pop_back(); })), kMesh, {"body.off", "hole"}},
    {"mesh_flipped",
     mesh_scene(changed([](TriMesh& m) { std::swap(m.corners[TriId(7)][0], m.corners[TriId(7)][1]); })),
     kMesh,
     {"body.off", "7"}},
    {"mesh_duplicate",
     mesh_scene(changed([](TriMesh& m) { m.corners.push_back(m.corners[TriId(3)]); })),
     kMesh,
     {"body.off", "48"}},
    {"mesh_inside_out",
     mesh_scene(changed([](TriMesh& m) {
       for (auto& c : m.corners)
         std::swap(c[0], c[1]);
     })),
     kMesh,
     {"body.off", "inward"}},
    {"mesh_nan",
     mesh_scene(
         changed([](TriMesh& m) { m.positions[NodeId(5)].y() = std::numeric_limits<double>::quiet_NaN(); })),
     kMesh,
     {"body.off", "line 8"}},
    {"mesh_zero_volume",
     mesh_scene(changed([](TriMesh& m) {
       for (Vec3& x : m.positions)
         x.z() = 0;
     })),
     kMesh,
     {"body.off"}},
    {"mesh_degenerate",
     mesh_scene(changed(
         [](TriMesh& m) {
           const auto [a, b, c] = m.corners[TriId(0)];
           m.positions[a] = 0.5 * (m.positions[b] + m.positions[c]);
         })),
     kMesh,
     {"body.off", "triangle"}},
    {"mesh_self_intersection",
     mesh_scene(changed([](TriMesh& m) { m.positions[m.corners[TriId(0)][0]] *= -1.5; })),
     kMesh,
     {"body.off", "intersect"}},
    {"mesh_unused_node",
     mesh_scene(changed([](TriMesh& m) { m.positions.push_back(Vec3(2, 2, 2)); })),
     kMesh,
     {"body.off", "26"}},
    {"mesh_index_out_of_range",
     mesh_scene(changed([](TriMesh& m) { m.corners[TriId(2)][1] = NodeId(900); })),
     kMesh,
     {"body.off", "900"}},
    {"mesh_truncated", mesh_scene(front_part(off_text(cube()), 0.7)), kMesh, {"body.off"}},
    {"mesh_empty", mesh_scene(""), kMesh, {"body.off"}},
    {"mesh_no_triangles", mesh_scene("OFF\n0 0 0\n"), kMesh, {"body.off"}},
    {"mesh_foreign", mesh_scene("\x89PNG\r\n\x1a\n and so on"), kMesh, {"body.off"}},
    {"mesh_huge_count", mesh_scene("OFF\n99999999999 99999999999 0\n0 0 0\n"), kMesh, {"body.off"}},
    {"mesh_unknown_ending",
     [](const TemporaryFolder& folder) {
       folder.write("body.step", "ISO-10303-21;");
       folder.write("scene.toml", "[body]\nmesh = \"body.step\"\n" + kMaterial);
     },
     kMesh,
     {"body.step", ".ply"}},
    {"mesh_two_bodies",
     mesh_scene(changed([](TriMesh& m) {
       const TriMesh one = m;
       for (const Vec3& x : one.positions)
         m.positions.push_back(x + Vec3(3, 0, 0));
       for (const auto& c : one.corners)
         m.corners.push_back({NodeId(c[0].index() + one.node_count()),
                              NodeId(c[1].index() + one.node_count()),
                              NodeId(c[2].index() + one.node_count())});
     })),
     kStress,
     {"separate bodies"}},

    // crack meshes
    {"crack_mesh_flipped",
     crack_scene("OFF\n4 2 0\n0 0 0\n.1 0 0\n.1 .1 0\n0 .1 0\n3 0 1 2\n3 0 3 2\n"),
     kSif,
     {"sheet.off"}},
    {"crack_mesh_truncated", crack_scene("OFF\n4 2 0\n0 0 0\n.1 0 0\n"), kSif, {"sheet.off"}},
    {"crack_mesh_degenerate",
     crack_scene("OFF\n3 1 0\n0 0 0\n.1 0 0\n.2 0 0\n3 0 1 2\n"),
     kSif,
     {"sheet.off"}},

    // places to write to
    {"out_in_no_folder",
     scene(kCube),
     {"mesh", "scene.toml", "--out", "out/a/b/mesh.ply"},
     {"out/a/b/mesh.ply"}},
    {"out_unwritable", scene(kCube), {"mesh", "scene.toml", "--out", "/proc/mesh.ply"}, {"/proc/mesh.ply"}},
    {"out_unknown_ending", scene(kCube), {"mesh", "scene.toml", "--out", "out/mesh.doc"}, {"out/mesh.doc"}},
    {"run_out_is_file",
     scene(kCube + kHeld + kPulled),
     {"run", "scene.toml", "--out", "scene.toml"},
     {"scene.toml"}},
    {"run_out_unwritable",
     scene(kCube + kHeld + kPulled),
     {"run", "scene.toml", "--out", "/proc/run"},
     {"/proc/run"}},
    {"run_out_foreign_folder",
     scene(kCube + kHeld + kPulled),
     {"run", "scene.toml", "--out", "."},
     {"new folder"}},

    // databases
    {"database_missing", nothing, {"database", "info", "no.h5"}, {"no.h5"}},
    {"database_truncated",
     broken_database([](auto& f) { return front_part(f, 0.5); }),
     {"database", "info", "broken.h5"},
     {"broken.h5"}},
    {"database_empty",
     broken_database([](auto&) { return std::string(); }),
     {"database", "stats", "broken.h5"},
     {"broken.h5"}},
    {"database_foreign",
     broken_database([](auto&) { return std::string("a,b,c\n1,2,3\n"); }),
     kTrain,
     {"broken.h5"}},
    {"database_train_truncated",
     broken_database([](auto& f) { return front_part(f, 0.9); }),
     kTrain,
     {"broken.h5"}},
    {"database_merge_one",
     broken_database([](auto& f) { return f; }),
     {"database", "merge", "good.h5", "--out", "out/all.h5"},
     {"FILE"}},
    {"database_merge_foreign",
     broken_database([](auto&) { return std::string("x"); }),
     {"database", "merge", "good.h5", "broken.h5", "--out", "out/all.h5"},
     {"broken.h5"}},
    {"database_merge_different",
     [](const TemporaryFolder& folder) {
       Database other = small_database();
       write_database(folder / "a.h5", other);
       other.header.resolution = 0.2;
       write_database(folder / "b.h5", other);
     },
     {"database", "merge", "a.h5", "b.h5", "--out", "out/all.h5"},
     {"b.h5"}},
    {"generate_without_table",
     scene(kCube),
     {"database", "generate", "scene.toml", "--out", "out/a.h5"},
     {"scene.toml", "[database]"}},
    {"generate_bad_shard",
     scene(kCube),
     {"database", "generate", "scene.toml", "--out", "out/a.h5", "--shard", "3/2"},
     {"--shard"}},

    // forests
    {"forest_missing", nothing, {"forest", "info", "no.forest"}, {"no.forest"}},
    {"forest_truncated",
     broken_forest([](auto& f) { return front_part(f, 0.6); }),
     {"forest", "info", "broken.forest"},
     {"broken.forest"}},
    {"forest_cut_by_a_byte",
     broken_forest([](auto& f) { return f.substr(0, f.size() - 1); }),
     {"forest", "inspect", "broken.forest"},
     {"broken.forest"}},
    {"forest_corrupt",
     broken_forest([](auto& f) { return with_flipped_byte(f, 0.5); }),
     {"forest", "info", "broken.forest"},
     {"broken.forest"}},
    {"forest_foreign",
     broken_forest([](auto&) { return std::string("just text"); }),
     {"run", "scene.toml", "--method", "forest", "--database", "broken.forest", "--out", "out/run"},
     {"broken.forest"}},
    {"calibrated_by_nothing",
     broken_forest([](auto& f) { return f; }),
     {"forest", "calibrate", "good.forest", "no.h5", "--out", "out/forest"},
     {"no.h5"}},
    {"forest_for_ridge",
     broken_forest([](auto& f) { return f; }),
     {"run", "scene.toml", "--method", "ridge", "--database", "good.forest"},
     {"ridge regression", "--method forest"}},
    {"tolerance_of_another_method",
     nothing,
     {"run", "scene.toml", "--method", "kept", "--tolerance", "0.01"},
     {"--tolerance", "--method hybrid"}},
    {"tolerance_below_zero",
     nothing,
     {"run", "scene.toml", "--method", "hybrid", "--tolerance", "-1"},
     {"--tolerance"}},
    {"inspected_by_two_things",
     [](const TemporaryFolder& folder) { write_small_ridge(folder / "small.ridge"); },
     {"forest", "inspect", "small.ridge", "--samples", "a.h5", "--scene", "scene.toml"},
     {"--samples", "--scene"}},
    {"training_without_samples",
     [](const TemporaryFolder& folder) { write_small_ridge(folder / "small.ridge"); },
     {"forest", "inspect", "small.ridge", "--training", "a.h5"},
     {"--training", "--samples", "--scene"}},
    {"ridge_with_trees",
     [](const TemporaryFolder& folder) { write_small_database(folder / "good.h5"); },
     {"forest", "train", "good.h5", "--out", "out/f", "--model", "ridge", "--trees", "5"},
     {"--trees", "--lambda", "--model"}},
    {"ridge_has_no_trees",
     [](const TemporaryFolder& folder) { write_small_ridge(folder / "small.ridge"); },
     {"forest", "inspect", "small.ridge"},
     {"small.ridge", "forest info"}},
    {"unknown_model",
     nothing,
     {"forest", "train", "a.h5", "--out", "out/f", "--model", "oracle"},
     {"--model", "ridge"}},
    {"context_nowhere_recorded",
     [](const TemporaryFolder& folder) { write_small_database(folder / "good.h5"); },
     {"forest", "train", "good.h5", "--out", "out/f", "--features", "dimensionless-context"},
     {"front_curvature", "surface_distance", "traction_I"}},
    {"forest_is_database",
     [](const TemporaryFolder& folder) { write_small_database(folder / "good.h5"); },
     {"forest", "evaluate", "good.h5", "--samples", "good.h5"},
     {"good.h5"}},

    // runs
    {"compare_missing", nothing, {"compare", "a", "b"}, {"a"}},
    {"compare_foreign",
     [](const TemporaryFolder& folder) { std::filesystem::create_directories(folder / "a"); },
     {"compare", "a", "a"},
     {"run.json"}},
    {"compare_damaged",
     [](const TemporaryFolder& folder) {
       std::filesystem::create_directories(folder / "a");
       folder.write("a/run.json", "{\"conchoid\": ");
     },
     {"compare", "a", "a"},
     {"run.json"}},
    {"reproduce_unknown",
     nothing,
     {"reproduce", "table-1", "table-9", "--out", "out/study"},
     {"table-9", "figure-13", "tree-study"}},
    {"reproduce_nowhere", nothing, {"reproduce", "table-1"}, {"--out"}},
    {"reproduce_without_scan", nothing, {"reproduce", "figure-12", "--out", "out/study"}, {"--armadillo"}},
    {"picture_of_nothing", nothing, {"picture", "a", "--out", "out/a.png"}, {"a"}},
    {"picture_not_png", nothing, {"picture", "a", "--out", "out/a.jpg"}, {".png"}},
};

class BadInputTest : public testing::TestWithParam<BadInput> {};

}  // namespace

TEST_P(BadInputTest, IsRefusedWithPlaceAndRemedyAndLeavesNothing) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "out");
  GetParam().files(folder);
  const std::size_t before = files_below(folder.path()).size();

  const Outcome outcome = run_program(GetParam().arguments, folder.path());
  EXPECT_EQ(outcome.status, GetParam().status) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  for (const char* part : GetParam().said)
    EXPECT_NE(outcome.err.find(part), std::string::npos)
        << "“" << part << "” is not in “" << outcome.err << "”";
  EXPECT_EQ(outcome.err.find("mistake in conchoid"), std::string::npos) << outcome.err;
  EXPECT_TRUE(std::filesystem::is_empty(folder / "out"));
  EXPECT_EQ(files_below(folder.path()).size(), before);
}
INSTANTIATE_TEST_SUITE_P(All, BadInputTest, testing::ValuesIn(kBadInputs),
                         [](const auto& info) { return std::string(info.param.name); });

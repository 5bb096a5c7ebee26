// What scripts rely on: keys of the JSON, one object on stdout, exit status, files of a run.

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cli/program.hpp"

using namespace conchoid::test;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

const std::string kMaterial = "[material]\nyoungs_modulus = 3.1e9\npoisson_ratio = 0.327\n";
const std::string kPenny =
    "[body]\nmodel = \"infinite\"\n" + kMaterial +
    "[[crack]]\nkind = \"disc\"\ncenter = [0, 0, 0]\nnormal = [0, 0, 1]\nradius = 0.5\n"
    "triangles = 150\n[remote_stress]\ntensor = [0, 0, 1e6, 0, 0, 0]\n";
const std::string kPulledCube = "[body]\nmodel = \"cube\"\n" + kMaterial +
                                "[resolution]\ncrack = 0.2\nsurface = 0.05\n"
                                "[[boundary]]\nregion = \"z+\"\ntraction = [0, 0, 9e7]\n"
                                "[[boundary]]\nregion = \"z-\"\nfixed = true\n";
const std::string kSpec = "[body]\nmodel = \"cube\"\n" + kMaterial +
                          "[resolution]\ncrack = 0.25\nsurface = 0.1\n"
                          "[database]\nregions = [\"z+\", \"z-\"]\nmagnitude = [8e7, 1e8]\nslope = [0, 40]\n";

/// Runs the program, expects success and one JSON object on stdout.
json json_of(const TemporaryFolder& folder, std::vector<std::string> arguments) {
  arguments.push_back("--json");
  const Outcome outcome = run_program(arguments, folder.path());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const json result = json::parse(outcome.out, nullptr, false);
  EXPECT_TRUE(result.is_object()) << outcome.out;
  return result;
}

double norm(const json& v) {
  return std::hypot(v[0].get<double>(), v[1].get<double>(), v[2].get<double>());
}

}  // namespace

TEST(Usage, FoldersMayBeNamedAsCommandsAre) {
  const TemporaryFolder folder;
  folder.write("run", kPenny);
  json_of(folder, {"run", "run", "--out", "forest"});
  json_of(folder, {"run", "run", "--out", "bem"});
  json_of(folder, {"compare", "bem", "forest"});
  json_of(folder, {"picture", "bem", "forest", "--width", "64", "--height", "64", "--out", "both.png"});
  EXPECT_TRUE(fs::exists(folder / "both.png"));
  const Outcome two = run_program({"sif", "run", "stress", "run"}, folder.path());
  EXPECT_EQ(two.status, 2) << two.out;
}

TEST(Run, OneOfASpecificationIsItsSceneUnderTheDrawnLoad) {
  const TemporaryFolder folder;
  const std::string body =
      "[body]\nmodel = \"cube\"\n" + kMaterial + "[resolution]\ncrack = 0.25\nsurface = 0.1\n";
  folder.write("spec.toml", body +
                                "[database]\nregions = [\"z+\", \"z-\"]\nmagnitude = [9e7, 9e7]\n"
                                "slope = [0, 0]\n");
  folder.write("scene.toml", body +
                                 "[[boundary]]\nregion = \"z+\"\ntraction = [0, 0, 9e7]\n"
                                 "[[boundary]]\nregion = \"z-\"\ntraction = [0, 0, -9e7]\n"
                                 "[run]\ninertia_relief = true\n");
  const json drawn = json_of(folder, {"run", "spec.toml", "--run", "3", "--out", "drawn"});
  EXPECT_EQ(drawn["hash"], json_of(folder, {"run", "scene.toml"})["hash"]);
  const json again = json_of(folder, {"run", "spec.toml", "--run", "3", "--out", "drawn", "--resume"});
  EXPECT_EQ(drawn["hash"], again["hash"]);
  const Outcome other =
      run_program({"run", "spec.toml", "--run", "4", "--out", "drawn", "--resume"}, folder.path());
  EXPECT_EQ(other.status, 2) << "it is another run";
}

TEST(Run, OneOfAWorldIsTheSameEveryTime) {
  const TemporaryFolder folder;
  folder.write("world.toml",
               "[world]\nelements = 60\nclasses = [\"box\", \"rod\"]\n[database]\nframes = 2\n");
  const json first = json_of(folder, {"run", "world.toml", "--run", "1"});
  EXPECT_EQ(first["frames"], 2);
  EXPECT_EQ(first["hash"], json_of(folder, {"run", "world.toml", "--run", "1"})["hash"]);
  EXPECT_NE(first["hash"], json_of(folder, {"run", "world.toml", "--run", "4"})["hash"]);
}

TEST(Help, EverySubCommandExplainsItself) {
  const TemporaryFolder folder;
  const std::vector<std::vector<std::string>> commands = {{"run"},
                                                          {"sif"},
                                                          {"stress"},
                                                          {"mesh"},
                                                          {"check"},
                                                          {"compare"},
                                                          {"reproduce"},
                                                          {"picture"},
                                                          {"help-scene"},
                                                          {"database", "generate"},
                                                          {"database", "info"},
                                                          {"database", "stats"},
                                                          {"database", "merge"},
                                                          {"forest", "train"},
                                                          {"forest", "info"},
                                                          {"forest", "evaluate"},
                                                          {"forest", "inspect"}};
  for (std::vector<std::string> command : commands) {
    command.push_back("--help");
    const Outcome outcome = run_program(command, folder.path());
    EXPECT_EQ(outcome.status, 0) << command[0];
    EXPECT_EQ(outcome.err, "") << command[0];
    for (const char* option : {"--threads", "--quiet", "--json"})
      EXPECT_NE(outcome.out.find(option), std::string::npos) << command[0] << " " << option;
  }
}

TEST(Help, RunTellsUnitsRangesAndDefaults) {
  const TemporaryFolder folder;
  const std::string help = run_program({"run", "--help"}, folder.path()).out;
  for (const char* part : {"poisson_ratio", "> -1 and < 0.5", "kg/m³", "two-point", "frames (whole number"})
    EXPECT_NE(help.find(part), std::string::npos) << part;
}

TEST(Sif, ThePennyCrackOpensInModeI) {
  const TemporaryFolder folder;
  folder.write("penny.toml", kPenny);
  const json report = json_of(folder, {"sif", "penny.toml"});
  EXPECT_EQ(report["triangles"], 150);
  ASSERT_EQ(report["fronts"].size(), 1u);
  const json& nodes = report["fronts"][0]["nodes"];
  ASSERT_EQ(nodes.size(), 30u);
  const double exact = 2e6 * std::sqrt(0.5 / std::numbers::pi);
  for (const json& node : nodes) {
    EXPECT_NEAR(norm(node["x"]), 0.5, 1e-12);
    EXPECT_NEAR(node["K"][0].get<double>(), exact, 0.06 * exact);
    EXPECT_NEAR(std::abs(node["e1"][2].get<double>()), 1, 1e-12);
    for (const char* axis : {"e1", "e2", "e3"})
      EXPECT_NEAR(norm(node[axis]), 1, 1e-12);
  }
}

TEST(Stress, AUniformPullIsSeenEverywhere) {
  const TemporaryFolder folder;
  folder.write("pull.toml", "[body]\nmodel = \"cube\"\n" + kMaterial +
                                "[[boundary]]\nregion = \"z+\"\ntraction = [0, 0, 1e6]\n"
                                "[[boundary]]\nregion = \"z-\"\ntraction = [0, 0, -1e6]\n");
  const json report = json_of(folder, {"stress", "pull.toml"});
  EXPECT_NEAR(report["max_principal"].get<double>(), 1e6, 1e4);
  ASSERT_EQ(report["triangles"].size(), 120u);
  for (const json& t : report["triangles"]) {
    EXPECT_NEAR(t["principal"][0].get<double>(), 1e6, 1e4);
    EXPECT_GE(t["principal"][1].get<double>(), t["principal"][2].get<double>());
    EXPECT_EQ(t["centroid"].size(), 3u);
    EXPECT_EQ(t["region"].get<std::string>().size(), 2u);
  }
}

TEST(Mesh, TheFileIsTheModel) {
  const TemporaryFolder folder;
  folder.write("cube.toml", "[body]\nmodel = \"cube\"\nscale = 2.0\n" + kMaterial);
  const json report = json_of(folder, {"mesh", "cube.toml", "--out", "cube.off"});
  EXPECT_EQ(report["triangles"], 120);
  EXPECT_NEAR(report["volume"].get<double>(), 8, 1e-12);
  EXPECT_TRUE(folder.read("cube.off").starts_with("OFF"));
}

TEST(Run, TheReportHoldsWhatTheContractNames) {
  const TemporaryFolder folder;
  folder.write("cube.toml", kPulledCube);
  const json report = json_of(folder, {"run", "cube.toml", "--out", "run"});
  EXPECT_EQ(report["stop"], "separated");
  ASSERT_GE(report["fragments"].size(), 2u);
  double volume = 0;
  for (const json& fragment : report["fragments"]) {
    EXPECT_TRUE(fragment["watertight"].get<bool>());
    volume += fragment["volume"].get<double>();
  }
  EXPECT_NEAR(volume, 1, 0.005);
  EXPECT_EQ(report["triangles"]["initial"], 120);
  EXPECT_GT(report["triangles"]["final"], 120);
  for (const char* part : {"total", "opening", "fracture", "other"})
    EXPECT_GE(report["seconds"][part].get<double>(), 0) << part;
  EXPECT_GT(report["opening_seconds_per_frame"].get<double>(), 0);
  for (const char* file : {"run.json", "run.pvd", "front.csv", "crack.ply", "fragments.glb",
                           "fragments/fragment_000.ply", "fragments/fragment_001.obj"})
    EXPECT_TRUE(fs::exists(folder / "run" / file)) << file;

  const json again = json_of(folder, {"run", "cube.toml", "--threads", "1", "--quiet"});
  EXPECT_EQ(again["hash"], report["hash"]) << "the same with one thread, without files";
}

TEST(Run, WithoutOutNothingIsWritten) {
  const TemporaryFolder folder;
  folder.write("cube.toml", kPulledCube);
  EXPECT_EQ(run_program({"run", "cube.toml", "--frames", "1"}, folder.path()).status, 0);
  EXPECT_EQ(files_below(folder.path()).size(), 1u);
}

TEST(Run, AFinishedRunIsKeptByResume) {
  const TemporaryFolder folder;
  folder.write("cube.toml", kPulledCube);
  json_of(folder, {"run", "cube.toml", "--frames", "2", "--out", "run"});
  const auto written = fs::last_write_time(folder / "run/run.json");
  const json again = json_of(folder, {"run", "cube.toml", "--frames", "2", "--out", "run", "--resume"});
  EXPECT_EQ(fs::last_write_time(folder / "run/run.json"), written);
  EXPECT_EQ(again["frames"], 2);
}

TEST(Run, TheSteadyRunIsComparedWithTheSolvedOne) {
  const TemporaryFolder folder;
  folder.write("cube.toml", kPulledCube);
  json_of(folder, {"run", "cube.toml", "--out", "a"});
  json_of(folder, {"run", "cube.toml", "--method", "steady", "--out", "b"});
  const json same = json_of(folder, {"compare", "a", "a"});
  EXPECT_LT(same["surface_mean"].get<double>(), 1e-9);
  EXPECT_NEAR(same["area_ratio"].get<double>(), 1, 1e-12);
  const json other = json_of(folder, {"compare", "a", "b"});
  EXPECT_LT(other["surface_mean"].get<double>(), 0.1 * other["bbox_diagonal"].get<double>());
  EXPECT_GE(other["surface_p95"].get<double>(), other["surface_mean"].get<double>());
  EXPECT_EQ(other["frames"].size(), 2u);
  EXPECT_TRUE(other["sif_log_error"].contains("III"));
  EXPECT_TRUE(other.contains("largest_fragment_iou"));
}

// A solved scene measures around its fronts what the regressor looks at.
TEST(Prediction, AForestForAnyBodyIsInspectedByAScene) {
  const TemporaryFolder folder;
  folder.write("cube.toml", kPulledCube);
  const json coverage =
      json_of(folder, {"forest", "inspect", "versatile", "--scene", "cube.toml"})["coverage"];
  ASSERT_GT(coverage["samples"].get<int>(), 0);
  for (const auto& feature : coverage["features"])
    if (feature["name"] == "r_bar/crack_radius" || feature["name"] == "wall") {
      EXPECT_GT(feature["median"].get<double>(), 0) << feature["name"];
    }
}

TEST(Prediction, HybridTakesTheNetworksThatComeWithTheProgramAndKeptWhereNoneIsWanted) {
  const TemporaryFolder folder;
  folder.write("cube.toml", kPulledCube);
  const auto hash_of = [&](const std::vector<std::string>& options) {
    std::vector<std::string> all = {"run", "cube.toml", "--method"};
    all.insert(all.end(), options.begin(), options.end());
    return json_of(folder, all)["hash"];
  };
  const json by_networks = hash_of({"network"}), kept = hash_of({"kept"});
  EXPECT_NE(by_networks, kept);
  EXPECT_EQ(hash_of({"hybrid", "--tolerance", "inf"}), by_networks);
  EXPECT_EQ(hash_of({"hybrid", "--tolerance", "inf", "--database", "versatile"}), by_networks);
  EXPECT_EQ(hash_of({"hybrid", "--tolerance", "inf", "--database", "none"}), kept);
}

TEST(Prediction, FromSpecificationToPredictedRun) {
  const TemporaryFolder folder;
  folder.write("spec.toml", kSpec);
  folder.write("cube.toml", kPulledCube);
  const json info = json_of(folder, {"database", "generate", "spec.toml", "--runs", "4", "--out", "cube.h5"});
  EXPECT_EQ(info["runs"], 4);
  EXPECT_TRUE(info["complete"].get<bool>());
  EXPECT_GT(info["samples"].get<int>(), 0);
  EXPECT_EQ(info["models"], json::array({"cube"}));
  EXPECT_EQ(info["material"]["poisson_ratio"], 0.327);

  folder.write("unseen.toml", kSpec + "seed = 99\n");
  json_of(folder, {"database", "generate", "unseen.toml", "--runs", "30", "--out", "unseen.h5"});

  const std::vector<std::pair<std::string, std::vector<std::string>>> models = {
      {"forest", {"--trees", "10", "--depth", "6"}},
      {"boosted", {"--trees", "10", "--depth", "4"}},
      {"network", {"--width", "8", "--epochs", "5"}},
      {"ridge", {"--degree", "1"}}};
  for (const auto& [model, options] : models) {
    std::vector<std::string> train = {"forest", "train", "cube.h5", "--out", model, "--model", model};
    train.insert(train.end(), options.begin(), options.end());
    const json trained = json_of(folder, train);
    EXPECT_EQ(trained["model"], model);
    EXPECT_EQ(json_of(folder, {"forest", "info", model}), trained);
    const json accuracy = json_of(folder, {"forest", "evaluate", model, "--samples", "cube.h5"});
    EXPECT_EQ(accuracy["samples"].get<int>(), info["training_samples"].get<int>() -
                                                  info["end_game_samples"].get<int>() -
                                                  info["new_node_samples"].get<int>());
    for (const char* mode : {"I", "II", "III"}) {
      EXPECT_TRUE(accuracy["rmse"].contains(mode));
      EXPECT_TRUE(accuracy["r2"].contains(mode));
      EXPECT_TRUE(accuracy["baseline_steady"]["r2"].contains(mode));
    }
    const json run = json_of(folder, {"run", "cube.toml", "--method", model, "--database", model});
    EXPECT_GT(run["frames"].get<int>(), 1);
    const json pure = json_of(
        folder, {"run", "cube.toml", "--method", "hybrid", "--tolerance", "inf", "--database", model});
    EXPECT_EQ(pure["hash"], run["hash"]);
    EXPECT_EQ(pure["solved_frames"], 1);
    EXPECT_GT(pure["expected_error"].get<double>(), 0);
    EXPECT_TRUE(trained["calibration"].is_null());
    if (model == "forest" || model == "ridge") {  // the others are of one set, as four runs make no groups
      const json calibrated =
          json_of(folder, {"forest", "calibrate", model, "unseen.h5", "--out", "calibrated"});
      EXPECT_EQ(calibrated["calibration"].size(), 3u);
      EXPECT_GT(calibrated["calibration"][0][0]["found"].get<double>(), 0);
      EXPECT_EQ(json_of(folder, {"forest", "info", "calibrated"}), calibrated);
      const json same = json_of(folder, {"run", "cube.toml", "--method", model, "--database", "calibrated"});
      EXPECT_EQ(same["hash"], run["hash"]);  // of what it states, not of what it answers
    }
    const json seen =
        json_of(folder, {"forest", "inspect", model, "--samples", "cube.h5", "--training", "cube.h5"});
    EXPECT_EQ(seen["modes"].is_null(), model == "ridge" || model == "network");
    EXPECT_EQ(seen["coverage"]["in_range"], accuracy["samples"]);
    EXPECT_EQ(seen["coverage"]["neighbours"]["median"], 0.0);
    EXPECT_EQ(seen["features"].size(), seen["coverage"]["features"].size());
    EXPECT_EQ(seen["accuracy"][model]["r2"], accuracy["r2"]);
    const json by_scene = json_of(folder, {"forest", "inspect", model, "--scene", "cube.toml"});
    EXPECT_GT(by_scene["coverage"]["samples"].get<int>(), 0);
    EXPECT_FALSE(by_scene["coverage"].contains("neighbours"));
  }
}

TEST(Database, ShardsMergeToTheWhole) {
  const TemporaryFolder folder;
  folder.write("spec.toml", kSpec);
  const json whole = json_of(folder, {"database", "generate", "spec.toml", "--runs", "3", "--out", "all.h5"});
  json_of(folder, {"database", "generate", "spec.toml", "--runs", "3", "--shard", "1/2", "--out", "a.h5"});
  json_of(folder, {"database", "generate", "spec.toml", "--runs", "3", "--shard", "2/2", "--out", "b.h5",
                   "--threads", "1"});
  const json merged = json_of(folder, {"database", "merge", "b.h5", "a.h5", "--out", "merged.h5"});
  EXPECT_EQ(merged["runs"], 3);
  EXPECT_EQ(merged["samples"], whole["samples"]);
  EXPECT_EQ(merged["hash"], whole["hash"]);
}

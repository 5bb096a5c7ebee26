// A scene whose material is a .vdb file beside it, run the way a user does.

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cli/program.hpp"
#include "vdb_file.hpp"

using namespace conchoid;
using namespace conchoid::test;
using nlohmann::json;

namespace {

/// @param field  keys of the toughness field
std::string scene(const std::string& field) {
  return "[body]\nmodel = \"cube\"\n"
         "[material]\nname = \"glass\"\n[material.toughness_field]\n" +
         field +
         "[resolution]\ncrack = 0.2\nsurface = 0.04\n"
         "[[crack]]\nkind = \"disc\"\ncenter = [0, 0, 0]\nnormal = [0, 0, 1]\nradius = 0.25\n"
         "[[boundary]]\nregion = \"z+\"\ntraction = [0, 0, 1e7]\n"
         "[[boundary]]\nregion = \"z-\"\ntraction = [0, 0, -1e7]\n"
         "[run]\nmax_cracks = 0\n";
}

json report(const std::vector<std::string>& arguments, const std::filesystem::path& folder) {
  const Outcome outcome = run_program(arguments, folder);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return json::parse(outcome.out, nullptr, false);
}

}  // namespace

TEST(VoxelField, ItsFileIsFoundBesideTheScene) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "scenes/fields");
  write_vdb(folder / "scenes/fields/stone.vdb",
            {sampled_grid("K", 2.5, {0, 0, 0}, {0, 0, 11}, [](const Vec3& x) {  // layers of 30 cm, in cm
              return 1 + 0.3 * std::sin(2 * std::numbers::pi * (x[2] / 30 + 0.25));
            })});
  const std::string tilted = "axes = [[4, 0, -1], [0, 1, 0], [1, 0, 4]]\n";
  const std::string keys = "kind = \"vdb\"\ngrid = \"K\"\nscale = 0.01\noutside = \"periodic\"\n" + tilted;
  folder.write("scenes/stone.toml", scene(keys + "file = \"fields/stone.vdb\"\n"));
  folder.write("scenes/layers.toml",
               scene("kind = \"layers\"\nwavelength = 0.3\namplitude = 0.3\nphase = -0.25\n" + tilted));
  folder.write("scenes/plain.toml", scene("kind = \"homogeneous\"\n"));
  folder.write("missing.toml", scene(keys + "file = \"fields/stone.vdb\"\n"));

  const json from_above = report({"run", "scenes/stone.toml", "--json", "--out", "stone"}, folder.path());
  EXPECT_EQ(from_above["stop"], "separated");
  EXPECT_EQ(from_above["fragments"].size(), 2u);
  const json from_beside = report({"run", "stone.toml", "--json"}, folder / "scenes");
  EXPECT_EQ(from_above["hash"], from_beside["hash"]);

  report({"run", "scenes/layers.toml", "--json", "--out", "layers"}, folder.path());
  report({"run", "scenes/plain.toml", "--json", "--out", "plain"}, folder.path());
  const double same = report({"compare", "stone", "layers", "--json"}, folder.path())["surface_mean"];
  const double other = report({"compare", "stone", "plain", "--json"}, folder.path())["surface_mean"];
  constexpr double kSurface = 0.04;
  EXPECT_LT(same, 0.1 * kSurface);
  EXPECT_GT(other, 0.25 * kSurface);  // the field was felt
  RecordProperty("layers", std::to_string(same));
  RecordProperty("plain", std::to_string(other));

  const Outcome missing = run_program({"run", "missing.toml"}, folder.path());
  EXPECT_EQ(missing.status, 2);
  EXPECT_NE(missing.err.find("stone.vdb"), std::string::npos) << missing.err;
}

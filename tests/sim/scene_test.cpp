#include "conchoid/sim/scene.hpp"

#include <gtest/gtest.h>

#include "conchoid/core/error.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/sim/settings.hpp"
#include "refusal.hpp"
#include "temporary_folder.hpp"

using namespace conchoid;

namespace {

const std::string kMaterial = "[material]\nyoungs_modulus = 3.1e9\npoisson_ratio = 0.327\n";
const std::string kCube = "[body]\nmodel = \"cube\"\n" + kMaterial;
const std::string kInfinite = "[body]\nmodel = \"infinite\"\n" + kMaterial;

Scene parse(const std::string& text) {
  return parse_scene(text, "scene.toml", ".");
}

std::string error_of(const std::string& text) {
  return test::refusal([&] { parse(text); });
}

struct BrokenScene {
  const char* name;
  std::string text;
  std::vector<const char*> said;  ///< parts of the message
};

void PrintTo(const BrokenScene& s, std::ostream* out) {
  *out << s.name;
}

class BrokenSceneTest : public testing::TestWithParam<BrokenScene> {};

const std::string kTop = "[[boundary]]\nregion = \"z+\"\n";
const std::string kDisc = "[[crack]]\nkind = \"disc\"\ncenter = [0.0, 0.0, 0.0]\nnormal = [0.0, 0.0, 1.0]\n";
const std::string kRectangle = "[[crack]]\nkind = \"rectangle\"\ncenter = [0, 0, 0]\n";

const BrokenScene kBroken[] = {
    {"empty", "", {"scene.toml:1", "[body]"}},
    {"no_material", "[body]\nmodel = \"cube\"\n", {"scene.toml:1", "[material]"}},
    {"syntax", kCube + "[run\n", {"scene.toml:6", "TOML"}},
    {"repeated_key", kCube + "youngs_modulus = 2\n", {"scene.toml:6", "TOML"}},
    {"unknown_table", kCube + "[materials]\n", {"scene.toml:6", "did you mean material?"}},
    {"database_table", kCube + "[database]\nruns = 3\n", {"scene.toml:6", "database"}},
    {"unknown_key", kCube + "tougness = 1e6\n", {"scene.toml:6", "tougness", "did you mean toughness?"}},
    {"unknown_key_like_nothing", kCube + "colour = 1\n", {"scene.toml:6", "known are", "density"}},
    {"list_for_table", "body = 3\n" + kMaterial, {"scene.toml:1", "[body]"}},
    {"table_for_list", kCube + "[crack]\nkind = \"disc\"\n", {"scene.toml:6", "[[crack]]"}},
    {"no_model_no_mesh", "[body]\nscale = 2.0\n" + kMaterial, {"scene.toml:1", "model, mesh"}},
    {"model_and_mesh",
     "[body]\nmodel = \"cube\"\nmesh = \"a.ply\"\n" + kMaterial,
     {"scene.toml:3", "contradict"}},
    {"unknown_model", "[body]\nmodel = \"cubes\"\n" + kMaterial, {"scene.toml:2", "did you mean \"cube\"?"}},
    {"missing_mesh", "[body]\nmesh = \"nowhere.ply\"\n" + kMaterial, {"scene.toml:2", "nowhere.ply"}},
    {"negative_scale", "[body]\nmodel = \"cube\"\nscale = -1.0\n" + kMaterial, {"scene.toml:3", "> 0"}},
    {"remesh_infinite",
     "[body]\nmodel = \"infinite\"\nremesh = 100\n" + kMaterial,
     {"scene.toml:3", "remove"}},
    {"modulus_zero",
     "[material]\nyoungs_modulus = 0\npoisson_ratio = 0.3\n[body]\nmodel = \"cube\"\n",
     {"scene.toml:2", "youngs_modulus", "> 0 Pa"}},
    {"modulus_nan",
     "[material]\nyoungs_modulus = nan\npoisson_ratio = 0.3\n[body]\nmodel = \"cube\"\n",
     {"scene.toml:2", "finite"}},
    {"modulus_infinite",
     "[material]\nyoungs_modulus = inf\npoisson_ratio = 0.3\n[body]\nmodel = \"cube\"\n",
     {"scene.toml:2", "finite"}},
    {"modulus_text",
     "[material]\nyoungs_modulus = \"3e9\"\npoisson_ratio = 0.3\n[body]\nmodel = \"cube\"\n",
     {"scene.toml:2", "a text", "a number in Pa"}},
    {"modulus_missing",
     "[material]\npoisson_ratio = 0.3\n[body]\nmodel = \"cube\"\n",
     {"scene.toml:1", "youngs_modulus"}},
    {"incompressible",
     "[material]\nyoungs_modulus = 1\npoisson_ratio = 0.5\n[body]\nmodel = \"cube\"\n",
     {"scene.toml:3", "poisson_ratio", "< 0.5"}},
    {"poisson_too_low",
     "[material]\nyoungs_modulus = 1\npoisson_ratio = -1\n[body]\nmodel = \"cube\"\n",
     {"scene.toml:3", "> -1"}},
    {"unknown_material",
     "[body]\nmodel = \"cube\"\n[material]\nname = \"marbel\"\n",
     {"scene.toml:4", "did you mean \"marble\"?"}},
    {"negative_toughness", kCube + "toughness = -1.0\n", {"scene.toml:6", "> 0 Pa√m"}},
    {"compressive_factor", kCube + "compressive_factor = 0.5\n", {"scene.toml:6", "≥ 1"}},
    {"field_kind",
     kCube + "[material.toughness_field]\nkind = \"grain\"\n",
     {"scene.toml:7", "did you mean \"grains\"?", "layers"}},
    {"field_without_kind",
     kCube + "[material.strength_field]\namplitude = 0.5\n",
     {"scene.toml:6", "[material.strength_field] lacks kind"}},
    {"field_unknown_key",
     kCube + "[material.strength_field]\nkind = \"noise\"\nwavelenght = 0.5\n",
     {"scene.toml:8", "did you mean wavelength?"}},
    {"field_foreign_key",
     kCube + "[material.toughness_field]\nkind = \"grains\"\nsize = 0.1\noctaves = 3\n",
     {"scene.toml:9", "octaves", "noise", "remove"}},
    {"field_key_of_homogeneous",
     kCube + "[material.toughness_field]\nkind = \"homogeneous\"\nseed = 3\n",
     {"scene.toml:8", "seed", "remove"}},
    {"layers_without_wavelength",
     kCube + "[material.toughness_field]\nkind = \"layers\"\namplitude = 0.3\n",
     {"scene.toml:6", "lacks wavelength"}},
    {"layers_too_strong",
     kCube + "[material.toughness_field]\nkind = \"layers\"\nwavelength = 0.1\namplitude = 1.0\n",
     {"scene.toml:9", "< 1"}},
    {"layers_no_direction",
     kCube + "[material.toughness_field]\nkind = \"layers\"\nwavelength = 0.1\namplitude = "
             "0.3\ndirection = [0, 0, 0]\n",
     {"scene.toml:10", "(0, 0, 0)"}},
    {"grains_weakening_one",
     kCube + "[material.toughness_field]\nkind = \"grains\"\nsize = 0.1\nweakening = 1.0\n",
     {"scene.toml:9", "weakening", "< 1"}},
    {"grains_thin_boundaries",
     kCube + "[material.toughness_field]\nkind = \"grains\"\nsize = 0.1\nwidth = 0.001\n",
     {"scene.toml:9", "width", "size / 50"}},
    {"grains_stretch",
     kCube + "[material.toughness_field]\nkind = \"grains\"\nsize = 0.1\nstretch = [1, 1, 0]\n",
     {"scene.toml:9", "> 0"}},
    {"noise_octaves",
     kCube + "[material.toughness_field]\nkind = \"noise\"\nwavelength = 0.1\namplitude = 0.2\noctaves = "
             "40\n",
     {"scene.toml:10", "1 … 16"}},
    {"field_axes_oblique",
     kCube + "[material.toughness_field]\nkind = \"grains\"\nsize = 0.1\naxes = [[1, 0, 0], [1, 1, 0], "
             "[0, 0, 1]]\n",
     {"scene.toml:9", "right angles"}},
    {"field_two_axes",
     kCube + "[material.toughness_field]\nkind = \"grains\"\nsize = 0.1\naxes = [[1, 0, 0], [0, 1, 0]]\n",
     {"scene.toml:9", "must hold 3"}},
    {"field_in_a_list_wrong_there",
     kCube + "[[material.toughness_field]]\nkind = \"grains\"\nsize = 0.1\n[[material.toughness_field]]\n"
             "kind = \"noise\"\nwavelength = -1\namplitude = 0.2\n",
     {"scene.toml:11", "wavelength", "> 0 m"}},
    {"vdb_missing",
     kCube + "[material.toughness_field]\nkind = \"vdb\"\nfile = \"nowhere.vdb\"\n",
     {"scene.toml:8", "nowhere.vdb"}},
    {"resolution_zero", kCube + "[resolution]\ncrack = 0.0\n", {"scene.toml:7", "> 0 m"}},
    {"surface_coarser", kCube + "[resolution]\ncrack = 0.1\nsurface = 0.2\n", {"scene.toml:8", "smaller"}},
    {"region_without_name",
     kCube + "[[region]]\nhalf_spaces = [[0.0, 0.0, 1.0, 0.4]]\n",
     {"scene.toml:6", "name"}},
    {"region_three_numbers",
     kCube + "[[region]]\nname = \"a\"\nhalf_spaces = [[0.0, 0.0, 1.0]]\n",
     {"scene.toml:8", "4 finite numbers"}},
    {"region_zero_normal",
     kCube + "[[region]]\nname = \"a\"\nhalf_spaces = [[0.0, 0.0, 0.0, 1.0]]\n",
     {"scene.toml:8", "(0, 0, 0)"}},
    {"region_twice",
     kCube + "[[region]]\nname = \"a\"\nhalf_spaces = [[1, 0, 0, 0]]\n[[region]]\nname = \"a\"\nhalf_spaces "
             "= [[1, 0, 0, 0]]\n",
     {"scene.toml:10", "already defined at scene.toml:6"}},
    {"unknown_region",
     kCube + "[[boundary]]\nregion = \"top\"\nfixed = true\n",
     {"scene.toml:7", "\"top\"", "z+"}},
    {"two_conditions",
     kCube + kTop + "fixed = true\n" + kTop + "traction = [0, 0, 1]\n",
     {"scene.toml:10", "scene.toml:6"}},
    {"traction_and_fixed",
     kCube + kTop + "fixed = true\ntraction = [0, 0, 1]\n",
     {"scene.toml:8", "contradict"}},
    {"no_condition",
     kCube + kTop,
     {"scene.toml:6", "traction, force, moment, pressure, displacement, fixed"}},
    {"fixed_false", kCube + kTop + "fixed = false\n", {"scene.toml:8", "fixed = true"}},
    {"traction_two_numbers", kCube + kTop + "traction = [0.0, 1.0]\n", {"scene.toml:8", "3 numbers"}},
    {"traction_nan", kCube + kTop + "traction = [0.0, nan, 1.0]\n", {"scene.toml:8", "finite"}},
    {"traction_texts", kCube + kTop + "traction = [\"0\", \"0\", \"1\"]\n", {"scene.toml:8", "finite"}},
    {"boundary_infinite",
     kInfinite + kDisc + "radius = 1\n" + kTop + "fixed = true\n",
     {"scene.toml:11", "[remote_stress]"}},
    {"infinite_without_crack", kInfinite, {"scene.toml", "add a [[crack]]"}},
    {"remote_stress_on_cube",
     kCube + "[remote_stress]\ntensor = [0, 0, 1, 0, 0, 0]\n",
     {"scene.toml:6", "[[boundary]]"}},
    {"remote_stress_short",
     kInfinite + kDisc + "radius = 1\n[remote_stress]\ntensor = [0, 0, 1]\n",
     {"scene.toml:12", "6 numbers"}},
    {"crack_kind", kCube + "[[crack]]\nkind = \"disk\"\n", {"scene.toml:7", "did you mean \"disc\"?"}},
    {"disc_without_radius", kCube + kDisc, {"scene.toml:6", "radius"}},
    {"disc_radius_zero", kCube + kDisc + "radius = 0.0\n", {"scene.toml:10", "> 0 m"}},
    {"disc_with_axes", kCube + kDisc + "radius = 1.0\naxes = [1.0, 2.0]\n", {"scene.toml:11", "ellipse"}},
    {"disc_zero_normal",
     kCube + "[[crack]]\nkind = \"disc\"\ncenter = [0, 0, 0]\nnormal = [0, 0, 0]\nradius = 1\n",
     {"scene.toml:9", "direction"}},
    {"ellipse_direction",
     kCube + "[[crack]]\nkind = \"ellipse\"\ncenter = [0, 0, 0]\nnormal = [0, 0, 1]\naxes = [2, 1]\n"
             "direction = [0, 0, 3]\n",
     {"scene.toml:11", "plane"}},
    {"rectangle_one_edge", kCube + kRectangle + "edges = [[1, 0, 0]]\n", {"scene.toml:9", "must hold 2"}},
    {"rectangle_parallel",
     kCube + kRectangle + "edges = [[1, 0, 0], [2, 0, 0]]\n",
     {"scene.toml:9", "parallel"}},
    {"rectangle_skew",
     kCube + kRectangle + "edges = [[1, 0, 0], [1, 1, 0]]\n",
     {"scene.toml:9", "right angle"}},
    {"crack_file_missing",
     kCube + "[[crack]]\nkind = \"mesh\"\nfile = \"no.ply\"\n",
     {"scene.toml:8", "no.ply"}},
    {"crack_triangles", kCube + kDisc + "radius = 1.0\ntriangles = 0\n", {"scene.toml:11", "4 … 100000"}},
    {"frames_zero", kCube + "[run]\nframes = 0\n", {"scene.toml:7", "1 … 100000"}},
    {"frames_fraction", kCube + "[run]\nframes = 2.5\n", {"scene.toml:7", "whole number"}},
    {"frames_list", kCube + "[run]\nframes = [3]\n", {"scene.toml:7", "a list"}},
    {"negative_cracks", kCube + "[run]\nmax_cracks = -1\n", {"scene.toml:7", "max_cracks"}},
    {"contact_text", kCube + "[run]\ncontact = \"true\"\n", {"scene.toml:7", "without quotes"}},
    {"elements", kCube + "[run]\nelements = \"cubic\"\n", {"scene.toml:7", "quadratic"}},
    {"sif_method", kCube + "[run]\nsif = \"three-point\"\n", {"scene.toml:7", "two-point"}},
    {"tolerance", kCube + "[run]\nquadrature_tolerance = 1.0\n", {"scene.toml:7", "quadrature_tolerance"}},
};

}  // namespace

TEST_P(BrokenSceneTest, NamesPlaceAndRemedy) {
  const std::string message = error_of(GetParam().text);
  for (const char* part : GetParam().said)
    EXPECT_NE(message.find(part), std::string::npos) << "“" << part << "” is not in “" << message << "”";
}
INSTANTIATE_TEST_SUITE_P(All, BrokenSceneTest, testing::ValuesIn(kBroken),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(Scene, ANamedMaterialGivesWhatIsNotWritten) {
  const Scene scene = parse("[body]\nmodel = \"cube\"\n[material]\nname = \"ice\"\nstrength = 2e6\n");
  EXPECT_EQ(scene.material.youngs_modulus, 9.3e9);
  EXPECT_EQ(scene.material.poisson_ratio, 0.325);
  EXPECT_EQ(scene.material.density, 917);
  EXPECT_EQ(scene.material.toughness, 1e5);
  EXPECT_EQ(scene.material.strength, 2e6);
}

TEST(Scene, MaterialFieldsAreReadWithTheirPlaces) {
  const Scene scene =
      parse(kCube +
            "[[material.toughness_field]]\nkind = \"layers\"\ndirection = [0, 3, 4]\n"
            "wavelength = 0.2\namplitude = 0.3\nphase = 0.25\n"
            "[[material.toughness_field]]\nkind = \"homogeneous\"\n"
            "[[material.toughness_field]]\nkind = \"grains\"\nsize = 0.1\nseed = 7\n"
            "origin = [1, 2, 3]\naxes = [[0, 2, 0], [-1, 0, 0], [0, 0, 1]]\n"
            "[material.strength_field]\nkind = \"noise\"\nwavelength = 0.3\namplitude = 0.4\n");
  const auto& toughness = scene.material.toughness_field;
  ASSERT_EQ(toughness.size(), 2u);
  const Layers& layers = std::get<Layers>(toughness[0].kind);
  EXPECT_EQ(layers.direction, Vec3(0, 0.6, 0.8));
  EXPECT_EQ(layers.phase, 0.25);
  EXPECT_FALSE(toughness[0].placement.origin.has_value());
  const Grains& grains = std::get<Grains>(toughness[1].kind);
  EXPECT_EQ(grains.seed, 7u);
  EXPECT_DOUBLE_EQ(grains.width, 0.02);
  EXPECT_EQ(*toughness[1].placement.origin, Vec3(1, 2, 3));
  EXPECT_EQ(toughness[1].placement.axes.col(0), Vec3::UnitY());
  ASSERT_EQ(scene.material.strength_field.size(), 1u);
  EXPECT_EQ(std::get<Noise>(scene.material.strength_field[0].kind).amplitude, 0.4);
}

TEST(Scene, TheExampleOfTheDocumentation) {
  const Scene scene = parse(R"([body]
model = "cube"
[material]
youngs_modulus = 3.1e9
poisson_ratio = 0.327
density = 1200
strength = 7.6e7
toughness = 1.0e6
compressive_factor = 3.0
[resolution]
crack = 0.1
surface = 0.005
[[region]]
name = "top"
half_spaces = [[0.0, 0.0, 1.0, 0.49]]
[[boundary]]
region = "z-"
fixed = true
[[boundary]]
region = "top"
traction = [0.0, 0.0, 5.0e6]
[[crack]]
kind = "disc"
center = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
radius = 0.2
triangles = 384
[run]
frames = 12
max_cracks = 0
seed = 7
inertia_relief = true
sif = "one-point"
rayleigh = "approximate"
)");
  EXPECT_EQ(scene.body.model, "cube");
  EXPECT_EQ(scene.material.youngs_modulus, 3.1e9);
  EXPECT_EQ(scene.material.density, 1200);
  EXPECT_EQ(scene.resolution.surface, 0.005);
  ASSERT_EQ(scene.boundary.size(), 2u);
  EXPECT_EQ(scene.boundary[0].kind, ConditionKind::displacement);
  EXPECT_EQ(scene.boundary[0].where, "scene.toml:16");
  EXPECT_EQ(scene.boundary[1].kind, ConditionKind::traction);
  EXPECT_EQ(scene.boundary[1].value, Vec3(0, 0, 5e6));
  ASSERT_EQ(scene.cracks.size(), 1u);
  EXPECT_EQ(scene.cracks[0].radius, 0.2);
  EXPECT_EQ(scene.cracks[0].triangles, 384);
  EXPECT_EQ(scene.run.frames, 12);
  EXPECT_EQ(scene.run.seed, 7u);
  EXPECT_TRUE(scene.run.inertia_relief);
  EXPECT_EQ(scene.run.sif, SifSource::one_point);
  EXPECT_FALSE(scene.run.exact_rayleigh_speed);
}

TEST(Scene, RemoteStressIsWrittenInVoigtOrder) {
  const Scene scene = parse(kInfinite + kDisc + "radius = 1\n[remote_stress]\ntensor = [1, 2, 3, 4, 5, 6]\n");
  Mat3 expected;
  expected << 1, 6, 5, 6, 2, 4, 5, 4, 3;
  EXPECT_EQ(scene.remote_stress, expected);
}

TEST(Scene, FileNamesAreRelativeToTheScene) {
  const test::TemporaryFolder folder;
  folder.write("body.off", "OFF\n0 0 0\n");
  folder.write("scene.toml", "[body]\nmesh = \"body.off\"\n" + kMaterial);
  EXPECT_EQ(read_scene(folder / "scene.toml").body.mesh, folder / "body.off");
}

TEST(Scene, AMissingFileIsNamed) {
  try {
    read_scene("/nowhere/scene.toml");
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/scene.toml"), std::string::npos) << error.what();
  }
}

TEST(Scene, WritingTheStandardValuesOutChangesNothing) {
  std::string text = "[body]\nmodel = \"cube\"\nscale = 1.0\n" + kMaterial;
  for (const char* table : {"material", "run"}) {
    if (std::string(table) != "material") text += "[" + std::string(table) + "]\n";
    for (const Setting& s : settings())
      if (s.table == table && !s.standard.empty())
        text += std::string(s.key) + " = " + std::string(s.standard) + "\n";
  }
  const Scene a = parse(kCube), b = parse(text);
  EXPECT_EQ(a.body.scale, b.body.scale);
  EXPECT_EQ(a.material.density, b.material.density);
  EXPECT_EQ(a.material.strength, b.material.strength);
  EXPECT_EQ(a.material.toughness, b.material.toughness);
  EXPECT_EQ(a.material.compressive_factor, b.material.compressive_factor);
  EXPECT_EQ(a.run.frames, b.run.frames);
  EXPECT_EQ(a.run.max_cracks, b.run.max_cracks);
  EXPECT_EQ(a.run.seed, b.run.seed);
  EXPECT_EQ(a.run.inertia_relief, b.run.inertia_relief);
  EXPECT_EQ(a.run.contact, b.run.contact);
  EXPECT_EQ(a.run.sif, b.run.sif);
  EXPECT_EQ(a.run.sif_convention, b.run.sif_convention);
  EXPECT_EQ(a.run.quadrature_tolerance, b.run.quadrature_tolerance);
  EXPECT_EQ(a.run.exact_rayleigh_speed, b.run.exact_rayleigh_speed);
  EXPECT_EQ(a.run.smallest_fragment, b.run.smallest_fragment);
}

TEST(SceneRegions, OwnRegionsComeBeforeTheModels) {
  const Scene scene = parse(
      kCube + "[[region]]\nname = \"corner\"\nhalf_spaces = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0.49]]\n");
  const BodyModel cube = built_in_model("cube");
  const auto regions = scene_regions(scene, cube.mesh, cube.regions);
  EXPECT_EQ(regions.size(), 7u);
  std::size_t triangles = 0;
  for (const Region& region : regions)
    triangles += region.triangles.size();
  EXPECT_EQ(triangles, cube.mesh.triangle_count());
  EXPECT_GT(find_region(regions, "corner")->triangles.size(), 0u);
  EXPECT_EQ(find_region(regions, "z+")->triangles.size() + find_region(regions, "corner")->triangles.size(),
            find_region(cube.regions, "z+")->triangles.size());
}

TEST(SceneRegions, AnEmptyRegionIsRefusedWithItsPlace) {
  const Scene scene = parse(kCube + "[[region]]\nname = \"sky\"\nhalf_spaces = [[0, 0, 1, 9]]\n");
  const BodyModel cube = built_in_model("cube");
  try {
    scene_regions(scene, cube.mesh, cube.regions);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("scene.toml:6: the region \"sky\""), std::string::npos)
        << error.what();
  }
}

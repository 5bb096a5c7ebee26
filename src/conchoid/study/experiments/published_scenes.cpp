#include "conchoid/study/experiments/published_scenes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "conchoid/sim/database_spec.hpp"

namespace conchoid {
namespace {

std::string material(const Variant& v = {}) {
  std::string text = fmt::format(
      "[material]\nyoungs_modulus = 3.1e9\npoisson_ratio = 0.327\ndensity = 1200.0\nstrength = 7.6e7\n"
      "toughness = {:.6e}\n",
      v.toughness);
  if (v.noisy_toughness)
    text += "[material.toughness_field]\nkind = 'noise'\nwavelength = 0.3\namplitude = 0.4\n";
  return text;
}

std::string body(const std::string& model) {
  return fmt::format("[body]\nmodel = '{}'\n", model);
}

std::string resolution(double crack, double surface) {
  return fmt::format("[resolution]\ncrack = {}\nsurface = {}\n", crack, surface);
}

std::string traction(const std::string& region, double x, double y, double z) {
  return fmt::format("[[boundary]]\nregion = '{}'\ntraction = [{}, {}, {}]\n", region, x, y, z);
}

std::string free_run(int max_cracks) {
  return fmt::format("[run]\nmax_cracks = {}\ninertia_relief = true\n", max_cracks);
}

std::string pulled_scene(const std::string& model, const std::string& pulled, const std::string& opposite,
                         double slope, const Variant& v) {
  constexpr double degree = std::numbers::pi / 180;
  const double alpha = (slope + v.turned) * degree, beta = v.rotation * degree, f = 1e8 * v.load;
  const double x = f * std::sin(alpha) * std::cos(beta), y = f * std::sin(alpha) * std::sin(beta);
  const double z = f * std::cos(alpha);
  return body(model) + (v.remesh > 0 ? fmt::format("remesh = {}\n", v.remesh) : "") + material(v) +
         resolution(0.1 * v.crack_edge, 0.02) + traction(pulled, x, y, z) + traction(opposite, -x, -y, -z) +
         free_run(1);
}

struct Loads {
  int full = 300, smoke = 20;  // runs
  int seed = 1;
  std::string regions;    // TOML list
  std::string magnitude;  // TOML list [Pa]
  std::string slope = "[0.0, 85.0]";
  std::string direction = "[0.0, 0.0, 1.0]";
};

std::string loads(const Loads& l, StudyScale scale) {
  return fmt::format(
      "[database]\nruns = {}\nseed = {}\nregions = {}\nmagnitude = {}\nslope = {}\ndirection = {}\nframes = "
      "31\n",
      scale == StudyScale::full ? l.full : l.smoke, l.seed, l.regions, l.magnitude, l.slope, l.direction);
}

constexpr const char* kCubeFaces = "['z+', 'z-']";
constexpr const char* kMagnitude = "[7.8e7, 1.2e8]";

std::string cubes(const Loads& l, StudyScale scale, const Variant& v = {}) {
  return body("cube") + material(v) + resolution(0.1, 0.02) + loads(l, scale);
}

// What holds and loads the bar, but for the traction.
std::string bar_body() {
  std::string text = body("bar") + material() + resolution(0.012, 0.002);
  for (const char* support : {"support-left", "support-right"})
    text += fmt::format("[[boundary]]\nregion = '{}'\ndisplacement = ['free', 'free', 0.0]\n", support);
  return text;
}

std::string armadillo_body(const std::filesystem::path& file) {
  constexpr double crack = 3;
  return fmt::format("[body]\nmesh = '{}'\nremesh = 1000\nscale = 1.0\n", file.string()) + material() +
         resolution(crack, 0.1 * crack) +
         "[[region]]\nname = 'left hand'\nhalf_spaces = [[0.0, 1.0, 0.0, 50.0], [1.0, 0.0, 0.0, 45.0]]\n"
         "[[region]]\nname = 'right hand'\nhalf_spaces = [[0.0, 1.0, 0.0, 50.0], [-1.0, 0.0, 0.0, 45.0]]\n"
         "[[region]]\nname = 'feet'\nhalf_spaces = [[0.0, -1.0, 0.0, 50.0]]\n"
         "[[boundary]]\nregion = 'feet'\nfixed = true\n";
}

}  // namespace

std::string cube_scene(double slope, const Variant& v) {
  return pulled_scene("cube", "z+", "z-", slope, v);
}

std::string cylinder_scene(double slope, const Variant& v) {
  return pulled_scene("cylinder", "top", "bottom", slope, v);
}

std::string bar_scene() {
  return bar_body() + traction("load", 0, 0, -8e7) + "[run]\nmax_cracks = 1\n";
}

std::string edge_crack_scene(int mode) {
  const double f = 2e7;
  const double x = mode == 2 ? f : 0, y = mode == 3 ? f : 0, z = mode == 1 ? f : 0;
  return body("edge-crack-cube") + material() + resolution(0.1, 0.02) + traction("z+", x, y, z) +
         traction("z-", -x, -y, -z) + free_run(0);
}

std::string armadillo_scene(const std::filesystem::path& file) {
  return armadillo_body(file) + traction("left hand", 1e6, 0, 0) + traction("right hand", -1e6, 0, 0) +
         "[run]\nmax_cracks = 1\n";
}

std::string cube_database(StudyScale scale, const Variant& v) {
  return cubes({.full = 7502, .smoke = 40, .seed = 1, .regions = kCubeFaces, .magnitude = kMagnitude}, scale,
               v);
}

std::string small_cube_database(StudyScale scale) {
  return cubes({.full = 3001, .smoke = 16, .seed = 2, .regions = kCubeFaces, .magnitude = kMagnitude}, scale);
}

std::string cylinder_database(StudyScale scale) {
  return body("cylinder") + material() + resolution(0.1, 0.02) +
         loads(
             {.full = 3001, .smoke = 24, .seed = 3, .regions = "['top', 'bottom']", .magnitude = kMagnitude},
             scale);
}

std::string bar_database(StudyScale scale) {
  return bar_body() + loads({.full = 151,
                             .smoke = 4,
                             .seed = 4,
                             .regions = "['load']",
                             .magnitude = "[6.0e7, 1.0e8]",
                             .slope = "[0.0, 0.0]",
                             .direction = "[0.0, 0.0, -1.0]"},
                            scale);
}

std::string armadillo_database(const std::filesystem::path& file, StudyScale scale) {
  return armadillo_body(file) + loads({.full = 151,
                                       .smoke = 3,
                                       .seed = 5,
                                       .regions = "['left hand', 'right hand']",
                                       .magnitude = "[8.0e5, 1.2e6]",
                                       .slope = "[0.0, 0.0]",
                                       .direction = "[1.0, 0.0, 0.0]"},
                                      scale);
}

std::string magnitude_database(StudyScale scale, const Variant& v) {
  return cubes({.full = 70,
                .smoke = 8,
                .seed = 6,
                .regions = kCubeFaces,
                .magnitude = kMagnitude,
                .slope = "[45.0, 45.0]"},
               scale, v);
}

std::string held_out_cubes(StudyScale scale, const Variant& v) {
  return cubes({.full = 200,
                .smoke = 12,
                .seed = 2024,
                .regions = kCubeFaces,
                .magnitude = kMagnitude,
                .slope = "[0.0, 60.0]"},
               scale, v);
}

std::string held_out_scene(SceneOfLoad scene, int i) {
  const DatabaseSpec spec = parse_database_spec(held_out_cubes(StudyScale::full), "held-out loads", "");
  const DrawnLoad load = draw_load(spec, i);
  return scene(load.slope, {.load = load.magnitude / 1e8, .rotation = load.rotation});
}

}  // namespace conchoid

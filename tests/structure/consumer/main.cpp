#include <cmath>
#include <cstdio>

#include "conchoid/io/level_set.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/sim/scene.hpp"

int main(int argc, char**) {
  const conchoid::Scene scene = conchoid::parse_scene(
      "[body]\nmodel = \"cube\"\n[material]\nyoungs_modulus = 3.1e9\npoisson_ratio = 0.327\n", "scene.toml",
      ".");
  const double volume = conchoid::enclosed_volume(conchoid::built_in_model(scene.body.model).mesh);
  if (argc > 1) conchoid::require_level_sets("level sets");  // throws where the module is not found
  std::printf("volume %g\n", volume);
  return std::abs(volume - 1) < 1e-12 ? 0 : 1;
}

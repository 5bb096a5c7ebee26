#include <cmath>
#include <cstdio>

#include "conchoid/mesh/models.hpp"
#include "conchoid/sim/scene.hpp"

int main() {
  const conchoid::Scene scene = conchoid::parse_scene(
      "[body]\nmodel = \"cube\"\n[material]\nyoungs_modulus = 3.1e9\npoisson_ratio = 0.327\n", "scene.toml",
      ".");
  const double volume = conchoid::enclosed_volume(conchoid::built_in_model(scene.body.model).mesh);
  std::printf("volume %g\n", volume);
  return std::abs(volume - 1) < 1e-12 ? 0 : 1;
}

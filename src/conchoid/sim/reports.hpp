#pragma once

#include <string>
#include <vector>

#include "conchoid/crack/front/front.hpp"
#include "conchoid/sim/scene.hpp"

namespace conchoid {

/// SIFs along the initial crack fronts; nothing grows.
struct SifNode {
  Vec3 position;   ///< scene coordinates [m]
  Vec3 intensity;  ///< K_I, K_II, K_III [Pa√m]
  FrontFrame frame;
};
struct SifReport {
  struct FrontLine {
    bool closed = false;
    std::vector<SifNode> nodes;
  };
  std::vector<FrontLine> fronts;
  std::size_t triangles = 0;  ///< of the cracks inside the body
  double opened_volume = 0;   ///< ∫ n·Δu over the cracks [m³]
  std::string elements;       ///< "linear" or "quadratic" (body_elements.hpp)
  double seconds = 0;
  std::vector<std::string> warnings;  ///< of elements too coarse (resolution_warnings.hpp)
};
SifReport compute_sifs(const Scene& scene);

/// Stress on the surface of the body with its initial cracks.
struct StressReport {
  struct SurfaceTriangle {
    Vec3 centroid;       ///< scene coordinates [m]
    Vec3 principal;      ///< σ1 ≥ σ2 ≥ σ3 [Pa]
    std::string region;  ///< empty: in none
  };
  double max_principal = 0;
  double max_displacement = 0;  ///< of the nodes [m]; up to a rigid motion where nothing is held
  std::vector<SurfaceTriangle> triangles;
  std::string elements;  ///< "linear" or "quadratic"
  double seconds = 0;
  std::vector<std::string> warnings;
};
/// Throws InputError for the infinite body, which has no surface.
StressReport compute_stress(const Scene& scene);

}  // namespace conchoid

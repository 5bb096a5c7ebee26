#include "conchoid/sim/body_elements.hpp"

#include "conchoid/bem/quadratic_stress.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/log.hpp"
#include "conchoid/remesh/wall_resolution.hpp"

namespace conchoid {
namespace {

bool wants_quadratic(const RunSpec& run, const TriMesh& surface) {
  if (surface.corners.empty() || run.elements == ElementOrder::linear) return false;
  if (run.elements == ElementOrder::quadratic) return true;
  return surface.triangle_count() <= most_quadratic_elements && coarse_walls(surface).has_value();
}

}  // namespace

void choose_elements(const RunSpec& run, const std::vector<BoundaryKind>& kinds, PreparedBody& body) {
  if (!wants_quadratic(run, body.surface)) return;
  const auto make = [&] {
    body.quadratic = std::make_shared<const QuadraticBody>(body.surface, kinds, body.material.elastic(),
                                                           run.quadrature_tolerance, run.cache);
  };
  if (run.elements == ElementOrder::quadratic) return make();
  try {
    make();
    message("walls are thin beside the elements: quadratic ones are used (run.elements)");
  } catch (const ComputationError& error) {
    warning(std::string("linear elements are used on thin walls, as quadratic ones fail: ") + error.what());
  }
}

std::string_view elements_of(const PreparedBody& body) {
  return body.quadratic ? "quadratic" : "linear";
}

LoadCase as_elements_take(LoadCase load, const PreparedBody& body) {
  return body.quadratic ? as_field(*body.quadratic, load) : load;
}

}  // namespace conchoid

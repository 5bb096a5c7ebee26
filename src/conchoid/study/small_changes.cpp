#include "conchoid/study/small_changes.hpp"

#include <cmath>
#include <numbers>

#include "conchoid/core/vec.hpp"

namespace conchoid {
namespace {

constexpr double kLoad = 1.005, kEdge = 1.1, kElements = 1.1;
constexpr double kTurn = 0.5 * std::numbers::pi / 180;

template <class Map>
PreparedRun with_mapped_loads(PreparedRun run, const Map& map) {
  for (BoundaryCondition& c : run.scene.boundary)
    for (Vec3* v : {&c.value, &c.free_value, &c.moment, &c.twist})
      *v = map(*v);
  return run;
}

PreparedRun larger_load(const PreparedRun& of) {
  return with_load(of, kLoad);
}

// None where all that acts is pressure.
std::optional<PreparedRun> turned_load(const PreparedRun& of) {
  Vec3 first = Vec3::Zero();
  for (const BoundaryCondition& c : of.scene.boundary)
    for (const Vec3& v : {c.value, c.free_value, c.moment, c.twist})
      if (first.isZero(0)) first = v;
  if (first.isZero(0)) return std::nullopt;
  Eigen::Index least = 0;
  first.cwiseAbs().minCoeff(&least);
  const Vec3 axis = cross(first, Vec3::Unit(least)).normalized();
  return with_mapped_loads(of, [&](const Vec3& v) -> Vec3 {  // Rodrigues' formula
    return std::cos(kTurn) * v + std::sin(kTurn) * cross(axis, v) +
           (1 - std::cos(kTurn)) * axis.dot(v) * axis;
  });
}

PreparedRun longer_edge(const PreparedRun& of) {
  PreparedRun run = of;
  PreparedBody body = *of.body;
  body.crack_edge *= kEdge;
  run.body = std::make_shared<const PreparedBody>(std::move(body));
  return run;
}

std::optional<PreparedRun> other_mesh(const PreparedRun& of) {
  if (of.scene.body.model.empty() && of.scene.body.mesh.empty()) return std::nullopt;
  PreparedRun run = of;
  run.scene.body.remesh =
      static_cast<int>(std::lround(kElements * static_cast<double>(of.body->surface.triangle_count())));
  run.body = std::make_shared<const PreparedBody>(prepare(run.scene));
  return run;
}

}  // namespace

PreparedRun with_load(const PreparedRun& of, double factor) {
  PreparedRun run = with_mapped_loads(of, [&](const Vec3& v) -> Vec3 { return factor * v; });
  for (BoundaryCondition& c : run.scene.boundary)
    c.pressure *= factor;
  return run;
}

const std::vector<SmallChange>& small_changes() {
  static const std::vector<SmallChange> changes{{"solved, load + 0.5 %", larger_load},
                                                {"solved, load turned 0.5 deg", turned_load},
                                                {"solved, edge + 10 %", longer_edge},
                                                {"solved, elements + 10 %", other_mesh}};
  return changes;
}

}  // namespace conchoid

#include "conchoid/bem/load_case.hpp"

#include <algorithm>
#include <string>

#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

void require_count(std::size_t given, std::size_t wanted, const char* values, const char* places) {
  if (given == wanted) return;
  throw InputError("load case: " + std::to_string(given) + " " + values + " for a surface of " +
                   std::to_string(wanted) + " " + places + "; give one for each");
}

[[noreturn]] void refuse(const char* value, const char* place, std::size_t index, const char* why) {
  throw InputError(std::string("load case: the ") + value + " of " + place + " " + std::to_string(index) +
                   " " + why);
}

}  // namespace

std::vector<Mat3> held_at_nodes(const TriMesh& surface, const std::vector<BoundaryKind>& kinds) {
  std::vector<Mat3> held(surface.node_count(), Mat3::Zero());
  for (std::size_t t = 0; t < surface.triangle_count(); ++t)
    if (!kinds[t].holds_nothing())
      for (NodeId node : surface.corners[TriId(t)])
        held[node.index()] = join_held(held[node.index()], kinds[t].held());
  return held;
}

LoadCase load_case(const TriMesh& surface, const BoundaryData& data, AmbientField ambient) {
  LoadCase load{data.traction, data.displacement, std::move(ambient)};
  if (data.kind.size() != surface.triangle_count()) return load;
  const std::vector<Mat3> held = held_at_nodes(surface, data.kind);
  for (std::size_t t = 0; t < std::min(load.traction.size(), data.kind.size()); ++t)
    if (!data.kind[t].holds_nothing())
      load.traction[t] = (Mat3::Identity() - data.kind[t].held()) * load.traction[t];
  for (std::size_t i = 0; i < std::min(load.displacement.size(), held.size()); ++i)
    if (!held[i].isIdentity(0)) load.displacement[NodeId(i)] = held[i] * load.displacement[NodeId(i)];
  return load;
}

void require_fitting_load(const TriMesh& surface, const std::vector<BoundaryKind>& kinds,
                          const LoadCase& load) {
  constexpr double round_off = 1e-9;  // of projecting a value
  require_count(load.traction.size(), surface.triangle_count(), "tractions", "triangles");
  require_count(load.displacement.size(), surface.node_count(), "displacements", "nodes");
  const std::vector<Mat3> held = held_at_nodes(surface, kinds);
  for (std::size_t t = 0; t < kinds.size(); ++t) {
    const Vec3& value = load.traction[t];
    if (!value.allFinite()) refuse("traction", "triangle", t, "is not a finite number");
    if ((kinds[t].held() * value).norm() > round_off * value.norm())
      refuse("traction", "triangle", t,
             "is given, but the operator was made for its displacement; make one for the other kind, or set "
             "the traction to zero");
  }
  for (std::size_t i = 0; i < held.size(); ++i) {
    const Vec3& value = load.displacement[NodeId(i)];
    if (!value.allFinite()) refuse("displacement", "node", i, "is not a finite number");
    if ((value - held[i] * value).norm() > round_off * value.norm())
      refuse("displacement", "node", i,
             "is given, but the operator was made for traction all around it; make one that holds a triangle "
             "there, or set the displacement to zero");
  }
}

}  // namespace conchoid

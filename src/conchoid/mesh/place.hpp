#pragma once

#include <array>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// A point as a key: equal only to the last bit.
using Place = std::array<double, 3>;
inline Place place(const Vec3& x) {
  return {x[0], x[1], x[2]};
}

/// Per node the one with the lowest id at the same place.
IdVector<NodeId, NodeId> first_at_place(const TriMesh& mesh);

}  // namespace conchoid

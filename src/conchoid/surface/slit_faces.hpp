#pragma once

#include <vector>

#include "conchoid/surface/fragments.hpp"

namespace conchoid {

/// Which nodes lie where others do.
struct SharedPlaces {
  IdVector<NodeId, NodeId> first;  ///< per node: the first one at its place
  IdVector<NodeId, char> shared;   ///< per node: whether there are others

  explicit SharedPlaces(const TriMesh& mesh);
};

/// Per face: those of the same piece that it lies on, if it is one of a slit.
std::vector<std::vector<std::size_t>> opposite_faces(const Fragment& fragment, const SharedPlaces& places);

/// Fills in Fragment::unfinished.solid: the surface without its slits, sewn together at their mouths. Left
/// empty where there is no slit. To be called before open_slits(), while the two faces lie on each other.
void keep_solid(Fragment& fragment);

}  // namespace conchoid

#pragma once

#include <array>
#include <map>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// A point as a key: equal only to the last bit (but −0 is 0).
using Place = std::array<double, 3>;
inline Place place(const Vec3& x) {
  return {x[0], x[1], x[2]};
}

/// Per node the one with the lowest id at the same place.
IdVector<NodeId, NodeId> first_at_place(const TriMesh& mesh);

/// Hands out one node per place: triangles that name the same places share their nodes.
class NodeWelder {
 public:
  explicit NodeWelder(TriMesh& mesh) : mesh_(mesh) {}
  NodeId operator()(const Vec3& x);

 private:
  TriMesh& mesh_;
  std::map<Place, NodeId> nodes_;
};

}  // namespace conchoid

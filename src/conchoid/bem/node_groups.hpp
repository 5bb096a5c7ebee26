#pragma once

#include <cstddef>
#include <vector>

#include "conchoid/core/ids.hpp"
#include "conchoid/core/vec.hpp"

namespace conchoid {

/// The nodes in groups of at most `most` that lie together, each in the order of ids: halved across the longest side of
/// their box until they are few enough. Nodes that lie together share their triangles, and so the integrals of these.
std::vector<std::vector<NodeId>> compact_groups(const IdVector<NodeId, Vec3>& positions,
                                                std::vector<NodeId> nodes, std::size_t most);

}  // namespace conchoid

#pragma once

#include <array>

#include "conchoid/core/ids.hpp"

namespace conchoid {

/// The nodes of a triangle.
using Corners = std::array<NodeId, 3>;

inline bool has(const Corners& c, NodeId n) {
  return c[0] == n || c[1] == n || c[2] == n;
}

}  // namespace conchoid

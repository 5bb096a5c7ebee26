#pragma once

#include <string>

#include "conchoid/mesh/region_rules.hpp"

namespace conchoid {

/// Why half spaces take no triangle, for messages: how far the surface reaches along each normal, and where the
/// half space begins. "along (0, 0, 1) the body reaches from -0.5 to 0.5, the half space begins at 0.6"
std::string reach_text(const RegionRule& rule, const TriMesh& surface);

}  // namespace conchoid

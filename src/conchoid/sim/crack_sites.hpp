#pragma once

#include <vector>

#include "conchoid/bem/cracked_body.hpp"
#include "conchoid/crack/law/initiation.hpp"
#include "conchoid/sim/crack_state.hpp"
#include "conchoid/sim/prepared_body.hpp"

namespace conchoid {

/// A stress compared with the strength.
struct StressPeak {
  double ratio = 0;              ///< σ1 / S_c; 0: nowhere above
  Vec3 position = Vec3::Zero();  ///< of the prepared body [m]
};

/// Where the surface is strained most, as last solved, among the places where a crack could start: triangles that
/// are neither wholly held nor excluded and that no crack cuts, farther than 2 r̄ from the cracks that are there. The
/// infinite body has none.
StressPeak largest_stress(const PreparedBody& prepared, const CrackState& crack, const CrackedBody& body);

/// Where new cracks start under the stress as last solved: on free triangles of the body's surface that no
/// crack cuts, or as branches on faces of cracks away from their fronts, where it exceeds the strength most.
/// None starts where the whole displacement is prescribed, or a region excludes it.
std::vector<CrackSite> find_crack_sites(const PreparedBody& prepared, const CrackState& crack,
                                        const CrackedBody& body, std::size_t most);

}  // namespace conchoid

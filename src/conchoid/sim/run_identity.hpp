#pragma once

#include <string>

#include "conchoid/core/hash.hpp"
#include "conchoid/sim/body_setup.hpp"
#include "conchoid/sim/run.hpp"

namespace conchoid {

void add_mesh(ContentHash& hash, const TriMesh& mesh);

/// Hash of everything that the frames of a run follow from: scene, what its files hold, method, regressor,
/// program. How many frames are wanted and what is written of them is no part of it.
std::string run_identity(const Scene& scene, const BodySetup& setup, const RunOptions& options);

}  // namespace conchoid

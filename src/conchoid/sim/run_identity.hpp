#pragma once

#include <string>

#include "conchoid/core/hash.hpp"
#include "conchoid/sim/prepared_body.hpp"
#include "conchoid/sim/run.hpp"

namespace conchoid {

void add_mesh(ContentHash& hash, const TriMesh& mesh);

/// Hash of everything that the frames of a run follow from: scene, meshes, material and load as they took
/// effect, method, regressor, program. So a scene that was built in code, and has no text or another's, is
/// told from others all the same. How many frames are wanted and what is written of them is no part of it.
std::string run_identity(const Scene& scene, const PreparedBody& body, const LoadCase& load,
                         const RunOptions& options);

}  // namespace conchoid

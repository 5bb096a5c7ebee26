#pragma once

#include "conchoid/core/byte_cache.hpp"
#include "conchoid/mesh/tri_mesh.hpp"
#include "conchoid/remesh/local_edges.hpp"

namespace conchoid {

/// remesh(), or what the cache has of it. With limits of regions, which have no bytes to tell them by, always anew.
/// @param cache  may be null
TriMesh kept_remesh(const TriMesh& surface, int triangles, const RemeshSettings& settings,
                    const ByteCache* cache);

}  // namespace conchoid

#pragma once

#include "conchoid/core/byte_cache.hpp"
#include "conchoid/mesh/tri_mesh.hpp"
#include "conchoid/remesh/local_edges.hpp"
#include "conchoid/remesh/weld.hpp"

namespace conchoid {

/// welded_if_it_helps(); a surface that the cache knows to bound a body is not looked at again.
/// @param cache  may be null
AttributedMesh kept_welded_if_it_helps(AttributedMesh surface, WeldReport& report, const ByteCache* cache);

/// remesh(), or what the cache has of it. With limits of regions, which have no bytes to tell them by, always anew.
/// @param cache  may be null
TriMesh kept_remesh(const TriMesh& surface, int triangles, const RemeshSettings& settings,
                    const ByteCache* cache);

}  // namespace conchoid

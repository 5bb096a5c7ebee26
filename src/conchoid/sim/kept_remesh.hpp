#pragma once

#include "conchoid/core/byte_cache.hpp"
#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// remesh(), or what the cache has of it. @param cache  may be null
TriMesh kept_remesh(const TriMesh& surface, int triangles, const ByteCache* cache);

}  // namespace conchoid

#pragma once

#include <vector>

#include "conchoid/surface/fragments.hpp"

namespace conchoid {

/// One piece made of several that touch (mesh, kinds and sources; no mass): fracture faces that lie on each
/// other are taken out and the rims sewn together. Where faces on each other are divided differently in a way
/// that cannot be matched, they stay as a slit; the result is closed in either case.
/// @param all      the pieces of the body
/// @param members  which of them become one, ascending
Fragment welded(const std::vector<Fragment>& all, const std::vector<std::size_t>& members);

}  // namespace conchoid

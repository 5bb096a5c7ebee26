#pragma once

#include "conchoid/core/bytes.hpp"
#include "conchoid/learn/tree_ensemble.hpp"

namespace conchoid {

/// Trees in the files of regressors: number of trees u32, per tree: number of nodes u32, feature u8[] (255: a leaf),
/// threshold or, of a leaf, value f32[]; nodes breadth first, children side by side.
void put_trees(ByteWriter& out, const TreeEnsemble& ensemble);
/// Throws InputError as TreeEnsemble does, or if bytes are missing. @param features  number of features per row
TreeEnsemble get_trees(ByteReader& in, int features);

}  // namespace conchoid

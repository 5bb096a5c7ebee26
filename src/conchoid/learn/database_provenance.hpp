#pragma once

#include "conchoid/learn/database.hpp"
#include "conchoid/learn/regressor.hpp"

namespace conchoid {

/// What a regressor that is trained on a database says of it; runs, samples and their hash are filled in by
/// the training.
Provenance provenance_of(const DatabaseHeader& header);

}  // namespace conchoid

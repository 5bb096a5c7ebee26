#pragma once

#include "conchoid/learn/database.hpp"
#include "conchoid/learn/regressor.hpp"

namespace conchoid {

/// What a regressor that is trained on a database says of it; runs, samples and their hash are filled in by
/// the training.
Provenance provenance_of(const DatabaseHeader& header);

/// Several databases to be learned from together.
struct JoinedSamples {
  SampleSet samples;
  /// Models of all; material and resolution where they agree, else 0; specifications one after the other.
  Provenance provenance;
};
/// Chosen samples of all, with runs numbered on so that they stay apart.
JoinedSamples join_samples(const std::vector<Database>& databases, const TrainingChoice& choice);

}  // namespace conchoid

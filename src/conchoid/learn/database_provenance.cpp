#include "conchoid/learn/database_provenance.hpp"

#include <algorithm>

namespace conchoid {

Provenance provenance_of(const DatabaseHeader& header) {
  Provenance provenance;
  provenance.models = header.models;
  provenance.material = header.material;
  provenance.resolution = header.resolution;
  provenance.spec = header.spec;
  return provenance;
}

JoinedSamples join_samples(const std::vector<Database>& databases, const TrainingChoice& choice) {
  JoinedSamples out;
  std::int32_t first = 0;
  for (const Database& database : databases) {
    SampleSet samples = database.training_samples(choice);
    for (std::int32_t& run : samples.run())
      run += first;
    first += database.header.planned_runs;
    out.samples.append(samples);
    Provenance of_this = provenance_of(database.header);
    std::erase_if(of_this.models, [&](const std::string& model) { return !choice.takes(model); });
    if (&database == &databases.front()) {
      out.provenance = std::move(of_this);
      continue;
    }
    Provenance& all = out.provenance;
    for (const std::string& model : of_this.models)
      if (std::find(all.models.begin(), all.models.end(), model) == all.models.end())
        all.models.push_back(model);
    if (!(all.material == of_this.material)) all.material = {};
    if (all.resolution != of_this.resolution) all.resolution = 0;
    all.spec += "\n" + of_this.spec;
  }
  return out;
}

}  // namespace conchoid

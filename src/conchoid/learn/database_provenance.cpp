#include "conchoid/learn/database_provenance.hpp"

namespace conchoid {

Provenance provenance_of(const DatabaseHeader& header) {
  Provenance provenance;
  provenance.models = header.models;
  provenance.material = header.material;
  provenance.resolution = header.resolution;
  provenance.spec = header.spec;
  return provenance;
}

}  // namespace conchoid

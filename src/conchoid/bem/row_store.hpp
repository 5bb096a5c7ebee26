#pragma once

#include <optional>
#include <string>
#include <vector>

#include "conchoid/bem/enrichment_rows.hpp"

namespace conchoid {

/// Keeps the rows that enrichment functions added to the system, so that a run that goes on after a stop need not
/// integrate them again. Everything else is computed as it was, in the same order, and gives the same bits.
class RowStore {
 public:
  virtual ~RowStore() = default;
  /// The rows of that name, or nothing: then they are assembled and handed to keep().
  /// @param name  of the functions that are there and of those whose rows are wanted (a hash of their
  ///              geometry)
  virtual std::optional<std::vector<EnrichmentRows>> recall(const std::string& name) = 0;
  virtual void keep(const std::string& name, const std::vector<EnrichmentRows>& rows) = 0;
};

/// Rows of the functions listed in `wanted`: from the store if it has them, else assembled.
/// @param store  may be null
std::vector<EnrichmentRows> stored_rows(const EnrichmentProblem& problem, const EnrichedSpace& space,
                                        const std::vector<std::size_t>& wanted, RowStore* store);

}  // namespace conchoid

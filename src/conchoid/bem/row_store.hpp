#pragma once

#include <optional>
#include <string>
#include <vector>

#include "conchoid/bem/crack_host.hpp"

namespace conchoid {

/// Keeps the rows that enrichment functions added to the system, so that a run that goes on after a stop need not
/// integrate them again. Everything else is computed as it was, in the same order, and gives the same bits.
class RowStore {
 public:
  virtual ~RowStore() = default;
  /// The rows of that name, or nothing: then they are assembled and handed to keep().
  /// @param name  of the functions that are there, of those whose rows are wanted, and of the places where
  ///              values are prescribed (a hash of the functions' geometry and of the places)
  virtual std::optional<std::vector<EnrichmentRows>> recall(const std::string& name) = 0;
  virtual void keep(const std::string& name, const std::vector<EnrichmentRows>& rows) = 0;
};

/// host.rows(), or what the store has under their name.
/// @param store   may be null
/// @param memory  see assemble_enrichment_rows()
std::vector<EnrichmentRows> stored_rows(const CrackHost& host, const EnrichedSpace& space,
                                        std::span<const LoadSource> sources,
                                        const std::vector<std::size_t>& wanted, RowStore* store,
                                        PairMemory& memory);

}  // namespace conchoid

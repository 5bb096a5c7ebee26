#pragma once

#include <optional>
#include <string>
#include <vector>

#include "conchoid/bem/cut_rows.hpp"

namespace conchoid {

/// Keeps the rows that cut functions added to the system, so that a run that goes on after a stop need not
/// integrate them again. Everything else is computed as it was, in the same order, and gives the same bits.
class RowStore {
 public:
  virtual ~RowStore() = default;
  /// The rows of that name, or nothing: then they are assembled and handed to keep().
  /// @param name  of the functions that are there and of those whose rows are wanted (a hash of their
  ///              geometry)
  virtual std::optional<std::vector<CutRows>> recall(const std::string& name) = 0;
  virtual void keep(const std::string& name, const std::vector<CutRows>& rows) = 0;
};

/// Rows of the functions listed in `wanted`: from the store if it has them, else assembled.
/// @param store  may be null
std::vector<CutRows> stored_cut_rows(const CutProblem& problem, const CutSpace& space,
                                     const std::vector<std::size_t>& wanted, RowStore* store);

}  // namespace conchoid

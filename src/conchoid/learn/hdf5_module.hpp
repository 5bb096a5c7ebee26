#pragma once

#include <cstdint>
#include <string>

#include "conchoid/core/module.hpp"
#include "conchoid/learn/database.hpp"

namespace conchoid {

constexpr Module kHdf5Module{"conchoid_databases", "HDF5", "CONCHOID_WITH_LEARNING"};

constexpr std::int32_t kDatabaseVersion = 2;  ///< of the file

/// The database as the bytes of an HDF5 file, and back. One call at a time: HDF5 is not safe for several threads.
/// Throw ComputationError (DatabaseToHdf5) and InputError with the reason alone.
using DatabaseToHdf5 = void(const Database& database, std::string& image);
using DatabaseFromHdf5 = void(std::string& image, Database& database);

}  // namespace conchoid

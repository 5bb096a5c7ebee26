// In place of database_file.cpp and bagging.cpp where CONCHOID_WITH_LEARNING is off. Forests can be read and predict.
#include "conchoid/core/build_options.hpp"
#include "conchoid/learn/bagging.hpp"
#include "conchoid/learn/database.hpp"

namespace conchoid {

void require_databases(const std::filesystem::path& file) {
  throw_built_without(file.string() + ": databases", "HDF5 and XGBoost", "CONCHOID_WITH_LEARNING");
}

Database read_database(const std::filesystem::path& file) {
  require_databases(file);
  return {};
}

void write_database(const std::filesystem::path& file, const Database&) {
  require_databases(file);
}

std::vector<std::vector<RegressionTree>> fit_bagged_trees(std::span<const float>, std::size_t,
                                                          const std::vector<BaggingTarget>&,
                                                          const BaggingSettings&,
                                                          const std::function<void()>&,
                                                          std::vector<std::vector<float>>*) {
  throw_built_without("training a forest", "HDF5 and XGBoost", "CONCHOID_WITH_LEARNING");
}

}  // namespace conchoid

// In place of level_set.cpp where CONCHOID_WITH_VDB is off.
#include "conchoid/core/build_options.hpp"
#include "conchoid/io/level_set.hpp"

namespace conchoid {

void require_level_sets(const std::string& where) {
  throw_built_without(where + ": format 'vdb'", "OpenVDB", "CONCHOID_WITH_VDB");
}

void write_fragments_vdb(const std::filesystem::path& path, const std::vector<Fragment>&, double) {
  require_level_sets(path.string());
}

}  // namespace conchoid

#include "conchoid/material/vdb_module.hpp"

namespace conchoid {

std::shared_ptr<const VoxelGrid> read_vdb(const std::filesystem::path& path, const std::string& name) {
  const auto read =
      module_function<ReadVdb>(kVdbModule, "conchoid_read_vdb", path.string() + ": cannot be read");
  auto grid = std::make_shared<VoxelGrid>();
  read(path, name, *grid);
  return grid;
}

}  // namespace conchoid

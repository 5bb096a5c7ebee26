// Reads .vdb files: a module (core/module.hpp).
#include "conchoid/material/vdb_module.hpp"

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <cmath>

#include "conchoid/core/error.hpp"

namespace conchoid {

namespace {

constexpr std::size_t kMostVoxels = std::size_t{1} << 27;

template <class Grid>
VoxelGrid copy(const Grid& grid, const std::string& what) {
  const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
  if (box.empty()) throw InputError(what + " has no active voxels; write its values as active ones");
  const openvdb::Coord size = box.dim();
  VoxelGrid out;
  out.size = {size.x(), size.y(), size.z()};
  const double count = double(size.x()) * size.y() * size.z();
  if (count > double(kMostVoxels))
    throw InputError(fmt::format("{} spans {} × {} × {} voxels, more than 2^27; resample it coarser", what,
                                 size.x(), size.y(), size.z()));
  if (!grid.transform().isLinear())
    throw InputError(what + " has a transform that is not linear; resample it to a linear one");
  const openvdb::math::Mat4d m =
      grid.transform().baseMap()->getAffineMap()->getMat4().inverse();  // row vectors
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c)
      out.to_index(r, c) = m(c, r);
    out.offset[r] = m(3, r) - box.min()[r];
  }
  out.values.reserve(static_cast<std::size_t>(count));
  const auto read = grid.getConstAccessor();
  for (int k = box.min().z(); k <= box.max().z(); ++k)
    for (int j = box.min().y(); j <= box.max().y(); ++j)
      for (int i = box.min().x(); i <= box.max().x(); ++i) {
        const auto value = static_cast<float>(read.getValue({i, j, k}));
        if (!(value > 0) || !std::isfinite(value))
          throw InputError(
              fmt::format("{} holds {} at voxel ({}, {}, {}); factors must be positive and finite", what,
                          value, i, j, k));
        out.values.push_back(value);
      }
  return out;
}

bool has_numbers(const openvdb::GridBase& grid) {
  return grid.isType<openvdb::FloatGrid>() || grid.isType<openvdb::DoubleGrid>();
}

openvdb::GridBase::Ptr open_grid(openvdb::io::File& file, const std::string& name, const std::string& path) {
  std::vector<std::string> names;
  openvdb::GridBase::Ptr only;
  const openvdb::GridPtrVecPtr grids = file.readAllGridMetadata();
  for (const openvdb::GridBase::Ptr& grid : *grids)
    if (has_numbers(*grid)) {
      names.push_back(grid->getName());
      if (name.empty() || grid->getName() == name) only = grid;
    }
  if (names.empty()) throw InputError(path + " has no grid of numbers (float or double); write one");
  if (name.empty() && names.size() > 1)
    throw InputError(fmt::format("{} has several grids; name one with grid = \"{}\"", path,
                                 fmt::join(names, "\", or \"")));
  if (!only)
    throw InputError(fmt::format("{} has no grid \"{}\" of numbers; choose from \"{}\"", path, name,
                                 fmt::join(names, "\", \"")));
  return file.readGrid(only->getName());
}

}  // namespace

}  // namespace conchoid

CONCHOID_MODULE_FUNCTION void conchoid_read_vdb(const std::filesystem::path& path, const std::string& name,
                                                conchoid::VoxelGrid& out) {
  using namespace conchoid;
  static_assert(std::is_same_v<decltype(conchoid_read_vdb), ReadVdb>);
  openvdb::initialize();
  try {
    openvdb::io::File file(path.string());
    file.open(false);
    const openvdb::GridBase::Ptr grid = open_grid(file, name, path.string());
    const std::string what = fmt::format("{}: grid \"{}\"", path.string(), grid->getName());
    out = grid->isType<openvdb::FloatGrid>() ? copy(static_cast<const openvdb::FloatGrid&>(*grid), what)
                                             : copy(static_cast<const openvdb::DoubleGrid&>(*grid), what);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {  // OpenVDB's own, and what damaged files lead it into
    throw InputError(
        fmt::format("{} cannot be read as a .vdb file ({}); write it again", path.string(), error.what()));
  }
}

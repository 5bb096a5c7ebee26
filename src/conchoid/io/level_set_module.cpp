// Level sets by OpenVDB: a module (core/module.hpp).
#include "conchoid/io/level_set_module.hpp"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>

#include <sstream>

#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

constexpr float half_width = 3;  // of the narrow band [voxel]

openvdb::FloatGrid::Ptr level_set(const TriMesh& piece, const openvdb::math::Transform& transform) {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  for (const Vec3& x : piece.positions) {
    const openvdb::Vec3d at = transform.worldToIndex(openvdb::Vec3d(x[0], x[1], x[2]));
    if (!(at.length() < 1e6))
      throw ComputationError(
          "level sets: the pieces are more than 10⁶ voxels long; make resolution.surface larger");
    points.emplace_back(at);
  }
  for (const auto& c : piece.corners)
    triangles.emplace_back(c[0].value, c[1].value, c[2].value);
  const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> mesh(points, triangles);
  const auto grid = openvdb::tools::meshToVolume<openvdb::FloatGrid>(mesh, transform, half_width, half_width);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  return grid;
}

}  // namespace
}  // namespace conchoid

CONCHOID_MODULE_FUNCTION void conchoid_level_sets(const std::vector<conchoid::LevelSetSource>& sources,
                                                  double voxel, const conchoid::Vec3& origin,
                                                  std::string& bytes) {
  using namespace conchoid;
  static_assert(std::is_same_v<decltype(conchoid_level_sets), LevelSetBytes>);
  openvdb::initialize();
  const auto transform = openvdb::math::Transform::createLinearTransform(voxel);
  transform->postTranslate(openvdb::Vec3d(origin[0], origin[1], origin[2]));
  openvdb::GridPtrVec grids;
  for (const LevelSetSource& source : sources) {
    grids.push_back(level_set(source.mesh, *transform));
    grids.back()->setName(source.name);
    grids.back()->insertMeta("mass", openvdb::DoubleMetadata(source.mass));
    grids.back()->insertMeta("volume", openvdb::DoubleMetadata(source.volume));
  }
  std::ostringstream out(std::ios::binary);
  openvdb::io::Stream(out).write(grids);
  bytes = std::move(out).str();
}

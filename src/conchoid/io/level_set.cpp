// The only file that sees OpenVDB's headers here: they are heavy.
#include "conchoid/io/level_set.hpp"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>

#include <sstream>

#include "conchoid/core/atomic_file.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/hash.hpp"
#include "conchoid/io/fragments_io.hpp"

namespace conchoid {
namespace {

constexpr float half_width = 3;  // of the narrow band [voxel]

openvdb::FloatGrid::Ptr level_set(const Fragment& fragment, const openvdb::math::Transform& transform) {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  for (const Vec3& x : fragment.mesh.positions) {
    const openvdb::Vec3d at = transform.worldToIndex(openvdb::Vec3d(x[0], x[1], x[2]));
    if (!(at.length() < 1e6))
      throw ComputationError(
          "level sets: the pieces are more than 10⁶ voxels long; make resolution.surface larger");
    points.emplace_back(at);
  }
  for (const auto& c : fragment.mesh.corners)
    triangles.emplace_back(c[0].value, c[1].value, c[2].value);
  const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> mesh(points, triangles);
  const auto grid = openvdb::tools::meshToVolume<openvdb::FloatGrid>(mesh, transform, half_width, half_width);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  return grid;
}

/// Voxels of one lattice for all pieces, counted from their middle: coordinates are single precision.
openvdb::math::Transform::Ptr lattice(const std::vector<Fragment>& fragments, double voxel) {
  Box all{Vec3::Zero(), Vec3::Zero()};
  for (const Fragment& f : fragments) {
    const Box box = bounding_box(f.mesh);
    all = &f == &fragments.front() ? box : Box{all.low.cwiseMin(box.low), all.high.cwiseMax(box.high)};
  }
  const auto transform = openvdb::math::Transform::createLinearTransform(voxel);
  const Vec3 middle = voxel * (all.center() / voxel).array().round().matrix();
  transform->postTranslate(openvdb::Vec3d(middle[0], middle[1], middle[2]));
  return transform;
}

/// OpenVDB gives every file a name of its own, drawn at random: 36 characters near its beginning. Here they
/// are made from the content.
void name_by_content(std::string& bytes) {
  constexpr std::size_t header = 8 + 4 + 4 + 4 + 1, length = 36;
  if (bytes.size() < header + length) return;
  bytes.replace(header, length, length, '0');
  ContentHash hash;
  hash.add(std::string_view(bytes));
  std::string name = hash.hex();
  for (const std::size_t dash : {8, 13, 18, 23})
    name.insert(dash, 1, '-');
  bytes.replace(header, length, name);
}

}  // namespace

void require_level_sets(const std::string&) {}

void write_fragments_vdb(const std::filesystem::path& path, const std::vector<Fragment>& fragments,
                         double voxel) {
  openvdb::initialize();
  const auto transform = lattice(fragments, voxel);
  openvdb::GridPtrVec grids;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    grids.push_back(level_set(fragments[i], *transform));
    grids.back()->setName(fragment_name(i));
    grids.back()->insertMeta("mass", openvdb::DoubleMetadata(fragments[i].mass));
    grids.back()->insertMeta("volume", openvdb::DoubleMetadata(fragments[i].volume));
  }
  std::ostringstream out(std::ios::binary);
  openvdb::io::Stream(out).write(grids);
  std::string bytes = std::move(out).str();
  name_by_content(bytes);
  AtomicFile file(path);
  file.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.commit();
}

}  // namespace conchoid

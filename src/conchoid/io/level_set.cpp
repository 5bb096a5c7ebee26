#include "conchoid/io/level_set.hpp"

#include "conchoid/core/atomic_file.hpp"
#include "conchoid/core/hash.hpp"
#include "conchoid/io/fragments_io.hpp"
#include "conchoid/io/level_set_module.hpp"

namespace conchoid {
namespace {

LevelSetBytes* level_set_bytes(const std::string& where) {
  return module_function<LevelSetBytes>(kLevelSetModule, "conchoid_level_sets", where + ": format 'vdb'");
}

/// Voxels of one lattice for all pieces are counted from their middle: coordinates are single precision.
Vec3 middle_voxel(const std::vector<Fragment>& fragments, double voxel) {
  Box all{Vec3::Zero(), Vec3::Zero()};
  for (const Fragment& f : fragments) {
    const Box box = bounding_box(f.mesh);
    all = &f == &fragments.front() ? box : Box{all.low.cwiseMin(box.low), all.high.cwiseMax(box.high)};
  }
  return voxel * (all.center() / voxel).array().round().matrix();
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

void require_level_sets(const std::string& where) {
  level_set_bytes(where);
}

void write_fragments_vdb(const std::filesystem::path& path, const std::vector<Fragment>& fragments,
                         double voxel) {
  std::vector<LevelSetSource> sources;
  for (std::size_t i = 0; i < fragments.size(); ++i)
    sources.push_back({fragments[i].mesh, fragment_name(i), fragments[i].mass, fragments[i].volume});
  std::string bytes;
  level_set_bytes(path.string())(sources, voxel, middle_voxel(fragments, voxel), bytes);
  name_by_content(bytes);
  AtomicFile file(path);
  file.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.commit();
}

}  // namespace conchoid

#include "conchoid/sim/run_identity.hpp"

#include <array>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "conchoid/learn/regressor.hpp"

namespace conchoid {
namespace {

// Other kinds of fields stand in the scene itself.
void add_voxels(ContentHash& hash, const std::vector<FieldFactor>& factors) {
  for (const FieldFactor& factor : factors)
    if (const auto* voxels = std::get_if<Voxels>(&factor.kind)) {
      const VoxelGrid& grid = *voxels->grid;
      hash.add(grid.size);
      hash.add(std::string_view(reinterpret_cast<const char*>(grid.values.data()),
                                grid.values.size() * sizeof(float)));
      hash.add(std::span<const double>(grid.to_index.data(), 9));
      hash.add(std::span<const double>(grid.offset.data(), 3));
    }
}

}  // namespace

void add_mesh(ContentHash& hash, const TriMesh& mesh) {
  hash.add(std::span<const Vec3>(mesh.positions));
  for (const auto& c : mesh.corners)
    hash.add(std::array{c[0].value, c[1].value, c[2].value});
}

std::string run_identity(const Scene& scene, const BodySetup& setup, const RunOptions& options) {
  ContentHash hash;
  for (const char* text : {CONCHOID_VERSION, __VERSION__})
    hash.add(text);
  hash.add(scene.text);
  hash.add(options.method);
  if (options.regressor) hash.add(options.regressor->content_hash());
  add_mesh(hash, setup.surface);
  add_mesh(hash, setup.detailed);
  for (const TriMesh& crack : setup.cracks)
    add_mesh(hash, crack);
  add_voxels(hash, scene.material.toughness_field);
  add_voxels(hash, scene.material.strength_field);
  return hash.hex();
}

}  // namespace conchoid

#include "conchoid/sim/run_identity.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "conchoid/learn/regressor.hpp"

namespace conchoid {
namespace {

void add(ContentHash& hash, const Vec3& v) {
  hash.add(std::span<const double>(v.data(), 3));
}
void add(ContentHash& hash, const Mat3& m) {
  hash.add(std::span<const double>(m.data(), 9));
}

void add(ContentHash& hash, const Layers& f) {
  add(hash, f.direction);
  hash.add(std::array{f.wavelength, f.amplitude, f.phase});
}
void add(ContentHash& hash, const Grains& f) {
  add(hash, f.stretch);
  hash.add(std::array{f.size, f.width, f.weakening, f.spread});
  hash.add(f.seed);
}
void add(ContentHash& hash, const Noise& f) {
  hash.add(std::array{f.wavelength, f.amplitude, static_cast<double>(f.octaves), f.gain});
  hash.add(f.seed);
}
void add(ContentHash& hash, const Voxels& f) {
  const VoxelGrid& grid = *f.grid;
  hash.add(grid.size);
  hash.add(std::string_view(reinterpret_cast<const char*>(grid.values.data()),
                            grid.values.size() * sizeof(float)));
  add(hash, grid.to_index);
  add(hash, grid.offset);
  hash.add(std::array{f.scale, f.outside == Outside::periodic ? 1.0 : 0.0});
}

void add(ContentHash& hash, const std::vector<FieldFactor>& factors) {
  hash.add(static_cast<std::uint64_t>(factors.size()));
  for (const FieldFactor& factor : factors) {
    hash.add(static_cast<std::uint64_t>(factor.kind.index()));
    std::visit([&](const auto& kind) { add(hash, kind); }, factor.kind);
    hash.add(static_cast<std::uint64_t>(factor.placement.origin.has_value()));
    add(hash, factor.placement.origin.value_or(Vec3::Zero()));
    add(hash, factor.placement.axes);
  }
}

void add(ContentHash& hash, const MaterialSpec& m) {
  hash.add(std::array{m.youngs_modulus, m.poisson_ratio, m.density, m.strength, m.toughness,
                      m.compressive_factor});
  add(hash, m.toughness_field);
  add(hash, m.strength_field);
}

void add(ContentHash& hash, const MaterialFrame& frame) {
  add(hash, frame.turn);
  add(hash, frame.shift);
  add(hash, frame.center.value_or(Vec3::Zero()));
}

void add(ContentHash& hash, const LoadCase& load, const TriMesh& surface) {
  hash.add(std::span<const Vec3>(load.traction));
  hash.add(std::span<const Vec3>(load.displacement));
  if (!load.ambient.stress) return;
  add(hash, load.ambient.stress(Vec3::Zero()));
  for (const Vec3& x : surface.positions)
    add(hash, load.ambient.stress(x));
}

// How many frames are wanted is no part of it.
void add(ContentHash& hash, const RunSpec& run) {
  hash.add(static_cast<std::uint64_t>(run.max_cracks));
  hash.add(run.seed);
  hash.add(std::array{static_cast<double>(run.max_cracks_per_frame), run.smallest_body, run.smallest_fragment,
                      static_cast<double>(run.max_fragments), static_cast<double>(run.solve_every)});
  for (const bool choice :
       {run.inertia_relief, run.contact, run.published_compression, run.exact_rayleigh_speed,
        run.sif == SifSource::one_point, run.sif_convention == OpeningConvention::half,
        run.after_separation == AfterSeparation::stop})
    hash.add(static_cast<std::uint64_t>(choice));
  hash.add(run.quadrature_tolerance);
  hash.add(static_cast<std::uint64_t>(run.elements));
}

}  // namespace

void add_mesh(ContentHash& hash, const TriMesh& mesh) {
  hash.add(std::span<const Vec3>(mesh.positions));
  for (const auto& c : mesh.corners)
    hash.add(std::array{c[0].value, c[1].value, c[2].value});
}

std::string run_identity(const Scene& scene, const PreparedBody& body, const LoadCase& load,
                         const RunOptions& options) {
  ContentHash hash;
  for (const char* text : {CONCHOID_VERSION, __VERSION__})
    hash.add(text);
  hash.add(scene.text);
  hash.add(options.method);
  if (options.regressor) hash.add(options.regressor->content_hash());
  if (options.tolerance) hash.add(std::array{*options.tolerance});
  add_mesh(hash, body.surface);
  add_mesh(hash, body.detailed);
  for (const TriMesh& crack : body.cracks)
    add_mesh(hash, crack);
  add(hash, body.material);
  add(hash, body.pieces);
  hash.add(std::array{body.crack_edge, body.surface_edge});
  for (const BoundaryKind& kind : body.elastic->kinds()) {
    hash.add(static_cast<std::uint64_t>(kind.holds_all()));
    if (kind.holds_all() || kind.holds_nothing()) continue;
    const Mat3 H = kind.held();
    hash.add(std::span<const double>(H.data(), 9));
  }
  add(hash, load, body.surface);
  add(hash, scene.run);
  return hash.hex();
}

}  // namespace conchoid

#include "conchoid/sim/cut_piece.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "conchoid/core/error.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/sim/mended_fragment.hpp"

namespace conchoid {
namespace {

struct WayToCut {
  double shift;        // of the cracks, along their mean normal, × edge of the surface
  double most_mended;  // × volume of a part: what mending it may take or add
};
constexpr std::array<WayToCut, 6> kWaysToCut{{{0, kMendedVolume},
                                              {0.02, kMendedVolume},
                                              {-0.02, kMendedVolume},
                                              {0.05, kMendedVolume},
                                              {-0.05, kMendedVolume},
                                              {0, kRoughlyMendedVolume}}};

// The parts, mended; none where not all of them are solids, or where it cannot be cut so.
std::optional<Pieces> solid_parts(const Fracture& fracture, const OutputSpec& output,
                                  const WayToCut& way) try {
  Vec3 normal = Vec3::Zero();
  const TriMesh& sheet = fracture.crack().sheet.mesh;
  for (std::size_t t = 0; t < sheet.triangle_count(); ++t)
    normal += area_vector(sheet, TriId(t));
  const double shift = way.shift * fracture.body().surface_edge;
  Pieces cut = cut_into_pieces(fracture, output, shift * normal.normalized());
  std::vector<char> solid(cut.fragments.size());
  parallel_for(solid.size(), 1, [&](std::size_t i, std::size_t) {
    Fragment& f = cut.fragments[i];
    solid[i] = is_solid(f);
    if (solid[i]) return;
    mend_fragment(f, way.most_mended);
    solid[i] = is_solid(f);
  });
  if (std::find(solid.begin(), solid.end(), 0) != solid.end()) return std::nullopt;
  return cut;
} catch (const ComputationError&) {
  return std::nullopt;
}

}  // namespace

std::optional<SolidParts> cut_piece(const Fracture& fracture, const OutputSpec& output) {
  for (const WayToCut& way : kWaysToCut) {
    std::optional<Pieces> parts = solid_parts(fracture, output, way);
    if (parts && !(fracture.parted() && parts->fragments.size() < 2))
      return SolidParts{*std::move(parts), way.most_mended};
  }
  return std::nullopt;
}

}  // namespace conchoid

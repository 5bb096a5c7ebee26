#include "conchoid/sim/pieces.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "conchoid/core/error.hpp"
#include "conchoid/intersect/unfold.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/mesh/surface_parts.hpp"
#include "conchoid/sim/unfinished_cracks.hpp"
#include "conchoid/surface/fragment_attributes.hpp"
#include "conchoid/surface/move_fragment.hpp"
#include "conchoid/surface/open_slits.hpp"
#include "conchoid/surface/slit_faces.hpp"

namespace conchoid {
namespace {

constexpr double kRunOut =
    0.5;  // × r̄: how far a crack that separates the coarse body is run on through the detailed one
// Far below what can be seen, far above what single precision rounds away.
constexpr double kSlitWidth = 2e-4;  // of the crack surface's edge length

TriMesh join(const std::vector<TriMesh>& sheets) {
  TriMesh all;
  for (const TriMesh& sheet : sheets) {
    const std::size_t first = all.node_count();
    all.positions.insert(all.positions.end(), sheet.positions.begin(), sheet.positions.end());
    for (const auto& c : sheet.corners)
      all.corners.push_back(
          {NodeId(c[0].index() + first), NodeId(c[1].index() + first), NodeId(c[2].index() + first)});
  }
  return all;
}

// Of the sheet; nodes that no triangle uses are dropped.
TriMesh part_inside(const CutComplex& cut) {
  std::vector<TriId> all;
  for (std::size_t t = 0; t < cut.sheet.size(); ++t)
    all.emplace_back(t);
  return submesh({cut.positions, cut.sheet}, all);
}

std::vector<TriMesh> run_on(std::vector<TriMesh> sheets, double length) {
  for (TriMesh& sheet : sheets)
    sheet = unfolded_part(extend_sheet_beyond(sheet, boundary_edges(sheet), length));
  return sheets;
}

AttributeSettings attribute_settings(const OutputSpec& output, const PreparedBody& body) {
  AttributeSettings settings;
  settings.projection = output.projection;
  settings.texture_size = output.texture_size.value_or(std::cbrt(enclosed_volume(body.detailed)));
  settings.crease_angle = output.crease_angle * std::numbers::pi / 180;
  return settings;
}

void cut(const Fracture& fracture, Pieces& out) {
  const PreparedBody& body = fracture.body();
  const RunSpec& run = fracture.settings();
  const FragmentSettings settings{body.material.density, run.smallest_fragment,
                                  static_cast<std::size_t>(run.max_fragments)};
  std::vector<TriMesh> sheets = fracture.visible_sheets();
  try {
    out.fragments = cut_into_fragments(body.detailed, sheets, settings);
    if (fracture.stop() == StopReason::separated && settings.maximum_count != 1 && out.fragments.size() < 2) {
      std::vector<TriMesh> longer = run_on(sheets, kRunOut * body.crack_edge);
      std::vector<Fragment> pieces = cut_into_fragments(body.detailed, longer, settings);
      if (pieces.size() > 1) {
        sheets = std::move(longer);
        out.fragments = std::move(pieces);
      }
    }
    out.crack = part_inside(corefine(body.detailed, join(sheets)));
  } catch (const ComputationError& error) {  // folded over itself: the frames are still worth having
    out.warnings.push_back(
        fmt::format("the body could not be cut by the fine crack surface ({}); crack.ply holds the surface "
                    "as swept, the body is left whole",
                    error.what()));
    out.crack = join(sheets);
    out.fragments = cut_into_fragments(body.detailed, {}, settings);
  }
}

}  // namespace

TriMesh crack_surface(const Fracture& fracture) {
  const PreparedBody& body = fracture.body();
  TriMesh crack = join(fracture.visible_sheets());
  if (!body.infinite()) try {
      crack = part_inside(corefine(body.detailed, crack));
    } catch (const ComputationError&) {  // folded over itself: as it was swept
    }
  for (Vec3& x : crack.positions)
    x += body.origin;
  return crack;
}

void arrange_pieces(Pieces& pieces, const PreparedBody& body, const OutputSpec& output) {
  const double volume = enclosed_volume(body.detailed);
  const auto size = [&](const Fragment& f) { return std::llround(1e9 * f.volume / volume); };
  std::stable_sort(pieces.fragments.begin(), pieces.fragments.end(),
                   [&](const Fragment& x, const Fragment& y) { return size(x) > size(y); });
  pieces.contacts = fragment_contacts(pieces.fragments);
  // Attributes are made about the body's centre, then every bit of a position is as it was.
  std::vector<IdVector<NodeId, Vec3>> positions;
  for (Fragment& f : pieces.fragments) {
    positions.push_back(f.mesh.positions);
    for (Vec3& x : f.mesh.positions)
      x -= body.origin;
  }
  transfer_attributes(pieces.fragments, body.detailed, body.attributes, attribute_settings(output, body));
  for (std::size_t i = 0; i < positions.size(); ++i)
    pieces.fragments[i].mesh.positions = std::move(positions[i]);
}

Pieces cut_into_pieces(const Fracture& fracture, const OutputSpec& output) {
  const PreparedBody& body = fracture.body();
  Pieces out;
  if (body.infinite()) {
    out.crack = crack_surface(fracture);
    return out;
  }
  cut(fracture, out);
  out.contacts = fragment_contacts(out.fragments);
  for (Fragment& f : out.fragments) {
    keep_solid(f);
    f.unfinished.sheets = unfinished_cracks(fracture.crack().sheet, f, body.crack_edge);
    open_slits(f, kSlitWidth * body.surface_edge);
  }
  transfer_attributes(out.fragments, body.detailed, body.attributes, attribute_settings(output, body));
  for (Fragment& f : out.fragments)
    move_fragment(f, body.origin, body.detailed, body.scene_positions);
  for (Vec3& x : out.crack.positions)
    x += body.origin;
  return out;
}

}  // namespace conchoid

#include "conchoid/sim/pieces.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "conchoid/core/error.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/intersect/sheet_inside.hpp"
#include "conchoid/mesh/surface_parts.hpp"
#include "conchoid/sim/body_cut.hpp"
#include "conchoid/sim/mended_fragment.hpp"
#include "conchoid/sim/unfinished_cracks.hpp"
#include "conchoid/surface/fragment_attributes.hpp"
#include "conchoid/surface/move_fragment.hpp"
#include "conchoid/surface/open_slits.hpp"
#include "conchoid/surface/slit_faces.hpp"

namespace conchoid {
namespace {

AttributeSettings attribute_settings(const OutputSpec& output, const PreparedBody& body) {
  AttributeSettings settings;
  settings.projection = output.projection;
  settings.texture_size = output.texture_size.value_or(std::cbrt(enclosed_volume(body.detailed)));
  settings.crease_angle = output.crease_angle * std::numbers::pi / 180;
  return settings;
}

// The crack inside the body; as it was swept where it is folded over itself.
TriMesh trimmed_crack(const PreparedBody& body, const std::vector<TriMesh>& sheets) {
  try {
    return sheet_inside(corefine(body.detailed, join(sheets)));
  } catch (const ComputationError&) {
    return join(sheets);
  } catch (const InputError&) {
    return join(sheets);
  }
}

// Its surface, for cracks in it that it does not show.
void keep_whole(Fragment& f) {
  f.unfinished.solid = f.mesh;
  f.unfinished.solid_face.clear();
  for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t)
    f.unfinished.solid_face.emplace_back(t);
}

}  // namespace

TriMesh crack_surface(const Fracture& fracture) {
  const PreparedBody& body = fracture.body();
  const std::vector<TriMesh>& sheets = fracture.visible_sheets();
  TriMesh crack = body.infinite() ? join(sheets) : trimmed_crack(body, sheets);
  for (Vec3& x : crack.positions)
    x += body.origin;
  return crack;
}

TriMesh swept_crack(const Fracture& fracture) {
  TriMesh crack = fracture.swept_surface();
  for (Vec3& x : crack.positions)
    x += fracture.body().origin;
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

Pieces cut_into_pieces(const Fracture& fracture, const OutputSpec& output, const Vec3& shift) {
  const PreparedBody& body = fracture.body();
  Pieces out;
  if (body.infinite()) {
    out.crack = crack_surface(fracture);
    return out;
  }
  std::vector<TriMesh> sheets = fracture.visible_sheets();
  for (TriMesh& sheet : sheets)
    for (Vec3& x : sheet.positions)
      x += shift;
  BodyCut cut = fracture.parted() && shift.isZero(0) ? *fracture.parted()
                                                     : cut_body(body, fracture.settings(), std::move(sheets));
  out.fragments = std::move(cut.fragments);
  out.warnings = std::move(cut.warnings);
  out.crack = join({cut.inside ? *cut.inside : trimmed_crack(body, cut.sheets), cut.ligament});
  out.contacts = fragment_contacts(out.fragments);
  const auto unclear = parallel_values(out.fragments.size(), 1, [&](std::size_t i) {
    Fragment& f = out.fragments[i];
    keep_solid(f);
    if (cut.stands_for > 0) keep_whole(f);
    GoingOn going_on = unfinished_cracks(fracture.crack().sheet, f, body.crack_edge, cut.stands_for);
    f.unfinished.sheets = std::move(going_on.sheets);
    if (cut.opened.empty())
      open_slits(f, slit_width(body));
    else
      f.mesh.positions = std::move(cut.opened[i]);
    mend_folded_slivers(f);
    return going_on.unclear;
  });
  if (const int count = std::accumulate(unclear.begin(), unclear.end(), 0); count > 0)
    out.warnings.push_back(fmt::format(
        "{}: what goes on in the piece cannot be told, as its surface touches itself along an edge there; "
        "another resolution.surface may part it",
        count == 1 ? "a crack that ends in a piece stays as it is"
                   : fmt::format("{} cracks that end in pieces stay as they are", count)));
  transfer_attributes(out.fragments, body.detailed, body.attributes, attribute_settings(output, body));
  for (Fragment& f : out.fragments)
    move_fragment(f, body.origin, body.detailed, body.scene_positions);
  for (Vec3& x : out.crack.positions)
    x += body.origin;
  return out;
}

}  // namespace conchoid

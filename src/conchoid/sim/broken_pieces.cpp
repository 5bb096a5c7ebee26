#include "conchoid/sim/broken_pieces.hpp"

#include <algorithm>
#include <cmath>

#include "conchoid/core/parallel.hpp"
#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/mesh/surface_parts.hpp"
#include "conchoid/sim/mended_fragment.hpp"

namespace conchoid {
namespace {

// Sheet triangles that the fracture faces come from, counted from 0.
std::size_t sheet_triangles(const std::vector<Fragment>& fragments) {
  std::size_t count = 0;
  for (const Fragment& f : fragments)
    for (std::size_t t = 0; t < f.source.size(); ++t)
      if (f.face_kind[t] == FaceKind::fracture) count = std::max(count, f.source[t].index() + 1);
  return count;
}

// The volume and mass of a piece go to its parts: what mending it took or added (mend_fragment()) is none of theirs.
void share_out(const Fragment& whole, std::vector<Fragment>& parts) {
  const TriMesh& solid = whole.unfinished.solid.corners.empty() ? whole.mesh : whole.unfinished.solid;
  const double ratio = whole.volume / enclosed_volume(solid);
  for (Fragment& part : parts) {
    part.volume *= ratio;
    part.mass *= ratio;
    part.inertia *= ratio;
  }
}

// The cracks that end in a piece, where its mesh does not show them as those that went on.
TriMesh slits_of(const Fragment& piece) {
  std::vector<char> solid(piece.mesh.triangle_count(), 0);
  for (const TriId t : piece.unfinished.solid_face)
    solid[t.index()] = 1;
  std::vector<TriId> slits;
  for (std::size_t t = 0; t < solid.size(); ++t)
    if (!solid[t]) slits.emplace_back(t);
  return slits.empty() ? join(piece.unfinished.sheets) : submesh(piece.mesh, slits);
}

// A crack that ended in a piece is part of what broke it later: it is nearer to the piece's slits than to its
// surface.
void remove_slits(TriMesh& crack, const Fragment& piece) {
  if (piece.unfinished.solid.corners.empty()) return;
  const TriMesh own = slits_of(piece);
  if (own.corners.empty()) return;
  const ClosestPointTree slits(own), surface(piece.unfinished.solid);
  const auto keep = parallel_values(crack.triangle_count(), 256, [&](std::size_t t) -> char {
    const Vec3 x = centroid(crack, TriId(t));
    return slits.closest(x).squared_distance >= surface.closest(x).squared_distance;
  });
  std::vector<TriId> kept;
  for (std::size_t t = 0; t < keep.size(); ++t)
    if (keep[t]) kept.emplace_back(t);
  crack = submesh(crack, kept);
}

}  // namespace

BrokenPieces::BrokenPieces(std::shared_ptr<const PreparedBody> body, Pieces pieces, const OutputSpec& output)
    : body_(std::move(body)), output_(output), sheet_triangles_(sheet_triangles(pieces.fragments)) {
  for (Fragment& f : pieces.fragments)
    entries_.push_back({std::move(f)});
  pieces.fragments.clear();
  all_ = std::move(pieces);
}

std::size_t BrokenPieces::count() const {
  return static_cast<std::size_t>(
      std::count_if(entries_.begin(), entries_.end(), [](const Entry& e) { return !e.broken; }));
}

// Original faces of a part lie on any face of its parent, fracture faces included.
void BrokenPieces::trace_back(Fragment& part, const Fragment& parent) const {
  const std::vector<TriId>& solid_face = parent.unfinished.solid_face;
  for (std::size_t t = 0; t < part.source.size(); ++t) {
    TriId& source = part.source[t];
    if (part.face_kind[t] == FaceKind::fracture) {
      source = TriId(source.index() + sheet_triangles_);
      continue;
    }
    const TriId face = solid_face.empty() ? source : solid_face[source.index()];
    part.face_kind[t] = parent.face_kind[face.index()];
    source = parent.source[face.index()];
  }
}

std::size_t BrokenPieces::replace(std::size_t id, Pieces parts) {
  const std::size_t first = entries_.size(), count = sheet_triangles(parts.fragments);
  remove_slits(all_.crack, entries_[id].fragment);
  all_.crack = join({all_.crack, parts.crack});
  all_.warnings.insert(all_.warnings.end(), parts.warnings.begin(), parts.warnings.end());
  share_out(entries_[id].fragment, parts.fragments);
  for (Fragment& part : parts.fragments) {
    trace_back(part, entries_[id].fragment);
    entries_.push_back({std::move(part)});
  }
  sheet_triangles_ += count;
  entries_[id] = {Fragment{}, true};
  return first;
}

Pieces BrokenPieces::take() {
  const bool again = std::any_of(entries_.begin(), entries_.end(), [](const Entry& e) { return e.broken; });
  Pieces out = std::move(all_);
  for (Entry& e : entries_)
    if (!e.broken) out.fragments.push_back(std::move(e.fragment));
  entries_.clear();
  if (again) arrange_pieces(out, *body_, output_);
  return out;
}

}  // namespace conchoid

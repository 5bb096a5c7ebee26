#include "conchoid/surface/fragments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <map>

#include "conchoid/core/error.hpp"
#include "conchoid/core/interrupt.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/core/progress.hpp"
#include "conchoid/intersect/corefine.hpp"
#include "conchoid/intersect/sheet_inside.hpp"
#include "conchoid/mesh/id_lists.hpp"
#include "conchoid/surface/cut_slivers.hpp"
#include "conchoid/surface/mass_properties.hpp"
#include "conchoid/surface/separation.hpp"
#include "conchoid/surface/slit_edges.hpp"
#include "conchoid/surface/small_fragments.hpp"

namespace conchoid {
namespace {

/// A piece between two cuts: closed mesh and where its triangles come from.
struct Piece {
  TriMesh mesh;
  std::vector<FaceKind> kind;
  std::vector<TriId> source;
};

/// Faces of the sheet with the same piece on both sides.
std::vector<bool> slit_pieces(const CutComplex& cut, const Shells& shells) {
  std::vector<bool> slit(cut.sheet.size());
  for (std::size_t s = 0; s < slit.size(); ++s)
    slit[s] =
        shells.solid[shells.surface_faces + s] == shells.solid[shells.surface_faces + shells.sheet_faces + s];
  return slit;
}

/// Which sheet faces to leave out so that no piece is smaller than `minimum_volume`: the smallest piece joins
/// the neighbour it shares the largest area with, again and again.
std::vector<bool> faces_between_slivers(const CutComplex& cut, const Shells& shells, double minimum_volume) {
  std::vector<bool> left_out(cut.sheet.size());
  for (std::size_t s = 0; s < left_out.size(); ++s)
    left_out[s] = !shells.present[shells.surface_faces + s];
  std::vector<double> volume = shells.volume;
  std::vector<std::size_t> joined(volume.size());
  for (std::size_t s = 0; s < joined.size(); ++s)
    joined[s] = s;
  std::vector<bool> stuck(volume.size(), false);
  for (;;) {
    std::size_t sliver = volume.size();
    for (std::size_t s = 0; s < volume.size(); ++s)
      if (joined[s] == s && !stuck[s] && volume[s] < minimum_volume &&
          (sliver == volume.size() || volume[s] < volume[sliver]))
        sliver = s;
    if (sliver == volume.size()) return left_out;
    std::map<std::size_t, double> shared;
    const auto neighbour = [&](std::size_t s) {
      if (left_out[s]) return sliver;
      const std::size_t a = joined[shells.solid[shells.surface_faces + s]];
      const std::size_t b = joined[shells.solid[shells.surface_faces + shells.sheet_faces + s]];
      return a == b ? sliver : a == sliver ? b : b == sliver ? a : sliver;
    };
    for (std::size_t s = 0; s < cut.sheet.size(); ++s)
      if (const std::size_t other = neighbour(s); other != sliver) {
        const auto& c = cut.sheet[TriId(s)];
        shared[other] += area_vector2(cut.positions[c[0]], cut.positions[c[1]], cut.positions[c[2]]).norm();
      }
    if (shared.empty()) {
      stuck[sliver] = true;
      continue;
    }
    const std::size_t into = std::max_element(shared.begin(), shared.end(), [](const auto& x, const auto& y) {
                               return x.second < y.second;
                             })->first;
    for (std::size_t s = 0; s < cut.sheet.size(); ++s)
      if (neighbour(s) == into) left_out[s] = true;
    for (std::size_t& j : joined)
      if (j == sliver) j = into;
    volume[into] += volume[sliver];
  }
}

/// The solids of a glued complex as meshes of their own. Nodes in the order of the complex.
std::vector<Piece> separate(const CutComplex& cut, const Shells& shells, const Piece& parent,
                            std::size_t first_sheet_triangle) {
  std::vector<NodeId> node_of(shells.vertex_count);
  std::vector<std::int32_t> solid_of(shells.vertex_count);
  for (std::size_t f = 0; f < shells.corners.size(); ++f)
    if (shells.present[f])
      for (int k = 0; k < 3; ++k) {
        node_of[shells.vertex[f][k]] = shells.corners[f][k];
        solid_of[shells.vertex[f][k]] = shells.solid[f];
      }
  const NodeLists<std::uint32_t> vertices(cut.positions.size(), [&](const auto& put) {
    for (std::size_t v = 0; v < node_of.size(); ++v)
      put(node_of[v], static_cast<std::uint32_t>(v));
  });
  std::vector<Piece> pieces(shells.volume.size());
  std::vector<NodeId> local(shells.vertex_count);
  for (NodeId n(0); n.index() < vertices.size(); ++n.value)
    for (const std::uint32_t v : vertices[n])
      local[v] = pieces[solid_of[v]].mesh.positions.add(cut.positions[n]);
  for (std::size_t f = 0; f < shells.corners.size(); ++f) {
    if (!shells.present[f]) continue;
    Piece& piece = pieces[shells.solid[f]];
    const auto& v = shells.vertex[f];
    piece.mesh.corners.push_back({local[v[0]], local[v[1]], local[v[2]]});
    if (f < shells.surface_faces) {
      const std::size_t from = cut.surface_parent[f].index();
      piece.kind.push_back(parent.kind[from]);
      piece.source.push_back(parent.source[from]);
    } else {
      const TriId from = cut.sheet_parent[(f - shells.surface_faces) % shells.sheet_faces];
      piece.kind.push_back(FaceKind::fracture);
      piece.source.emplace_back(first_sheet_triangle + from.index());
    }
  }
  return pieces;
}

/// The sheet moved along its own normals by a share of its size.
TriMesh nudged(TriMesh sheet, double share) {
  IdVector<NodeId, Vec3> normals(sheet.node_count(), Vec3::Zero());
  for (std::size_t t = 0; t < sheet.triangle_count(); ++t)
    for (const NodeId n : sheet.corners[TriId(t)])
      normals[n] += unit_normal(sheet, TriId(t));
  const double step = share * bounding_box(sheet).diagonal();
  for (std::size_t i = 0; i < sheet.node_count(); ++i)
    if (const double length = normals[NodeId(i)].norm(); length > 0)
      sheet.positions[NodeId(i)] += step / length * normals[NodeId(i)];
  return sheet;
}

double mean_edge(const TriMesh& sheet) {
  double sum = 0;
  for (std::size_t t = 0; t < sheet.triangle_count(); ++t) {
    const Triangle x = sheet.triangle(TriId(t));
    sum += (x[1] - x[0]).norm() + (x[2] - x[1]).norm() + (x[0] - x[2]).norm();
  }
  return sum / (3 * static_cast<double>(sheet.triangle_count()));
}

/// Lowest triangle that a cut may leave, in edges of the sheet.
constexpr double kSmallestHeight = 3e-4;

struct CutPieces {
  std::vector<Piece> pieces;
  bool clean;  ///< nowhere do sheet and surface pass through each other
};

/// How a sheet cuts.
struct SheetCut {
  std::size_t first_triangle = 0;            ///< number of its first triangle among those of all sheets
  double minimum_volume = 0;                 ///< of the pieces it parts [m³]
  bool slits = true;                         ///< it also cuts where it parts nothing
  std::optional<TriMesh>* inside = nullptr;  ///< where its part inside of the piece goes, as it lies
};

CutPieces cut_piece_once(const Piece& piece, const TriMesh& sheet, const SheetCut& how) {
  CutComplex cut = corefine(piece.mesh, sheet);
  if (how.inside && !how.inside->has_value()) *how.inside = sheet_inside(cut);
  if (cut.sheet.empty() && cut.mouth.empty()) return {{piece}, true};
  remove_slivers(cut, piece.mesh, sheet, kSmallestHeight * mean_edge(sheet));
  split_edges_between_front_nodes(cut);
  const Gluer gluer(cut);
  Shells shells = gluer.glue();
  const auto leave_out = [&](const std::vector<bool>& left_out) {
    for (std::size_t s = 0; s < left_out.size(); ++s)
      if (left_out[s] && shells.present[shells.surface_faces + s]) {
        shells = gluer.glue(left_out);
        return;
      }
  };
  if (!how.slits) leave_out(slit_pieces(cut, shells));
  leave_out(faces_between_slivers(cut, shells, how.minimum_volume));
  return {separate(cut, shells, piece, how.first_triangle), shells.overlaps == 0};
}

/// Earlier cuts have left rounded nodes: where faces of theirs overlap by round-off, a sheet may not find a
/// clean way through. Then it is moved by far less than any visible size.
std::vector<Piece> cut_piece(const Piece& piece, const TriMesh& sheet, SheetCut how) {
  constexpr std::array shares{0.0, 1e-10, -1e-10, 1e-9, -1e-9, 1e-8, -1e-8};
  std::vector<Piece> fallback;
  std::exception_ptr failure;
  for (const double share : shares) {
    throw_if_interrupted();
    try {
      CutPieces cut =
          share == 0 ? cut_piece_once(piece, sheet, how) : cut_piece_once(piece, nudged(sheet, share), how);
      if (cut.clean) return std::move(cut.pieces);
      if (fallback.empty()) fallback = std::move(cut.pieces);
    } catch (const ComputationError&) {
      failure = std::current_exception();
    }
    how.inside = nullptr;  // is of the sheet where it lies
  }
  if (fallback.empty()) std::rethrow_exception(failure);
  return fallback;
}

void set_mass(Fragment& fragment, double density) {
  const MassProperties m = mass_properties(fragment.mesh, density);
  fragment.volume = m.volume;
  fragment.mass = m.mass;
  fragment.center_of_mass = m.center_of_mass;
  fragment.inertia = m.inertia;
}

std::vector<Piece> cut_pieces(const std::vector<Piece>& pieces, const TriMesh& sheet, const SheetCut& how) {
  std::vector<Piece> next;
  for (const Piece& piece : pieces)
    for (Piece& part : cut_piece(piece, sheet, how))
      next.push_back(std::move(part));
  return next;
}

std::vector<Fragment> as_fragments(std::vector<Piece> pieces, const FragmentSettings& settings,
                                   double body_volume) {
  std::vector<Fragment> fragments;
  for (Piece& piece : pieces) {
    Fragment fragment;
    fragment.volume = enclosed_volume(piece.mesh);
    fragment.mesh = std::move(piece.mesh);
    fragment.face_kind = std::move(piece.kind);
    fragment.source = std::move(piece.source);
    fragments.push_back(std::move(fragment));
  }
  fragments = joined_small_fragments(
      std::move(fragments), {settings.minimum_volume_fraction * body_volume, settings.maximum_count});
  parallel_for(2 * fragments.size(), 1, [&](std::size_t task, std::size_t) {
    Fragment& fragment = fragments[task / 2];
    if (task % 2 == 0)
      fragment.watertight = is_watertight(fragment.mesh);
    else
      set_mass(fragment, settings.density);
  });
  // largest first; pieces equal up to round-off keep their order
  const auto size = [&](const Fragment& f) { return std::llround(1e9 * f.volume / body_volume); };
  std::stable_sort(fragments.begin(), fragments.end(),
                   [&](const Fragment& x, const Fragment& y) { return size(x) > size(y); });
  return fragments;
}

}  // namespace

std::vector<Fragment> cut_into_fragments(const TriMesh& surface, const std::vector<TriMesh>& sheets,
                                         const FragmentSettings& settings, CutFindings* findings) {
  const double body_volume = enclosed_volume(surface);
  std::vector<Piece> pieces(1);
  pieces[0].mesh = surface;
  pieces[0].kind.assign(surface.triangle_count(), FaceKind::original);
  for (std::size_t t = 0; t < surface.triangle_count(); ++t)
    pieces[0].source.emplace_back(t);
  SheetCut how{0, settings.minimum_volume_fraction * body_volume, true, nullptr};
  if (findings && sheets.size() == 1) how.inside = &findings->inside;
  Progress progress("sheets cut", sheets.size());
  for (const TriMesh& sheet : sheets) {
    pieces = cut_pieces(pieces, sheet, how);
    how.first_triangle += sheet.triangle_count();
    progress.advance();
  }
  return as_fragments(std::move(pieces), settings, body_volume);
}

std::vector<Fragment> part_fragments(const std::vector<Fragment>& fragments, const TriMesh& surface,
                                     std::size_t first_triangle, const FragmentSettings& settings) {
  double body_volume = 0;
  std::vector<Piece> pieces;
  for (const Fragment& f : fragments) {
    pieces.push_back({f.mesh, f.face_kind, f.source});
    body_volume += f.volume;
  }
  const SheetCut how{first_triangle, settings.minimum_volume_fraction * body_volume, false, nullptr};
  return as_fragments(cut_pieces(pieces, surface, how), settings, body_volume);
}

}  // namespace conchoid

#include "conchoid/sim/body_cut.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "conchoid/core/error.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/intersect/unfold.hpp"
#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/mesh/surface_parts.hpp"
#include "conchoid/surface/open_slits.hpp"

namespace conchoid {
namespace {

// Tried in turn.
constexpr std::array<LigamentOverlap, 4> kOverlaps{{{3.5, 0.25}, {3.5, -0.25}, {5, 0.25}, {5, -0.25}}};

// A piece below this share of what a ligament would part from the body is a chip of the two surfaces that cut it, not
// the part: the volumes are counted in cells.
constexpr double kLeastShareOfPart = 0.5;

// Likewise, where none of these will do.
constexpr std::array<DividingSurface, 4> kDividingSurfaces{{{20, true}, {20, false}, {5, false}, {0, false}}};
constexpr double kStandsFor = 2;  // × cell: the parts of cracks within are its own

constexpr int kCleanWays = 2;  // tried, where they part off chips as well

constexpr double kSlitWidth = 2e-4;  // × the crack surface's edge length

FragmentSettings fragment_settings(const PreparedBody& body, const RunSpec& run) {
  return {body.material.density, run.smallest_fragment, static_cast<std::size_t>(run.max_fragments)};
}

// What of the ligament's surface has parted pieces: of each face the side to which its normal points.
TriMesh parting_faces(const std::vector<Fragment>& fragments, const TriMesh& surface, std::size_t first) {
  TriMesh parting;
  for (const Fragment& f : fragments) {
    std::vector<TriId> faces;
    for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t) {
      const std::size_t source = f.source[t].index();
      if (f.face_kind[t] == FaceKind::fracture && source >= first &&
          area_vector(f.mesh, TriId(t)).dot(area_vector(surface, TriId(source - first))) > 0)
        faces.emplace_back(t);
    }
    parting = join({parting, submesh(f.mesh, faces)});
  }
  return parting;
}

// None where there is no clean way through.
std::vector<Fragment> parted_by(const std::vector<Fragment>& fragments, const TriMesh& surface,
                                std::size_t first, const FragmentSettings& settings) {
  try {
    return part_fragments(fragments, surface, first, settings);
  } catch (const ComputationError&) {
    return {};
  } catch (const InputError&) {  // the surface passes through itself
    return {};
  }
}

// The fragments' nodes with their slits open, and whether none crosses itself then.
struct OpenFragments {
  std::vector<IdVector<NodeId, Vec3>> positions;
  bool clean = true;
};

OpenFragments open_all(const std::vector<Fragment>& fragments, double width) {
  OpenFragments open;
  open.positions.resize(fragments.size());
  std::vector<char> clean(fragments.size());
  parallel_for(fragments.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Fragment f = fragments[i];
      clean[i] = open_slits(f, width);
      open.positions[i] = std::move(f.mesh.positions);
    }
  });
  open.clean = std::all_of(clean.begin(), clean.end(), [](char c) { return c != 0; });
  return open;
}

// The triangles of the sheets that lie farther than `near` from the surface.
TriMesh apart_from(const TriMesh& sheets, const TriMesh& surface, double near) {
  if (surface.corners.empty()) return sheets;
  const ClosestPointTree tree(surface);
  std::vector<TriId> apart;
  for (std::size_t t = 0; t < sheets.triangle_count(); ++t)
    if (tree.closest(centroid(sheets, TriId(t))).squared_distance > near * near) apart.emplace_back(t);
  return submesh(sheets, apart);
}

// Breaks one ligament of a body that is whole but for slits.
class LigamentCut {
 public:
  LigamentCut(BodyCut& cut, const PreparedBody& body, const RunSpec& run, const LastLigament& ligament,
              const TriMesh& sheets)
      : cut_(cut),
        body_(body),
        settings_(fragment_settings(body, run)),
        ligament_(ligament),
        sheets_(sheets),
        surfaces_(ligament, sheets) {}

  // Along a surface that joins the cracks, which part the body with it.
  bool over_ends() {
    std::optional<Parted> best;
    int clean_ways = 0;
    for (const LigamentOverlap& overlap : kOverlaps) {
      std::optional<Parted> way =
          parted(cut_.fragments, unfolded_part(surfaces_.with(overlap)), sheets_.triangle_count());
      if (!way || !way->open.clean) continue;
      if (clean_ways++ == 0 || way->fragments.size() < best->fragments.size()) best = std::move(way);
      if (clean_ways == kCleanWays || best->fragments.size() == 2) break;
    }
    if (best) take(std::move(*best));
    return best.has_value();
  }

  // Along a surface of its own, past cracks too ragged to be joined; what of them lies along it, it stands for.
  bool between_sides() {
    const double stands_for = kStandsFor * ligament_.grid->size();
    const std::vector<Fragment> whole = cut_into_fragments(body_.detailed, {}, settings_);
    for (const DividingSurface& how : kDividingSurfaces) {
      TriMesh surface = unfolded_part(surfaces_.between_sides(how));
      TriMesh others = apart_from(sheets_, surface, stands_for);
      std::optional<Parted> way = parted(whole, std::move(surface), others.triangle_count());
      if (!way || !way->open.clean) continue;
      cut_.inside = others.corners.empty() ? std::optional(TriMesh{}) : std::nullopt;
      cut_.sheets = {std::move(others)};
      cut_.stands_for = stands_for;
      cut_.warnings = {fmt::format(
          "the cracks about what was left to break are too ragged to be joined: the body is cut "
          "along a surface of its own there, {:.3g} m coarse; a smaller resolution.crack shows it "
          "finer",
          ligament_.grid->size())};
      take(std::move(*way));
      return true;
    }
    return false;
  }

 private:
  struct Parted {
    std::vector<Fragment> fragments;
    TriMesh surface;
    std::size_t first;  // of its triangles, among the sources
    OpenFragments open;
  };

  // None where there is no way through, or nothing but chips of the surfaces that cut comes off.
  std::optional<Parted> parted(const std::vector<Fragment>& fragments, TriMesh surface,
                               std::size_t first) const {
    std::vector<Fragment> parts = parted_by(fragments, surface, first, settings_);
    if (parts.size() < 2 || parts[1].volume < kLeastShareOfPart * ligament_.smaller_part) return std::nullopt;
    OpenFragments open = open_all(parts, slit_width(body_));
    return Parted{std::move(parts), std::move(surface), first, std::move(open)};
  }

  void take(Parted way) {
    cut_.ligament = parting_faces(way.fragments, way.surface, way.first);
    cut_.fragments = std::move(way.fragments);
    cut_.opened = std::move(way.open.positions);
  }

  BodyCut& cut_;
  const PreparedBody& body_;
  FragmentSettings settings_;
  const LastLigament& ligament_;
  const TriMesh& sheets_;
  LigamentSurfaces surfaces_;
};

// Where nothing that is left of the detailed body is little, as elements that are coarse beside a slender part leave out
// much of it: what has broken of the elements.
// @param broken  none: they are apart already
std::optional<LastLigament> ligament_like_elements(const PreparedBody& body, const TriMesh& sheets,
                                                   const TriMesh& of_elements,
                                                   const std::optional<LastLigament>& broken) {
  if (broken) return find_same_ligament(body.detailed, sheets, body.crack_edge, *broken);
  for (const LastLigament& seen :
       find_last_ligaments(body.surface, of_elements, body.crack_edge, LigamentsOf::each_and_all))
    if (seen.faces.empty()) return find_same_ligament(body.detailed, sheets, body.crack_edge, seen);
  return std::nullopt;
}

}  // namespace

double slit_width(const PreparedBody& body) {
  return kSlitWidth * body.surface_edge;
}

BodyCut cut_body(const PreparedBody& body, const RunSpec& run, std::vector<TriMesh> sheets) {
  BodyCut cut;
  cut.sheets = std::move(sheets);
  const auto left_whole = [&](const std::exception& error) {  // the frames are still worth having
    cut.warnings.push_back(
        fmt::format("the body could not be cut by the fine crack surface ({}); crack.ply holds the surface "
                    "as swept, the body is left whole",
                    error.what()));
    cut.fragments = cut_into_fragments(body.detailed, {}, fragment_settings(body, run));
  };
  CutFindings findings;
  try {
    cut.fragments = cut_into_fragments(body.detailed, cut.sheets, fragment_settings(body, run), &findings);
  } catch (const ComputationError& error) {  // folded over itself
    left_whole(error);
  } catch (const InputError& error) {  // passes through itself
    left_whole(error);
  }
  cut.inside = std::move(findings.inside);
  return cut;
}

void cut_ligament(BodyCut& cut, const PreparedBody& body, const RunSpec& run,
                  const std::vector<LastLigament>& ligaments) {
  const TriMesh all = join(cut.sheets);
  // A chip is not worth the slits of the body it comes off.
  const double least = run.smallest_body * enclosed_volume(body.detailed);
  for (const LastLigament& ligament : ligaments) {
    LigamentCut by(cut, body, run, ligament, all);
    if (by.over_ends()) return;
    if (ligament.smaller_part >= least && by.between_sides()) return;
  }
}

BodyCut cut_or_break(const PreparedBody& body, const RunSpec& run, const std::vector<TriMesh>& sheets,
                     const TriMesh& of_elements, const WhatBreaks& what) {
  BodyCut cut;
  std::vector<LastLigament> ligaments;
  const auto find = [&] {
    ligaments = find_last_ligaments(body.detailed, join(sheets), body.crack_edge, what.of);
    std::erase_if(ligaments, [&](const LastLigament& ligament) { return !what.breaks(ligament); });
  };
  const bool expected = what.broken.has_value();  // that the sheets alone do not part it: side by side then
  parallel_for(expected ? 2 : 1, 1, [&](std::size_t task, std::size_t) {
    if (task == 0)
      cut = cut_body(body, run, sheets);
    else
      find();
  });
  if (cut.parted()) return cut;
  if (!expected) find();
  if (ligaments.empty())
    if (auto same = ligament_like_elements(body, join(sheets), of_elements, what.broken))
      ligaments.push_back(*std::move(same));
  cut_ligament(cut, body, run, ligaments);
  return cut;
}

}  // namespace conchoid

#include "conchoid/sim/body_cut.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "conchoid/core/error.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/intersect/unfold.hpp"
#include "conchoid/mesh/surface_parts.hpp"
#include "conchoid/surface/open_slits.hpp"

namespace conchoid {
namespace {

// Tried in turn.
constexpr std::array<LigamentOverlap, 8> kOverlaps{
    {{3.5, 0.25}, {3.5, -0.25}, {5, 0.25}, {5, -0.25}, {4.2, 0.35}, {4.2, -0.35}, {2.8, 0.15}, {2.8, -0.15}}};

// A piece below this share of what a ligament would part from the body is a chip of the two surfaces that cut it, not
// the part: the volumes are counted in cells.
constexpr double kLeastShareOfPart = 0.5;

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

void cut_ligament(BodyCut& cut, const PreparedBody& body, const RunSpec& run, LigamentsOf of,
                  const std::function<bool(const LastLigament&)>& breaks) {
  const TriMesh all = join(cut.sheets);
  for (const LastLigament& ligament : find_last_ligaments(body.detailed, all, body.crack_edge, of)) {
    if (!breaks(ligament)) continue;
    std::vector<Fragment> best;
    TriMesh best_surface;
    int clean_ways = 0;
    const LigamentSurfaces surfaces(ligament, all);
    for (const LigamentOverlap& overlap : kOverlaps) {
      TriMesh surface = unfolded_part(surfaces.with(overlap));
      std::vector<Fragment> parts =
          parted_by(cut.fragments, surface, all.triangle_count(), fragment_settings(body, run));
      if (parts.size() < 2 || parts[1].volume < kLeastShareOfPart * ligament.smaller_part) continue;
      OpenFragments open = open_all(parts, slit_width(body));
      if (open.clean) ++clean_ways;
      if (best.empty() || (open.clean && (clean_ways == 1 || parts.size() < best.size()))) {
        best = std::move(parts);
        best_surface = std::move(surface);
        cut.opened = std::move(open.positions);
      }
      if (clean_ways == kCleanWays || (clean_ways > 0 && best.size() == 2)) break;
    }
    if (clean_ways == 0) continue;
    cut.ligament = parting_faces(best, best_surface, all.triangle_count());
    cut.fragments = std::move(best);
    return;
  }
}

}  // namespace conchoid

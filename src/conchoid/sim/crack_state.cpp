#include "conchoid/sim/crack_state.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "conchoid/bem/cracked_body.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/intersect/manifold_part.hpp"
#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/mesh/longest_edge_bisection.hpp"
#include "conchoid/surface/separation.hpp"

namespace conchoid {
namespace {

constexpr double kSliver = 5e-3;  // altitude over longest edge that needs no other try
// The same for the displacement that the sheet has already: another moves all of it, and nothing of the system stays.
constexpr double kSliverKept = 1e-3;
constexpr double kNothing = 1e-9;  // below it a piece has no area
// × r̄, longest edge of the surface's pieces at a crack, and how much longer they become with each unit of distance
// from it: K at the ends of a mouth is within a few hundredths then (docs/verification.md).
constexpr double kMouthEdge = 1;
constexpr double kMouthEdgeGrowth = 1;
// × r̄, displacements of a sheet that leaves slivers where it is.
constexpr std::array<double, 8> kShifts{0.0, 0.01, -0.013, 0.024, -0.031, 0.045, -0.057, 0.08};
constexpr double kEqualLength = 1e-6;  // × an edge: lengths that round-off alone tells apart

// Distance of x behind the front at node a: across the front's tangent.
double distance_behind(const Vec3& front, const FrontFrame& frame, const Vec3& x) {
  const Vec3 d = x - front;
  return (d - d.dot(frame.e3) * frame.e3).norm();
}

double squared_longest_edge(const Triangle& t) {
  return std::max({(t[0] - t[1]).squaredNorm(), (t[1] - t[2]).squaredNorm(), (t[2] - t[0]).squaredNorm()});
}

// Smallest altitude over longest edge among the pieces of the cut.
double worst_piece(const CutComplex& cut) {
  double worst = std::numeric_limits<double>::infinity();
  const auto look_at = [&](const std::array<NodeId, 3>& c) {
    const Vec3 &a = cut.positions[c[0]], &b = cut.positions[c[1]], &d = cut.positions[c[2]];
    const double longest = squared_longest_edge({a, b, d});
    const double altitude = longest > 0 ? area_vector2(a, b, d).norm() / longest : 0;
    worst = std::min(worst, altitude);
  };
  for (const auto& c : cut.surface)
    look_at(c);
  for (const auto& c : cut.sheet)
    look_at(c);
  return worst;
}

// The least height of the sheet's pieces over the surface, over their longest edges: what lies between is a flake that
// no system resolves, although no piece need be a sliver.
double flattest_wedge(const CutComplex& cut, const ClosestPointTree& surface) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& c : cut.sheet) {
    const Triangle t{cut.positions[c[0]], cut.positions[c[1]], cut.positions[c[2]]};
    const double height2 = 9 * surface.closest((t[0] + t[1] + t[2]) / 3).squared_distance;
    least = std::min(least, height2 / squared_longest_edge(t));
  }
  return std::sqrt(least);
}

// Squared distance of a triangle from the sheet, at its corners and the middles of its edges and of itself.
double squared_distance(const ClosestPointTree& sheet, const Triangle& t) {
  double least = sheet.closest((t[0] + t[1] + t[2]) / 3).squared_distance;
  for (int k = 0; k < 3; ++k) {
    least = std::min(least, sheet.closest(t[k]).squared_distance);
    least = std::min(least, sheet.closest(0.5 * (t[k] + t[(k + 1) % 3])).squared_distance);
  }
  return least;
}

// The surface as fine as the sheet where that is near: there its displacement changes within a crack edge.
DividedMesh divide_near(const TriMesh& surface, const TriMesh& sheet, double crack_edge) {
  const BoxTree boxes(sheet);
  const ClosestPointTree near(sheet);
  return bisect_longest_edges(surface, [&](const Triangle& t) {
    const double longest = std::sqrt(squared_longest_edge(t));
    const double reach = (longest - kMouthEdge * crack_edge) / kMouthEdgeGrowth - kEqualLength * longest;
    if (!(reach > 0)) return false;
    const Vec3 margin = Vec3::Constant(reach);
    const Vec3 low = t[0].cwiseMin(t[1]).cwiseMin(t[2]), high = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
    bool found = false;
    boxes.visit_overlapping({low - margin, high + margin}, [&](TriId) { found = true; });
    return found && squared_distance(near, t) < reach * reach;
  });
}

DividedMesh undivided(const TriMesh& surface) {
  return bisect_longest_edges(surface, [](const Triangle&) { return false; });
}

// As if the undivided surface had been cut: the nodes of its divisions are none of its own.
CutDivision belong_to(const TriMesh& surface, DividedMesh divided, CutComplex& cut) {
  CutDivision division{std::move(divided.halves), {}};
  cut.surface_node_count = surface.node_count();
  for (TriId& t : cut.surface_parent) {
    division.half.push_back(divided.half[t.index()]);
    t = divided.parent[t.index()];
  }
  return division;
}

// Where the sheet runs exactly through nodes of the surface, or along one of its triangles, the pieces
// degenerate, or lie on it. The boundary elements then see it displaced along its normal by a hundredth of a
// crack edge or a few, the first that leaves no sliver and no flake; the one before is tried before all others.
void cut_for_elements(CrackState& state, const TriMesh& surface, const TriMesh& sheet, double crack_edge,
                      NearCracks near) {
  CutComplex best;
  double best_piece = -1, best_shift = 0;
  DividedMesh divided =
      near == NearCracks::divided ? divide_near(surface, sheet, crack_edge) : undivided(surface);
  const ClosestPointTree faces(surface);
  const bool known = !state.cut.sheet.empty();
  std::vector<double> shifts{state.displacement};
  for (const double shift : kShifts)
    if (shift != state.displacement) shifts.push_back(shift);
  for (const double shift : shifts) {
    TriMesh moved = sheet;
    if (shift != 0) {
      const IdVector<NodeId, Vec3> normals = unit_node_normals(sheet);
      for (std::size_t i = 0; i < moved.node_count(); ++i)
        moved.positions[NodeId(i)] += shift * crack_edge * normals[NodeId(i)];
    }
    try {
      CutComplex cut = corefine(divided.mesh, moved, {kMouthMerge, kMouthBend});
      const double piece = std::min(worst_piece(cut), flattest_wedge(cut, faces));
      if (piece > best_piece) {
        best = std::move(cut);
        best_piece = piece;
        best_shift = shift;
      }
    } catch (const ComputationError&) {  // mouth curves that cannot be told apart: the next one may do
      continue;
    }
    if (best_piece > (known && shift == state.displacement ? kSliverKept : kSliver)) break;
  }
  if (!(best_piece > kNothing))
    throw SingularSystem(
        "the crack runs along the surface mesh so closely that no boundary elements fit between; change "
        "resolution.crack or remesh the body");
  state.cut = std::move(best);
  state.division = belong_to(surface, std::move(divided), state.cut);
  state.displacement = best_shift;
}

// Area vectors around the nodes of the cut's sheet, in the planes of the triangles it was cut from: at the mouth little
// may be left of one, and that turned where nodes merged.
IdVector<NodeId, Vec3> area_vectors_of_whole_sheet(const CutComplex& cut, const TriMesh& sheet) {
  IdVector<NodeId, Vec3> sum(cut.positions.size(), Vec3::Zero());
  for (std::size_t t = 0; t < cut.sheet.size(); ++t) {
    const auto& c = cut.sheet[TriId(t)];
    const double area =
        area_vector2(cut.positions[c[0]], cut.positions[c[1]], cut.positions[c[2]]).norm() / 2;
    for (const NodeId node : c)
      sum[node] += area * unit_normal(sheet, cut.sheet_parent[t]);
  }
  return sum;
}

// What the cut says of the sheet.
// @param sheet  that was cut
void read_cut(CrackState& state, const TriMesh& sheet) {
  state.trimmed = {state.cut.positions, state.cut.sheet};
  state.fronts = find_fronts(state.trimmed, state.cut.mouth,
                             state.sheet.frame == 0 ? FrontNormals::carried_on : FrontNormals::facets,
                             area_vectors_of_whole_sheet(state.cut, sheet));
  std::vector<char> on_mouth(state.cut.positions.size(), 0), used(state.cut.positions.size(), 0);
  for (const Edge& e : state.cut.mouth)
    on_mouth[e.a.index()] = on_mouth[e.b.index()] = 1;
  for (const auto& c : state.cut.sheet)
    for (NodeId node : c)
      used[node.index()] = 1;
  state.node_in_cut.assign(state.sheet.mesh.node_count(), NodeId{});
  for (std::size_t i = 0; i < state.cut.positions.size(); ++i) {
    const NodeId of_sheet = state.cut.sheet_node[NodeId(i)];
    if (of_sheet.valid() && used[i] && !on_mouth[i]) state.node_in_cut[of_sheet] = NodeId(i);
  }
  state.points.clear();
  const auto area_vectors = node_area_vectors(state.sheet.mesh);
  for (std::size_t f = 0; f < state.sheet.fronts.size(); ++f) {
    const SheetFront& front = state.sheet.fronts[f];
    const std::vector<FrontFrame> frames = front_frames(state.sheet, front, area_vectors);
    for (std::size_t k = 0; k < front.nodes.size(); ++k) {
      const NodeId node = front.nodes[k];
      const bool inside = state.node_in_cut[node].valid();
      FrontState& mark = state.sheet.state[node];
      if (mark != FrontState::arrested) mark = inside ? FrontState::active : FrontState::outside;
      if (!inside) continue;
      FrontPoint point{node, state.sheet.correlation[node], frames[k], 0, static_cast<int>(f)};
      if (point.correlation.valid())
        point.distance = distance_behind(state.sheet.mesh.positions[node], frames[k],
                                         state.sheet.mesh.positions[point.correlation]);
      state.points.push_back(point);
    }
  }
}

}  // namespace

void update_crack(CrackState& state, const TriMesh& surface, double crack_edge, NearCracks near) {
  const bool infinite = surface.corners.empty();
  const TriMesh sheet = infinite ? state.sheet.mesh : embedded_part(state.sheet.mesh);
  if (infinite)
    state.cut = uncut_sheet(sheet);
  else
    cut_for_elements(state, surface, sheet, crack_edge, near);
  read_cut(state, sheet);
}

bool hold_crumbs(CrackState& state, double volume) {
  CutComplex& cut = state.cut;
  if (cut.surface.empty()) return false;
  const Shells shells = glue(cut);
  const auto of_crumb = [&](std::size_t face) {
    return shells.volume[static_cast<std::size_t>(shells.solid[face])] < volume;
  };
  IdVector<TriId, std::array<NodeId, 3>> sheet;
  std::vector<TriId> parent;
  std::vector<Edge> edges;
  for (std::size_t s = 0; s < cut.sheet.size(); ++s) {
    const std::size_t upper = shells.surface_faces + s, lower = shells.opposite(upper);
    if (shells.solid[upper] != shells.solid[lower] && (of_crumb(upper) || of_crumb(lower))) continue;
    const auto& c = cut.sheet[TriId(s)];
    sheet.push_back(c);
    parent.push_back(cut.sheet_parent[s]);
    for (std::size_t k = 0; k < 3; ++k)
      edges.emplace_back(c[k], c[(k + 1) % 3]);
  }
  if (sheet.size() == cut.sheet.size()) return false;
  std::sort(edges.begin(), edges.end());
  std::erase_if(cut.mouth, [&](const Edge& e) { return !std::binary_search(edges.begin(), edges.end(), e); });
  cut.sheet = std::move(sheet);
  cut.sheet_parent = std::move(parent);
  read_cut(state, embedded_part(state.sheet.mesh));
  return true;
}

std::vector<Vec3> point_positions(const CrackState& state) {
  std::vector<Vec3> positions;
  for (const FrontPoint& point : state.points)
    positions.push_back(state.sheet.mesh.positions[point.node]);
  return positions;
}

std::vector<FrontPoint> ligament_points(const CrackState& state) {
  std::set<std::size_t> parents;  // sheet triangles with a piece of front that has no node of the sheet
  for (const Front& front : state.fronts) {
    const bool has_node = std::any_of(front.nodes.begin(), front.nodes.end(), [&](NodeId node) {
      const NodeId of_sheet = state.cut.sheet_node[node];
      return of_sheet.valid() && state.node_in_cut[of_sheet].valid();
    });
    if (has_node) continue;
    for (std::size_t t = 0; t < state.cut.sheet.size(); ++t) {
      const auto& c = state.cut.sheet[TriId(t)];
      const auto on_front = std::count_if(c.begin(), c.end(), [&](NodeId node) {
        return std::find(front.nodes.begin(), front.nodes.end(), node) != front.nodes.end();
      });
      if (on_front >= 2) parents.insert(state.cut.sheet_parent[t].index());
    }
  }
  std::vector<FrontPoint> points;
  const auto area_vectors = node_area_vectors(state.sheet.mesh);
  for (std::size_t f = 0; f < state.sheet.fronts.size(); ++f) {
    const SheetFront& front = state.sheet.fronts[f];
    const std::vector<FrontFrame> frames = front_frames(state.sheet, front, area_vectors);
    for (std::size_t k = 0; k < front.nodes.size(); ++k) {
      const NodeId node = front.nodes[k];
      if (state.sheet.state[node] != FrontState::outside) continue;
      const bool wanted = std::any_of(parents.begin(), parents.end(), [&](std::size_t t) {
        const auto& c = state.sheet.mesh.corners[TriId(t)];
        return std::find(c.begin(), c.end(), node) != c.end();
      });
      if (wanted) points.push_back({node, {}, frames[k], 0, static_cast<int>(f)});
    }
  }
  return points;
}

}  // namespace conchoid

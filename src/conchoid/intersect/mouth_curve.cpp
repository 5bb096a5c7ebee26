#include "conchoid/intersect/mouth_curve.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "conchoid/core/error.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/mesh/box_tree.hpp"
#include "conchoid/mesh/corners.hpp"

namespace conchoid {
namespace {

constexpr std::size_t kOfTask = 256;  // elements looked at by one task

using NearPair = std::pair<TriId, TriId>;

// Of one triangle of each pair.
std::vector<NodeId> nodes_near(const TriMesh& mesh, const std::vector<NearPair>& near,
                               TriId NearPair::*triangle) {
  std::vector<NodeId> nodes;
  nodes.reserve(3 * near.size());
  for (const NearPair& pair : near)
    nodes.insert(nodes.end(), mesh.corners[pair.*triangle].begin(), mesh.corners[pair.*triangle].end());
  return nodes;
}

// On which sides of the other's plane its corners lie.
std::array<int, 3> sides_of(const PerturbedTriangle& triangle, const PerturbedTriangle& other) {
  std::array<int, 3> s;
  for (int k = 0; k < 3; ++k)
    s[k] = orientation(*other[0], *other[1], *other[2], *triangle[k]);
  return s;
}

}  // namespace

struct MouthCurve::Intersection {
  std::optional<Segment> segment;  // none where they do not intersect
  bool broken = false;             // neither in a segment nor not at all
};

bool MouthCurve::Segment::has_step(const Edge& e) const {
  return std::find(path.begin(), path.end(), e.a) != path.end() &&
         std::find(path.begin(), path.end(), e.b) != path.end();
}

MouthCurve::MouthCurve(const TriMesh& surface, const TriMesh& sheet)
    : MouthCurve(surface, sheet, overlapping_boxes(surface, sheet)) {}

MouthCurve::MouthCurve(const TriMesh& surface, const TriMesh& sheet, const NearTriangles& near)
    : surface_(surface),
      sheet_(sheet),
      surface_points_(surface, Role::surface, 0, nodes_near(surface, near, &NearPair::first)),
      sheet_points_(sheet, Role::sheet, static_cast<std::uint32_t>(surface.node_count()),
                    nodes_near(sheet, near, &NearPair::second)) {
  find_segments(near);
  make_nodes();
  join_crossings(Kind::surface_edge);
  join_crossings(Kind::sheet_edge);
}

const std::vector<std::size_t>& MouthCurve::SegmentsOfTriangles::operator[](TriId t) const {
  return segments[static_cast<std::size_t>(std::lower_bound(triangles.begin(), triangles.end(), t) -
                                           triangles.begin())];
}

void MouthCurve::find_segments(const NearTriangles& near) {
  const auto found = parallel_values(near.size(), kOfTask,
                                     [&](std::size_t i) { return intersect(near[i].first, near[i].second); });
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].broken)
      throw ComputationError(
          "surface triangle " + std::to_string(near[i].first.value) + " and crack triangle " +
          std::to_string(near[i].second.value) +
          " do not intersect in a segment: is one of them without area or are their nodes not finite?");
    if (found[i].segment) segments_.push_back(*found[i].segment);
  }
}

MouthCurve::Intersection MouthCurve::intersect(TriId t, TriId s) const {
  const PerturbedTriangle T = surface_triangle(t), S = sheet_triangle(s);
  const auto sheet_side = sides_of(S, T);
  if (sheet_side[0] == sheet_side[1] && sheet_side[1] == sheet_side[2]) return {};
  const auto surface_side = sides_of(T, S);
  if (surface_side[0] == surface_side[1] && surface_side[1] == surface_side[2]) return {};
  struct End {
    MouthNode node;
    bool inside_on_right;  // of the segment that starts here
  };
  std::vector<End> ends;
  for (int k = 0; k < 3; ++k) {
    const int j = (k + 1) % 3;
    if (sheet_side[k] != sheet_side[j] && pierces(*S[k], *S[j], T))
      ends.push_back(
          {{Kind::sheet_edge, {sheet_.corners[s][k], sheet_.corners[s][j]}, t}, sheet_side[j] < 0});
    if (surface_side[k] != surface_side[j] && pierces(*T[k], *T[j], S))
      ends.push_back(
          {{Kind::surface_edge, {surface_.corners[t][k], surface_.corners[t][j]}, s}, surface_side[j] > 0});
  }
  if (ends.empty()) return {};
  if (ends.size() != 2 || ends[0].inside_on_right == ends[1].inside_on_right)
    return {.segment = {}, .broken = true};
  const int from = ends[0].inside_on_right ? 1 : 0;
  return {.segment = Segment{t, s, ends[from].node, ends[1 - from].node, {}}};
}

PerturbedTriangle MouthCurve::edge_triangle(const MouthNode& at) const {
  return at.kind == Kind::sheet_edge ? surface_triangle(at.triangle) : sheet_triangle(at.triangle);
}

const PerturbedPoints& MouthCurve::edge_points(const MouthNode& at) const {
  return at.kind == Kind::sheet_edge ? sheet_points_ : surface_points_;
}

// The nodes of the mouth, and all in one numbering.
void MouthCurve::make_nodes() {
  for (const Segment& s : segments_) {
    nodes_.push_back(s.from);
    nodes_.push_back(s.to);
  }
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  positions_.insert(positions_.end(), surface_.positions.begin(), surface_.positions.end());
  positions_.insert(positions_.end(), sheet_.positions.begin(), sheet_.positions.end());
  const auto ends = [&](const MouthNode& at) {
    const auto& points = edge_points(at);
    return std::pair<const PerturbedPoint&, const PerturbedPoint&>(points[at.edge.a], points[at.edge.b]);
  };
  crossings_ = parallel_values(nodes_.size(), kOfTask, [&](std::size_t k) {
    const auto [p, q] = ends(nodes_[k]);
    return crossing(p, q, edge_triangle(nodes_[k]));
  });
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const auto [p, q] = ends(nodes_[k]);
    positions_.push_back(crossings_[k].point(p, q));
  }
  for (Segment& s : segments_)
    s.path = {node(index_of(s.from)), node(index_of(s.to))};
  order_along_edges();
}

std::size_t MouthCurve::index_of(const MouthNode& at) const {
  return static_cast<std::size_t>(std::lower_bound(nodes_.begin(), nodes_.end(), at) - nodes_.begin());
}

// Nodes on one edge follow each other in nodes_; along_edge_ holds them in their order from edge.a to
// edge.b.
void MouthCurve::order_along_edges() {
  constexpr std::size_t edges_of_task = 64;
  along_edge_.resize(nodes_.size());
  std::iota(along_edge_.begin(), along_edge_.end(), 0);
  std::vector<std::size_t> first;  // node of each edge, and past the last one
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if (i == 0 || nodes_[i].kind != nodes_[i - 1].kind || nodes_[i].edge != nodes_[i - 1].edge)
      first.push_back(i);
  const std::size_t edges = first.size();
  first.push_back(nodes_.size());
  parallel_for(edges, edges_of_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e)
      std::sort(along_edge_.begin() + static_cast<long>(first[e]),
                along_edge_.begin() + static_cast<long>(first[e + 1]),
                [&](std::size_t i, std::size_t j) { return i != j && before(i, j); });
  });
}

bool MouthCurve::before(std::size_t i, std::size_t j) const {
  const double left = crossings_[i].to_p * crossings_[j].to_q,
               right = crossings_[j].to_p * crossings_[i].to_q;
  if (std::abs(left - right) > 1e-13 * std::max(left, right)) return left < right;
  const auto& points = edge_points(nodes_[i]);
  return crosses_before(points[nodes_[i].edge.a], points[nodes_[i].edge.b], edge_triangle(nodes_[i]),
                        edge_triangle(nodes_[j]));
}

std::vector<NodeId> MouthCurve::nodes_on_edge(Kind kind, NodeId from, NodeId to) const {
  const Edge edge(from, to);
  std::vector<NodeId> nodes;
  for (std::size_t i = index_of({kind, edge, TriId(0)});
       i < nodes_.size() && nodes_[i].kind == kind && nodes_[i].edge == edge; ++i)
    nodes.push_back(node(along_edge_[i]));
  if (from != edge.a) std::reverse(nodes.begin(), nodes.end());
  return nodes;
}

TriangleCut MouthCurve::triangle_cut(Kind kind, TriId t) const {
  const bool of_surface = kind == Kind::surface_edge;
  const std::size_t node_offset = of_surface ? 0 : surface_.node_count();
  Corners ascending = mesh_of(kind).corners[t];
  std::sort(ascending.begin(), ascending.end());
  TriangleCut cut;
  for (int k = 0; k < 3; ++k) {
    cut.corners[k] = NodeId(ascending[k].index() + node_offset);
    cut.on_edge[k] = nodes_on_edge(kind, ascending[k], ascending[(k + 1) % 3]);
  }
  for (const std::size_t i : segments_in(kind)[t]) {
    const auto& path = segments_[i].path;
    for (std::size_t k = 0; k + 1 < path.size(); ++k)
      cut.segments.emplace_back(path[k], path[k + 1]);
    for (std::size_t k = 1; k + 1 < path.size(); ++k)
      cut.through.push_back({path[k - 1], path[k], path[k + 1]});
  }
  cut.turn = [=, this](NodeId before, NodeId at, NodeId after) { return turn(kind, t, before, at, after); };
  return cut;
}

// Sense of the turn that a curve in triangle t takes where it passes from one triangle of the other mesh
// to the next, across their common edge: the dihedral angle there decides.
int MouthCurve::turn(Kind kind, TriId t, NodeId before, NodeId at, NodeId after) const {
  const bool of_surface = kind == Kind::surface_edge;
  const std::size_t first_node = node(0).index();
  if (at.index() < first_node || at.index() >= first_node + nodes_.size()) return 0;
  const Edge edge = nodes_[at.index() - first_node].edge;
  const auto other_triangle = [&](NodeId end) {
    for (const std::size_t i : segments_in(kind)[t])
      if (segments_[i].has_step(Edge(end, at))) return of_surface ? segments_[i].sheet : segments_[i].surface;
    return TriId();
  };
  const TriId from = other_triangle(before), to = other_triangle(after);
  if (!from.valid() || !to.valid() || from == to) return 0;
  const TriMesh& mesh = of_surface ? sheet_ : surface_;
  const auto& points = of_surface ? sheet_points_ : surface_points_;
  const Corners &c = mesh.corners[from], &d = mesh.corners[to];
  const auto opposite =
      std::find_if(d.begin(), d.end(), [&](NodeId n) { return n != edge.a && n != edge.b; });
  const auto apex = std::find_if(c.begin(), c.end(), [&](NodeId n) { return n != edge.a && n != edge.b; });
  const NodeId end =
      c[static_cast<std::size_t>(apex - c.begin() + 2) % 3];  // of the edge as `from` runs through it
  const PerturbedTriangle F = points.triangle(c);
  PerturbedTriangle X = of_surface ? surface_triangle(t) : sheet_triangle(t);
  std::sort(X.begin(), X.end(), [](const auto* x, const auto* y) { return x->id < y->id; });
  // seen from X's normal, the side of `from` its normal points away from lies left of the curve if `end`
  // lies above X
  const bool back_is_left = orientation(*X[0], *X[1], *X[2], points[end]) > 0;
  const bool goes_back = orientation(*F[0], *F[1], *F[2], points[*opposite]) < 0;
  return back_is_left == goes_back ? 1 : -1;
}

// A sheet that passes through itself draws mouth curves that cross; they get a common node there. A segment
// lies in one triangle of the kind alone, so that all are looked at before any is joined.
void MouthCurve::join_crossings(Kind kind) {
  auto& [triangles, lists] = kind == Kind::surface_edge ? on_surface_ : on_sheet_;
  const auto triangle_of = [&](std::size_t i) {
    return kind == Kind::surface_edge ? segments_[i].surface : segments_[i].sheet;
  };
  std::vector<std::size_t> by_triangle(segments_.size());
  std::iota(by_triangle.begin(), by_triangle.end(), 0);
  std::stable_sort(by_triangle.begin(), by_triangle.end(),
                   [&](std::size_t i, std::size_t j) { return triangle_of(i) < triangle_of(j); });
  for (const std::size_t i : by_triangle) {
    if (triangles.empty() || triangles.back() != triangle_of(i)) {
      triangles.push_back(triangle_of(i));
      lists.emplace_back();
    }
    lists.back().push_back(i);
  }
  const auto crossings = parallel_values(lists.size(), kOfTask, [&](std::size_t k) {
    return lists[k].size() < 2 ? std::vector<CrossingSegments>()
                               : crossing_segments(positions_, triangle_cut(kind, triangles[k]));
  });
  for (std::size_t k = 0; k < lists.size(); ++k)
    for (const CrossingSegments& c : crossings[k]) {
      const auto with = [&](const Edge& e) -> Segment& {
        return segments_[*std::find_if(lists[k].begin(), lists[k].end(),
                                       [&](std::size_t i) { return segments_[i].has_step(e); })];
      };
      join(with(c.first), with(c.second));
    }
}

// Node where two segments come closest.
void MouthCurve::join(Segment& s, Segment& t) {
  const auto& [p, q] = std::pair(positions_[s.path.front()], positions_[s.path.back()]);
  const auto& [v, w] = std::pair(positions_[t.path.front()], positions_[t.path.back()]);
  const Vec3 a = q - p, b = w - v, n = cross(a, b);
  const double share =
      n.squaredNorm() > 0 ? std::clamp(cross(v - p, b).dot(n) / n.squaredNorm(), 0.0, 1.0) : 0.5;
  const NodeId node = positions_.add(Vec3(p + share * a));
  for (Segment* x : {&s, &t}) {
    const Vec3 start = positions_[x->path.front()], along = positions_[x->path.back()] - start;
    const auto place = std::find_if(x->path.begin() + 1, x->path.end() - 1, [&](NodeId other) {
      return (positions_[other] - start).dot(along) > (positions_[node] - start).dot(along);
    });
    x->path.insert(place, node);
  }
}

std::vector<MouthSide> MouthCurve::sides() const {
  std::vector<MouthSide> mouth;
  for (const Segment& s : segments_)
    for (std::size_t k = 0; k + 1 < s.path.size(); ++k)
      mouth.emplace_back(Edge(s.path[k], s.path[k + 1]), s.path[k] < s.path[k + 1]);
  return mouth;
}

}  // namespace conchoid

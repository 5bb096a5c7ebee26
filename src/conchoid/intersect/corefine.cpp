#include "conchoid/intersect/corefine.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "conchoid/core/error.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/core/progress.hpp"
#include "conchoid/intersect/corefine_merge.hpp"
#include "conchoid/intersect/inside_pieces.hpp"
#include "conchoid/intersect/predicates.hpp"
#include "conchoid/intersect/retriangulate.hpp"
#include "conchoid/mesh/box_tree.hpp"
#include "conchoid/mesh/corners.hpp"
#include "conchoid/mesh/winding_number.hpp"

namespace conchoid {
namespace {

using Points = std::array<const PerturbedPoint*, 3>;

/// Where an edge of one mesh passes through a triangle of the other: a node of the mouth.
struct Key {
  enum Kind : std::uint8_t { sheet_edge, surface_edge } kind;
  Edge edge;
  TriId triangle;
  friend auto operator<=>(const Key&, const Key&) = default;
};

/// A piece of the mouth: where one surface triangle and one sheet triangle intersect. Inside lies to the left
/// of from → to, seen from the side the sheet's normal points to.
struct Segment {
  TriId surface, sheet;
  Key from, to;
  std::vector<NodeId> path;  ///< from, crossings with other segments (only if the sheet or the surface passes
                             ///< through itself), to
};

constexpr std::size_t kOfTask = 256;  // elements looked at by one task

class Corefinement {
 public:
  Corefinement(const TriMesh& surface, const TriMesh& sheet)
      : surface_(surface),
        sheet_(sheet),
        surface_points_(perturbed_points(surface, Role::surface, 0)),
        sheet_points_(
            perturbed_points(sheet, Role::sheet, static_cast<std::uint32_t>(surface.node_count()))) {}

  CutComplex run() {
    cut_both();
    return keep_inside();
  }
  SplitSurfaces split() {
    cut_both();
    std::vector<MouthSide> mouth = mouth_sides();
    const std::vector<bool> sheet_inside =
        inside_pieces(sheet_pieces_, mouth, [&](NodeId n) { return ray_says_inside(n); });
    // What lies to the left on the sheet lies to the right on the surface (theirs is the same curve).
    for (MouthSide& side : mouth)
      side.second = !side.second;
    const std::vector<Corners> surface_pieces(result_.surface.begin(), result_.surface.end());
    const std::vector<bool> surface_inside = inside_pieces(surface_pieces, std::move(mouth), [&](NodeId n) {
      return winding_number(sheet_, positions_[n]) > 0.5;
    });
    SplitSurfaces out;
    for (std::size_t p = 0; p < surface_pieces.size(); ++p)
      out.first.push_back({surface_pieces[p], surface_inside[p]});
    for (std::size_t p = 0; p < sheet_pieces_.size(); ++p)
      out.second.push_back({sheet_pieces_[p], sheet_inside[p]});
    out.positions = std::move(positions_);
    return out;
  }
  /// Per node of the complex that run() returned.
  IdVector<NodeId, SurfaceSupport> supports() const { return supports_; }

 private:
  Points surface_triangle(TriId t) const { return triangle(surface_, surface_points_, t); }
  Points sheet_triangle(TriId s) const { return triangle(sheet_, sheet_points_, s); }
  static Points triangle(const TriMesh& mesh, const std::vector<PerturbedPoint>& points, TriId t) {
    const Corners& c = mesh.corners[t];
    return {&points[c[0].index()], &points[c[1].index()], &points[c[2].index()]};
  }

  static std::array<int, 3> sides(const Points& plane, const Points& of) {
    std::array<int, 3> s;
    for (int k = 0; k < 3; ++k)
      s[k] = orientation(*plane[0], *plane[1], *plane[2], *of[k]);
    return s;
  }

  static bool pierces(const PerturbedPoint& p, const PerturbedPoint& q, const Points& t) {
    const int s = orientation(p, q, *t[0], *t[1]);
    return s == orientation(p, q, *t[1], *t[2]) && s == orientation(p, q, *t[2], *t[0]);
  }

  void cut_both() {
    Progress progress("steps of a cut", 5);
    const auto step = [&](auto&& work) {
      work();
      progress.advance();
    };
    step([&] { find_segments(); });
    step([&] { make_nodes(); });
    step([&] {
      join_crossings(Key::surface_edge);
      join_crossings(Key::sheet_edge);
    });
    step([&] { cut_surface(); });
    step([&] { cut_sheet(); });
  }

  void find_segments() {
    const auto near = overlapping_boxes(surface_, sheet_);
    const auto found = parallel_values(
        near.size(), kOfTask, [&](std::size_t i) { return intersect(near[i].first, near[i].second); });
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (found[i].broken)
        throw ComputationError(
            "surface triangle " + std::to_string(near[i].first.value) + " and crack triangle " +
            std::to_string(near[i].second.value) +
            " do not intersect in a segment: is one of them without area or are their nodes not finite?");
      if (found[i].segment) segments_.push_back(*found[i].segment);
    }
  }

  struct Intersection {
    std::optional<Segment> segment;  ///< none where they do not intersect
    bool broken = false;             ///< neither in a segment nor not at all
  };
  Intersection intersect(TriId t, TriId s) const {
    const Points T = surface_triangle(t), S = sheet_triangle(s);
    const auto sheet_side = sides(T, S);
    if (sheet_side[0] == sheet_side[1] && sheet_side[1] == sheet_side[2]) return {};
    const auto surface_side = sides(S, T);
    if (surface_side[0] == surface_side[1] && surface_side[1] == surface_side[2]) return {};
    struct End {
      Key key;
      bool inside_on_right;  ///< of the segment that starts here
    };
    std::vector<End> ends;
    for (int k = 0; k < 3; ++k) {
      const int j = (k + 1) % 3;
      if (sheet_side[k] != sheet_side[j] && pierces(*S[k], *S[j], T))
        ends.push_back(
            {{Key::sheet_edge, {sheet_.corners[s][k], sheet_.corners[s][j]}, t}, sheet_side[j] < 0});
      if (surface_side[k] != surface_side[j] && pierces(*T[k], *T[j], S))
        ends.push_back(
            {{Key::surface_edge, {surface_.corners[t][k], surface_.corners[t][j]}, s}, surface_side[j] > 0});
    }
    if (ends.empty()) return {};
    if (ends.size() != 2 || ends[0].inside_on_right == ends[1].inside_on_right)
      return {.segment = {}, .broken = true};
    const int from = ends[0].inside_on_right ? 1 : 0;
    return {.segment = Segment{t, s, ends[from].key, ends[1 - from].key, {}}};
  }

  Points edge_triangle(const Key& key) const {
    return key.kind == Key::sheet_edge ? surface_triangle(key.triangle) : sheet_triangle(key.triangle);
  }
  const std::vector<PerturbedPoint>& edge_points(const Key& key) const {
    return key.kind == Key::sheet_edge ? sheet_points_ : surface_points_;
  }

  /// Work numbering: surface nodes, all sheet nodes, mouth nodes by key.
  void make_nodes() {
    for (const Segment& s : segments_) {
      keys_.push_back(s.from);
      keys_.push_back(s.to);
    }
    std::sort(keys_.begin(), keys_.end());
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
    positions_.insert(positions_.end(), surface_.positions.begin(), surface_.positions.end());
    positions_.insert(positions_.end(), sheet_.positions.begin(), sheet_.positions.end());
    const auto ends = [&](const Key& key) {
      const auto& points = edge_points(key);
      return std::pair<const PerturbedPoint&, const PerturbedPoint&>(points[key.edge.a.index()],
                                                                     points[key.edge.b.index()]);
    };
    crossings_ = parallel_values(keys_.size(), kOfTask, [&](std::size_t k) {
      const auto [p, q] = ends(keys_[k]);
      return crossing(p, q, edge_triangle(keys_[k]));
    });
    for (std::size_t k = 0; k < keys_.size(); ++k) {
      const auto [p, q] = ends(keys_[k]);
      positions_.push_back(crossings_[k].point(p, q));
    }
    for (Segment& s : segments_)
      s.path = {node(s.from), node(s.to)};
    order_along_edges();
  }

  NodeId node(std::size_t key) const { return NodeId(surface_.node_count() + sheet_.node_count() + key); }
  std::size_t key_index(const Key& key) const {
    return static_cast<std::size_t>(std::lower_bound(keys_.begin(), keys_.end(), key) - keys_.begin());
  }
  NodeId node(const Key& key) const { return node(key_index(key)); }

  /// Nodes on one edge follow each other in keys_; along_edge_ holds them in their order from edge.a to
  /// edge.b.
  void order_along_edges() {
    constexpr std::size_t edges_of_task = 64;
    along_edge_.resize(keys_.size());
    std::iota(along_edge_.begin(), along_edge_.end(), 0);
    std::vector<std::size_t> first;  // node of each edge, and past the last one
    for (std::size_t i = 0; i < keys_.size(); ++i)
      if (i == 0 || keys_[i].kind != keys_[i - 1].kind || keys_[i].edge != keys_[i - 1].edge)
        first.push_back(i);
    const std::size_t edges = first.size();
    first.push_back(keys_.size());
    parallel_for(edges, edges_of_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t e = begin; e < end; ++e)
        std::sort(along_edge_.begin() + static_cast<long>(first[e]),
                  along_edge_.begin() + static_cast<long>(first[e + 1]),
                  [&](std::size_t i, std::size_t j) { return i != j && before(i, j); });
    });
  }

  bool before(std::size_t i, std::size_t j) const {
    const double left = crossings_[i].to_p * crossings_[j].to_q,
                 right = crossings_[j].to_p * crossings_[i].to_q;
    if (std::abs(left - right) > 1e-13 * std::max(left, right)) return left < right;
    const auto& points = edge_points(keys_[i]);
    return crosses_before(points[keys_[i].edge.a.index()], points[keys_[i].edge.b.index()],
                          edge_triangle(keys_[i]), edge_triangle(keys_[j]));
  }

  std::vector<NodeId> nodes_on_edge(Key::Kind kind, NodeId from, NodeId to) const {
    const Edge edge(from, to);
    std::vector<NodeId> nodes;
    for (std::size_t i = key_index({kind, edge, TriId(0)});
         i < keys_.size() && keys_[i].kind == kind && keys_[i].edge == edge; ++i)
      nodes.push_back(node(along_edge_[i]));
    if (from != edge.a) std::reverse(nodes.begin(), nodes.end());
    return nodes;
  }

  /// What cuts one triangle. Edges of the surface are cut by the sheet (kind surface_edge) and the other way
  /// round.
  TriangleCut triangle_cut(Key::Kind kind, TriId t) const {
    const bool of_surface = kind == Key::surface_edge;
    const std::size_t node_offset = of_surface ? 0 : surface_.node_count();
    Corners ascending = (of_surface ? surface_ : sheet_).corners[t];
    std::sort(ascending.begin(), ascending.end());
    TriangleCut cut;
    for (int k = 0; k < 3; ++k) {
      cut.corners[k] = NodeId(ascending[k].index() + node_offset);
      cut.on_edge[k] = nodes_on_edge(kind, ascending[k], ascending[(k + 1) % 3]);
    }
    for (const std::size_t i : (of_surface ? on_surface_ : on_sheet_)[t]) {
      const auto& path = segments_[i].path;
      for (std::size_t k = 0; k + 1 < path.size(); ++k)
        cut.segments.emplace_back(path[k], path[k + 1]);
      for (std::size_t k = 1; k + 1 < path.size(); ++k)
        cut.through.push_back({path[k - 1], path[k], path[k + 1]});
    }
    cut.turn = [=, this](NodeId before, NodeId at, NodeId after) { return turn(kind, t, before, at, after); };
    return cut;
  }

  /// Sense of the turn that a curve in triangle t takes where it passes from one triangle of the other mesh
  /// to the next, across their common edge: the dihedral angle there decides.
  int turn(Key::Kind kind, TriId t, NodeId before, NodeId at, NodeId after) const {
    const bool of_surface = kind == Key::surface_edge;
    const std::size_t first_key = node(std::size_t{0}).index();
    if (at.index() < first_key || at.index() >= first_key + keys_.size()) return 0;
    const Edge edge = keys_[at.index() - first_key].edge;
    const auto other_triangle = [&](NodeId end) {
      for (const std::size_t i : (of_surface ? on_surface_ : on_sheet_)[t])
        if (has_step(segments_[i], Edge(end, at)))
          return of_surface ? segments_[i].sheet : segments_[i].surface;
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
    const Points F = triangle(mesh, points, from);
    Points X = of_surface ? surface_triangle(t) : sheet_triangle(t);
    std::sort(X.begin(), X.end(), [](const auto* x, const auto* y) { return x->id < y->id; });
    // seen from X's normal, the side of `from` its normal points away from lies left of the curve if `end`
    // lies above X
    const bool back_is_left = orientation(*X[0], *X[1], *X[2], points[end.index()]) > 0;
    const bool goes_back = orientation(*F[0], *F[1], *F[2], points[opposite->index()]) < 0;
    return back_is_left == goes_back ? 1 : -1;
  }

  /// A sheet that passes through itself draws mouth curves that cross; they get a common node there. A segment
  /// lies in one triangle of the kind alone, so that all are looked at before any is joined.
  void join_crossings(Key::Kind kind) {
    auto& lists = kind == Key::surface_edge ? on_surface_ : on_sheet_;
    lists.resize((kind == Key::surface_edge ? surface_ : sheet_).triangle_count());
    for (std::size_t i = 0; i < segments_.size(); ++i)
      lists[kind == Key::surface_edge ? segments_[i].surface : segments_[i].sheet].push_back(i);
    const auto crossings = parallel_values(lists.size(), kOfTask, [&](std::size_t t) {
      return lists[TriId(t)].size() < 2 ? std::vector<CrossingSegments>()
                                        : crossing_segments(positions_, triangle_cut(kind, TriId(t)));
    });
    for (std::size_t t = 0; t < lists.size(); ++t)
      for (const CrossingSegments& c : crossings[t]) {
        const auto with = [&](const Edge& e) -> Segment& {
          return segments_[*std::find_if(lists[TriId(t)].begin(), lists[TriId(t)].end(),
                                         [&](std::size_t i) { return has_step(segments_[i], e); })];
        };
        join(with(c.first), with(c.second));
      }
  }

  static bool has_step(const Segment& s, const Edge& e) {
    const auto a = std::find(s.path.begin(), s.path.end(), e.a),
               b = std::find(s.path.begin(), s.path.end(), e.b);
    return a != s.path.end() && b != s.path.end();
  }

  /// Node where two segments come closest.
  void join(Segment& s, Segment& t) {
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

  /// Pieces of one cut triangle, oriented like it; in canonical order and rotation, the same for a reflected
  /// mesh.
  std::vector<Corners> cut_triangle(Key::Kind kind, TriId t) const {
    const Corners& corners = (kind == Key::surface_edge ? surface_ : sheet_).corners[t];
    Corners ascending = corners;
    std::sort(ascending.begin(), ascending.end());
    const bool even =
        corners[1] ==
        ascending[(std::find(ascending.begin(), ascending.end(), corners[0]) - ascending.begin() + 1) % 3];
    std::vector<Corners> pieces = retriangulate(positions_, triangle_cut(kind, t));
    for (Corners& p : pieces) {
      std::rotate(p.begin(), std::min_element(p.begin(), p.end()), p.end());
      if (!even) std::swap(p[1], p[2]);
    }
    std::sort(pieces.begin(), pieces.end(), [](Corners x, Corners y) {
      std::sort(x.begin(), x.end());
      std::sort(y.begin(), y.end());
      return x < y;
    });
    return pieces;
  }

  /// Of all triangles of a kind, what cut_triangle says; nothing of those that are whole.
  std::vector<std::vector<Corners>> cut_triangles(Key::Kind kind) const {
    const auto& lists = kind == Key::surface_edge ? on_surface_ : on_sheet_;
    return parallel_values(lists.size(), kOfTask, [&](std::size_t t) {
      return lists[TriId(t)].empty() ? std::vector<Corners>() : cut_triangle(kind, TriId(t));
    });
  }

  void cut_surface() {
    const auto cut = cut_triangles(Key::surface_edge);
    for (std::size_t i = 0; i < cut.size(); ++i) {
      const TriId t(i);
      if (on_surface_[t].empty()) {
        result_.surface.push_back(surface_.corners[t]);
        result_.surface_parent.push_back(t);
      }
      for (const Corners& p : cut[i]) {
        result_.surface.push_back(p);
        result_.surface_parent.push_back(t);
      }
    }
  }

  void cut_sheet() {
    const auto cut = cut_triangles(Key::sheet_edge);
    for (std::size_t i = 0; i < cut.size(); ++i) {
      const TriId s(i);
      if (on_sheet_[s].empty()) {
        Corners c = sheet_.corners[s];
        for (NodeId& id : c)
          id = NodeId(id.index() + surface_.node_count());
        sheet_pieces_.push_back(c);
        sheet_parents_.push_back(s);
      }
      for (const Corners& p : cut[i]) {
        sheet_pieces_.push_back(p);
        sheet_parents_.push_back(s);
      }
    }
  }

  /// The mouth's left side is inside.
  std::vector<MouthSide> mouth_sides() const {
    std::vector<MouthSide> mouth;
    for (const Segment& s : segments_)
      for (std::size_t k = 0; k + 1 < s.path.size(); ++k)
        mouth.emplace_back(Edge(s.path[k], s.path[k + 1]), s.path[k] < s.path[k + 1]);
    return mouth;
  }

  /// Whether a segment towards +x +y +z misses the box of a triangle, by more than round-off.
  static bool is_beside_ray(const Vec3& from, const Vec3& to, const Points& T) {
    constexpr double round_off = 1e-9;  // of the segment's length
    double first = -round_off, last = 1 + round_off;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = T[0]->x[axis], b = T[1]->x[axis], c = T[2]->x[axis], length = to[axis] - from[axis];
      if (std::max({a, b, c}) < from[axis]) return true;
      first = std::max(first, (std::min({a, b, c}) - from[axis]) / length - round_off);
      last = std::min(last, (std::max({a, b, c}) - from[axis]) / length + round_off);
    }
    return first > last;
  }

  /// Parity of the surface triangles between a sheet node and a point far away.
  bool ray_says_inside(NodeId work_id) const {
    const PerturbedPoint& p = sheet_points_[work_id.index() - surface_.node_count()];
    const Box box = bounding_box(surface_);
    PerturbedPoint far;
    far.x = p.x + 4 * (box.high - p.x).cwiseAbs() + 2 * (box.high - box.low);
    far.id = static_cast<std::uint32_t>(surface_.node_count() + sheet_.node_count());
    constexpr std::size_t triangles_of_task = 4096;
    std::atomic<std::size_t> passed = 0;
    parallel_for(surface_.triangle_count(), triangles_of_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        const Points T = surface_triangle(TriId(t));
        if (is_beside_ray(p.x, far.x, T)) continue;
        if (orientation(*T[0], *T[1], *T[2], p) != orientation(*T[0], *T[1], *T[2], far) &&
            pierces(p, far, T))
          ++passed;
      }
    });
    return passed % 2 == 1;
  }

  CutComplex keep_inside() {
    const std::vector<bool> inside =
        inside_pieces(sheet_pieces_, mouth_sides(), [&](NodeId n) { return ray_says_inside(n); });
    const std::size_t ns = surface_.node_count();
    std::vector<bool> used(positions_.size(), false);
    for (std::size_t i = 0; i < ns; ++i)
      used[i] = true;
    for (std::size_t i = ns + sheet_.node_count(); i < positions_.size(); ++i)
      used[i] = true;
    for (std::size_t p = 0; p < sheet_pieces_.size(); ++p)
      if (inside[p])
        for (const NodeId id : sheet_pieces_[p])
          used[id.index()] = true;
    std::vector<NodeId> final_id(positions_.size());
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      if (!used[i]) continue;
      final_id[i] = result_.positions.add(positions_[NodeId(i)]);
      const bool of_sheet = i >= ns && i < ns + sheet_.node_count();
      result_.sheet_node.push_back(of_sheet ? NodeId(i - ns) : NodeId());
    }
    result_.surface_node_count = ns;
    for (Corners& c : result_.surface)
      for (NodeId& id : c)
        id = final_id[id.index()];
    for (std::size_t p = 0; p < sheet_pieces_.size(); ++p) {
      if (!inside[p]) continue;
      Corners c = sheet_pieces_[p];
      for (NodeId& id : c)
        id = final_id[id.index()];
      result_.sheet.push_back(c);
      result_.sheet_parent.push_back(sheet_parents_[p]);
    }
    for (const Segment& s : segments_)
      for (std::size_t k = 0; k + 1 < s.path.size(); ++k)
        result_.mouth.emplace_back(final_id[s.path[k].index()], final_id[s.path[k + 1].index()]);
    std::sort(result_.mouth.begin(), result_.mouth.end());
    set_supports(final_id);
    return std::move(result_);
  }

  void set_supports(const std::vector<NodeId>& final_id) {
    using enum SurfaceSupport::Kind;
    supports_.resize(result_.positions.size());
    for (std::size_t i = 0; i < surface_.node_count(); ++i)
      supports_[NodeId(i)].kind = vertex;
    for (std::size_t i = node(keys_.size()).index(); i < final_id.size(); ++i)
      supports_[final_id[i]].kind = vertex;  // crossings stay where they are
    for (std::size_t k = 0; k < keys_.size(); ++k) {
      SurfaceSupport& support = supports_[final_id[node(k).index()]];
      support.kind = keys_[k].kind == Key::surface_edge ? edge : face;
      if (support.kind == edge) {
        support.edge = keys_[k].edge;
        continue;
      }
      support.face = keys_[k].triangle;
      const Points T = surface_triangle(support.face);
      const NodeId a = keys_[k].edge.a;
      support.outside = orientation(*T[0], *T[1], *T[2], sheet_points_[a.index()]) > 0 ? a : keys_[k].edge.b;
    }
  }

  const TriMesh& surface_;
  const TriMesh& sheet_;
  std::vector<PerturbedPoint> surface_points_, sheet_points_;
  std::vector<Segment> segments_;
  std::vector<Key> keys_;            ///< mouth nodes, sorted
  std::vector<Crossing> crossings_;  ///< per key
  std::vector<std::size_t> along_edge_;
  IdVector<TriId, std::vector<std::size_t>> on_surface_, on_sheet_;  ///< segments per triangle
  IdVector<NodeId, Vec3> positions_;                                 ///< in work numbering
  std::vector<Corners> sheet_pieces_;
  std::vector<TriId> sheet_parents_;
  CutComplex result_;
  IdVector<NodeId, SurfaceSupport> supports_;
};

}  // namespace

CutComplex corefine(const TriMesh& surface, const TriMesh& sheet, const CorefineSettings& settings) {
  Corefinement corefinement(surface, sheet);
  CutComplex cut = corefinement.run();
  if (settings.merge > 0)
    merge_mouth(cut, surface, sheet, corefinement.supports(), settings.merge, settings.across);
  return cut;
}

SplitSurfaces split_by_each_other(const TriMesh& first, const TriMesh& second) {
  return Corefinement(first, second).split();
}

}  // namespace conchoid

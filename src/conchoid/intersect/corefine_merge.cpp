#include "conchoid/intersect/corefine_merge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "conchoid/intersect/cut_editor.hpp"

namespace conchoid {
namespace {

using Kind = SurfaceSupport::Kind;

/// Edge of the equilateral triangle of the same area.
double size_of(const TriMesh& mesh, TriId t) {
  return std::sqrt(4 / std::sqrt(3.0) * area_vector(mesh, t).norm());
}

/// How far a node may go, in merging distances, when that removes an edge shorter than one merging distance.
constexpr float farthest = 3;

class Merger : private CutEditor {
 public:
  Merger(CutComplex& cut, const TriMesh& surface, const TriMesh& sheet,
         IdVector<NodeId, SurfaceSupport> supports, double merge, double across)
      : CutEditor(cut, surface, sheet),
        supports_(std::move(supports)),
        merge_(static_cast<float>(merge)),
        across_(across) {}

  void run() {
    measure_sizes();
    claim_outer_nodes();
    constexpr int most_rounds = 50;
    for (int round = 0; round < most_rounds; ++round) {
      const bool flipped = flip_edges();
      const bool merged = merge_once_each();
      if (!flipped && !merged) break;
    }
    write_back();
  }

 private:
  /// Local edge length at every node: mean of surface and sheet, the smallest triangles at the node decide;
  /// where one is much finer than the other, it must not lose its own edges.
  void measure_sizes() {
    constexpr double infinity = std::numeric_limits<double>::infinity(), most = 3;
    std::array<IdVector<NodeId, double>, 2> smallest;
    for (const int l : {surface_layer, sheet_layer}) {
      smallest[l].assign(cut_.positions.size(), infinity);
      for (std::size_t p = 0; p < layers_[l].size(); ++p) {
        const CutPiece& piece = layers_[l][p];
        if (!on_mouth(piece.corners[0]) && !on_mouth(piece.corners[1]) && !on_mouth(piece.corners[2]))
          continue;
        const double size = size_of(l == surface_layer ? surface_ : sheet_, piece.parent);
        for (const NodeId n : piece.corners)
          smallest[l][n] = std::min(smallest[l][n], size);
      }
    }
    size_.resize(cut_.positions.size());
    for (std::size_t i = 0; i < size_.size(); ++i) {
      const auto [low, high] = std::minmax(smallest[0][NodeId(i)], smallest[1][NodeId(i)]);
      size_[NodeId(i)] = high == infinity ? low : std::min(std::sqrt(low * high), most * low);
    }
  }

  /// A sheet node close outside the surface (or exactly on it, which counts as outside) lives on in the mouth
  /// node next to it.
  void claim_outer_nodes() {
    std::map<NodeId, std::pair<double, NodeId>> nearest;
    for (std::size_t i = cut_.surface_node_count; i < cut_.positions.size(); ++i) {
      const NodeId n(i), outer = supports_[n].outside;
      if (!outer.valid()) continue;
      const double distance = (at(n) - sheet_.positions[outer]).norm();
      if (!(static_cast<float>(distance / size_[n]) < merge_)) continue;
      const auto [found, fresh] = nearest.try_emplace(outer, distance, n);
      if (!fresh && distance < found->second.first) found->second = {distance, n};
    }
    for (const auto& [outer, best] : nearest)
      cut_.sheet_node[best.second] = outer;
  }

  /// Whether the sheet's pieces would be bent too far if one of their nodes went to x: it leaves the planes of the
  /// triangles they come from.
  bool bends(const std::vector<std::size_t>& pieces, const Vec3& x, double size) const {
    return std::any_of(pieces.begin(), pieces.end(), [&](std::size_t p) {
      const TriId parent = layers_[sheet_layer][p].parent;
      const Vec3& on = sheet_.positions[sheet_.corners[parent][0]];
      return std::abs((x - on).dot(unit_normal(sheet_, parent))) > across_ * size;
    });
  }

  struct Candidate {
    float ratio;  ///< length or altitude / local edge length; float, so that equal lengths tie whatever the
                  ///< round-off
    NodeId moving;
    NodeId p, q;  ///< q invalid: collapse onto p; else pull into edge pq
    auto key() const { return std::tie(ratio, moving, p, q); }
  };

  bool merge_once_each() {
    std::vector<Candidate> candidates;
    for (const int l : {surface_layer, sheet_layer})
      for (std::size_t p = 0; p < layers_[l].size(); ++p)
        if (layers_[l].alive(p)) add_candidates(layers_[l][p].corners, candidates);
    std::sort(candidates.begin(), candidates.end(),
              [](const Candidate& x, const Candidate& y) { return x.key() < y.key(); });
    candidates.erase(std::unique(candidates.begin(), candidates.end(),
                                 [](const Candidate& x, const Candidate& y) { return x.key() == y.key(); }),
                     candidates.end());
    bool changed = false;
    std::vector<bool> touched(cut_.positions.size(), false);  // their lengths are no longer those of the list
    for (const Candidate& c : candidates) {
      if (touched[c.moving.index()] || touched[c.p.index()] || (c.q.valid() && touched[c.q.index()]))
        continue;
      if (!(c.q.valid() ? pull_into_edge(c.moving, c.p, c.q) : collapse(c.moving, c.p))) continue;
      changed = true;
      touched[c.moving.index()] = touched[c.p.index()] = true;
      if (c.q.valid()) touched[c.q.index()] = true;
    }
    return changed;
  }

  void add_candidates(const Corners& c, std::vector<Candidate>& out) const {
    if (!on_mouth(c[0]) && !on_mouth(c[1]) && !on_mouth(c[2])) return;
    double longest = 0;
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, (at(c[(k + 1) % 3]) - at(c[k])).norm());
    for (int k = 0; k < 3; ++k) {
      const NodeId a = c[k], p = c[(k + 1) % 3], q = c[(k + 2) % 3];
      const double size = std::min(size_[p], size_[q]);
      const auto short_edge =
          static_cast<float>((at(q) - at(p)).norm() / std::max(size, std::min(longest, 1.5 * size)));
      if (short_edge < merge_) {
        if (may_collapse(p, q)) out.push_back({short_edge, p, q, NodeId()});
        if (may_collapse(q, p)) out.push_back({short_edge, q, p, NodeId()});
        add_corner_cut(short_edge, p, q, size, out);
      }
      const double base = (at(q) - at(p)).norm();
      if (base == 0) continue;
      const double altitude = area_vector2(at(a), at(p), at(q)).norm() / base;
      const double foot = (at(a) - at(p)).dot(at(q) - at(p)) / (base * base);
      const auto low = static_cast<float>(altitude / std::min(longest, std::min(size, size_[a])));
      if (low < merge_ && foot > 0 && foot < 1) out.push_back({low, a, std::min(p, q), std::max(p, q)});
    }
  }

  /// A short mouth edge from one surface edge to another cuts off their common corner: better through it.
  void add_corner_cut(float ratio, NodeId p, NodeId q, double size, std::vector<Candidate>& out) const {
    const SurfaceSupport &e = supports_[p], &f = supports_[q];
    if (!is_mouth(p, q) || e.kind != Kind::edge || f.kind != Kind::edge || e.edge == f.edge) return;
    for (const NodeId corner : {e.edge.a, e.edge.b}) {
      if (corner != f.edge.a && corner != f.edge.b) continue;
      for (const NodeId m : {p, q})
        if (static_cast<float>((at(m) - at(corner)).norm() / size) < farthest * merge_)
          out.push_back({ratio, m, corner, NodeId()});
    }
  }

  /// Whether m may move to where n is: within its part of the surface; a node of the sheet inside the body
  /// only onto the mouth.
  bool may_collapse(NodeId m, NodeId n) const {
    const SurfaceSupport &from = supports_[m], &to = supports_[n];
    switch (from.kind) {
      case Kind::none:
        return on_mouth(n);
      case Kind::vertex:
        return false;
      case Kind::edge:
        return on_mouth(m) && ((to.kind == Kind::vertex && (n == from.edge.a || n == from.edge.b)) ||
                               (to.kind == Kind::edge && to.edge == from.edge));
      case Kind::face: {
        const Corners& corners = surface_.corners[from.face];
        return on_mouth(m) &&
               ((to.kind == Kind::vertex && has(corners, n)) ||
                (to.kind == Kind::edge && has(corners, to.edge.a) && has(corners, to.edge.b)) ||
                (to.kind == Kind::face && to.face == from.face));
      }
    }
    return false;
  }

  /// Moves m to n; if that would tear at the neighbours of m on a mouth that passes n closely, they go along.
  bool collapse(NodeId m, NodeId n) {
    if (collapse_all({m}, n)) return true;
    if (!on_mouth(m) || on_mouth(n)) return false;
    const std::vector<NodeId> run = run_near(m, n);
    return run.size() > 1 && collapse_all(run, n);
  }

  /// The part of the mouth around m whose nodes may go to n and are close to it or to each other.
  std::vector<NodeId> run_near(NodeId m, NodeId n) const {
    const auto close = [&](NodeId x, NodeId y, float factor) {
      return static_cast<float>((at(x) - at(y)).norm() / std::min(size_[x], size_[m])) < factor * merge_;
    };
    std::vector<NodeId> run{m};
    for (std::size_t k = 0; k < run.size(); ++k)
      for (const NodeId x : mouth_[run[k]])
        if (std::find(run.begin(), run.end(), x) == run.end() && may_collapse(x, n) &&
            close(x, n, farthest) && (close(x, n, 1) || close(x, run[k], 1)))
          run.push_back(x);
    return run;
  }

  bool collapse_all(const std::vector<NodeId>& run, NodeId n) {
    CutChange change;
    change.gone = run;
    const auto gone = [&](NodeId x) { return std::find(run.begin(), run.end(), x) != run.end(); };
    std::size_t ends = 0;
    for (const NodeId m : run) {
      if (on_mouth(m) && bends(layers_[sheet_layer].around(m), at(n), size_[m])) return false;
      if (on_mouth(m) && on_mouth(n)) {
        if (!is_mouth(m, n)) return false;  // two arms of the mouth would touch
        if (mouth_[m].size() == 1 && mouth_[n].size() == 1)
          return false;                                                 // nothing of the mouth would remain
        if (mouth_[m].size() == 1 && may_collapse(n, m)) return false;  // the end stays where it is
      }
      ends += mouth_[m].size() == 1;
      for (const NodeId x : mouth_[m]) {
        if (!gone(x) || m < x) change.mouth_removed.emplace_back(m, x);
        if (x != n && !gone(x)) change.mouth_added.emplace_back(n, x);
      }
    }
    if (ends > 1 || (on_mouth(run[0]) && !on_mouth(n) && change.mouth_added.empty())) return false;
    for (const int l : {surface_layer, sheet_layer}) {
      for (const NodeId m : run)
        change.removed[l].insert(change.removed[l].end(), layers_[l].around(m).begin(),
                                 layers_[l].around(m).end());
      std::sort(change.removed[l].begin(), change.removed[l].end());
      change.removed[l].erase(std::unique(change.removed[l].begin(), change.removed[l].end()),
                              change.removed[l].end());
      for (const std::size_t p : change.removed[l]) {
        CutPiece piece = layers_[l][p];
        std::replace_if(piece.corners.begin(), piece.corners.end(), gone, n);
        const Corners& c = piece.corners;
        if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0]) change.added[l].push_back(piece);
      }
    }
    if (!make(change)) return false;
    for (const NodeId m : run) {
      if (!cut_.sheet_node[n].valid()) cut_.sheet_node[n] = cut_.sheet_node[m];
      size_[n] = std::min(size_[n], size_[m]);
    }
    return true;
  }

  /// Node m lies close to edge pq, which it shares a piece with: the edge is led through m.
  bool pull_into_edge(NodeId m, NodeId p, NodeId q) {
    const bool mouth_edge = is_mouth(p, q);
    const auto on_edge = layers_[surface_layer].on_edge(p, q);
    SurfaceSupport support = supports_[m];
    Vec3 to = at(m);
    const double foot = (at(m) - at(p)).dot(at(q) - at(p)) / (at(q) - at(p)).squaredNorm();
    const Vec3 on_line =
        foot < 0.5 ? Vec3(at(p) + foot * (at(q) - at(p))) : Vec3(at(q) + (1 - foot) * (at(p) - at(q)));
    if (mouth_edge && !on_mouth(m) &&
        on_surface(m)) {  // the surface's own node beside the mouth: the mouth goes there
      const TriId face = layers_[surface_layer][on_edge[0]].parent;
      if (face != layers_[surface_layer][on_edge[1]].parent || !has(surface_.corners[face], m)) return false;
      if (bends(layers_[sheet_layer].on_edge(p, q), at(m), std::min(size_[p], size_[q]))) return false;
    } else if (mouth_edge && !on_surface(m)) {  // a node of the sheet just below the surface: it comes up
      support = support_of_edge(p, q, on_edge);
      to = on_line;
    } else if (!mouth_edge && on_mouth(m) && support.kind == Kind::face &&
               on_edge.size() == 2) {  // mouth node beside a surface edge
      const SurfaceSupport edge = support_of_edge(p, q, on_edge);
      if (edge.kind != Kind::edge) return false;
      if (!has(surface_.corners[support.face], edge.edge.a) ||
          !has(surface_.corners[support.face], edge.edge.b))
        return false;
      support = edge;
      to = on_line;
      if (bends(layers_[sheet_layer].around(m), to, size_[m])) return false;
    } else {
      return false;
    }
    CutChange change;
    change.moved = m;
    change.to = to;
    for (const int l : {surface_layer, sheet_layer}) {
      change.removed[l] = layers_[l].around(m);
      for (const std::size_t t : layers_[l].on_edge(p, q))
        if (!has(layers_[l][t].corners, m)) change.removed[l].push_back(t);
      for (const std::size_t t : change.removed[l]) {
        const CutPiece& piece = layers_[l][t];
        const bool both = has(piece.corners, p) && has(piece.corners, q);
        if (!both) {
          change.added[l].push_back(piece);
        } else if (!has(piece.corners, m)) {
          for (const NodeId end : {p, q}) {
            CutPiece half = piece;
            std::replace(half.corners.begin(), half.corners.end(), end, m);
            change.added[l].push_back(half);
          }
        }
      }
    }
    if (mouth_edge) {
      change.mouth_removed.emplace_back(p, q);
      change.mouth_added.emplace_back(p, m);
      change.mouth_added.emplace_back(m, q);
    }
    if (!make(change)) return false;
    supports_[m] = support;
    return true;
  }

  /// Part of the surface that the whole edge lies on.
  SurfaceSupport support_of_edge(NodeId p, NodeId q, const std::vector<std::size_t>& on_edge) const {
    SurfaceSupport support;
    if (on_edge.size() != 2) return support;
    const TriId s = layers_[surface_layer][on_edge[0]].parent, t = layers_[surface_layer][on_edge[1]].parent;
    if (s == t) {
      support.kind = Kind::face;
      support.face = s;
      return support;
    }
    for (const NodeId n : {p, q})
      if (supports_[n].kind == Kind::edge) return supports_[n];
    support.kind = Kind::edge;
    support.edge = Edge(p, q);
    return support;
  }

  /// Flips edges inside cut triangles while that improves the worse of the two pieces.
  bool flip_edges() {
    bool any = false;
    for (const int l : {surface_layer, sheet_layer})
      for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t p = 0; p < layers_[l].size(); ++p)
          for (int k = 0; k < 3 && layers_[l].alive(p); ++k)
            changed = flip(l, p, k) || changed;
        any = any || changed;
      }
    return any;
  }

  bool flip(int l, std::size_t p, int k) {
    const CutPiece piece = layers_[l][p];
    const NodeId a = piece.corners[k], b = piece.corners[(k + 1) % 3], c = piece.corners[(k + 2) % 3];
    if (a > b || is_mouth(a, b)) return false;
    const auto both = layers_[l].on_edge(a, b);
    if (both.size() != 2) return false;
    const CutPiece& other = layers_[l][both[0] == p ? both[1] : both[0]];
    if (other.parent != piece.parent) return false;
    NodeId d;
    for (const NodeId n : other.corners)
      if (n != a && n != b) d = n;
    if (c == d || !layers_[l].on_edge(c, d).empty()) return false;
    CutChange change;
    change.removed[l] = both;
    change.added[l] = {{{a, d, c}, piece.parent}, {{d, b, c}, piece.parent}};
    return make(change);
  }

  IdVector<NodeId, SurfaceSupport> supports_;
  float merge_;
  double across_;
  IdVector<NodeId, double> size_;
};

}  // namespace

void merge_mouth(CutComplex& cut, const TriMesh& surface, const TriMesh& sheet,
                 IdVector<NodeId, SurfaceSupport> supports, double merge, double across) {
  if (!cut.mouth.empty()) Merger(cut, surface, sheet, std::move(supports), merge, across).run();
}

}  // namespace conchoid

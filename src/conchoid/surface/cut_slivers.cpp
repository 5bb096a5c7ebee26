#include "conchoid/surface/cut_slivers.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "conchoid/core/interrupt.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/mesh/corners.hpp"
#include "conchoid/mesh/id_lists.hpp"

namespace conchoid {
namespace {

using PieceId = std::size_t;

struct Piece {
  Corners corners;
  TriId parent;
  bool sheet = false;
  bool alive = true;
  std::int8_t badness = 0;  ///< 0: no sliver
};

/// How many pieces meet at an edge.
struct EdgeUse {
  int surface = 0, sheet = 0;
  bool special() const { return !(surface == 2 && sheet == 0) && !(surface == 0 && sheet == 2); }
  friend bool operator==(const EdgeUse&, const EdgeUse&) = default;
};

struct Shape {
  double height = 0, longest = 0;
  int apex = 0;  ///< corner opposite the longest edge
};

Shape shape(const Triangle& t) {
  Shape s;
  for (int k = 0; k < 3; ++k)
    if (const double length = (t[(k + 1) % 3] - t[(k + 2) % 3]).norm(); length > s.longest) {
      s.longest = length;
      s.apex = k;
    }
  if (s.longest > 0) s.height = area_vector2(t[0], t[1], t[2]).norm() / s.longest;
  return s;
}

Triangle triangle(const CutComplex& cut, const Corners& c) {
  return {cut.positions[c[0]], cut.positions[c[1]], cut.positions[c[2]]};
}

bool own(const CutComplex& cut, NodeId n) {
  return n.index() < cut.surface_node_count;
}

/// Every step has to lessen the sum of this. Narrow triangles of the input are none of ours.
std::int8_t badness(const CutComplex& cut, const Piece& p, double smallest) {
  if (!p.sheet && std::all_of(p.corners.begin(), p.corners.end(), [&](NodeId n) { return own(cut, n); }))
    return 0;
  const double height = shape(triangle(cut, p.corners)).height;
  return height >= smallest ? 0 : height >= 0.1 * smallest ? 1 : height >= 1e-3 * smallest ? 10 : 100;
}

std::vector<Piece> pieces_of(const CutComplex& cut, double smallest) {
  constexpr std::size_t of_task = 4096;
  const std::size_t of_surface = cut.surface.size();
  return parallel_values(of_surface + cut.sheet.size(), of_task, [&](std::size_t i) {
    Piece p = i < of_surface
                  ? Piece{cut.surface[TriId(i)], cut.surface_parent[i], false}
                  : Piece{cut.sheet[TriId(i - of_surface)], cut.sheet_parent[i - of_surface], true};
    p.badness = badness(cut, p, smallest);
    return p;
  });
}

/// The pieces around each node, in a list that can be changed from when it is first asked for: most nodes are far from any
/// sliver.
class Stars {
 public:
  Stars(std::size_t node_count, const std::vector<Piece>& pieces)
      : at_first_(node_count,
                  [&](const auto& put) {
                    for (PieceId p = 0; p < pieces.size(); ++p)
                      for (const NodeId n : pieces[p].corners)
                        put(n, static_cast<std::uint32_t>(p));
                  }),
        number_(node_count, -1) {}

  /// Ascending.
  std::vector<PieceId>& operator[](NodeId n) {
    if (number_[n] < 0) {
      number_[n] = static_cast<std::int32_t>(lists_.size());
      const auto star = at_first_[n];
      lists_.emplace_back(star.begin(), star.end());
    }
    return lists_[static_cast<std::size_t>(number_[n])];
  }
  void add_node() {
    number_.push_back(static_cast<std::int32_t>(lists_.size()));
    lists_.emplace_back();
  }
  /// Nodes that have been added are none any more.
  void keep_nodes(std::size_t node_count) { number_.resize(node_count); }

 private:
  NodeLists<std::uint32_t> at_first_;
  IdVector<NodeId, std::int32_t> number_;  ///< of the node's list; −1: none yet
  std::deque<std::vector<PieceId>> lists_;
};

/// The complex as it changes. Steps are written down, so that they can be taken back.
class SliverRemoval {
 public:
  /// @param pieces  of the complex
  SliverRemoval(CutComplex& cut, std::vector<Piece> pieces, const TriMesh& surface, const TriMesh& sheet,
                double smallest)
      : cut_(cut),
        surface_(surface),
        sheet_(sheet),
        smallest_(smallest),
        pieces_(std::move(pieces)),
        stars_(cut.positions.size(), pieces_) {
    for (const Piece& p : pieces_)
      badness_ += p.badness;
  }

  void run() {
    for (bool changed = true; changed;) {
      changed = false;
      throw_if_interrupted();
      for (PieceId p = 0; p < pieces_.size(); ++p)
        if (pieces_[p].alive && pieces_[p].badness > 0) {
          throw_if_interrupted();
          changed = remove(p) || changed;
        }
    }
    write_back();
  }

 private:
  /// Zero: a sliver itself.
  Vec3 reliable_normal(const TriMesh& mesh, TriId t) const {
    return shape(mesh.triangle(t)).height < 1e-3 * smallest_ ? Vec3(Vec3::Zero()) : unit_normal(mesh, t);
  }

  // Steps, and taking them back.

  void add(Piece p) {
    for (const NodeId n : p.corners)
      stars_[n].push_back(pieces_.size());
    added_.push_back(pieces_.size());
    p.badness = badness(cut_, p, smallest_);
    badness_ += p.badness;
    pieces_.push_back(p);
  }
  void unlink(PieceId p) {
    for (const NodeId n : pieces_[p].corners)
      std::erase(stars_[n], p);
    badness_ -= pieces_[p].badness;
  }
  void kill(PieceId p) {
    unlink(p);
    pieces_[p].alive = false;
    killed_.push_back(p);
  }
  void commit() {
    added_.clear();
    killed_.clear();
    drawn_.clear();
  }
  void take_back(std::size_t node_count) {
    for (; !added_.empty(); added_.pop_back()) {
      if (pieces_.back().alive) unlink(pieces_.size() - 1);
      pieces_.pop_back();
    }
    for (const PieceId p : killed_) {
      if (p >= pieces_.size()) continue;
      pieces_[p].alive = true;
      for (const NodeId n : pieces_[p].corners) {
        auto& star = stars_[n];
        star.insert(std::lower_bound(star.begin(), star.end(), p), p);
      }
      badness_ += pieces_[p].badness;
    }
    cut_.positions.resize(node_count);
    cut_.sheet_node.resize(node_count);
    stars_.keep_nodes(node_count);
    commit();
  }

  // What lies where.

  std::vector<NodeId> neighbours(NodeId n) {
    std::vector<NodeId> out;
    for (const PieceId p : stars_[n])
      for (const NodeId m : pieces_[p].corners)
        if (m != n) out.push_back(m);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }
  std::vector<PieceId> pieces_at(NodeId a, NodeId b) {
    std::vector<PieceId> out;
    for (const PieceId p : stars_[a])
      if (has(pieces_[p].corners, b)) out.push_back(p);
    return out;
  }
  EdgeUse use(NodeId a, NodeId b) {
    EdgeUse u;
    for (const PieceId p : pieces_at(a, b))
      ++(pieces_[p].sheet ? u.sheet : u.surface);
    return u;
  }
  /// Triangles of the input surface the node lies in.
  std::vector<TriId> support(NodeId n) {
    std::vector<TriId> out;
    for (const PieceId p : stars_[n])
      if (!pieces_[p].sheet) out.push_back(pieces_[p].parent);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

  /// Of a node: on how many special edges it lies, and whether these make one smooth line.
  struct Line {
    std::size_t edges = 0;
    bool junction = false;
  };
  Line line(NodeId n) {
    Line l;
    std::optional<EdgeUse> first;
    for (const NodeId m : neighbours(n)) {
      const EdgeUse u = use(n, m);
      if (!u.special()) continue;
      ++l.edges;
      if (first && *first != u) l.junction = true;
      first = u;
    }
    l.junction = l.junction || (l.edges != 0 && l.edges != 2);
    return l;
  }

  /// Whether drawing a and b together leaves all connections as they are.
  bool keeps_connections(NodeId a, NodeId b) {
    std::vector<NodeId> opposite;
    for (const PieceId p : pieces_at(a, b))
      for (const NodeId n : pieces_[p].corners)
        if (n != a && n != b) opposite.push_back(n);
    std::sort(opposite.begin(), opposite.end());
    if (std::adjacent_find(opposite.begin(), opposite.end()) != opposite.end()) return false;
    const std::vector<NodeId> around_a = neighbours(a), around_b = neighbours(b);
    std::vector<NodeId> common;
    std::set_intersection(around_a.begin(), around_a.end(), around_b.begin(), around_b.end(),
                          std::back_inserter(common));
    if (common != opposite) return false;
    if (shares_link_edge(a, b)) return false;
    const bool special = use(a, b).special();
    const Line at_a = line(a), at_b = line(b);
    if (at_a.edges > 0 && at_b.edges > 0 && !special) return false;
    if (at_a.junction && at_b.junction) return false;
    return std::none_of(common.begin(), common.end(),
                        [&](NodeId x) { return use(a, x).special() && use(b, x).special(); });
  }
  bool shares_link_edge(NodeId a, NodeId b) {
    const auto link = [&](NodeId n, NodeId without) {
      std::set<Edge> edges;
      for (const PieceId p : stars_[n]) {
        const Corners& c = pieces_[p].corners;
        if (has(c, without)) continue;
        for (int k = 0; k < 3; ++k)
          if (c[k] == n) edges.emplace(c[(k + 1) % 3], c[(k + 2) % 3]);
      }
      return edges;
    };
    const std::set<Edge> of_b = link(b, a);
    const std::set<Edge> of_a = link(a, b);
    return std::any_of(of_a.begin(), of_a.end(), [&](const Edge& e) { return of_b.contains(e); });
  }

  /// Whether a piece faces as the triangle it is a part of, as far as that can be told.
  bool upright(const Piece& p) const {
    const Vec3 n = reliable_normal(p.sheet ? sheet_ : surface_, p.parent);
    const Triangle t = triangle(cut_, p.corners);
    if (n.isZero(0)) return true;
    const Vec3 area = area_vector2(t[0], t[1], t[2]);
    const Shape s = shape(t);
    constexpr double least = 0.3;     // cosine
    constexpr double rounded = 1e-6;  // of the smallest height: no area but for round-off
    if (s.height < smallest_) return area.dot(n) >= -rounded * smallest_ * s.longest;
    return area.dot(n) > least * area.norm();
  }

  /// Whether a node stays in its triangles of the surface where the other one is.
  bool may_move(NodeId from, NodeId to) {
    constexpr double rounded = 1e-3;  // of the smallest height
    if ((cut_.positions[from] - cut_.positions[to]).norm() <= rounded * smallest_) return true;
    const std::vector<TriId> here = support(from), there = support(to);
    return std::includes(there.begin(), there.end(), here.begin(), here.end());
  }

  /// Draws `removed` into `kept`. False: not allowed, nothing done.
  bool collapse(NodeId removed, NodeId kept) {
    if (own(cut_, removed) || !may_move(removed, kept) || !keeps_connections(removed, kept)) return false;
    std::vector<Piece> moved;
    for (const PieceId p : stars_[removed]) {
      if (has(pieces_[p].corners, kept)) continue;
      moved.push_back(pieces_[p]);
      auto& c = moved.back().corners;
      std::replace(c.begin(), c.end(), removed, kept);
      if (!upright(moved.back())) return false;
    }
    for (const PieceId p : std::vector<PieceId>(stars_[removed]))
      kill(p);
    for (const Piece& p : moved)
      add(p);
    drawn_.emplace_back(removed, kept);
    return true;
  }

  NodeId split(NodeId a, NodeId b, const Vec3& at) {
    const std::vector<PieceId> around = pieces_at(a, b);
    const NodeId middle = cut_.positions.add(at);
    cut_.sheet_node.emplace_back();
    stars_.add_node();
    for (const PieceId p : around) {
      const Piece whole = pieces_[p];
      kill(p);
      for (const NodeId end : {a, b}) {
        Piece half = whole;
        std::replace(half.corners.begin(), half.corners.end(), end, middle);
        add(half);
      }
    }
    return middle;
  }

  template <class Step>
  bool attempt(const Step& step) {
    const std::int64_t before = badness_;
    const std::size_t nodes = cut_.positions.size();
    if (step() && badness_ < before) {
      for (const auto& [removed, kept] : drawn_)
        if (!cut_.sheet_node[kept].valid()) cut_.sheet_node[kept] = cut_.sheet_node[removed];
      commit();
      return true;
    }
    take_back(nodes);
    return false;
  }

  bool remove(PieceId p) {
    const Corners c = pieces_[p].corners;
    std::array<int, 3> edges{0, 1, 2};
    const auto length = [&](int k) { return (cut_.positions[c[k]] - cut_.positions[c[(k + 1) % 3]]).norm(); };
    std::stable_sort(edges.begin(), edges.end(), [&](int k, int l) { return length(k) < length(l); });
    for (const int k : edges) {
      if (!(length(k) < smallest_)) break;
      const auto ends = std::minmax(c[k], c[(k + 1) % 3]);
      if (attempt([&] { return collapse(ends.second, ends.first); })) return true;
      if (attempt([&] { return collapse(ends.first, ends.second); })) return true;
    }
    return draw_in(p);
  }

  /// The corner opposite the longest edge goes into that edge, or the edge to the corner.
  bool draw_in(PieceId p) {
    const Corners c = pieces_[p].corners;
    const int k = shape(triangle(cut_, c)).apex;
    const NodeId apex = c[k], a = c[(k + 1) % 3], b = c[(k + 2) % 3];
    const Vec3 from = cut_.positions[std::min(a, b)], along = cut_.positions[std::max(a, b)] - from;
    if (!(along.squaredNorm() > 0)) return false;
    const double share = (cut_.positions[apex] - from).dot(along) / along.squaredNorm();
    if (!(share > 0 && share < 1)) return false;
    const Vec3 foot = from + share * along;
    return attempt([&] { return collapse(apex, split(a, b, foot)); }) ||
           attempt([&] { return collapse(split(a, b, foot), apex); });
  }

  void write_back() {
    cut_.surface.clear();
    cut_.surface_parent.clear();
    cut_.sheet.clear();
    cut_.sheet_parent.clear();
    IdVector<NodeId, char> on_surface(cut_.positions.size(), 0);
    for (const Piece& p : pieces_) {
      if (!p.alive) continue;
      (p.sheet ? cut_.sheet : cut_.surface).push_back(p.corners);
      (p.sheet ? cut_.sheet_parent : cut_.surface_parent).push_back(p.parent);
      if (!p.sheet)
        for (const NodeId n : p.corners)
          on_surface[n] = 1;
    }
    cut_.mouth.clear();
    for (const Corners& c : cut_.sheet)
      for (int k = 0; k < 3; ++k) {
        const NodeId a = c[k], b = c[(k + 1) % 3];
        if (on_surface[a] && on_surface[b] && use(a, b).surface > 0) cut_.mouth.emplace_back(a, b);
      }
    std::sort(cut_.mouth.begin(), cut_.mouth.end());
    cut_.mouth.erase(std::unique(cut_.mouth.begin(), cut_.mouth.end()), cut_.mouth.end());
  }

  CutComplex& cut_;
  const TriMesh &surface_, &sheet_;
  double smallest_;
  std::vector<Piece> pieces_;
  Stars stars_;
  std::vector<PieceId> added_, killed_;
  std::int64_t badness_ = 0;                      ///< of all pieces
  std::vector<std::pair<NodeId, NodeId>> drawn_;  ///< since the last commit: removed, kept
};

}  // namespace

void remove_slivers(CutComplex& cut, const TriMesh& surface, const TriMesh& sheet, double smallest) {
  std::vector<Piece> pieces = pieces_of(cut, smallest);
  if (std::any_of(pieces.begin(), pieces.end(), [](const Piece& p) { return p.badness > 0; }))
    SliverRemoval(cut, std::move(pieces), surface, sheet, smallest).run();
}

}  // namespace conchoid

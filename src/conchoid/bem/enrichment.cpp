#include "conchoid/bem/enrichment.hpp"

#include <algorithm>
#include <map>

namespace conchoid {
namespace {

using Corners = std::array<NodeId, 3>;

std::array<double, 3> unit_value(const Corners& c, NodeId node, double value) {
  return {c[0] == node ? value : 0.0, c[1] == node ? value : 0.0, c[2] == node ? value : 0.0};
}

int corner_of(const Corners& c, NodeId node) {
  return c[0] == node ? 0 : c[1] == node ? 1 : 2;
}

// The parent's three corner functions at a point of its plane.
Vec3 barycentric(const Triangle& parent, const Vec3& x) {
  const Vec3 n = area_vector2(parent[0], parent[1], parent[2]);
  const double scale = 1 / n.squaredNorm();
  Vec3 b;
  for (int k = 0; k < 3; ++k)
    b[k] = n.dot(cross(parent[(k + 1) % 3] - x, parent[(k + 2) % 3] - x)) * scale;
  return b;
}

// Triangles around nodes, and edges with the triangles that run along them in either direction.
class Star {
 public:
  explicit Star(const IdVector<TriId, Corners>& corners) {
    for (std::size_t t = 0; t < corners.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const Corners& c = corners[TriId(t)];
        around_[c[k]].push_back(t);
        along_[{c[k], c[(k + 1) % 3]}] = t;
      }
  }
  const std::vector<std::size_t>& around(NodeId node) const {
    static const std::vector<std::size_t> none;
    const auto found = around_.find(node);
    return found == around_.end() ? none : found->second;
  }
  /// Triangle that has a→b among its counter-clockwise edges, or −1.
  long along(NodeId a, NodeId b) const {
    const auto found = along_.find({a, b});
    return found == along_.end() ? -1 : static_cast<long>(found->second);
  }

 private:
  std::map<NodeId, std::vector<std::size_t>> around_;
  std::map<std::pair<NodeId, NodeId>, std::size_t> along_;
};

class SpaceBuilder {
 public:
  SpaceBuilder(const CutComplex& cut, const TriMesh& surface, const std::vector<BoundaryKind>& kinds,
               const CutDivision& division)
      : cut_(cut),
        surface_(surface),
        kinds_(kinds),
        division_(division),
        surface_star_(cut.surface),
        crack_star_(cut.sheet) {}

  EnrichedSpace build() {
    add_panels();
    add_halves();
    classify_nodes();
    for (std::size_t i = 0; i < cut_.positions.size(); ++i)
      add_functions(NodeId(i));
    for (EnrichmentFunction& f : out_.functions) {
      f.free -= held_[f.node.index()];
      make_key(f);
    }
    return std::move(out_);
  }

 private:
  Triangle geometry(const Corners& c) const {
    return {cut_.positions[c[0]], cut_.positions[c[1]], cut_.positions[c[2]]};
  }

  void add_panels() {
    out_.surface_count = cut_.surface.size();
    out_.parent = cut_.surface_parent;
    for (std::size_t t = 0; t < cut_.surface.size(); ++t) {
      const Corners& c = cut_.surface[TriId(t)];
      out_.panels.push_back(make_panel(geometry(c), c));
      const Corners& parent = surface_.corners[cut_.surface_parent[t]];
      const Triangle x = surface_.triangle(cut_.surface_parent[t]);
      std::array<Vec3, 3> values;
      for (int k = 0; k < 3; ++k) {
        const auto own = std::find(parent.begin(), parent.end(), c[k]);
        values[k] =
            own == parent.end() ? barycentric(x, cut_.positions[c[k]]) : Vec3::Unit(own - parent.begin());
      }
      if (const std::size_t half = half_of(t); half != kNoHalf) keep_exact(division_.halves[half], c, values);
      out_.parent_values.push_back(values);
    }
    for (const Corners& c : cut_.sheet)
      out_.panels.push_back(make_panel(geometry(c), c));
  }

  std::size_t half_of(std::size_t piece) const {
    return division_.half.empty() ? kNoHalf : division_.half[piece];
  }

  // Corners that the piece shares with the half it lies in.
  static void keep_exact(const HalfTriangle& half, const Corners& piece, std::array<Vec3, 3>& values) {
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < 3; ++i)
        if (half.corners[i] == piece[k]) values[k] = half.in_parent[i];
  }

  // The hats of the middles of divided edges, and how the pieces see them.
  void add_halves() {
    halves_of_.resize(cut_.positions.size());
    middle_values_.resize(cut_.positions.size());
    std::vector<Vec3> function;  // per half: what its middle's hat is of the parent's corner functions
    for (std::size_t h = 0; h < division_.halves.size(); ++h) {
      const HalfTriangle& half = division_.halves[h];
      halves_of_[half.corners[2].index()].push_back(h);
      const Vec3 n = cross(half.in_parent[0], half.in_parent[1]);
      function.push_back(n / n.dot(half.in_parent[2]));
    }
    for (std::size_t t = 0; t < cut_.surface.size(); ++t)
      for (std::size_t h = half_of(t); h != kNoHalf; h = division_.halves[h].whole) {
        const std::array<Vec3, 3>& at = out_.parent_values[t];
        middle_values_[division_.halves[h].corners[2].index()].push_back(
            {t, {function[h].dot(at[0]), function[h].dot(at[1]), function[h].dot(at[2])}});
      }
  }

  void classify_nodes() {
    const std::size_t n = cut_.positions.size();
    on_front_.assign(n, 0);
    held_.assign(n, Mat3::Zero());
    mouth_edges_.resize(n);
    for (const Edge& e : cut_.mouth) {
      mouth_edges_[e.a.index()].push_back(e.b);
      mouth_edges_[e.b.index()].push_back(e.a);
    }
    for (const Corners& c : cut_.sheet)
      for (int k = 0; k < 3; ++k) {
        const NodeId a = c[k], b = c[(k + 1) % 3];
        if (crack_star_.along(b, a) >= 0 ||
            std::binary_search(cut_.mouth.begin(), cut_.mouth.end(), Edge(a, b)))
          continue;
        on_front_[a.index()] = on_front_[b.index()] = 1;
      }
    for (std::size_t t = 0; t < cut_.surface.size(); ++t)
      if (const BoundaryKind& kind = kinds_[cut_.surface_parent[t].index()]; !kind.holds_nothing())
        for (NodeId node : cut_.surface[TriId(t)])
          held_[node.index()] = join_held(held_[node.index()], kind.held());
  }

  void add_functions(NodeId node) {
    const bool on_mouth = !mouth_edges_[node.index()].empty();
    if (held_[node.index()].isIdentity(0)) return;
    if (!halves_of_[node.index()].empty())
      add_middle(node);
    else if (!is_surface_node(node) && !surface_star_.around(node).empty())
      add_hat(node);
    if (crack_star_.around(node).empty()) return;
    if (on_front_[node.index()]) return;
    if (!on_mouth) return add_crack_hat(node);
    if (mouth_edges_[node.index()].size() == 2) add_mouth(node);
  }

  bool is_surface_node(NodeId node) const { return node.index() < cut_.surface_node_count; }

  void add_crack_values(NodeId node, EnrichmentFunction& f) const {
    for (std::size_t t : crack_star_.around(node))
      f.support.push_back({out_.surface_count + t, unit_value(cut_.sheet[TriId(t)], node, -1)});
  }

  void add_crack_hat(NodeId node) {
    EnrichmentFunction f{EnrichmentKind::crack, node, {}, {}, Mat3::Identity()};
    add_crack_values(node, f);
    out_.functions.push_back(std::move(f));
  }

  void add_hat(NodeId node) {
    EnrichmentFunction f{EnrichmentKind::hat, node, {}, {}, Mat3::Identity()};
    for (std::size_t t : surface_star_.around(node))
      f.support.push_back({t, unit_value(cut_.surface[TriId(t)], node, 1)});
    out_.functions.push_back(std::move(f));
  }

  void add_middle(NodeId node) {
    out_.functions.push_back({EnrichmentKind::hat, node, middle_values_[node.index()], {}, Mat3::Identity()});
  }

  // The surface pieces around a mouth node fall into two fans. The piece on the side the crack normal points
  // to runs along the mouth edge in the direction the crack triangle does.
  void add_mouth(NodeId node) {
    EnrichmentFunction f{EnrichmentKind::mouth, node, {}, {}, Mat3::Identity()};
    std::vector<std::size_t> plus;
    if (!collect_plus_fan(node, plus)) return;
    add_crack_values(node, f);
    for (std::size_t t : surface_star_.around(node)) {
      const bool is_plus = std::find(plus.begin(), plus.end(), t) != plus.end();
      f.support.push_back({t, unit_value(cut_.surface[TriId(t)], node, is_plus ? 0.5 : -0.5)});
    }
    out_.functions.push_back(std::move(f));
  }

  bool collect_plus_fan(NodeId node, std::vector<std::size_t>& plus) const {
    for (NodeId other : mouth_edges_[node.index()]) {
      // walk counter-clockwise from the mouth edge node→other if the crack runs that way: its left side is
      // plus
      if (crack_star_.along(node, other) < 0) continue;
      NodeId spoke = other;
      for (std::size_t guard = 0; guard <= surface_star_.around(node).size(); ++guard) {
        const long t = surface_star_.along(node, spoke);
        if (t < 0) return false;
        plus.push_back(static_cast<std::size_t>(t));
        const Corners& c = cut_.surface[TriId(static_cast<std::size_t>(t))];
        spoke = c[(corner_of(c, node) + 2) % 3];
        if (is_mouth_edge(node, spoke)) return true;
      }
      return false;
    }
    return false;
  }

  bool is_mouth_edge(NodeId a, NodeId b) const {
    const auto& others = mouth_edges_[a.index()];
    return std::find(others.begin(), others.end(), b) != others.end();
  }

  using KeyPart = std::array<double, 12>;

  // A triangle and the values at its corners, of which only that of corner `first` is not zero.
  static KeyPart key_part(const Triangle& x, const std::array<double, 3>& w, int first) {
    KeyPart part;
    for (int k = 0; k < 3; ++k) {
      const int c = (first + k) % 3;
      for (int j = 0; j < 3; ++j)
        part[4 * k + j] = x[c][j];
      part[4 * k + 3] = w[c];
    }
    return part;
  }

  void make_key(EnrichmentFunction& f) const {
    std::vector<KeyPart> parts;
    if (f.kind == EnrichmentKind::hat && !halves_of_[f.node.index()].empty()) {
      for (const std::size_t h : halves_of_[f.node.index()])
        parts.push_back(key_part(geometry(division_.halves[h].corners), {0, 0, 1}, 2));
    } else {
      for (const PanelValues& v : f.support) {
        int first = 0;
        while (first < 2 && v.w[first] == 0)
          ++first;
        parts.push_back(key_part(out_.panels[v.panel].x, v.w, first));
      }
    }
    std::sort(parts.begin(), parts.end());
    f.key.push_back(static_cast<double>(f.kind));
    for (const auto& part : parts)
      f.key.insert(f.key.end(), part.begin(), part.end());
  }

  const CutComplex& cut_;
  const TriMesh& surface_;
  const std::vector<BoundaryKind>& kinds_;
  const CutDivision& division_;
  const Star surface_star_, crack_star_;
  std::vector<char> on_front_;
  std::vector<Mat3> held_;  // per node: projection onto the directions in which it is held
  std::vector<std::vector<NodeId>> mouth_edges_;
  std::vector<std::vector<std::size_t>> halves_of_;      // per node: the halves that it is the middle of
  std::vector<std::vector<PanelValues>> middle_values_;  // per node: its hat on the pieces of these
  EnrichedSpace out_;
};

}  // namespace

EnrichedSpace make_enriched_space(const CutComplex& cut, const TriMesh& surface,
                                  const std::vector<BoundaryKind>& kinds, const CutDivision& division) {
  return SpaceBuilder(cut, surface, kinds, division).build();
}

CutComplex uncut_sheet(const TriMesh& sheet) {
  CutComplex cut;
  cut.positions = sheet.positions;
  for (std::size_t i = 0; i < sheet.node_count(); ++i)
    cut.sheet_node.push_back(NodeId(i));
  cut.sheet = sheet.corners;
  for (std::size_t t = 0; t < sheet.triangle_count(); ++t)
    cut.sheet_parent.push_back(TriId(t));
  return cut;
}

CutComplex whole_surface(const TriMesh& surface) {
  CutComplex cut;
  cut.positions = surface.positions;
  cut.surface_node_count = surface.node_count();
  cut.sheet_node.assign(surface.node_count(), NodeId{});
  cut.surface = surface.corners;
  for (std::size_t t = 0; t < surface.triangle_count(); ++t)
    cut.surface_parent.push_back(TriId(t));
  return cut;
}

}  // namespace conchoid

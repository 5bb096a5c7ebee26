#include "conchoid/surface/weld_fragments.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "conchoid/core/union_find.hpp"
#include "conchoid/intersect/retriangulate.hpp"
#include "conchoid/mesh/place.hpp"
#include "conchoid/surface/contacts.hpp"

namespace conchoid {
namespace {

/// A triangle of a member.
struct Face {
  std::array<NodeId, 3> corners;
  FaceKind kind;
  TriId source;
  std::size_t member;
};

using Tiles = std::map<TriId, std::vector<Triangle>>;

/// Fracture faces of all pieces, by the sheet triangle they come from.
Tiles all_tiles(const std::vector<Fragment>& pieces) {
  Tiles tiles;
  for (const Fragment& f : pieces)
    for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t)
      if (f.face_kind[t] == FaceKind::fracture) tiles[f.source[t]].push_back(f.mesh.triangle(TriId(t)));
  return tiles;
}

Vec3 area_of(const Triangle& t) {
  return 0.5 * area_vector2(t[0], t[1], t[2]);
}

class Weld {
 public:
  Weld(const std::vector<Fragment>& all, const std::vector<std::size_t>& members) : tiles_(all_tiles(all)) {
    for (const std::size_t m : members) {
      const std::size_t first = positions_.size();
      const TriMesh& mesh = all[m].mesh;
      positions_.insert(positions_.end(), mesh.positions.begin(), mesh.positions.end());
      for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        auto corners = mesh.corners[TriId(t)];
        for (NodeId& c : corners)
          c = NodeId(c.index() + first);
        faces_.push_back({corners, all[m].face_kind[t], all[m].source[t], m});
      }
    }
  }

  /// Slits so narrow that their sides would share an edge are closed; those whose sides cannot be matched
  /// are widened instead, until they are wide enough.
  Fragment sewn() {
    divide_alike();
    std::set<Place> closed, open;
    for (int round = 0; round < 12; ++round) {
      find_partners(closed, open);
      Fragment out = sew();
      const std::set<Place> pinched = pinched_places(out.mesh);
      if (pinched.empty()) return out;
      for (const Place& p : pinched)
        if (!closed.insert(p).second) open.insert(p);
    }
    return unsewn();
  }

 private:
  /// Side by side.
  Fragment unsewn() const {
    Fragment out;
    out.mesh.positions = positions_;
    for (const Face& face : faces_)
      add(out, face, face.corners);
    return out;
  }

  static void add(Fragment& out, const Face& face, const std::array<NodeId, 3>& corners) {
    out.mesh.corners.push_back(corners);
    out.face_kind.push_back(face.kind);
    out.source.push_back(face.source);
  }

  Triangle triangle(const Face& f) const {
    return {positions_[f.corners[0]], positions_[f.corners[1]], positions_[f.corners[2]]};
  }

  // --- faces that lie on several smaller ones are divided like them

  void divide_alike() {
    std::vector<Face> divided;
    std::vector<const Face*> whole;
    for (const Face& face : faces_)
      if (face.kind != FaceKind::fracture || !divide(face, divided)) whole.push_back(&face);
    for (const Face* face : whole)
      divide_edges(*face, divided);
    faces_ = std::move(divided);
  }

  /// What lies on the face, turned to look its way; empty unless it covers the face in several parts.
  std::vector<Triangle> parts_on(const Face& face) const {
    const Triangle t = triangle(face);
    const Vec3 area = area_of(t);
    std::vector<Triangle> parts;
    if (area.isZero(0)) return parts;
    double covered = 0;
    for (const Triangle& other : tiles_.at(face.source)) {
      const Vec3 its_area = area_of(other);
      if (!(its_area.dot(area) < 0)) continue;
      if (common_area(other, t, area.normalized()) < 0.5 * its_area.norm()) continue;
      parts.push_back({other[0], other[2], other[1]});
      covered += its_area.norm();
    }
    if (parts.size() < 2 || std::abs(covered / area.norm() - 1) > 1e-6) parts.clear();
    return parts;
  }

  /// Replaces a face by the parts that lie on it. False, and nothing happens, where these do not fit its
  /// corners or its neighbours.
  bool divide(const Face& face, std::vector<Face>& out) {
    const std::vector<Triangle> parts = parts_on(face);
    if (parts.empty()) return false;
    const auto rim = rim_of(parts);
    std::array<std::vector<Place>, 3> inner;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto walked =
          walk(rim, positions_[face.corners[k]], positions_[face.corners[(k + 1) % 3]], rim.size());
      if (!walked) return false;
      inner[k] = *walked;
    }
    if (inner[0].size() + inner[1].size() + inner[2].size() + 3 != rim.size()) return false;
    for (std::size_t k = 0; k < 3; ++k)
      if (!fits(face.corners[k], face.corners[(k + 1) % 3], inner[k])) return false;
    std::map<Place, NodeId> node_at;
    for (std::size_t k = 0; k < 3; ++k) {
      node_at[place(positions_[face.corners[k]])] = face.corners[k];
      const std::vector<NodeId> nodes = nodes_along(face.corners[k], face.corners[(k + 1) % 3], inner[k]);
      for (std::size_t i = 0; i < nodes.size(); ++i)
        node_at[inner[k][i]] = nodes[i];
    }
    for (const Triangle& part : parts) {
      Face small = face;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [entry, is_new] = node_at.try_emplace(place(part[k]));
        if (is_new) entry->second = positions_.add(part[k]);
        small.corners[k] = entry->second;
      }
      out.push_back(small);
    }
    return true;
  }

  /// Edges of the parts that have one part only: from → to.
  static std::map<Place, Place> rim_of(const std::vector<Triangle>& parts) {
    std::map<std::pair<Place, Place>, int> edges;
    for (const Triangle& t : parts)
      for (std::size_t k = 0; k < 3; ++k)
        ++edges[{place(t[k]), place(t[(k + 1) % 3])}];
    std::map<Place, Place> rim;
    for (const auto& [edge, count] : edges)
      if (!edges.contains({edge.second, edge.first})) rim[edge.first] = edge.second;
    return rim;
  }

  /// Places between two places on the rim.
  static std::optional<std::vector<Place>> walk(const std::map<Place, Place>& rim, const Vec3& from,
                                                const Vec3& to, std::size_t limit) {
    std::vector<Place> between;
    for (Place at = place(from); between.size() <= limit;) {
      const auto next = rim.find(at);
      if (next == rim.end()) return std::nullopt;
      at = next->second;
      if (at == place(to)) return between;
      between.push_back(at);
    }
    return std::nullopt;
  }

  /// Whether the edge is still whole, or has been divided at these places.
  bool fits(NodeId from, NodeId to, std::vector<Place> between) const {
    const auto known = on_edge_.find(Edge(from, to));
    if (known == on_edge_.end()) return true;
    if (to < from) std::reverse(between.begin(), between.end());
    return std::equal(between.begin(), between.end(), known->second.begin(), known->second.end(),
                      [&](const Place& p, NodeId n) { return p == place(positions_[n]); });
  }

  std::vector<NodeId> nodes_along(NodeId from, NodeId to, const std::vector<Place>& between) {
    const auto [entry, is_new] = on_edge_.try_emplace(Edge(from, to));
    std::vector<NodeId>& nodes = entry->second;
    if (is_new) {
      for (const Place& p : between)
        nodes.push_back(positions_.add(Vec3(p[0], p[1], p[2])));
      if (to < from) std::reverse(nodes.begin(), nodes.end());
    }
    std::vector<NodeId> directed = nodes;
    if (to < from) std::reverse(directed.begin(), directed.end());
    return directed;
  }

  /// A face takes in the nodes that its neighbours have put on its edges.
  void divide_edges(const Face& face, std::vector<Face>& out) {
    TriangleCut cut;
    cut.corners = face.corners;
    std::sort(cut.corners.begin(), cut.corners.end());
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeId a = cut.corners[k], b = cut.corners[(k + 1) % 3];
      const auto known = on_edge_.find(Edge(a, b));
      if (known == on_edge_.end()) continue;
      cut.on_edge[k] = known->second;
      if (b < a) std::reverse(cut.on_edge[k].begin(), cut.on_edge[k].end());
      count += cut.on_edge[k].size();
    }
    if (count == 0) {
      out.push_back(face);
      return;
    }
    const auto at = std::find(cut.corners.begin(), cut.corners.end(), face.corners[0]) - cut.corners.begin();
    const bool even = cut.corners[static_cast<std::size_t>(at + 1) % 3] == face.corners[1];
    for (auto corners : retriangulate(positions_, cut)) {
      if (!even) std::swap(corners[1], corners[2]);
      out.push_back({corners, face.kind, face.source, face.member});
    }
  }

  // --- faces of two members that lie on each other

  /// The same for both of two faces that lie on each other.
  struct Key {
    TriId source;
    std::array<Place, 3> corners;
    friend auto operator<=>(const Key&, const Key&) = default;
  };

  /// @param closed  faces with a corner there may lie on one of their own member; open: they stay apart
  void find_partners(const std::set<Place>& closed, const std::set<Place>& open) {
    partner_.assign(faces_.size(), {});
    std::map<Key, std::vector<std::size_t>> waiting;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      if (faces_[f].kind != FaceKind::fracture) continue;
      const Key key = key_of(faces_[f]);
      const auto touches = [&](const std::set<Place>& places) {
        return std::any_of(key.corners.begin(), key.corners.end(),
                           [&](const Place& p) { return places.contains(p); });
      };
      if (touches(open)) continue;
      const bool any_member = touches(closed);
      std::vector<std::size_t>& others = waiting[key];
      std::optional<std::size_t> turn;
      const auto match = std::find_if(others.begin(), others.end(), [&](std::size_t g) {
        return (any_member || faces_[g].member != faces_[f].member) && (turn = turn_between(f, g));
      });
      if (match == others.end()) {
        others.push_back(f);
        continue;
      }
      partner_[f] = {*match, *turn};
      partner_[*match] = {f, *turn};
      others.erase(match);
    }
  }

  Key key_of(const Face& face) const {
    Key key{face.source, {}};
    for (std::size_t k = 0; k < 3; ++k)
      key.corners[k] = place(positions_[face.corners[k]]);
    std::sort(key.corners.begin(), key.corners.end());
    return key;
  }

  /// The t for which corner k of f lies at corner t − k of g, if they look at each other. Corners may
  /// coincide, as long as one is left to tell.
  std::optional<std::size_t> turn_between(std::size_t f, std::size_t g) const {
    for (std::size_t t = 0; t < 3; ++t) {
      bool all = true;
      for (std::size_t k = 0; k < 3; ++k)
        all = all && positions_[faces_[f].corners[k]] == positions_[faces_[g].corners[(t + 3 - k) % 3]];
      if (all) return t;
    }
    return std::nullopt;
  }

  bool gone(std::size_t f) const { return partner_[f].face != nowhere; }

  // --- what is left, joined across its edges

  struct Half {
    std::size_t face, corner;
  };

  Fragment sew() const {
    std::map<std::pair<NodeId, NodeId>, Half> half_of;
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k)
        half_of[{faces_[f].corners[k], faces_[f].corners[(k + 1) % 3]}] = {f, k};
    const auto across = [&](const Half& h) {
      const auto& c = faces_[h.face].corners;
      return half_of.at({c[(h.corner + 1) % 3], c[h.corner]});
    };
    UnionFind corners(3 * faces_.size());
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      if (gone(f)) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        Half other = across({f, k});
        while (gone(other.face)) {  // through the joint, on the other member
          const Partner& p = partner_[other.face];
          other = across({p.face, (p.turn + 3 - (other.corner + 1) % 3) % 3});
        }
        corners.join(3 * f + k, 3 * other.face + (other.corner + 1) % 3);
        corners.join(3 * f + (k + 1) % 3, 3 * other.face + other.corner);
      }
    }
    return collected(corners);
  }

  /// Ends of edges that have more than two triangles.
  static std::set<Place> pinched_places(const TriMesh& mesh) {
    std::map<std::pair<NodeId, NodeId>, int> uses;
    for (const auto& c : mesh.corners)
      for (std::size_t k = 0; k < 3; ++k)
        ++uses[{c[k], c[(k + 1) % 3]}];
    std::set<Place> pinched;
    for (const auto& [edge, count] : uses)
      if (count != 1 || !uses.contains({edge.second, edge.first}))
        for (const NodeId node : {edge.first, edge.second})
          pinched.insert(place(mesh.positions[node]));
    return pinched;
  }

  /// Nodes are numbered in the order of the members' own.
  Fragment collected(UnionFind& corners) const {
    std::vector<NodeId> lowest(3 * faces_.size());
    for (std::size_t c = 0; c < lowest.size(); ++c) {
      if (gone(c / 3)) continue;
      NodeId& node = lowest[corners.root(c)];
      const NodeId own = faces_[c / 3].corners[c % 3];
      if (!node.valid() || own < node) node = own;
    }
    std::vector<std::size_t> order;
    for (std::size_t c = 0; c < lowest.size(); ++c)
      if (lowest[c].valid()) order.push_back(c);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t x, std::size_t y) { return lowest[x] < lowest[y]; });
    Fragment out;
    std::vector<NodeId> id(lowest.size());
    for (const std::size_t c : order)
      id[c] = out.mesh.positions.add(positions_[lowest[c]]);
    for (std::size_t f = 0; f < faces_.size(); ++f)
      if (!gone(f))
        add(out, faces_[f],
            {id[corners.root(3 * f)], id[corners.root(3 * f + 1)], id[corners.root(3 * f + 2)]});
    return out;
  }

  static constexpr std::size_t nowhere = static_cast<std::size_t>(-1);
  /// The face that one lies on, and how their corners correspond.
  struct Partner {
    std::size_t face = nowhere, turn = 0;
  };
  const Tiles tiles_;
  IdVector<NodeId, Vec3> positions_;
  std::vector<Face> faces_;
  std::map<Edge, std::vector<NodeId>> on_edge_;  ///< new nodes, from edge.a to edge.b
  std::vector<Partner> partner_;
};

}  // namespace

Fragment welded(const std::vector<Fragment>& all, const std::vector<std::size_t>& members) {
  Fragment out = Weld(all, members).sewn();
  for (const std::size_t m : members)
    out.volume += all[m].volume;
  return out;
}

}  // namespace conchoid

#include "conchoid/intersect/retriangulate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "conchoid/core/error.hpp"
#include "conchoid/mesh/triangulate_polygon.hpp"

namespace conchoid {
namespace {

using Index = PlaneIndex;
using Polygon = PlanePolygon;
using Link = PlaneLink;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The triangle in its own plane: x along (corner 0, corner 1), longest edge of length 1. Local nodes are 0,
/// 1, 2 (corners), then the others in ascending id, so that an index comparison is an id comparison.
class LocalTriangle {
 public:
  LocalTriangle(const IdVector<NodeId, Vec3>& positions, const TriangleCut& cut) : cut_(cut) {
    collect_nodes();
    project(positions);
    for (int k = 0; k < 3; ++k) {
      Index last = k;
      nodes_.edges_of[k] |= (1 << k) | (1 << ((k + 2) % 3));
      for (const NodeId id : cut.on_edge[k]) {
        const Index i = index(id);
        nodes_.edges_of[i] |= 1 << k;
        rim_.push_back(last);
        last = i;
      }
      rim_.push_back(last);
    }
    for (std::size_t i = 0; i < rim_.size(); ++i)
      nodes_.used.insert(plane_link(rim_[i], rim_[(i + 1) % rim_.size()]));
    for (const Edge& s : cut.segments) {
      const Index a = index(s.a), b = index(s.b);
      nodes_.used.insert(plane_link(a, b));
      neighbours_[a].push_back(b);
      neighbours_[b].push_back(a);
    }
    for (const auto& t : cut.through)
      through_[index(t[1])].push_back({index(t[0]), index(t[2])});
  }

  std::vector<CrossingSegments> crossings() {
    std::vector<CrossingSegments> result;
    const std::vector<Polygon> curves = chords();
    for (std::size_t i = 0; i < curves.size(); ++i)
      for (std::size_t j = i + 1; j < curves.size(); ++j)
        if (alternate(curves[i], curves[j])) result.push_back(meeting_segments(curves[i], curves[j]));
    return result;
  }

  std::vector<std::array<NodeId, 3>> pieces() {
    std::vector<Polygon> faces = faces_at_rim();
    join_islands(faces);
    std::vector<std::array<Index, 3>> triangles;
    for (Polygon& face : faces)
      triangulate_polygon(nodes_, std::move(face), triangles);
    std::vector<std::array<NodeId, 3>> result;
    for (const auto& t : triangles)
      result.push_back({ids_[t[0]], ids_[t[1]], ids_[t[2]]});
    return result;
  }

 private:
  Index index(NodeId id) const {
    for (int k = 0; k < 3; ++k)
      if (cut_.corners[k] == id) return k;
    return static_cast<Index>(std::lower_bound(ids_.begin() + 3, ids_.end(), id) - ids_.begin());
  }

  void collect_nodes() {
    ids_.assign(cut_.corners.begin(), cut_.corners.end());
    for (const auto& nodes : cut_.on_edge)
      ids_.insert(ids_.end(), nodes.begin(), nodes.end());
    for (const Edge& s : cut_.segments)
      for (const NodeId id : {s.a, s.b})
        if (std::find(cut_.corners.begin(), cut_.corners.end(), id) == cut_.corners.end()) ids_.push_back(id);
    std::sort(ids_.begin() + 3, ids_.end());
    ids_.erase(std::unique(ids_.begin() + 3, ids_.end()), ids_.end());
    nodes_.edges_of.assign(ids_.size(), 0);
    neighbours_.resize(ids_.size());
  }

  void project(const IdVector<NodeId, Vec3>& positions) {
    const Vec3 &a = positions[ids_[0]], &b = positions[ids_[1]], &c = positions[ids_[2]];
    const double longest =
        std::sqrt(std::max({(b - a).squaredNorm(), (c - a).squaredNorm(), (c - b).squaredNorm()}));
    Vec3 e1 = b - a;
    if (e1.squaredNorm() > 0) e1 /= e1.norm();
    Vec3 e2 = (c - a) - e1.dot(c - a) * e1;
    if (e2.squaredNorm() > 0) e2 /= e2.norm();
    nodes_.at.resize(ids_.size());
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      const Vec3 d = (positions[ids_[i]] - a) / (longest > 0 ? longest : 1.0);
      nodes_.at[i] = {d.dot(e1), d.dot(e2)};
    }
  }

  std::vector<Index> places_on_rim() const {
    std::vector<Index> place(ids_.size(), -1);
    for (std::size_t i = 0; i < rim_.size(); ++i)
      place[rim_[i]] = static_cast<Index>(i);
    return place;
  }

  /// Next node of the curve that comes from `previous`; straight on where curves cross; `previous` again
  /// where the curve ends.
  Index along_curve(Index previous, Index node) const {
    const auto& next = neighbours_[node];
    if (next.size() == 1) return next[0];
    if (next.size() == 2) return next[0] != previous ? next[0] : next[1];
    if (const auto found = through_.find(node); found != through_.end())
      for (const Link& l : found->second) {
        if (l.first == previous) return l.second;
        if (l.second == previous) return l.first;
      }
    throw ComputationError("mouth curves branch inside a triangle");
  }

  /// Curves from rim to rim.
  std::vector<Polygon> chords() const {
    const std::vector<Index> place = places_on_rim();
    std::vector<Polygon> curves;
    for (const Index start : rim_) {
      if (neighbours_[start].empty()) continue;
      Polygon curve{start, neighbours_[start][0]};
      while (place[curve.back()] < 0 && neighbours_[curve.back()].size() > 1)
        curve.push_back(along_curve(curve[curve.size() - 2], curve.back()));
      if (place[curve.back()] > place[start]) curves.push_back(std::move(curve));
    }
    return curves;
  }

  bool alternate(const Polygon& c, const Polygon& d) const {
    const std::vector<Index> place = places_on_rim();
    const Index c0 = place[c.front()], c1 = place[c.back()], d0 = place[d.front()], d1 = place[d.back()];
    return (c0 < d0 && d0 < c1) != (c0 < d1 && d1 < c1);
  }

  CrossingSegments meeting_segments(const Polygon& c, const Polygon& d) const {
    double best = infinity;
    std::size_t at_c = 0, at_d = 0;
    for (std::size_t i = 0; i + 1 < c.size(); ++i)
      for (std::size_t j = 0; j + 1 < d.size(); ++j) {
        const double distance =
            (nodes_.at[c[i]] + nodes_.at[c[i + 1]] - nodes_.at[d[j]] - nodes_.at[d[j + 1]]).squaredNorm();
        const double rank = crosses(c[i], c[i + 1], d[j], d[j + 1]) ? -1 / (1 + distance) : distance;
        if (rank < best) {
          best = rank;
          at_c = i;
          at_d = j;
        }
      }
    return {Edge(ids_[c[at_c]], ids_[c[at_c + 1]]), Edge(ids_[d[at_d]], ids_[d[at_d + 1]])};
  }

  /// Directions at a node where curves cross, counter-clockwise: in the order in which the curves reach the
  /// rim.
  std::vector<Index> counterclockwise(Index node, const std::vector<Index>& place) const {
    std::vector<std::pair<Index, Index>> order;
    for (const Index first : neighbours_[node]) {
      Index previous = node, at = first;
      for (std::size_t guard = 0; place[at] < 0; ++guard) {
        const Index next = along_curve(previous, at);
        previous = at;
        at = next;
        if (guard > ids_.size()) throw ComputationError("mouth curves in a triangle do not close");
      }
      order.emplace_back(place[at], first);
    }
    std::sort(order.begin(), order.end());
    std::vector<Index> directions;
    for (const auto& [where, first] : order)
      directions.push_back(first);
    return directions;
  }

  /// Where a face on the left goes on after the step previous → node, off the rim.
  Index around_face(Index previous, Index node, const std::vector<Index>& place) const {
    if (neighbours_[node].size() <= 2) return along_curve(previous, node);
    const std::vector<Index> directions = counterclockwise(node, place);
    const auto from = std::find(directions.begin(), directions.end(), previous);
    return from == directions.begin() ? directions.back() : *(from - 1);
  }

  /// Walks the faces that touch the rim: at a node on an edge the one segment that starts there lies between
  /// the two parts of the edge.
  std::vector<Polygon> faces_at_rim() {
    const Index n = static_cast<Index>(rim_.size());
    const std::vector<Index> place = places_on_rim();
    for (const Index i : rim_)
      if (neighbours_[i].size() > 1)
        throw ComputationError("a cut triangle has two mouth curves through one edge node");
    std::vector<Polygon> faces;
    std::set<Link> walked;  // directed steps
    const auto walk = [&](Index from, Index to) {
      Polygon face;
      Index previous = from, node = to;
      while (walked.insert({previous, node}).second) {
        face.push_back(previous);
        Index next;
        if (place[node] < 0) {
          next = around_face(previous, node, place);
        } else {
          const Index ahead = rim_[(place[node] + 1) % n], behind = rim_[(place[node] + n - 1) % n];
          next = previous == behind && !neighbours_[node].empty() && !is_segment(previous, node)
                     ? neighbours_[node][0]
                     : ahead;
        }
        previous = node;
        node = next;
      }
      faces.push_back(std::move(face));
    };
    std::vector<bool> seen(ids_.size(), false);
    std::size_t nodes = 0, steps = 0;
    for (Index i = 0; i < n; ++i) {
      if (!walked.contains({rim_[i], rim_[(i + 1) % n]})) walk(rim_[i], rim_[(i + 1) % n]);
      for (const Index member : mark(rim_[i], seen)) {
        ++nodes;
        steps += neighbours_[member].size();
      }
    }
    // faces in the middle, bounded by crossing curves alone
    for (Index i = 3; i < static_cast<Index>(ids_.size()); ++i)
      if (seen[i])
        for (const Index j : neighbours_[i])
          if (!walked.contains({i, j})) walk(i, j);
    if (faces.size() + nodes != rim_.size() + steps / 2 + 1)
      throw ComputationError("mouth curves cross inside a triangle");
    return faces;
  }

  bool is_segment(Index a, Index b) const {
    return std::find(neighbours_[a].begin(), neighbours_[a].end(), b) != neighbours_[a].end();
  }

  /// Curves that touch no edge: closed loops and open paths. Larger loops first, so that nested ones find
  /// their face.
  void join_islands(std::vector<Polygon>& faces) {
    std::vector<bool> seen(ids_.size(), false);
    for (const Index i : rim_)
      mark(i, seen);
    struct Island {
      Polygon walk;
      double area;
      bool closed;
    };
    std::vector<Island> islands;
    for (Index i = 3; i < static_cast<Index>(ids_.size()); ++i) {
      if (seen[i]) continue;
      islands.push_back({});
      Island& island = islands.back();
      Index start = i;  // the lowest id of a loop, the lower end of a path
      const std::vector<Index> members = mark(i, seen);
      for (const Index m : members) {
        if (neighbours_[m].size() > 2) throw ComputationError("mouth curves branch inside a triangle");
        if (neighbours_[m].size() == 1 && (neighbours_[start].size() != 1 || m < start)) start = m;
      }
      island.closed = neighbours_[start].size() == 2;
      Index previous = -1, node = start;
      do {
        island.walk.push_back(node);
        const auto& next = neighbours_[node];
        const Index to = next.size() == 1      ? next[0]
                         : previous < 0        ? std::min(next[0], next[1])
                         : next[0] != previous ? next[0]
                                               : next[1];
        previous = node;
        node = to;
      } while (node != start);
      island.area = std::abs(signed_area(island.walk));
      if (island.closed && turns_right(island.walk)) std::reverse(island.walk.begin(), island.walk.end());
    }
    std::stable_sort(islands.begin(), islands.end(),
                     [](const Island& x, const Island& y) { return x.area > y.area; });
    for (const Island& island : islands) {
      Polygon& face = containing_face(faces, island.walk);
      Polygon hole = island.walk;
      std::reverse(hole.begin(), hole.end());
      bridge(face, hole);
      if (island.closed) faces.push_back(island.walk);
    }
  }

  std::vector<Index> mark(Index start, std::vector<bool>& seen) const {
    std::vector<Index> members;
    if (seen[start]) return members;
    seen[start] = true;
    members.push_back(start);
    for (std::size_t k = 0; k < members.size(); ++k)
      for (const Index j : neighbours_[members[k]])
        if (!seen[j]) {
          seen[j] = true;
          members.push_back(j);
        }
    return members;
  }

  double signed_area(const Polygon& p) const {
    double sum = 0;
    for (std::size_t i = 1; i + 1 < p.size(); ++i)
      sum += plane_area2(nodes_.at[p[0]], nodes_.at[p[i]], nodes_.at[p[i + 1]]);
    return sum;
  }

  /// Whether a closed curve goes round clockwise: by the sum of its turns, which is ±2π; those near ±π get
  /// their sign exactly.
  bool turns_right(const Polygon& p) const {
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Index a = p[i], b = p[(i + 1) % p.size()], c = p[(i + 2) % p.size()];
      const Vec2 u = nodes_.at[b] - nodes_.at[a], v = nodes_.at[c] - nodes_.at[b];
      double angle = std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v));
      if (std::abs(angle) > 3 && cut_.turn)
        if (const int sense = cut_.turn(ids_[a], ids_[b], ids_[c])) angle = sense * std::abs(angle);
      sum += angle;
    }
    return sum < 0;
  }

  bool contains(const Polygon& p, const Vec2& x) const {
    bool inside = false;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vec2 &a = nodes_.at[p[i]], &b = nodes_.at[p[(i + 1) % p.size()]];
      if ((a.y() > x.y()) != (b.y() > x.y()) && (plane_area2(a, b, x) > 0) == (b.y() > a.y()))
        inside = !inside;
    }
    return inside;
  }

  /// The face most nodes of the island lie in (round-off may put single ones astray).
  Polygon& containing_face(std::vector<Polygon>& faces, const Polygon& island) const {
    std::size_t best = 0;
    long best_votes = -1;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      long votes = 0;
      for (std::size_t i = 0; i < island.size(); ++i)
        votes +=
            contains(faces[f], nodes_.at[island[i]]) +
            contains(faces[f], 0.5 * (nodes_.at[island[i]] + nodes_.at[island[(i + 1) % island.size()]]));
      if (votes > best_votes) {
        best_votes = votes;
        best = f;
      }
    }
    return faces[best];
  }

  bool crosses(Index a, Index b, Index c, Index d) const {
    if (a == c || a == d || b == c || b == d) return false;
    const auto &A = nodes_.at[a], &B = nodes_.at[b], &C = nodes_.at[c], &D = nodes_.at[d];
    return (plane_area2(A, B, C) > 0) != (plane_area2(A, B, D) > 0) &&
           (plane_area2(C, D, A) > 0) != (plane_area2(C, D, B) > 0);
  }

  /// Joins a hole to the polygon around it by the shortest edge that crosses nothing; the joined walk runs
  /// along it twice.
  void bridge(Polygon& face, const Polygon& hole) {
    struct Candidate {
      double length;
      std::size_t i, j;
    };
    std::vector<Candidate> candidates;
    for (std::size_t i = 0; i < face.size(); ++i)
      for (std::size_t j = 0; j < hole.size(); ++j)
        candidates.push_back({(nodes_.at[face[i]] - nodes_.at[hole[j]]).squaredNorm(), i, j});
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& x, const Candidate& y) { return x.length < y.length; });
    const auto clear = [&](const Candidate& c) {
      for (const Polygon* p : {static_cast<const Polygon*>(&face), &hole})
        for (std::size_t k = 0; k < p->size(); ++k)
          if (crosses(face[c.i], hole[c.j], (*p)[k], (*p)[(k + 1) % p->size()])) return false;
      return in_wedge(nodes_, face, c.i, nodes_.at[hole[c.j]]) &&
             in_wedge(nodes_, hole, c.j, nodes_.at[face[c.i]]);
    };
    const auto found = std::find_if(candidates.begin(), candidates.end(), clear);
    const Candidate chosen = found != candidates.end() ? *found : candidates.front();
    nodes_.used.insert(plane_link(face[chosen.i], hole[chosen.j]));
    Polygon joined(face.begin(), face.begin() + static_cast<long>(chosen.i) + 1);
    for (std::size_t k = 0; k <= hole.size(); ++k)
      joined.push_back(hole[(chosen.j + k) % hole.size()]);
    joined.insert(joined.end(), face.begin() + static_cast<long>(chosen.i), face.end());
    face = std::move(joined);
  }

  const TriangleCut& cut_;
  std::vector<NodeId> ids_;
  PlaneNodes nodes_;
  std::vector<std::vector<Index>> neighbours_;  ///< along segments
  std::map<Index, std::vector<Link>> through_;  ///< at crossings: nodes before and after, per curve
  Polygon rim_;
};

}  // namespace

std::vector<CrossingSegments> crossing_segments(const IdVector<NodeId, Vec3>& positions,
                                                const TriangleCut& cut) {
  return LocalTriangle(positions, cut).crossings();
}

std::vector<std::array<NodeId, 3>> retriangulate(const IdVector<NodeId, Vec3>& positions,
                                                 const TriangleCut& cut) {
  return LocalTriangle(positions, cut).pieces();
}

}  // namespace conchoid

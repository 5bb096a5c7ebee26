#include "conchoid/crack/front/strip.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "conchoid/crack/front/strip_runs.hpp"
#include "conchoid/crack/length_factors.hpp"

namespace conchoid {

namespace {

/// The strip before its nodes have ids: vertices are numbered old nodes first (position in the curve), then
/// new ones.
struct Draft {
  std::vector<Vec3> position;       ///< per vertex
  std::vector<StripNode> curve;     ///< ids not yet set
  std::vector<std::size_t> vertex;  ///< per node of the new curve
  struct Face {
    std::array<std::size_t, 3> corners;
    std::size_t edge;  ///< old edge it belongs to
  };
  std::vector<Face> faces;
};

class Drafting {
 public:
  Drafting(const TriMesh& mesh, const StripCurve& curve, const std::vector<Vec3>& target,
           const std::vector<bool>& moved, const StripSettings& settings)
      : mesh_(mesh),
        curve_(curve),
        moved_(moved),
        settings_(settings),
        runs_(mesh, curve, target, moved, settings) {}

  Draft draft() {
    const std::size_t n = curve_.nodes.size();
    for (NodeId node : curve_.nodes)
      draft_.position.push_back(mesh_.positions[node]);
    first_vertices();
    const std::size_t start = first_of_its_run();
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = (start + k) % n;
      const std::size_t before = previous_index(i, n, curve_.closed);
      if (k == 0 || vertex_[before] != vertex_[i]) add_node(i);
      if (i + 1 < n || curve_.closed) add_edge(i);
    }
    return std::move(draft_);
  }

 private:
  std::size_t next(std::size_t i) const { return next_index(i, curve_.nodes.size(), curve_.closed); }

  /// New vertex of each old node: itself where it stays, one per run of merged ones.
  void first_vertices() {
    const std::size_t n = curve_.nodes.size();
    constexpr auto kNone = static_cast<std::size_t>(-1);
    std::vector<std::size_t> of_run(n, kNone);
    vertex_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      if (!moved_[i]) {
        vertex_[i] = i;
        continue;
      }
      std::size_t& vertex = of_run[runs_.run(i)];
      if (vertex == kNone) {
        vertex = draft_.position.size();
        draft_.position.push_back(runs_.position(i));
      }
      vertex_[i] = vertex;
    }
  }

  /// A node whose predecessor belongs to another run (0 if there is only one run), so that no run is cut by
  /// the start.
  std::size_t first_of_its_run() const {
    const std::size_t n = curve_.nodes.size();
    for (std::size_t i = 0; i < n; ++i)
      if (!curve_.closed || vertex_[previous_index(i, n, true)] != vertex_[i]) return i;
    return 0;
  }

  void add_node(std::size_t i) {
    StripNode node;
    node.first = node.last = i;
    if (moved_[i]) node.kind = StripNode::Kind::moved;
    if (moved_[i] && runs_.merged(i)) {
      node.kind = StripNode::Kind::merged;
      node.s = 0.5;
      const std::size_t n = curve_.nodes.size();
      for (std::size_t k = 1; k < n && vertex_[next(node.last)] == vertex_[i] && next(node.last) != node.last;
           ++k)
        node.last = next(node.last);
      if (settings_.between && !runs_.pinned(i))
        draft_.position[vertex_[i]] = settings_.between(node.first, node.last, 0.5);
    }
    draft_.curve.push_back(node);
    draft_.vertex.push_back(vertex_[i]);
  }

  void add_edge(std::size_t i) {
    const std::size_t j = next(i);
    if (!moved_[i] && !moved_[j]) return;
    if (vertex_[i] == vertex_[j]) {
      face(i, vertex_[i], j, i);
      return;
    }
    std::vector<std::size_t> chain{vertex_[i]};
    insert_between(i, j, chain);
    chain.push_back(vertex_[j]);
    connect(i, j, chain);
  }

  void insert_between(std::size_t i, std::size_t j, std::vector<std::size_t>& chain) {
    const Vec3 a = draft_.position[vertex_[i]], b = runs_position_of(j);
    const double length = (b - a).norm();
    if (!(settings_.split_above > 0) || length <= settings_.split_above) return;
    const int parts = std::max(2, static_cast<int>(std::ceil(length / settings_.split_above)));
    for (int k = 1; k < parts; ++k) {
      const double s = static_cast<double>(k) / parts;
      StripNode node;
      node.kind = StripNode::Kind::inserted;
      node.first = i;
      node.last = j;
      node.s = s;
      chain.push_back(draft_.position.size());
      draft_.position.push_back(settings_.between ? settings_.between(i, j, s) : Vec3((1 - s) * a + s * b));
      draft_.curve.push_back(node);
      draft_.vertex.push_back(chain.back());
    }
  }

  Vec3 runs_position_of(std::size_t j) const { return draft_.position[vertex_[j]]; }

  /// Triangles between the old edge (i, j) and the chain that takes its place: a fan at the unmoved end, else
  /// fans at both ends that meet in the middle.
  void connect(std::size_t i, std::size_t j, const std::vector<std::size_t>& chain) {
    const std::size_t parts = chain.size() - 1;
    for (std::size_t k = 0; k < parts; ++k) {
      const bool middle = 2 * k + 1 == parts;
      if (!moved_[i])
        face(chain[k], chain[k + 1], j, i);
      else if (!moved_[j])
        face(chain[k], chain[k + 1], i, i);
      else if (middle)
        quad(i, j, chain[k], chain[k + 1]);
      else
        face(chain[k], chain[k + 1], 2 * k + 1 < parts ? i : j, i);
    }
    if (moved_[i] && moved_[j] && parts % 2 == 0) face(i, chain[parts / 2], j, i);
  }

  void quad(std::size_t i, std::size_t j, std::size_t a, std::size_t b) {
    const double from_i = (draft_.position[b] - draft_.position[i]).norm();
    const double from_j = (draft_.position[a] - draft_.position[j]).norm();
    const bool tie = std::abs(from_i - from_j) <= kEqualDiagonals * std::max(from_i, from_j);
    bool at_i = tie ? curve_.nodes[i] < curve_.nodes[j] : from_i < from_j;
    if (!sound_pair(i, j, a, b, at_i) && sound_pair(i, j, a, b, !at_i)) at_i = !at_i;
    if (at_i) {
      face(i, a, b, i);
      face(i, b, j, i);
    } else {
      face(i, a, j, i);
      face(a, b, j, i);
    }
  }

  /// Whether neither triangle of the quad i, a, b, j is turned over with the diagonal at i (else at j).
  bool sound_pair(std::size_t i, std::size_t j, std::size_t a, std::size_t b, bool at_i) const {
    const auto& x = draft_.position;
    const Vec3 expected = cross(x[a] - x[i] + x[b] - x[j], x[j] - x[i]);
    const Vec3 first = at_i ? area_vector2(x[i], x[a], x[b]) : area_vector2(x[i], x[a], x[j]);
    const Vec3 second = at_i ? area_vector2(x[i], x[b], x[j]) : area_vector2(x[a], x[b], x[j]);
    return first.dot(expected) > kLeastStripCosine * first.norm() * expected.norm() &&
           second.dot(expected) > kLeastStripCosine * second.norm() * expected.norm();
  }

  void face(std::size_t a, std::size_t b, std::size_t c, std::size_t edge) {
    if (a != b && b != c && c != a) draft_.faces.push_back({{a, b, c}, edge});
  }

  const TriMesh& mesh_;
  const StripCurve& curve_;
  const std::vector<bool>& moved_;
  const StripSettings& settings_;
  StripRuns runs_;
  std::vector<std::size_t> vertex_;
  Draft draft_;
};

/// Old nodes whose motion makes a degenerate triangle or turns one over.
std::vector<std::size_t> spoiled_nodes(const Draft& draft, const StripCurve& curve,
                                       const std::vector<Vec3>& target, const std::vector<bool>& moved) {
  const std::size_t n = curve.nodes.size();
  std::vector<std::size_t> bad;
  for (const auto& face : draft.faces) {
    const std::size_t i = face.edge, j = next_index(i, n, curve.closed);
    Vec3 motion = Vec3::Zero();
    for (std::size_t k : {i, j})
      if (moved[k]) motion += target[k] - draft.position[k];
    const Vec3 expected = cross(motion, draft.position[j] - draft.position[i]);
    const Vec3 &a = draft.position[face.corners[0]], &b = draft.position[face.corners[1]],
               &c = draft.position[face.corners[2]];
    const Vec3 area = area_vector2(a, b, c);
    const double longest2 = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    if (area.norm() > kLeastStripShape * longest2 &&
        area.dot(expected) > kLeastStripCosine * area.norm() * expected.norm())
      continue;
    for (std::size_t k : {i, j})
      if (moved[k]) bad.push_back(k);
  }
  std::sort(bad.begin(), bad.end());
  bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
  return bad;
}

Draft sound_draft(const TriMesh& mesh, const StripCurve& curve, const StripSettings& settings) {
  std::vector<Vec3> target = curve.target;
  std::vector<bool> moved = curve.moved;
  for (std::size_t attempt = 0;; ++attempt) {
    Draft draft = Drafting(mesh, curve, target, moved, settings).draft();
    const auto bad = spoiled_nodes(draft, curve, target, moved);
    if (bad.empty()) return draft;
    for (std::size_t i : bad) {
      const Vec3& x = mesh.positions[curve.nodes[i]];
      target[i] = x + 0.5 * (target[i] - x);
      if (attempt >= kStripHalvings) moved[i] = false;
    }
  }
}

/// Final ids, in an order that only old ids decide: moved and merged nodes by their smallest old id, then
/// inserted ones by the ids they lie between, nearest to the smaller one first.
std::vector<NodeId> assign_ids(const TriMesh& mesh, const StripCurve& curve, const Draft& draft,
                               std::vector<std::size_t>& order) {
  const std::size_t n = curve.nodes.size();
  struct Key {
    bool inserted;
    NodeId low, high;
    double s;
    std::size_t vertex;
  };
  std::vector<Key> keys;
  for (std::size_t k = 0; k < draft.curve.size(); ++k) {
    const StripNode& node = draft.curve[k];
    if (node.kind == StripNode::Kind::kept) continue;
    Key key{node.kind == StripNode::Kind::inserted, curve.nodes[node.first], curve.nodes[node.last], node.s,
            draft.vertex[k]};
    if (node.kind == StripNode::Kind::merged)
      for (std::size_t i = node.first;; i = next_index(i, n, curve.closed)) {
        key.low = std::min(key.low, curve.nodes[i]);
        key.high = std::max(key.high, curve.nodes[i]);
        if (i == node.last) break;
      }
    if (key.high < key.low) {
      std::swap(key.low, key.high);
      key.s = 1 - key.s;
    }
    keys.push_back(key);
  }
  std::sort(keys.begin(), keys.end(), [](const Key& x, const Key& y) {
    if (x.inserted != y.inserted) return y.inserted;
    if (x.low != y.low) return x.low < y.low;
    if (x.high != y.high) return x.high < y.high;
    return x.s < y.s;
  });
  std::vector<NodeId> ids(draft.position.size());
  std::copy(curve.nodes.begin(), curve.nodes.end(), ids.begin());
  std::size_t next_id = mesh.node_count();
  for (const Key& key : keys) {
    ids[key.vertex] = NodeId(next_id++);
    order.push_back(key.vertex);
  }
  return ids;
}

std::array<NodeId, 3> smallest_first(std::array<NodeId, 3> corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

void append_faces(TriMesh& mesh, const Draft& draft, const std::vector<NodeId>& ids) {
  using Corners = std::array<NodeId, 3>;
  std::vector<std::pair<Corners, Corners>> faces;  // ids ascending; as the face runs
  for (const auto& face : draft.faces) {
    const Corners c = smallest_first({ids[face.corners[0]], ids[face.corners[1]], ids[face.corners[2]]});
    faces.emplace_back(c, c);
    std::sort(faces.back().first.begin(), faces.back().first.end());
  }
  std::sort(faces.begin(), faces.end());
  for (const auto& [ascending, corners] : faces)
    mesh.corners.push_back(corners);
}

}  // namespace

Strip append_strip(TriMesh& mesh, const StripCurve& curve, const StripSettings& settings) {
  const Draft draft = sound_draft(mesh, curve, settings);
  std::vector<std::size_t> order;
  const std::vector<NodeId> ids = assign_ids(mesh, curve, draft, order);
  for (std::size_t vertex : order)
    mesh.positions.push_back(draft.position[vertex]);
  append_faces(mesh, draft, ids);
  Strip strip;
  strip.closed = curve.closed;
  strip.curve = draft.curve;
  for (std::size_t k = 0; k < strip.curve.size(); ++k)
    strip.curve[k].id = ids[draft.vertex[k]];
  if (strip.curve.size() < (curve.closed ? 3u : 2u)) strip.curve.clear();
  return strip;
}

}  // namespace conchoid

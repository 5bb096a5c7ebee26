#include "conchoid/crack/front/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "conchoid/core/error.hpp"
#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/crack/front/strip.hpp"
#include "conchoid/crack/length_factors.hpp"

namespace conchoid {

namespace {

/// Motion per node of the sheet.
class Motions {
 public:
  Motions(const CrackSheet& sheet, const std::vector<FrontMotion>& motions)
      : displacement_(sheet.mesh.node_count()) {
    std::vector<bool> on_front(sheet.mesh.node_count(), false);
    for (const SheetFront& front : sheet.fronts)
      for (NodeId node : front.nodes)
        on_front[node.index()] = true;
    moved_.assign(sheet.mesh.node_count(), false);
    for (const FrontMotion& motion : motions) {
      if (!motion.node.valid() || motion.node.index() >= on_front.size() || !on_front[motion.node.index()])
        throw InputError("crack front: node " + std::to_string(motion.node.value) +
                         " is to move but lies on no front; move nodes of CrackSheet::fronts only");
      if (!motion.displacement.allFinite())
        throw InputError("crack front: the motion of node " + std::to_string(motion.node.value) +
                         " is not finite");
      moved_[motion.node.index()] = true;
      displacement_[motion.node] = motion.displacement;
    }
  }
  bool moved(NodeId n) const { return moved_[n.index()]; }
  void stop(NodeId n) { moved_[n.index()] = false; }
  const Vec3& displacement(NodeId n) const { return displacement_[n]; }

 private:
  std::vector<bool> moved_;
  IdVector<NodeId, Vec3> displacement_;
};

StripCurve moved_curve(const CrackSheet& sheet, const SheetFront& front, const Motions& motions) {
  StripCurve curve;
  curve.nodes = front.nodes;
  curve.closed = front.closed;
  for (NodeId node : front.nodes) {
    curve.moved.push_back(motions.moved(node));
    curve.target.push_back(sheet.mesh.positions[node] +
                           (motions.moved(node) ? motions.displacement(node) : Vec3::Zero()));
  }
  return curve;
}

/// Draws new nodes towards the middle of their neighbours on the new front. Only between two moved
/// neighbours: next to a node that stays the front may well have a corner.
void smooth(StripCurve& curve, double smoothing) {
  const std::size_t n = curve.nodes.size();
  const std::vector<Vec3> x = curve.target;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = previous_index(i, n, curve.closed), after = next_index(i, n, curve.closed);
    if (before == i || after == i || !curve.moved[i] || !curve.moved[before] || !curve.moved[after]) continue;
    const Vec3 chord = x[after] - x[before];
    const double length2 = chord.squaredNorm();
    if (!(length2 > 0)) continue;
    const Vec3 pull = 0.5 * (x[before] + x[after]) - x[i];
    const Vec3 along = pull.dot(chord) / length2 * chord;
    curve.target[i] += smoothing * (along + kSmoothingAcross * (pull - along));
  }
}

/// Closest of the candidates to x; at equal distance the smaller id.
NodeId closest_node(const TriMesh& mesh, const std::vector<NodeId>& candidates, const Vec3& x) {
  NodeId best;
  double least = 0;
  for (NodeId c : candidates) {
    const double distance = (mesh.positions[c] - x).norm();
    const bool tie = best.valid() && std::abs(distance - least) <= kEqualDistance * std::max(distance, least);
    if (!best.valid() || (tie ? c < best : distance < least)) {
      best = c;
      least = distance;
    }
  }
  return best;
}

FrontSuccession::Kind kind_of(StripNode::Kind kind) {
  switch (kind) {
    case StripNode::Kind::kept:
      return FrontSuccession::Kind::kept;
    case StripNode::Kind::moved:
      return FrontSuccession::Kind::moved;
    case StripNode::Kind::merged:
      return FrontSuccession::Kind::merged;
    case StripNode::Kind::inserted:
      return FrontSuccession::Kind::inserted;
  }
  return FrontSuccession::Kind::kept;
}

/// The old front nodes a new node comes from: the whole run of a merged one.
std::vector<NodeId> ancestors(const SheetFront& old, const StripNode& node) {
  std::vector<NodeId> found{old.nodes[node.first]};
  for (std::size_t i = node.first; i != node.last;) {
    i = next_index(i, old.nodes.size(), old.closed);
    found.push_back(old.nodes[i]);
  }
  return found;
}

void inherit(CrackSheet& sheet, const SheetFront& old, const StripNode& node) {
  const std::vector<NodeId> from = ancestors(old, node);
  const NodeId behind = closest_node(sheet.mesh, from, sheet.mesh.positions[node.id]);
  const bool active =
      std::any_of(from.begin(), from.end(), [&](NodeId n) { return sheet.state[n] == FrontState::active; });
  sheet.state[node.id] = active ? FrontState::active : sheet.state[behind];
  sheet.correlation[node.id] = behind;
  sheet.travelled[node.id] =
      sheet.travelled[behind] + (sheet.mesh.positions[node.id] - sheet.mesh.positions[behind]).norm();
}

void grow_attributes(CrackSheet& sheet) {
  const std::size_t nodes = sheet.mesh.node_count();
  sheet.state.resize(nodes, FrontState::active);
  sheet.correlation.resize(nodes);
  sheet.travelled.resize(nodes, 0.0);
  sheet.node_birth.resize(nodes, sheet.frame);
  sheet.triangle_birth.resize(sheet.mesh.triangle_count(), sheet.frame);
}

/// Interior nodes of the triangles with a front edge at each front node: the closest becomes its correlation
/// node.
void initial_correlation(CrackSheet& sheet, std::size_t first_front, TriId first_triangle) {
  std::vector<bool> on_front(sheet.mesh.node_count(), false);
  std::vector<Edge> front_edges;
  for (std::size_t f = first_front; f < sheet.fronts.size(); ++f) {
    const SheetFront& front = sheet.fronts[f];
    for (NodeId node : front.nodes)
      on_front[node.index()] = true;
    for (std::size_t i = 0; i < edge_count(front.nodes.size(), front.closed); ++i)
      front_edges.emplace_back(front.nodes[i], front.nodes[next_index(i, front.nodes.size(), front.closed)]);
  }
  std::sort(front_edges.begin(), front_edges.end());
  for (std::size_t t = first_triangle.index(); t < sheet.mesh.triangle_count(); ++t) {
    const auto& c = sheet.mesh.corners[TriId(t)];
    for (int k = 0; k < 3; ++k) {
      const NodeId a = c[k], b = c[(k + 1) % 3], across = c[(k + 2) % 3];
      if (on_front[across.index()] || !std::binary_search(front_edges.begin(), front_edges.end(), Edge(a, b)))
        continue;
      for (NodeId node : {a, b}) {
        std::vector<NodeId> candidates{across};
        if (sheet.correlation[node].valid()) candidates.push_back(sheet.correlation[node]);
        sheet.correlation[node] = closest_node(sheet.mesh, candidates, sheet.mesh.positions[node]);
      }
    }
  }
}

SheetFront successor(CrackSheet& sheet, const SheetFront& old, const Strip& strip,
                     std::vector<FrontSuccession>& succession) {
  SheetFront front;
  front.closed = strip.closed;
  for (const StripNode& node : strip.curve) {
    succession.push_back({node.id, kind_of(node.kind), old.nodes[node.first], old.nodes[node.last], node.s});
    front.nodes.push_back(node.id);
    if (node.kind != StripNode::Kind::kept) inherit(sheet, old, node);
  }
  if (front.closed && !front.nodes.empty()) start_at_smallest_id(front.nodes);
  return front;
}

}  // namespace

NodeId append_part(CrackSheet& sheet, const TriMesh& part, const std::vector<Edge>& mouth) {
  const NodeId first(sheet.mesh.node_count());
  const TriId first_triangle(sheet.mesh.triangle_count());
  const std::size_t first_front = sheet.fronts.size();
  const auto shifted = [&](NodeId n) { return NodeId(n.index() + first.index()); };
  for (const Front& front : find_fronts(part, mouth)) {
    SheetFront added;
    added.closed = front.closed;
    for (NodeId node : front.nodes)
      added.nodes.push_back(shifted(node));
    sheet.fronts.push_back(std::move(added));
  }
  sheet.mesh.positions.insert(sheet.mesh.positions.end(), part.positions.begin(), part.positions.end());
  for (const auto& c : part.corners)
    sheet.mesh.corners.push_back({shifted(c[0]), shifted(c[1]), shifted(c[2])});
  grow_attributes(sheet);
  initial_correlation(sheet, first_front, first_triangle);
  return first;
}

TriMesh oriented_like(const CrackSheet& sheet, TriMesh part) {
  const std::vector<int> connected = connected_parts(sheet.mesh);
  double least = std::numeric_limits<double>::infinity();
  int nearest = -1;
  for (std::size_t i = 0; i < sheet.mesh.node_count(); ++i)
    for (const Vec3& x : part.positions)
      if (const double d = (sheet.mesh.positions[NodeId(i)] - x).norm(); d < least) {
        least = d;
        nearest = connected[i];
      }
  Vec3 theirs = Vec3::Zero(), own = Vec3::Zero();
  for (std::size_t t = 0; t < sheet.mesh.triangle_count(); ++t)
    if (connected[sheet.mesh.corners[TriId(t)][0].index()] == nearest)
      theirs += area_vector(sheet.mesh, TriId(t));
  for (std::size_t t = 0; t < part.triangle_count(); ++t)
    own += area_vector(part, TriId(t));
  if (own.dot(theirs) < -kAcrossSheets * own.norm() * theirs.norm())
    for (auto& c : part.corners)
      std::swap(c[1], c[2]);
  return part;
}

std::vector<FrontFrame> front_frames(const CrackSheet& sheet, const SheetFront& front) {
  return front_frames(sheet, front, node_area_vectors(sheet.mesh));
}

std::vector<FrontFrame> front_frames(const CrackSheet& sheet, const SheetFront& front,
                                     const IdVector<NodeId, Vec3>& area_vectors) {
  return front_frames(sheet.mesh, area_vectors, front.nodes, front.closed,
                      sheet.frame == 0 ? FrontNormals::carried_on : FrontNormals::facets);
}

AdvanceResult advance(CrackSheet& sheet, const std::vector<FrontMotion>& requested, double target_edge,
                      const AdvanceSettings& settings) {
  Motions motions(sheet, requested);
  AdvanceResult result;
  if (settings.stop_touching) result.arrested = touching_nodes(sheet, requested, target_edge);
  for (NodeId node : result.arrested) {
    motions.stop(node);
    sheet.state[node] = FrontState::arrested;
  }
  result.first_new_node = NodeId(sheet.mesh.node_count());
  result.first_new_triangle = TriId(sheet.mesh.triangle_count());
  ++sheet.frame;
  std::vector<SheetFront> fronts;
  for (const SheetFront& old : sheet.fronts) {
    StripCurve curve = moved_curve(sheet, old, motions);
    if (settings.smoothing > 0) smooth(curve, settings.smoothing);
    StripSettings strip_settings{settings.split_above * target_edge,
                                 settings.collapse_below * target_edge,
                                 kClosingRadius * target_edge,
                                 {}};
    if (settings.between)
      strip_settings.between = [&](std::size_t a, std::size_t b, double s) {
        return settings.between(old.nodes[a], old.nodes[b], s);
      };
    const Strip strip = append_strip(sheet.mesh, curve, strip_settings);
    grow_attributes(sheet);
    SheetFront front = successor(sheet, old, strip, result.succession.emplace_back());
    if (!front.nodes.empty()) fronts.push_back(std::move(front));
  }
  sheet.fronts = std::move(fronts);
  return result;
}

}  // namespace conchoid

#include "conchoid/remesh/editable_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "conchoid/core/interrupt.hpp"
#include "conchoid/intersect/self_intersection.hpp"
#include "conchoid/mesh/box.hpp"

namespace conchoid {
namespace {

constexpr double most_turning = 0.35;  // cosine of the largest turn of a normal in one step
constexpr double flattest = 0.02;      // height over longest edge that a step may create

bool contains(const std::vector<TriId>& ids, TriId t) {
  return std::find(ids.begin(), ids.end(), t) != ids.end();
}

}  // namespace

double flatness(const Triangle& x) {
  const double longest =
      std::max({(x[1] - x[0]).squaredNorm(), (x[2] - x[1]).squaredNorm(), (x[0] - x[2]).squaredNorm()});
  return longest > 0 ? area_vector2(x[0], x[1], x[2]).norm() / longest : 0;
}

double smallest_angle(const Triangle& x) {
  double smallest = 4;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 a = x[(k + 1) % 3] - x[k], b = x[(k + 2) % 3] - x[k];
    smallest = std::min(smallest, std::atan2(cross(a, b).norm(), a.dot(b)));
  }
  return smallest;
}

EditableMesh::EditableMesh(const TriMesh& mesh, double cell)
    : positions_(mesh.positions), stars_(mesh.node_count()), cell_(cell), origin_(bounding_box(mesh).low) {
  corners_.reserve(mesh.triangle_count());
  for (const auto& c : mesh.corners) {
    throw_if_interrupted();
    add(c);
  }
}

Triangle EditableMesh::triangle(TriId t) const {
  return triangle(corners_[t]);
}

std::vector<NodeId> EditableMesh::neighbours(NodeId n) const {
  std::vector<NodeId> found;
  for (TriId t : stars_[n])
    for (NodeId other : corners_[t])
      if (other != n) found.push_back(other);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool EditableMesh::has_edge(NodeId a, NodeId b) const {
  return std::any_of(stars_[a].begin(), stars_[a].end(), [&](TriId t) {
    const auto& c = corners_[t];
    return c[0] == b || c[1] == b || c[2] == b;
  });
}

std::vector<Edge> EditableMesh::edges() const {
  std::vector<Edge> found;
  for (const auto& c : corners_)
    for (std::size_t k = 0; k < 3; ++k)
      if (c[0].valid() && c[k] < c[(k + 1) % 3]) found.emplace_back(c[k], c[(k + 1) % 3]);
  std::sort(found.begin(), found.end());
  return found;
}

std::array<TriId, 2> EditableMesh::triangles_at(const Edge& e) const {
  std::array<TriId, 2> found;
  for (TriId t : stars_[e.a])
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeId from = corners_[t][k], to = corners_[t][(k + 1) % 3];
      if (from == e.a && to == e.b) found[0] = t;
      if (from == e.b && to == e.a) found[1] = t;
    }
  return found;
}

NodeId EditableMesh::opposite(TriId t, const Edge& e) const {
  for (NodeId n : corners_[t])
    if (n != e.a && n != e.b) return n;
  return NodeId();
}

NodeId EditableMesh::split(const Edge& e, const Vec3& at) {
  const NodeId middle = positions_.add(at);
  stars_.emplace_back();
  Change change;
  for (TriId t : triangles_at(e)) {
    change.removed.push_back(t);
    for (NodeId end : {e.a, e.b}) {
      auto half = corners_[t];
      std::replace(half.begin(), half.end(), end, middle);
      change.added.push_back(half);
      const Triangle x = triangle(t);
      change.references.push_back(area_vector2(x[0], x[1], x[2]));
    }
  }
  return apply(change) ? middle : NodeId();
}

bool EditableMesh::collapse(NodeId removed, NodeId kept, const Vec3& at) {
  // Link condition: the ends have exactly the two opposite corners in common, and these have other edges
  // left.
  const Edge edge(removed, kept);
  const std::array<TriId, 2> at_edge = triangles_at(edge);
  const std::vector<NodeId> around_removed = neighbours(removed), around_kept = neighbours(kept);
  std::vector<NodeId> common;
  std::set_intersection(around_removed.begin(), around_removed.end(), around_kept.begin(), around_kept.end(),
                        std::back_inserter(common));
  if (common.size() != 2) return false;
  for (NodeId n : common)
    if (stars_[n].size() <= 3) return false;
  if (around_removed.size() + around_kept.size() <= 6 + 2) return false;
  Change change;
  change.moved = kept;
  change.at = at;
  for (NodeId n : {removed, kept})
    for (TriId t : stars_[n]) {
      if (contains(change.removed, t)) continue;
      change.removed.push_back(t);
      if (t == at_edge[0] || t == at_edge[1]) continue;
      auto corners = corners_[t];
      std::replace(corners.begin(), corners.end(), removed, kept);
      change.added.push_back(corners);
      const Triangle x = triangle(t);
      change.references.push_back(area_vector2(x[0], x[1], x[2]));
    }
  return apply(change);
}

bool EditableMesh::flip(const Edge& e) {
  const auto [forward, backward] = triangles_at(e);
  const NodeId left = opposite(forward, e), right = opposite(backward, e);
  if (left == right || has_edge(left, right)) return false;
  if (stars_[e.a].size() <= 3 || stars_[e.b].size() <= 3) return false;
  const Triangle x = triangle(forward), y = triangle(backward);
  const Vec3 reference = area_vector2(x[0], x[1], x[2]) + area_vector2(y[0], y[1], y[2]);
  return apply({{forward, backward},
                {{left, e.a, right}, {right, e.b, left}},
                {reference, reference},
                NodeId(),
                Vec3::Zero()});
}

bool EditableMesh::move(NodeId n, const Vec3& to) {
  Change change;
  change.moved = n;
  change.at = to;
  for (TriId t : stars_[n]) {
    change.removed.push_back(t);
    change.added.push_back(corners_[t]);
    const Triangle x = triangle(t);
    change.references.push_back(area_vector2(x[0], x[1], x[2]));
  }
  return apply(change);
}

bool EditableMesh::apply(const Change& change) {
  throw_if_interrupted();
  if (!acceptable(change)) return false;
  for (TriId t : change.removed)
    remove(t);
  if (change.moved.valid()) positions_[change.moved] = change.at;
  for (const auto& c : change.added)
    add(c);
  return true;
}

bool EditableMesh::acceptable(const Change& change) {
  double allowed_flatness = flattest;
  for (TriId t : change.removed)
    allowed_flatness = std::min(allowed_flatness, flatness(triangle(t)));
  const Vec3 before = change.moved.valid() ? positions_[change.moved] : Vec3::Zero();
  if (change.moved.valid()) positions_[change.moved] = change.at;
  bool good = true;
  for (std::size_t i = 0; i < change.added.size() && good; ++i) {
    const auto& c = change.added[i];
    const Triangle x = triangle(c);
    const Vec3 normal = area_vector2(x[0], x[1], x[2]);
    good = flatness(x) >= allowed_flatness && flatness(x) > 1e-6 &&
           normal.dot(change.references[i]) > most_turning * normal.norm() * change.references[i].norm();
  }
  good = good && keeps_clear(change.added, change.removed);
  if (change.moved.valid()) positions_[change.moved] = before;
  return good;
}

bool EditableMesh::keeps_clear(const std::vector<std::array<NodeId, 3>>& added,
                               const std::vector<TriId>& removed) {
  std::vector<Box> boxes;
  for (const auto& corners : added)
    boxes.push_back(box_of(triangle(corners)));
  Box all = boxes.front();
  for (const Box& box : boxes)
    all = united(all, box);
  for (std::size_t i = 0; i < added.size(); ++i)
    for (std::size_t j = i + 1; j < added.size(); ++j)
      if (overlap(boxes[i], boxes[j]) && triangles_intersect(positions_, added[i], added[j])) return false;
  ++query_;
  for (TriId t : removed)
    visited_[t] = query_;
  bool clear = true;
  visit_cells(all, [&](const Cell& cell) {
    const auto found = grid_.find(cell);
    if (!clear || found == grid_.end()) return;
    for (TriId t : found->second) {
      if (visited_[t] == query_) continue;
      visited_[t] = query_;
      const Box box = box_of(triangle(t));
      if (!overlap(all, box)) continue;
      for (std::size_t i = 0; i < added.size(); ++i)
        if (overlap(boxes[i], box) && triangles_intersect(positions_, added[i], corners_[t])) {
          clear = false;
          return;
        }
    }
  });
  return clear;
}

Triangle EditableMesh::triangle(const std::array<NodeId, 3>& c) const {
  return {positions_[c[0]], positions_[c[1]], positions_[c[2]]};
}

template <class Visit>
void EditableMesh::visit_cells(const Box& box, const Visit& visit) const {
  for_each_cell(cell_of(box.low - origin_, cell_), cell_of(box.high - origin_, cell_), visit);
}

void EditableMesh::remove(TriId t) {
  visit_cells(box_of(triangle(t)), [&](const Cell& cell) { std::erase(grid_.at(cell), t); });
  for (NodeId n : corners_[t])
    std::erase(stars_[n], t);
  corners_[t] = {};
  --alive_count_;
}

TriId EditableMesh::add(const std::array<NodeId, 3>& corners) {
  const TriId t = corners_.add(corners);
  visited_.push_back(0);
  for (NodeId n : corners)
    stars_[n].push_back(t);
  visit_cells(box_of(triangle(corners)), [&](const Cell& cell) { grid_[cell].push_back(t); });
  ++alive_count_;
  return t;
}

TriMesh EditableMesh::compact() const {
  TriMesh mesh;
  IdVector<NodeId, NodeId> renumbered(positions_.size());
  for (std::size_t n = 0; n < positions_.size(); ++n)
    if (alive(NodeId(n))) renumbered[NodeId(n)] = mesh.positions.add(positions_[NodeId(n)]);
  for (const auto& c : corners_)
    if (c[0].valid()) mesh.corners.push_back({renumbered[c[0]], renumbered[c[1]], renumbered[c[2]]});
  return mesh;
}

}  // namespace conchoid

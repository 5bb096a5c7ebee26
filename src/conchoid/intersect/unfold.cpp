#include "conchoid/intersect/unfold.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "conchoid/core/parallel.hpp"
#include "conchoid/intersect/manifold_part.hpp"
#include "conchoid/intersect/self_intersection.hpp"
#include "conchoid/mesh/id_lists.hpp"
#include "conchoid/mesh/sort_by_edge.hpp"

namespace conchoid {
namespace {

/// Triangles around each node, and the nodes to take the middle of.
struct Stars {
  NodeLists<TriId> triangles;
  NodeLists<NodeId> neighbours;

  explicit Stars(const TriMesh& sheet)
      : triangles(triangles_at_nodes(sheet)), neighbours(smoothing_neighbours(sheet)) {}

 private:
  /// All of a node inside, those along the boundary of a node on it.
  static NodeLists<NodeId> smoothing_neighbours(const TriMesh& sheet) {
    const std::vector<EdgeUse> uses = edge_uses(sheet.corners, sheet.node_count());
    IdVector<NodeId, char> on_boundary(sheet.node_count(), 0);
    for (const auto& [e, count] : uses)
      if (count == 1) on_boundary[e.a] = on_boundary[e.b] = 1;
    return NodeLists<NodeId>(sheet.node_count(), [&](const auto& put) {
      for (const auto& [e, count] : uses)
        for (const auto& [n, m] : {std::pair(e.a, e.b), std::pair(e.b, e.a)})
          if (!on_boundary[n] || count == 1) put(n, m);
    });
  }
};

constexpr double steepest = 0.25;  // cosine
constexpr int kRounds = 40;
constexpr int kRoundsPerRing = 8;
constexpr int kCrossingRounds = 6;
constexpr int kFoldEdges = 4;                // across a fold whose nodes need not be folded themselves
constexpr std::size_t kMostCrossings = 200;  // looked at in a round

bool is_folded(const TriMesh& sheet, std::span<const TriId> star) {
  if (star.size() < 2) return false;
  std::vector<Vec3> normals;
  for (const TriId t : star)
    if (const Vec3 n = unit_normal(sheet, t); !n.isZero(0)) normals.push_back(n);
  const auto hides_some = [&](const Vec3& d) {
    return std::any_of(normals.begin(), normals.end(), [&](const Vec3& n) { return n.dot(d) < steepest; });
  };
  Vec3 mean = Vec3::Zero();
  for (const Vec3& n : normals)
    mean += n;
  return hides_some(mean.normalized()) && hides_some(common_direction(normals));
}

void add_neighbours(std::vector<NodeId>& nodes, const Stars& stars) {
  const std::vector<NodeId> inner = nodes;
  for (const NodeId n : inner)
    nodes.insert(nodes.end(), stars.neighbours[n].begin(), stars.neighbours[n].end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

/// All at once, each to the middle of its neighbours.
void to_the_middle(TriMesh& sheet, const std::vector<NodeId>& nodes, const Stars& stars) {
  std::vector<Vec3> middle(nodes.size(), Vec3::Zero());
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (const NodeId m : stars.neighbours[nodes[k]])
      middle[k] += sheet.positions[m] / static_cast<double>(stars.neighbours[nodes[k]].size());
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (!stars.neighbours[nodes[k]].empty()) sheet.positions[nodes[k]] = middle[k];
}

/// Whether so few edges lead from one to the other as across a small fold.
bool are_near(const TriMesh& sheet, TriId a, TriId b, const Stars& stars) {
  std::vector<NodeId> around(sheet.corners[a].begin(), sheet.corners[a].end());
  std::sort(around.begin(), around.end());
  for (int edges = 0; edges < kFoldEdges; ++edges)
    add_neighbours(around, stars);
  return std::any_of(sheet.corners[b].begin(), sheet.corners[b].end(),
                     [&](NodeId n) { return std::binary_search(around.begin(), around.end(), n); });
}

/// The sheet with small crossings smoothed out: nodes of triangles that pass through others a few edges away
/// go to the middle of their neighbours, with more of these in every round. A sheet that has run into itself
/// stays.
TriMesh drawn_apart(TriMesh sheet) {
  const Stars stars(sheet);
  for (int round = 0; round < kCrossingRounds; ++round) {
    std::vector<NodeId> crossed;
    for (const auto& [a, b] : self_intersections(sheet, kMostCrossings))
      if (are_near(sheet, a, b, stars))
        for (const TriId t : {a, b})
          crossed.insert(crossed.end(), sheet.corners[t].begin(), sheet.corners[t].end());
    if (crossed.empty()) break;
    for (int ring = 0; ring <= round; ++ring)
      add_neighbours(crossed, stars);
    to_the_middle(sheet, crossed, stars);
  }
  return sheet;
}

}  // namespace

Vec3 common_direction(const std::vector<Vec3>& vectors) {
  std::vector<Vec3> set;  // pieces of one flat face have the same normal
  for (const Vec3& v : vectors)
    if (std::none_of(set.begin(), set.end(), [&](const Vec3& w) { return (v - w).squaredNorm() < 1e-20; }))
      set.push_back(v);
  Vec3 best = Vec3::Zero();
  double best_product = 1e-9;
  const auto consider = [&](const Vec3& toward) {
    const double length = toward.norm();
    if (!(length > 1e-12)) return;
    double smallest = 1e300;
    for (std::size_t i = 0; i < set.size() && smallest > best_product * length; ++i)
      smallest = std::min(smallest, set[i].dot(toward));
    if (smallest > best_product * length) {
      best_product = smallest / length;
      best = toward / length;
    }
  };
  // The point of the hull next to the origin is one of them, or lies between two, or between three.
  for (std::size_t i = 0; i < set.size(); ++i) {
    consider(set[i]);
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 u = set[j] - set[i];
      const double share = -set[i].dot(u) / u.squaredNorm();
      if (share > 0 && share < 1) consider(set[i] + share * u);
      for (std::size_t k = 0; k < j; ++k) {
        const Vec3 n = cross(u, set[k] - set[i]);
        consider(n.dot(set[i]) > 0 ? n : Vec3(-n));
      }
    }
  }
  return best;
}

TriMesh unfolded(TriMesh sheet) {
  const Stars stars(sheet);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<char> is(sheet.node_count(), 0);
    parallel_for(is.size(), 1024, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        is[i] = !stars.neighbours[NodeId(i)].empty() && is_folded(sheet, stars.triangles[NodeId(i)]);
    });
    std::vector<NodeId> folded;
    for (std::size_t i = 0; i < is.size(); ++i)
      if (is[i] != 0) folded.emplace_back(i);
    if (folded.empty()) break;
    // What stays folded in the middle of its neighbours needs them to move as well.
    for (int ring = 0; ring < round / kRoundsPerRing; ++ring)
      add_neighbours(folded, stars);
    to_the_middle(sheet, folded, stars);
  }
  return sheet;
}

TriMesh unfolded_part(const TriMesh& sheet) {
  // Small folds and crossings first: cut out they would be holes, by which a body hangs together.
  const TriMesh flat = unfolded(manifold_part(sheet));
  TriMesh embedded = embedded_part(flat);
  if (embedded.triangle_count() < flat.triangle_count()) {
    TriMesh apart = embedded_part(drawn_apart(flat));
    if (apart.triangle_count() > embedded.triangle_count()) embedded = std::move(apart);
  }
  TriMesh smoother = unfolded(embedded);
  return smoother.positions == embedded.positions ? embedded : embedded_part(smoother);
}

}  // namespace conchoid

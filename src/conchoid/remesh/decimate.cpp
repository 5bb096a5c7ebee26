#include "conchoid/remesh/decimate.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <queue>

#include "conchoid/core/interrupt.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/core/progress.hpp"
#include "conchoid/mesh/closest_point.hpp"

namespace conchoid {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Q(x) = xᵀ A x + 2 bᵀ x + c: sum of area-weighted squared distances from planes.
struct Quadric {
  Mat3 a = Mat3::Zero();
  Vec3 b = Vec3::Zero();
  double c = 0;

  void add_plane(const Vec3& unit_normal, double offset, double weight) {
    a += weight * unit_normal * unit_normal.transpose();
    b -= weight * offset * unit_normal;
    c += weight * offset * offset;
  }
  Quadric& operator+=(const Quadric& other) {
    a += other.a;
    b += other.b;
    c += other.c;
    return *this;
  }
  double operator()(const Vec3& x) const { return std::max(0.0, x.dot(a * x) + 2 * b.dot(x) + c); }
  /// Its minimum, drawn slightly toward `near` so that it is unique where the planes are parallel.
  Vec3 minimum(const Vec3& near) const {
    const double pull = 1e-3 * a.trace();
    if (!(pull > 0)) return near;
    const Mat3 regular = a + pull * Mat3::Identity();
    return near - regular.inverse() * (a * near + b);
  }
};

/// Short, as most are out of date when their turn comes: how they would merge is found anew then.
struct Candidate {
  double cost;
  Edge edge;
  std::uint32_t version;  ///< sum of the ends' versions when it was made
  bool operator<(
      const Candidate& other) const {  // the queue gives out the largest: smallest cost, then smallest ids
    return cost != other.cost ? cost > other.cost : edge > other.edge;
  }
};

/// A plane of unit normal n, n·x = offset; a zero normal is no plane.
struct Plane {
  Vec3 normal;
  double offset;
};

Plane plane_of(const Triangle& x) {
  const Vec3 normal2 = area_vector2(x[0], x[1], x[2]);
  const double area2 = normal2.norm();
  const Vec3 n = area2 > 0 ? Vec3(normal2 / area2) : Vec3(Vec3::Zero());
  return {n, n.dot(x[0])};
}

std::vector<Plane> own_planes(const EditableMesh& mesh) {
  std::vector<Plane> planes;
  for (std::size_t t = 0; t < mesh.triangle_slots(); ++t)
    planes.push_back(plane_of(mesh.triangle(TriId(t))));
  return planes;
}

std::vector<Plane> nearest_planes(const EditableMesh& mesh, const TriMesh& shape) {
  const ClosestPointTree tree(shape);
  return parallel_values(mesh.triangle_slots(), 256, [&](std::size_t t) {
    const Triangle x = mesh.triangle(TriId(t));
    const TriId nearest = tree.closest((x[0] + x[1] + x[2]) / 3).triangle;
    return plane_of(nearest.valid() ? shape.triangle(nearest) : x);
  });
}

class Decimation {
 public:
  /// @param planes     per triangle: what its error is measured from
  /// @param longest    edge that may come about [m]
  /// @param tolerance  largest root mean square of the distances merged into a node [m]
  Decimation(EditableMesh& mesh, FeatureLines& features, const std::vector<Plane>& planes, double tolerance,
             double longest)
      : mesh_(mesh),
        features_(features),
        tolerance_(tolerance),
        longest_(longest),
        quadrics_(mesh.node_slots()),
        versions_(mesh.node_slots(), 0) {
    for (std::size_t t = 0; t < mesh.triangle_slots(); ++t) {
      const Triangle x = mesh.triangle(TriId(t));
      const double area2 = area_vector2(x[0], x[1], x[2]).norm();
      if (!(area2 > 0)) continue;
      for (NodeId corner : mesh.corners(TriId(t)))
        quadrics_[corner].add_plane(planes[t].normal, planes[t].offset, area2 / 6);
    }
    for (const Edge& e : mesh.edges()) {
      throw_if_interrupted();
      propose(e);
    }
  }

  void run(std::size_t target) {
    Progress progress("triangles decimated, at most", mesh_.triangle_count() - target);
    while (mesh_.triangle_count() > target && !queue_.empty()) {
      throw_if_interrupted();
      const Candidate best = queue_.top();
      queue_.pop();
      if (versions_[best.edge.a] + versions_[best.edge.b] != best.version || !mesh_.alive(best.edge.a) ||
          !mesh_.alive(best.edge.b))
        continue;
      const auto merge = features_.merge(best.edge);
      if (!merge) continue;
      const auto [removed, kept, may_move] = *merge;
      if (!mesh_.collapse(removed, kept, place(best.edge, *merge, sum(best.edge)))) continue;
      progress.advance(2);
      features_.was_collapsed(removed, kept);
      quadrics_[kept] += quadrics_[removed];
      ++versions_[kept];
      for (NodeId n : mesh_.neighbours(kept))
        propose(Edge(kept, n));
    }
  }

 private:
  void propose(const Edge& e) {
    const auto merge = features_.merge(e);
    if (!merge) return;
    const Quadric both = sum(e);
    const Vec3 at = place(e, *merge, both);
    const double length2 = (mesh_.position(e.a) - mesh_.position(e.b)).squaredNorm();
    if (longest_ < infinity)
      for (const NodeId end : {e.a, e.b})
        for (const NodeId n : mesh_.neighbours(end))
          if ((mesh_.position(n) - at).norm() > longest_) return;
    constexpr double preference_for_short_edges = 1e-4;  // decides where the surface is flat
    const double error = both(at);
    if (error > tolerance_ * tolerance_ * both.a.trace()) return;  // the trace is the area merged
    queue_.push({error + preference_for_short_edges * length2 * length2, e, versions_[e.a] + versions_[e.b]});
  }

  Quadric sum(const Edge& e) const {
    Quadric both = quadrics_[e.a];
    both += quadrics_[e.b];
    return both;
  }

  Vec3 place(const Edge& e, const FeatureLines::Merge& merge, const Quadric& both) const {
    return merge.may_move ? both.minimum(0.5 * (mesh_.position(e.a) + mesh_.position(e.b)))
                          : mesh_.position(merge.kept);
  }

  EditableMesh& mesh_;
  FeatureLines& features_;
  double tolerance_, longest_;
  IdVector<NodeId, Quadric> quadrics_;
  IdVector<NodeId, std::uint32_t> versions_;
  std::priority_queue<Candidate> queue_;
};

}  // namespace

void decimate(EditableMesh& mesh, FeatureLines& features, std::size_t target_triangles) {
  if (mesh.triangle_count() > target_triangles)
    Decimation(mesh, features, own_planes(mesh), infinity, infinity).run(target_triangles);
}

void simplify(EditableMesh& mesh, const TriMesh& shape, double tolerance, double longest_edge) {
  FeatureLines none;
  Decimation(mesh, none, nearest_planes(mesh, shape), tolerance, longest_edge).run(0);
}

}  // namespace conchoid

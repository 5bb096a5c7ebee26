#include "conchoid/crack/front/front_frames.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "conchoid/crack/length_factors.hpp"

namespace conchoid {

namespace {

Vec3 normalized_or_zero(const Vec3& v) {
  const double scale = v.cwiseAbs().maxCoeff();
  if (!(scale > 0) || !std::isfinite(scale)) return Vec3::Zero();
  const Vec3 w = v / scale;
  return w / w.norm();
}

/// Direction of the curve at x between its neighbours. Where the curve is smooth, that of the circle through
/// the three points (each edge direction weighted by the length of the other edge); at a corner the bisector,
/// which no edge has behind it.
Vec3 tangent(const Vec3& before, const Vec3& x, const Vec3& after) {
  const double in_length = (x - before).norm(), out_length = (after - x).norm();
  const Vec3 in = normalized_or_zero(x - before), out = normalized_or_zero(after - x);
  if (!(in_length > 0) || !(out_length > 0)) return out_length > 0 ? out : in;
  const Vec3 bisector = normalized_or_zero(in + out);
  const Vec3 circle = normalized_or_zero(in * out_length + out * in_length);
  const double straightness = std::max(0.0, in.dot(out)), smooth = straightness * straightness;
  if ((in + out).norm() < 1e-6) return out;  // a front that turns back on itself has no bisector
  return normalized_or_zero((1 - smooth) * bisector + smooth * circle);
}

bool orthonormalize(const Vec3& normal, const Vec3& along, FrontFrame& frame) {
  frame.e1 = normalized_or_zero(normal);
  frame.e3 = normalized_or_zero(along - along.dot(frame.e1) * frame.e1);
  if (frame.e1.isZero(0) || frame.e3.isZero(0)) return false;
  frame.e2 = cross(frame.e3, frame.e1);
  return true;
}

/// Area-weighted centre of the triangles around each node.
IdVector<NodeId, Vec3> fan_centers(const TriMesh& mesh) {
  IdVector<NodeId, Vec3> sum(mesh.node_count(), Vec3::Zero());
  IdVector<NodeId, double> weight(mesh.node_count(), 0.0);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const double area = area_vector(mesh, TriId(t)).norm();
    const Vec3 center = centroid(mesh, TriId(t));
    for (NodeId corner : mesh.corners[TriId(t)]) {
      sum[corner] += area * center;
      weight[corner] += area;
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (weight[NodeId(i)] > 0) sum[NodeId(i)] /= weight[NodeId(i)];
  return sum;
}

/// Normals at the front nodes, carried on from the facets to the front: a facet's normal is that of a smooth
/// surface in its middle, not at its edge. Linear from the fan of the node itself and those of its neighbours
/// behind the front; less where these differ by more than kSmoothSurfaceTurn, as at a kink, and nothing at twice
/// that.
class CarriedNormals {
 public:
  CarriedNormals(const TriMesh& mesh, const IdVector<NodeId, Vec3>& area_vectors,
                 const std::vector<NodeId>& nodes)
      : mesh_(mesh), area_vectors_(area_vectors), centers_(fan_centers(mesh)), behind_(nodes.size()) {
    std::vector<std::pair<NodeId, std::size_t>> at;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      at.emplace_back(nodes[i], i);
    std::sort(at.begin(), at.end());
    const auto index_of = [&](NodeId n) {
      const auto found = std::lower_bound(at.begin(), at.end(), std::pair(n, std::size_t{0}));
      return found != at.end() && found->first == n ? found->second : nodes.size();
    };
    for (const auto& c : mesh.corners)
      for (NodeId front : c)
        if (const std::size_t i = index_of(front); i < nodes.size())
          for (NodeId other : c)
            if (index_of(other) == nodes.size()) behind_[i].push_back(other);
    for (auto& list : behind_) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
  }

  /// @param forward  across the front, away from the crack
  Vec3 operator()(std::size_t i, NodeId node, const Vec3& forward) const {
    const Vec3 here = normalized_or_zero(area_vectors_[node]);
    Vec3 sum = Vec3::Zero();
    double distance = 0;
    for (NodeId b : behind_[i]) {
      sum += normalized_or_zero(area_vectors_[b]);
      distance += (mesh_.positions[node] - centers_[b]).dot(forward) / static_cast<double>(behind_[i].size());
    }
    const Vec3 there = normalized_or_zero(sum);
    const double own = (mesh_.positions[node] - centers_[node]).dot(forward);
    if (there.isZero(0) || !(own > 0) || !(distance > 1.2 * own)) return here;
    const Vec3 turn = here - there;
    const double smooth = std::clamp(2 - turn.norm() / kSmoothSurfaceTurn, 0.0, 1.0);
    return here + smooth * std::min(1.0, own / (distance - own)) * turn;
  }

 private:
  const TriMesh& mesh_;
  const IdVector<NodeId, Vec3>& area_vectors_;
  IdVector<NodeId, Vec3> centers_;
  std::vector<std::vector<NodeId>>
      behind_;  // per front node: nodes of its triangles that are not on the front
};

void fill_missing(std::vector<FrontFrame>& frames, const std::vector<bool>& valid, bool closed) {
  const std::size_t n = frames.size();
  const std::vector<FrontFrame> known = frames;
  for (std::size_t i = 0; i < n; ++i) {
    if (valid[i]) continue;
    std::size_t back = i, ahead = i;
    for (std::size_t step = 0; step < n && !valid[back] && !valid[ahead]; ++step) {
      back = previous_index(back, n, closed);
      ahead = next_index(ahead, n, closed);
    }
    if (valid[back] || valid[ahead]) frames[i] = known[valid[back] ? back : ahead];
  }
}

}  // namespace

IdVector<NodeId, Vec3> node_area_vectors(const TriMesh& mesh) {
  IdVector<NodeId, Vec3> sum(mesh.node_count(), Vec3::Zero());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Vec3 area = area_vector(mesh, TriId(t));
    for (NodeId corner : mesh.corners[TriId(t)])
      sum[corner] += area;
  }
  return sum;
}

IdVector<NodeId, Vec3> unit_node_normals(const TriMesh& mesh) {
  IdVector<NodeId, Vec3> normals = node_area_vectors(mesh);
  for (Vec3& n : normals)
    n.normalize();
  return normals;
}

std::vector<FrontFrame> front_frames(const TriMesh& mesh, const IdVector<NodeId, Vec3>& normals,
                                     const std::vector<NodeId>& nodes, bool closed, FrontNormals kind) {
  const std::size_t n = nodes.size();
  std::vector<FrontFrame> frames(n, {Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()});
  std::vector<bool> valid(n);
  std::optional<CarriedNormals> carried;
  if (kind == FrontNormals::carried_on) carried.emplace(mesh, normals, nodes);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& before = mesh.positions[nodes[previous_index(i, n, closed)]];
    const Vec3& after = mesh.positions[nodes[next_index(i, n, closed)]];
    FrontFrame frame;
    const Vec3 along = tangent(before, mesh.positions[nodes[i]], after);
    valid[i] = orthonormalize(normals[nodes[i]], along, frame);
    if (valid[i] && carried) orthonormalize((*carried)(i, nodes[i], frame.e2), along, frame);
    if (valid[i]) frames[i] = frame;
  }
  fill_missing(frames, valid, closed);
  return frames;
}

Vec3 direction_at(const Vec3& e1, const Vec3& e2, double angle) {
  return std::cos(angle) * e2 + std::sin(angle) * e1;
}

FrontFrame interpolate(const FrontFrame& a, const FrontFrame& b, double s) {
  FrontFrame frame;
  if (orthonormalize((1 - s) * a.e1 + s * b.e1, (1 - s) * a.e3 + s * b.e3, frame)) return frame;
  return s < 0.5 ? a : b;
}

}  // namespace conchoid

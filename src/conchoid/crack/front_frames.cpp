#include "conchoid/crack/front_frames.hpp"

#include <cmath>

namespace conchoid {

namespace {

Vec3 normalized_or_zero(const Vec3& v) {
  const double scale = v.cwiseAbs().maxCoeff();
  if (!(scale > 0) || !std::isfinite(scale)) return Vec3::Zero();
  const Vec3 w = v / scale;
  return w / w.norm();
}

/// Direction of the curve at x between its neighbours: each edge direction weighted by the length of the
/// other one.
Vec3 tangent(const Vec3& before, const Vec3& x, const Vec3& after) {
  const Vec3 in = x - before, out = after - x;
  const double in_length = in.norm(), out_length = out.norm();
  const Vec3 sum = normalized_or_zero(in) * out_length + normalized_or_zero(out) * in_length;
  const double least = 1e-6 * (in_length + out_length);  // a front that turns back on itself has no bisector
  if (in_length > 0 && out_length > 0 && sum.norm() > least) return normalized_or_zero(sum);
  return normalized_or_zero(out_length > 0 ? out : in);
}

bool orthonormalize(const Vec3& normal, const Vec3& along, FrontFrame& frame) {
  frame.e1 = normalized_or_zero(normal);
  frame.e3 = normalized_or_zero(along - along.dot(frame.e1) * frame.e1);
  if (frame.e1.isZero(0) || frame.e3.isZero(0)) return false;
  frame.e2 = cross(frame.e3, frame.e1);
  return true;
}

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

std::vector<FrontFrame> front_frames(const TriMesh& mesh, const IdVector<NodeId, Vec3>& normals,
                                     const std::vector<NodeId>& nodes, bool closed) {
  const std::size_t n = nodes.size();
  std::vector<FrontFrame> frames(n, {Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()});
  std::vector<bool> valid(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& before = mesh.positions[nodes[previous_index(i, n, closed)]];
    const Vec3& after = mesh.positions[nodes[next_index(i, n, closed)]];
    FrontFrame frame;
    valid[i] = orthonormalize(normals[nodes[i]], tangent(before, mesh.positions[nodes[i]], after), frame);
    if (valid[i]) frames[i] = frame;
  }
  fill_missing(frames, valid, closed);
  return frames;
}

FrontFrame interpolate(const FrontFrame& a, const FrontFrame& b, double s) {
  FrontFrame frame;
  if (orthonormalize((1 - s) * a.e1 + s * b.e1, (1 - s) * a.e3 + s * b.e3, frame)) return frame;
  return s < 0.5 ? a : b;
}

}  // namespace conchoid

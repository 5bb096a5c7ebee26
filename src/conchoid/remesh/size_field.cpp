#include "conchoid/remesh/size_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "conchoid/core/parallel.hpp"

namespace conchoid {
namespace {

constexpr double smallest_size = 0.4;
constexpr double edges_per_radius = 0.9;  // a limb gets about seven edges around
constexpr double steepest_growth = 0.4;   // of the edge length per distance

/// Radius of the largest ball inside that touches the surface at x (inward normal `inward`).
double touching_ball(const ClosestPointTree& surface, const Vec3& x, const Vec3& inward, double largest) {
  constexpr int most_steps = 20;
  const double least_separation = std::cos(100 * std::numbers::pi / 180);
  double radius = largest;
  for (int step = 0; step < most_steps; ++step) {
    const Vec3 center = x + radius * inward;
    const auto hit = surface.closest(center);
    if (hit.squared_distance >= radius * radius * (1 - 1e-6)) break;
    const Vec3 chord = hit.point - x;
    const double depth = chord.dot(inward);
    if (!(depth > 0)) break;
    const double smaller = chord.squaredNorm() / (2 * depth);
    const Vec3 new_center = x + smaller * inward;
    if (-inward.dot((hit.point - new_center) / smaller) > least_separation) break;
    radius = std::min(radius, smaller);
  }
  return radius;
}

IdVector<NodeId, Vec3> node_normals(const TriMesh& mesh) {
  IdVector<NodeId, Vec3> normals(mesh.node_count(), Vec3::Zero());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    for (NodeId n : mesh.corners[TriId(t)])
      normals[n] += area_vector(mesh, TriId(t));
  for (Vec3& n : normals)
    n = n.norm() > 0 ? n.normalized() : Vec3::Zero();
  return normals;
}

}  // namespace

SizeField::SizeField(const TriMesh& samples, double edge)
    : samples_(samples), surface_(samples), size_(samples.node_count(), 1.0) {
  const auto normals = node_normals(samples);
  const double largest = edge / edges_per_radius;
  constexpr std::size_t nodes_of_task = 64;
  parallel_for(samples.node_count(), nodes_of_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const NodeId n(i);
      const double radius = touching_ball(surface_, samples.positions[n], -normals[n], largest);
      size_[n] = std::clamp(radius / largest, smallest_size, 1.0);
    }
  });
  limit_growth(edge);
}

SizeField::SizeField(const SizeField& field, double edge, IdVector<NodeId, double> values)
    : samples_(field.samples_), surface_(field.surface_), size_(std::move(values)) {
  limit_growth(edge);
}

void SizeField::limit_growth(double edge) {
  // Sizes grow no faster than `steepest_growth`: relaxed along the edges until nothing changes.
  bool changed = true;
  for (int pass = 0; pass < 100 && changed; ++pass) {
    changed = false;
    for (const auto& c : samples_.corners)
      for (std::size_t k = 0; k < 3; ++k) {
        const NodeId a = c[k], b = c[(k + 1) % 3];
        const double step = steepest_growth * (samples_.positions[a] - samples_.positions[b]).norm() / edge;
        if (size_[a] > size_[b] + step) {
          size_[a] = size_[b] + step;
          changed = true;
        }
        if (size_[b] > size_[a] + step) {
          size_[b] = size_[a] + step;
          changed = true;
        }
      }
  }
}

double SizeField::operator()(const Vec3& x) const {
  const auto hit = surface_.closest(x);
  const auto& c = samples_.corners[hit.triangle];
  // Linear on the triangle, with the sub-areas as weights.
  const Triangle t = samples_.triangle(hit.triangle);
  std::array<double, 3> weight;
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    sum += weight[k] = area_vector2(hit.point, t[(k + 1) % 3], t[(k + 2) % 3]).norm();
  if (!(sum > 0)) return size_[c[0]];
  return (weight[0] * size_[c[0]] + weight[1] * size_[c[1]] + weight[2] * size_[c[2]]) / sum;
}

double SizeField::triangle_count(double edge) const {
  double count = 0;
  for (std::size_t t = 0; t < samples_.triangle_count(); ++t) {
    const auto& c = samples_.corners[TriId(t)];
    const double local = edge * (size_[c[0]] + size_[c[1]] + size_[c[2]]) / 3;
    count += area_vector(samples_, TriId(t)).norm() * 4 / (std::numbers::sqrt3 * local * local);
  }
  return count;
}

}  // namespace conchoid

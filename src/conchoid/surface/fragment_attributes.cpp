#include "conchoid/surface/fragment_attributes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "conchoid/core/parallel.hpp"
#include "conchoid/surface/corner_normals.hpp"

namespace conchoid {
namespace {

template <class T>
T weighted(const std::array<T, 3>& values, const Vec3& w) {
  for (int k = 0; k < 3; ++k)
    if (w[k] == 1) return values[static_cast<std::size_t>(k)];
  return w[0] * values[0] + w[1] * values[1] + w[2] * values[2];
}

/// A direction at right angles to n, the same for every machine.
Vec3 across(const Vec3& n) {
  int least = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(n[k]) < std::abs(n[least])) least = k;
  return cross(Vec3::Unit(least), n).normalized();
}

/// u and v axes of the plane with normal n.
struct Plane {
  Vec3 u, v;
};

Plane facing(const Vec3& n) {
  const Vec3 u = across(n);
  return {u, cross(n, u)};
}

Plane of_axis(const Vec3& n) {
  int k = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(n[i]) > std::abs(n[k])) k = i;
  return {Vec3::Unit((k + 1) % 3), Vec3::Unit((k + 2) % 3)};
}

/// The direction that fracture faces look in most, either way: largest eigenvector of Σ A n nᵀ.
Vec3 common_direction(const Fragment& f) {
  Mat3 sum = Mat3::Zero();
  for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t) {
    if (f.face_kind[t] != FaceKind::fracture) continue;
    const Vec3 a = area_vector(f.mesh, TriId(t));
    if (const double area = a.norm(); area > 0) sum += a * a.transpose() / area;
  }
  if (!(sum.trace() > 0)) return Vec3::UnitZ();
  Vec3 n = Eigen::SelfAdjointEigenSolver<Mat3>(sum).eigenvectors().col(2);
  Eigen::Index largest = 0;
  n.cwiseAbs().maxCoeff(&largest);
  return n[largest] < 0 ? Vec3(-n) : n;
}

std::string free_name(std::string name, const std::vector<std::string>& taken) {
  const std::string wanted = name;
  for (int i = 2; std::find(taken.begin(), taken.end(), name) != taken.end(); ++i)
    name = wanted + "_" + std::to_string(i);
  return name;
}

class AttributeTransfer {
 public:
  AttributeTransfer(const TriMesh& surface, const SurfaceAttributes& given, const AttributeSettings& settings)
      : surface_(surface), given_(given), settings_(settings) {
    materials_ = given.material.empty() ? std::vector<std::string>{"original"} : given.materials;
    materials_.push_back(free_name("fracture", materials_));
  }

  void fill(Fragment& f) const {
    SurfaceAttributes& out = f.attributes;
    out = {};
    out.materials = materials_;
    out.normal = corner_normals(f.mesh, f.face_kind, settings_.crease_angle);
    out.uv.resize(f.mesh.triangle_count());
    out.material.resize(f.mesh.triangle_count());
    const Plane plane = facing(common_direction(f));
    for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t) {
      out.material[t] = static_cast<int>(materials_.size()) - 1;
      out.uv[t] = projected(f.mesh.triangle(TriId(t)), out.normal[t], plane);
      if (f.face_kind[t] == FaceKind::original) take_over(f, t);
    }
  }

 private:
  std::array<Vec2, 3> projected(const Triangle& x, const std::array<Vec3, 3>& normal,
                                const Plane& common) const {
    const Plane plane = settings_.projection == Projection::planar
                            ? common
                            : of_axis(area_vector2(x[0], x[1], x[2]).normalized() +
                                      0.01 * (normal[0] + normal[1] + normal[2]));
    std::array<Vec2, 3> uv;
    for (std::size_t k = 0; k < 3; ++k)
      uv[k] = Vec2(x[k].dot(plane.u), x[k].dot(plane.v)) / settings_.texture_size;
    return uv;
  }

  void take_over(Fragment& f, std::size_t t) const {
    SurfaceAttributes& out = f.attributes;
    const std::size_t from = f.source[t].index();
    out.material[t] = given_.material.empty() ? 0 : given_.material[from];
    const Triangle x = f.mesh.triangle(TriId(t)), parent = surface_.triangle(TriId(from));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 w = barycentric_weights(parent, x[k]);
      if (!given_.uv.empty()) out.uv[t][k] = weighted(given_.uv[from], w);
      if (given_.normal.empty()) continue;
      const Vec3 n = weighted(given_.normal[from], w);
      if (w.maxCoeff() == 1 && n.squaredNorm() > 0)
        out.normal[t][k] = n;
      else if (const double length = n.norm(); length > 0)
        out.normal[t][k] = n / length;
    }
  }

  const TriMesh& surface_;
  const SurfaceAttributes& given_;
  const AttributeSettings& settings_;
  std::vector<std::string> materials_;
};

}  // namespace

void transfer_attributes(std::vector<Fragment>& fragments, const TriMesh& surface,
                         const SurfaceAttributes& attributes, const AttributeSettings& settings) {
  const AttributeTransfer transfer(surface, attributes, settings);
  parallel_for(fragments.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      transfer.fill(fragments[i]);
  });
}

}  // namespace conchoid

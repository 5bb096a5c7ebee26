#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "conchoid/crack/law/hoop_stress_law.hpp"
#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid::testing {

inline const std::shared_ptr<const GrowthLaw> kLaw =
    std::make_shared<HoopStressLaw>(ElasticConstants{3.1e9, 0.327});

/// Flat disc, normal +z: ring k has 6k nodes, 6 rings² triangles. Radii of the rings are r(k).
template <class Radius>
TriMesh disc_with_radii(int rings, Radius radius) {
  TriMesh mesh;
  mesh.positions.push_back(Vec3::Zero());
  for (int k = 1; k <= rings; ++k)
    for (int j = 0; j < 6 * k; ++j) {
      const double phi = 2 * std::numbers::pi * j / (6 * k);
      mesh.positions.push_back(radius(k) * Vec3(std::cos(phi), std::sin(phi), 0));
    }
  const auto node = [](int k, int j) { return NodeId(k == 0 ? 0 : 1 + 3 * k * (k - 1) + j % (6 * k)); };
  for (int k = 1; k <= rings; ++k)
    for (int sector = 0; sector < 6; ++sector)
      for (int j = 0; j < k; ++j) {
        const int out = sector * k + j, in = sector * (k - 1) + j;
        mesh.corners.push_back({node(k - 1, in), node(k, out), node(k, out + 1)});
        if (j + 1 < k) mesh.corners.push_back({node(k - 1, in), node(k, out + 1), node(k - 1, in + 1)});
      }
  return mesh;
}

inline TriMesh disc(double radius, int rings) {
  return disc_with_radii(rings, [=](int k) { return radius * k / rings; });
}

/// Rectangle [0,w] × [0,h], normal +z, nx × ny cells of two triangles.
inline TriMesh rectangle(double w, double h, int nx, int ny) {
  TriMesh mesh;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i)
      mesh.positions.push_back({w * i / nx, h * j / ny, 0});
  const auto node = [=](int i, int j) { return NodeId(j * (nx + 1) + i); };
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      mesh.corners.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      mesh.corners.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  return mesh;
}

/// Some rotation, proper.
inline Mat3 some_rotation() {
  const Vec3 axis = Vec3(0.3, -0.8, 0.52).normalized();
  Mat3 k;
  k << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  return Mat3::Identity() + std::sin(1.234) * k + (1 - std::cos(1.234)) * k * k;
}

inline TriMesh transformed(TriMesh mesh, const Mat3& map, const Vec3& shift = Vec3::Zero()) {
  for (Vec3& x : mesh.positions)
    x = map * x + shift;
  return mesh;
}

/// x → −x, triangles turned over so that normals are mirrored too.
inline TriMesh mirrored(TriMesh mesh) {
  for (Vec3& x : mesh.positions)
    x.x() = -x.x();
  for (auto& c : mesh.corners)
    std::swap(c[1], c[2]);
  return mesh;
}

}  // namespace conchoid::testing

#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <random>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid::shapes {

/// Cube [−½, ½]³, n × n squares per face, each two triangles; outward.
inline TriMesh cube(int n) {
  TriMesh mesh;
  std::map<std::array<int, 3>, NodeId> ids;
  const auto node = [&](std::array<int, 3> at) {
    const auto [it, fresh] = ids.try_emplace(at);
    if (fresh) it->second = mesh.positions.add(Vec3(at[0], at[1], at[2]) / n - Vec3::Constant(0.5));
    return it->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, n})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto at = [&](int di, int dj) {
            std::array<int, 3> x{};
            x[axis] = side;
            x[(axis + 1) % 3] = i + di;
            x[(axis + 2) % 3] = j + dj;
            return node(x);
          };
          const NodeId a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
          if (side == n) {
            mesh.corners.push_back({a, b, c});
            mesh.corners.push_back({a, c, d});
          } else {
            mesh.corners.push_back({a, c, b});
            mesh.corners.push_back({a, d, c});
          }
        }
  return mesh;
}

/// Icosahedron, refined `levels` times, nodes on the unit sphere; outward.
inline TriMesh icosphere(int levels) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  TriMesh mesh;
  for (const Vec3& x :
       {Vec3(-1, g, 0), Vec3(1, g, 0), Vec3(-1, -g, 0), Vec3(1, -g, 0), Vec3(0, -1, g), Vec3(0, 1, g),
        Vec3(0, -1, -g), Vec3(0, 1, -g), Vec3(g, 0, -1), Vec3(g, 0, 1), Vec3(-g, 0, -1), Vec3(-g, 0, 1)})
    mesh.positions.push_back(x / x.norm());
  constexpr int faces[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (const auto& f : faces)
    mesh.corners.push_back({NodeId(f[0]), NodeId(f[1]), NodeId(f[2])});
  for (int level = 0; level < levels; ++level) {
    std::map<Edge, NodeId> middle;
    const auto mid = [&](NodeId a, NodeId b) {
      const auto [it, fresh] = middle.try_emplace(Edge(a, b));
      if (fresh) {
        const Vec3 x = mesh.positions[a] + mesh.positions[b];
        it->second = mesh.positions.add(x / x.norm());
      }
      return it->second;
    };
    IdVector<TriId, std::array<NodeId, 3>> fine;
    for (const auto& c : mesh.corners) {
      const NodeId ab = mid(c[0], c[1]), bc = mid(c[1], c[2]), ca = mid(c[2], c[0]);
      fine.push_back({c[0], ab, ca});
      fine.push_back({ab, c[1], bc});
      fine.push_back({ca, bc, c[2]});
      fine.push_back({ab, bc, ca});
    }
    mesh.corners = fine;
  }
  return mesh;
}

/// Sheet over [u0,u1] × [v0,v1] with nu × nv squares (two triangles each); `at` maps (u, v) into space.
inline TriMesh sheet(double u0, double u1, double v0, double v1, int nu, int nv,
                     const std::function<Vec3(double, double)>& at) {
  TriMesh mesh;
  for (int j = 0; j <= nv; ++j)
    for (int i = 0; i <= nu; ++i)
      mesh.positions.push_back(at(u0 + (u1 - u0) * i / nu, v0 + (v1 - v0) * j / nv));
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      const NodeId a(j * (nu + 1) + i), b(a.value + 1), d(a.value + nu + 1), c(d.value + 1);
      if ((i + j) % 2 == 0) {
        mesh.corners.push_back({a, b, c});
        mesh.corners.push_back({a, c, d});
      } else {
        mesh.corners.push_back({a, b, d});
        mesh.corners.push_back({b, c, d});
      }
    }
  return mesh;
}

/// Disc of rings × 6·ring triangles around `center`, in the plane spanned by e1, e2.
inline TriMesh disc(const Vec3& center, const Vec3& e1, const Vec3& e2, double radius, int rings) {
  TriMesh mesh;
  mesh.positions.push_back(center);
  std::vector<int> first{0};
  for (int r = 1; r <= rings; ++r) {
    first.push_back(static_cast<int>(mesh.node_count()));
    for (int k = 0; k < 6 * r; ++k) {
      const double phi = 2 * M_PI * k / (6 * r);
      mesh.positions.push_back(center + radius * r / rings * (std::cos(phi) * e1 + std::sin(phi) * e2));
    }
  }
  const auto id = [&](int r, int k) { return r == 0 ? NodeId(0) : NodeId(first[r] + k % (6 * r)); };
  for (int r = 1; r <= rings; ++r)
    for (int s = 0; s < 6; ++s)
      for (int k = 0; k < r; ++k) {
        mesh.corners.push_back({id(r - 1, s * (r - 1) + k), id(r, s * r + k), id(r, s * r + k + 1)});
        if (k + 1 < r)
          mesh.corners.push_back(
              {id(r - 1, s * (r - 1) + k), id(r, s * r + k + 1), id(r - 1, s * (r - 1) + k + 1)});
      }
  return mesh;
}

inline Mat3 random_rotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Vec3 a(normal(random), normal(random), normal(random)), b(normal(random), normal(random), normal(random));
  a /= a.norm();
  b -= a.dot(b) * a;
  b /= b.norm();
  Mat3 r;
  r.col(0) = a;
  r.col(1) = b;
  r.col(2) = cross(a, b);
  return r;
}

template <class Map>
TriMesh mapped(TriMesh mesh, const Map& map) {
  for (Vec3& x : mesh.positions)
    x = map(x);
  return mesh;
}

}  // namespace conchoid::shapes

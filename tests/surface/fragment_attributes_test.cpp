#include "conchoid/surface/fragment_attributes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "conchoid/surface/corner_normals.hpp"
#include "conchoid/surface/move_fragment.hpp"
#include "intersect/cut_shapes.hpp"

namespace conchoid {
namespace {

using namespace shapes;

int face_axis(const TriMesh& cube, TriId t) {
  Eigen::Index axis = 0;
  unit_normal(cube, t).cwiseAbs().maxCoeff(&axis);
  return static_cast<int>(axis);
}

/// Texture coordinates on the cube's faces: a chart of its own per face, linear in the place.
Vec2 chart(int axis, bool high, const Vec3& x) {
  return Vec2(0.3 * axis + 0.25 * (x[(axis + 1) % 3] + 0.5),
              (high ? 0.5 : 0.0) + 0.25 * (x[(axis + 2) % 3] + 0.5));
}

Vec3 soft_normal(const Vec3& x) {
  return x.normalized();
}

SurfaceAttributes painted(const TriMesh& cube) {
  SurfaceAttributes a;
  a.materials = {"x faces", "y faces", "z faces"};
  for (std::size_t t = 0; t < cube.triangle_count(); ++t) {
    const int axis = face_axis(cube, TriId(t));
    const bool high = centroid(cube, TriId(t))[axis] > 0;
    a.material.push_back(axis);
    a.uv.emplace_back();
    a.normal.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& x = cube.positions[cube.corners[TriId(t)][k]];
      a.uv.back()[k] = chart(axis, high, x);
      a.normal.back()[k] = soft_normal(x);
    }
  }
  return a;
}

struct Broken {
  TriMesh body;
  SurfaceAttributes paint;
  std::vector<Fragment> pieces;
};

Broken broken_cube(const AttributeSettings& settings) {
  Broken b;
  b.body = cube(4);
  b.paint = painted(b.body);
  const TriMesh wave = sheet(-0.9, 0.9, -0.9, 0.9, 14, 14, [](double u, double v) {
    return Vec3(u, v, 0.11 + 0.3 * u - 0.2 * v + 0.03 * std::sin(9 * u));
  });
  const TriMesh wall =
      sheet(-0.9, 0.9, -0.9, 0.9, 5, 5, [](double u, double v) { return Vec3(0.07 + 0.1 * u, u, v); });
  b.pieces = cut_into_fragments(b.body, {wave, wall}, {});
  transfer_attributes(b.pieces, b.body, b.paint, settings);
  return b;
}

TEST(FragmentAttributes, OriginalFacesKeepChartsMaterialsAndNormals) {
  const Broken b = broken_cube({});
  ASSERT_EQ(b.pieces.size(), 4u);
  std::size_t kept = 0, made = 0;
  for (const Fragment& f : b.pieces) {
    const SurfaceAttributes& a = f.attributes;
    EXPECT_EQ(a.materials, (std::vector<std::string>{"x faces", "y faces", "z faces", "fracture"}));
    for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t) {
      if (f.face_kind[t] == FaceKind::fracture) {
        EXPECT_EQ(a.material[t], 3);
        continue;
      }
      const TriId from = f.source[t];
      const int axis = face_axis(b.body, from);
      EXPECT_EQ(a.material[t], axis);
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& x = f.mesh.positions[f.mesh.corners[TriId(t)][k]];
        EXPECT_NEAR((a.uv[t][k] - chart(axis, centroid(b.body, from)[axis] > 0, x)).norm(), 0, 1e-14);
        EXPECT_NEAR(a.normal[t][k].norm(), 1, 1e-14);
        EXPECT_GT(a.normal[t][k].dot(soft_normal(x)), 0.99);  // between those of the corners
        bool own = false;
        for (std::size_t j = 0; j < 3; ++j)
          if (x == b.body.positions[b.body.corners[from][j]]) {
            own = true;
            EXPECT_EQ(a.uv[t][k], b.paint.uv[from.index()][j]);
            EXPECT_EQ(a.normal[t][k], b.paint.normal[from.index()][j]);
          }
        ++(own ? kept : made);
      }
    }
  }
  EXPECT_GT(kept, 500u);
  EXPECT_GT(made, 500u);
}

TEST(FragmentAttributes, BothSidesOfABreakCarryTheSameTexture) {
  const Broken b = broken_cube({.texture_size = 0.5});
  // the wave looks along z everywhere, the wall along x, from both sides
  for (const Fragment& f : b.pieces)
    for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t)
      if (f.face_kind[t] == FaceKind::fracture && area_vector(f.mesh, TriId(t)).norm() > 1e-15)
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec3& x = f.mesh.positions[f.mesh.corners[TriId(t)][k]];
          const bool wave = f.source[t].index() < 2 * 14 * 14;
          EXPECT_EQ(f.attributes.uv[t][k], wave ? Vec2(2 * x[0], 2 * x[1]) : Vec2(2 * x[1], 2 * x[2]));
        }
}

TEST(FragmentAttributes, PlanarProjectionHasNoSeamsOnAPiece) {
  const TriMesh body = cube(2);
  const TriMesh plane =
      sheet(-0.9, 0.9, -0.9, 0.9, 8, 8, [](double u, double v) { return Vec3(u, v, 0.5 * u + 0.1 * v); });
  auto pieces = cut_into_fragments(body, {plane}, {});
  transfer_attributes(pieces, body, {}, {.projection = Projection::planar, .texture_size = 2});
  const double stretch = std::sqrt(1 + 0.25 + 0.01);
  for (const Fragment& f : pieces) {
    EXPECT_EQ(f.attributes.materials, (std::vector<std::string>{"original", "fracture"}));
    double area = 0, texture = 0;
    for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t)
      if (f.face_kind[t] == FaceKind::fracture) {
        const auto& uv = f.attributes.uv[t];
        const Vec2 p = uv[1] - uv[0], q = uv[2] - uv[0];
        texture += 0.5 * std::abs(p[0] * q[1] - p[1] * q[0]);
        area += area_vector(f.mesh, TriId(t)).norm();
      }
    EXPECT_NEAR(area, stretch, 1e-12);
    EXPECT_NEAR(texture, area / 4, 1e-12);  // seen face on, in units of 2 m
  }
}

TEST(FragmentAttributes, FractureIsSmoothAndSharpAtItsRim) {
  const TriMesh body = cube(2);
  const TriMesh bowl = sheet(-0.9, 0.9, -0.9, 0.9, 24, 24,
                             [](double u, double v) { return Vec3(u, v, 0.3 * (u * u + v * v)); });
  auto pieces = cut_into_fragments(body, {bowl}, {});
  transfer_attributes(pieces, body, {}, {});
  for (const Fragment& f : pieces)
    for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& x = f.mesh.positions[f.mesh.corners[TriId(t)][k]];
        const Vec3& n = f.attributes.normal[t][k];
        if (area_vector(f.mesh, TriId(t)).norm() < 1e-15) continue;
        if (f.face_kind[t] == FaceKind::original) {
          EXPECT_NEAR((n - unit_normal(f.mesh, TriId(t))).norm(), 0, 1e-9);  // the cube's faces stay flat
        } else {
          const Vec3 exact = Vec3(-0.6 * x[0], -0.6 * x[1], 1).normalized();
          EXPECT_GT(std::abs(n.dot(exact)), 0.998);  // within 4°: the facets bend by up to 3°
        }
      }
}

// A smooth body: what it says about its own nodes stays up to the rim, the break has the normals of its
// sheet.
TEST(NodeNormals, NodesOfTheBodyKeepItsNormalsAndTheBreakHasItsOwn) {
  const TriMesh body = icosphere(3);
  SurfaceAttributes given;
  for (std::size_t t = 0; t < body.triangle_count(); ++t) {
    given.normal.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      given.normal.back()[k] = soft_normal(body.positions[body.corners[TriId(t)][k]]);
  }
  const auto dip = [](double u, double v) { return 0.2 * u * u - 0.1 * v; };
  auto pieces = cut_into_fragments(
      body, {sheet(-1.3, 1.3, -1.3, 1.3, 30, 30, [&](double u, double v) { return Vec3(u, v, dip(u, v)); })},
      {});
  ASSERT_EQ(pieces.size(), 2u);
  transfer_attributes(pieces, body, given, {});
  std::map<std::array<double, 3>, Vec3> of_body;
  for (const Vec3& x : body.positions)
    of_body[{x[0], x[1], x[2]}] = soft_normal(x);
  std::size_t kept = 0, rim = 0, inside = 0;
  for (const Fragment& f : pieces) {
    const auto normals = node_normals(f.mesh, f.face_kind, f.attributes.normal);
    const double side = f.center_of_mass.z() > dip(0, 0) ? -1 : 1;  // the upper piece looks down on the break
    std::set<NodeId> of_surface;
    for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t)
      if (f.face_kind[t] == FaceKind::original)
        of_surface.insert(f.mesh.corners[TriId(t)].begin(), f.mesh.corners[TriId(t)].end());
    for (std::size_t i = 0; i < f.mesh.node_count(); ++i) {
      const Vec3 &x = f.mesh.positions[NodeId(i)], &n = normals[NodeId(i)];
      EXPECT_NEAR(n.norm(), 1, 1e-14);
      if (const auto own = of_body.find({x[0], x[1], x[2]}); own != of_body.end()) {
        EXPECT_EQ(n, own->second);
        ++kept;
      } else if (of_surface.contains(NodeId(i))) {
        EXPECT_GT(n.dot(soft_normal(x)), 0.9999);
        ++rim;
      } else {
        EXPECT_GT(n.dot(side * Vec3(-0.4 * x[0], 0.1, 1).normalized()), 0.999);
        ++inside;
      }
    }
  }
  EXPECT_EQ(kept, body.node_count());
  EXPECT_GT(rim, 100u);
  EXPECT_GT(inside, 500u);
}

TEST(FragmentAttributes, ABrokenPieceCanBeBrokenAgain) {
  const TriMesh body = cube(2);
  SurfaceAttributes first;
  first.materials = {"original", "fracture"};
  for (std::size_t t = 0; t < body.triangle_count(); ++t)
    first.material.push_back(t % 2 == 0 ? 0 : 1);
  auto pieces = cut_into_fragments(
      body, {sheet(-0.9, 0.9, -0.9, 0.9, 3, 3, [](double u, double v) { return Vec3(u, v, 0.1); })}, {});
  transfer_attributes(pieces, body, first, {});
  EXPECT_EQ(pieces[0].attributes.materials, (std::vector<std::string>{"original", "fracture", "fracture_2"}));
}

TEST(MoveFragment, NodesOfTheBodyGoBackToTheSameBits) {
  TriMesh far = cube(5);
  const Vec3 origin(1e3 + 1.0 / 3.0, -2e3, 1.0 / 7.0);
  for (Vec3& x : far.positions)
    x = 0.7 * x + origin;
  TriMesh centred = far;
  for (Vec3& x : centred.positions)
    x -= origin;
  auto pieces = cut_into_fragments(
      centred,
      {sheet(-0.9, 0.9, -0.9, 0.9, 7, 7, [](double u, double v) { return Vec3(u, v, 0.2 * u + 0.03); })}, {});
  std::set<std::array<double, 3>> nodes, wanted;
  for (Fragment& f : pieces) {
    const Vec3 center = f.center_of_mass;
    move_fragment(f, origin, centred, far.positions);
    EXPECT_EQ(f.center_of_mass, Vec3(center + origin));
    EXPECT_NEAR(enclosed_volume(f.mesh), f.volume, 1e-10);
    for (const Vec3& x : f.mesh.positions)
      nodes.insert({x[0], x[1], x[2]});
  }
  for (const Vec3& x : far.positions)
    wanted.insert({x[0], x[1], x[2]});
  EXPECT_TRUE(std::includes(nodes.begin(), nodes.end(), wanted.begin(), wanted.end()));
}

}  // namespace
}  // namespace conchoid

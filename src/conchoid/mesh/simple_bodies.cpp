#include <cmath>
#include <map>

#include "conchoid/core/error.hpp"
#include "conchoid/mesh/models.hpp"

namespace conchoid {
namespace {

/// Nodes on the surface of a grid of cells, made on first use.
class GridNodes {
 public:
  GridNodes(TriMesh& mesh, const Vec3& size, const std::array<int, 3>& cells)
      : mesh_(mesh), size_(size), cells_(cells) {}
  NodeId operator()(const std::array<int, 3>& at) {
    const auto [found, inserted] = ids_.try_emplace(at, NodeId());
    if (inserted) {
      Vec3 x;
      for (int k = 0; k < 3; ++k)
        x[k] = size_[k] * (2 * at[k] - cells_[k]) /
               (2.0 * cells_[k]);  // exact mirror images in the coordinate planes
      found->second = mesh_.positions.add(x);
    }
    return found->second;
  }

 private:
  TriMesh& mesh_;
  Vec3 size_;
  std::array<int, 3> cells_;
  std::map<std::array<int, 3>, NodeId> ids_;
};

/// Divides every triangle in four; the new nodes are put on the sphere.
TriMesh subdivided(const TriMesh& coarse, double radius) {
  TriMesh fine;
  fine.positions = coarse.positions;
  std::map<Edge, NodeId> middles;
  auto middle = [&](NodeId a, NodeId b) {
    const auto [found, inserted] = middles.try_emplace(Edge(a, b), NodeId());
    if (inserted) {
      const Vec3 sum = coarse.positions[a] + coarse.positions[b];
      found->second = fine.positions.add(sum * (radius / sum.norm()));
    }
    return found->second;
  };
  for (const auto& [a, b, c] : coarse.corners) {
    const NodeId ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    fine.corners.push_back({a, ab, ca});
    fine.corners.push_back({ab, b, bc});
    fine.corners.push_back({ca, bc, c});
    fine.corners.push_back({ab, bc, ca});
  }
  return fine;
}

}  // namespace

TriMesh box_mesh(const Vec3& size, int nx, int ny, int nz) {
  if (nx < 1 || ny < 1 || nz < 1 || !(size.minCoeff() > 0))
    throw InputError("a box needs positive edge lengths and at least one cell along each edge");
  const std::array<int, 3> cells = {nx, ny, nz};
  TriMesh mesh;
  GridNodes node(mesh, size, cells);
  for (int axis = 0; axis < 3; ++axis) {
    const int p = (axis + 1) % 3, q = (axis + 2) % 3;  // (p, q, axis) is right-handed
    for (const bool positive : {false, true})
      for (int i = 0; i < cells[p]; ++i)
        for (int j = 0; j < cells[q]; ++j) {
          auto at = [&](int di, int dj) {
            std::array<int, 3> index{};
            index[axis] = positive ? cells[axis] : 0;
            index[p] = i + di;
            index[q] = j + dj;
            return node(index);
          };
          auto add = [&](NodeId a, NodeId b, NodeId c) {
            mesh.corners.push_back(positive ? std::array{a, b, c} : std::array{a, c, b});
          };
          const NodeId a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
          if ((i + j) % 2 == 0) {
            add(a, b, c);
            add(a, c, d);
          } else {
            add(a, b, d);
            add(b, c, d);
          }
        }
  }
  return mesh;
}

std::vector<Region> box_regions(const TriMesh& mesh) {
  const Box box = bounding_box(mesh);
  std::vector<Region> regions = {{"x-", {}}, {"x+", {}}, {"y-", {}}, {"y+", {}}, {"z-", {}}, {"z+", {}}};
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Triangle x = mesh.triangle(TriId(t));
    for (int axis = 0; axis < 3; ++axis)
      for (int side = 0; side < 2; ++side) {
        const double plane = side == 0 ? box.low[axis] : box.high[axis];
        if (x[0][axis] == plane && x[1][axis] == plane && x[2][axis] == plane)
          regions[2 * axis + side].triangles.push_back(TriId(t));
      }
  }
  return regions;
}

TriMesh icosphere(double radius, int subdivisions) {
  if (!(radius > 0) || subdivisions < 0 || subdivisions > 9)
    throw InputError("a sphere needs a positive radius and 0 to 9 subdivisions");
  const double golden = 0.5 * (1 + std::sqrt(5.0));
  TriMesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (double s : {1.0, -1.0})
      for (double l : {golden, -golden}) {
        Vec3 x = Vec3::Zero();
        x[axis] = s;
        x[(axis + 1) % 3] = l;
        mesh.positions.push_back(x);
      }
  // The icosahedron's faces are the triples of nodes at mutual distance 2.
  auto near = [&](std::size_t a, std::size_t b) {
    return (mesh.positions[NodeId(a)] - mesh.positions[NodeId(b)]).squaredNorm() < 5;
  };
  for (std::size_t a = 0; a < 12; ++a)
    for (std::size_t b = a + 1; b < 12; ++b)
      for (std::size_t c = b + 1; c < 12; ++c)
        if (near(a, b) && near(b, c) && near(c, a)) {
          const Vec3 xa = mesh.positions[NodeId(a)], xb = mesh.positions[NodeId(b)],
                     xc = mesh.positions[NodeId(c)];
          if (area_vector2(xa, xb, xc).dot(xa) > 0)
            mesh.corners.push_back({NodeId(a), NodeId(b), NodeId(c)});
          else
            mesh.corners.push_back({NodeId(a), NodeId(c), NodeId(b)});
        }
  for (Vec3& x : mesh.positions)
    x *= radius / x.norm();
  for (int s = 0; s < subdivisions; ++s)
    mesh = subdivided(mesh, radius);
  return mesh;
}

}  // namespace conchoid

#include "conchoid/remesh/voxel_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "conchoid/core/interrupt.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/mesh/closest_point.hpp"

namespace conchoid {
namespace {

constexpr std::size_t margin = 2;  // lattice points outside of the box, on every side
// Keeps the lattice off the faces of boxes, which often lie on whole multiples of a voxel.
constexpr std::array<double, 3> offset = {0.37, 0.41, 0.43};

// --- inside

/// Where an edge passes the line y = const of the xy-plane. From the edge alone, whichever triangle asks.
struct EdgePassage {
  double x, z;
  bool upward;  ///< in y, in the direction of the triangle
};

bool passes(const Vec3& p, const Vec3& q, double y) {
  return (p.y() <= y) != (q.y() <= y);
}

EdgePassage passage(const TriMesh& mesh, NodeId from, NodeId to, double y) {
  const Edge edge(from, to);
  const Vec3 &p = mesh.positions[edge.a], &q = mesh.positions[edge.b];
  const double s = (y - p.y()) / (q.y() - p.y());
  return {p.x() + s * (q.x() - p.x()), p.z() + s * (q.z() - p.z()),
          mesh.positions[from].y() < mesh.positions[to].y()};
}

/// A line in z meets a triangle: the surface winds once more (+1) or less below z.
struct Crossing {
  double z;
  int sign;
};

struct Row {
  std::size_t first;  ///< lattice point in x
  Crossing crossing;
};

/// All meetings of the lines (i, j) with triangle t.
void cross_lines(const TriMesh& mesh, TriId t, const InsideLattice& lattice, std::size_t j,
                 std::vector<Row>& out) {
  const double y = lattice.origin.y() + static_cast<double>(j) * lattice.voxel;
  const auto& c = mesh.corners[t];
  std::array<EdgePassage, 2> at{};
  std::size_t found = 0;
  for (std::size_t k = 0; k < 3; ++k)
    if (passes(mesh.positions[c[k]], mesh.positions[c[(k + 1) % 3]], y))
      at[found++] = passage(mesh, c[k], c[(k + 1) % 3], y);
  if (found != 2) return;
  if (at[1].x < at[0].x) std::swap(at[0], at[1]);
  const auto first_after = [&](double x) {
    // The first lattice point that is not left of x, found by comparing, not by rounding.
    auto i = static_cast<std::ptrdiff_t>(std::floor((x - lattice.origin.x()) / lattice.voxel));
    const auto place = [&](std::ptrdiff_t n) {
      return lattice.origin.x() + static_cast<double>(n) * lattice.voxel;
    };
    while (place(i) >= x)
      --i;
    while (place(i) < x)
      ++i;
    return i;
  };
  const std::ptrdiff_t begin = first_after(at[0].x), end = first_after(at[1].x);
  for (std::ptrdiff_t i = begin; i < end; ++i) {
    const double x = lattice.origin.x() + static_cast<double>(i) * lattice.voxel;
    const double s = (x - at[0].x) / (at[1].x - at[0].x);
    out.push_back({static_cast<std::size_t>(i), {at[0].z + s * (at[1].z - at[0].z), at[1].upward ? 1 : -1}});
  }
}

/// Triangles whose y-range meets each lattice row.
std::vector<std::vector<TriId>> triangles_of_rows(const TriMesh& mesh, const InsideLattice& lattice) {
  std::vector<std::vector<TriId>> rows(lattice.size[1]);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    throw_if_interrupted();
    const Triangle x = mesh.triangle(TriId(t));
    const double low = std::min({x[0].y(), x[1].y(), x[2].y()}),
                 high = std::max({x[0].y(), x[1].y(), x[2].y()});
    const auto row = [&](double y) { return std::floor((y - lattice.origin.y()) / lattice.voxel); };
    for (auto j = static_cast<std::size_t>(row(low)); j <= static_cast<std::size_t>(row(high)) + 1; ++j)
      rows[j].push_back(TriId(t));
  }
  return rows;
}

void fill_line(InsideLattice& lattice, std::size_t i, std::size_t j, std::vector<Crossing>& crossings) {
  std::sort(crossings.begin(), crossings.end(),
            [](const Crossing& a, const Crossing& b) { return a.z != b.z ? a.z > b.z : a.sign > b.sign; });
  int winding = 0;
  std::size_t next = 0;
  for (std::size_t k = lattice.size[2]; k-- > 0;) {
    const double z = lattice.origin.z() + static_cast<double>(k) * lattice.voxel;
    for (; next < crossings.size() && crossings[next].z > z; ++next)
      winding += crossings[next].sign;
    if (winding > 0) lattice.inside[lattice.index(i, j, k)] = 1;
  }
}

// --- boundary

/// Corner of a cube: bit 0 for x, 1 for y, 2 for z.
using Corner = unsigned;

/// The tetrahedra 0, a, a|b, 7 for the six orders of the axes; an odd order is turned over.
constexpr std::array<std::array<Corner, 4>, 6> tetrahedra = {
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};

class BoundaryBuilder {
 public:
  BoundaryBuilder(const InsideLattice& lattice, const TriMesh& surface) : lattice_(lattice), tree_(surface) {}

  TriMesh build() {
    const std::size_t edges_of_layer = ways * lattice_.size[0] * lattice_.size[1];
    for (auto& ids : ids_)
      ids.assign(edges_of_layer, NodeId());
    for (std::size_t k = 0; k + 1 < lattice_.size[2]; ++k) {
      std::fill(ids_[(k + 1) % 2].begin(), ids_[(k + 1) % 2].end(), NodeId());
      for (std::size_t j = 0; j + 1 < lattice_.size[1]; ++j, throw_if_interrupted())
        for (std::size_t i = 0; i + 1 < lattice_.size[0]; ++i)
          cut_cube(lattice_.index(i, j, k));
    }
    place_nodes();
    return std::move(mesh_);
  }

 private:
  struct LatticeEdge {
    std::size_t in, out;
  };

  std::size_t corner(std::size_t base, Corner c) const {
    return base + (c & 1) + ((c >> 1) & 1) * lattice_.size[0] +
           ((c >> 2) & 1) * lattice_.size[0] * lattice_.size[1];
  }

  void cut_cube(std::size_t base) {
    int count = 0;
    for (Corner c = 0; c < 8; ++c)
      count += lattice_.inside[corner(base, c)];
    if (count == 0 || count == 8) return;
    for (const auto& tetrahedron : tetrahedra)
      cut_tetrahedron(base, tetrahedron);
  }

  /// Even permutations keep the orientation, so that cases need no tables: the corners inside come first.
  void cut_tetrahedron(std::size_t base, const std::array<Corner, 4>& corners) {
    std::array<std::size_t, 4> p{};
    for (std::size_t i = 0; i < 4; ++i)
      p[i] = corner(base, corners[i]);
    bool even = true;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k + 1 < 4; ++k)
        if (lattice_.inside[p[k]] < lattice_.inside[p[k + 1]]) {
          std::swap(p[k], p[k + 1]);
          even = !even;
        }
    const int count =
        lattice_.inside[p[0]] + lattice_.inside[p[1]] + lattice_.inside[p[2]] + lattice_.inside[p[3]];
    if (count == 1) add(even, node(p[0], p[1]), node(p[0], p[2]), node(p[0], p[3]));
    if (count == 3) add(even, node(p[0], p[3]), node(p[1], p[3]), node(p[2], p[3]));
    if (count == 2) {
      const NodeId a = node(p[0], p[2]), b = node(p[0], p[3]), c = node(p[1], p[3]), d = node(p[1], p[2]);
      add(even, a, b, c);
      add(even, a, c, d);
    }
  }

  void add(bool even, NodeId a, NodeId b, NodeId c) {
    if (even)
      mesh_.corners.push_back({a, b, c});
    else
      mesh_.corners.push_back({a, c, b});
  }

  NodeId node(std::size_t in, std::size_t out) {
    // Both ends are corners of one cube: the lower one and the seven ways to go from it tell the edge.
    const std::size_t low = std::min(in, out), step = std::max(in, out) - low;
    const std::size_t row = lattice_.size[0], layer = row * lattice_.size[1];
    const std::size_t way =
        (step >= layer ? 4 : 0) + (step % layer >= row ? 2 : 0) + (step % row != 0 ? 1 : 0);
    NodeId& id = ids_[low / layer % 2][ways * (low % layer) + way];
    if (!id.valid()) {
      id = NodeId(edges_.size());
      edges_.push_back({in, out});
    }
    return id;
  }

  void place_nodes() {
    std::vector<std::size_t> points;
    for (const LatticeEdge& edge : edges_) {
      points.push_back(edge.in);
      points.push_back(edge.out);
    }
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    const auto distances = parallel_values(points.size(), 256, [&](std::size_t i) {
      return std::sqrt(tree_.closest(lattice_.point(points[i])).squared_distance);
    });
    const auto distance = [&](std::size_t point) {
      return distances[static_cast<std::size_t>(std::lower_bound(points.begin(), points.end(), point) -
                                                points.begin())];
    };
    mesh_.positions.reserve(edges_.size());
    for (const LatticeEdge& edge : edges_) {
      throw_if_interrupted();
      constexpr double closest = 0.05;
      const double d_in = distance(edge.in), d_out = distance(edge.out);
      const double s = d_in + d_out > 0 ? std::clamp(d_in / (d_in + d_out), closest, 1 - closest) : 0.5;
      const Vec3 in = lattice_.point(edge.in);
      mesh_.positions.push_back(in + s * (lattice_.point(edge.out) - in));
    }
  }

  const InsideLattice& lattice_;
  ClosestPointTree tree_;
  TriMesh mesh_;
  static constexpr std::size_t ways = 8;    ///< to go on from a lattice point
  std::array<std::vector<NodeId>, 2> ids_;  ///< of edges from points of the layers being cut, even and odd
  std::vector<LatticeEdge> edges_;
};

}  // namespace

Vec3 InsideLattice::point(std::size_t index) const {
  const std::size_t layer = size[0] * size[1];
  return origin + voxel * Vec3(static_cast<double>(index % size[0]),
                               static_cast<double>(index % layer / size[0]),
                               static_cast<double>(index / layer));
}

std::array<std::size_t, 3> lattice_size(const Box& box, double voxel) {
  std::array<std::size_t, 3> size{};
  for (int k = 0; k < 3; ++k) {
    const double cells = std::ceil((box.high[k] - box.low[k]) / voxel);
    size[static_cast<std::size_t>(k)] = static_cast<std::size_t>(std::min(cells, 1e6)) + 2 * margin + 1;
  }
  return size;
}

InsideLattice inside_lattice(const TriMesh& surface, double voxel) {
  InsideLattice lattice;
  const Box box = bounding_box(surface);
  lattice.voxel = voxel;
  lattice.size = lattice_size(box, voxel);
  for (int k = 0; k < 3; ++k)
    lattice.origin[k] =
        box.low[k] - (static_cast<double>(margin) - offset[static_cast<std::size_t>(k)]) * voxel;
  lattice.inside.assign(lattice.size[0] * lattice.size[1] * lattice.size[2], 0);
  const auto rows = triangles_of_rows(surface, lattice);
  parallel_for(lattice.size[1], 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      std::vector<Row> meetings;
      for (TriId t : rows[j])
        cross_lines(surface, t, lattice, j, meetings);
      std::vector<std::vector<Crossing>> lines(lattice.size[0]);
      for (const Row& meeting : meetings)
        lines[meeting.first].push_back(meeting.crossing);
      for (std::size_t i = 0; i < lines.size(); ++i)
        if (!lines[i].empty()) fill_line(lattice, i, j, lines[i]);
    }
  });
  return lattice;
}

TriMesh lattice_boundary(const InsideLattice& lattice, const TriMesh& surface) {
  return BoundaryBuilder(lattice, surface).build();
}

}  // namespace conchoid

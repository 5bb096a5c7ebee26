#include "conchoid/mesh/crack_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "conchoid/core/error.hpp"
#include "conchoid/mesh/circle_points.hpp"
#include "conchoid/mesh/sort_by_edge.hpp"

namespace conchoid {
namespace {

void require_positive(double value, const char* what) {
  if (!(value > 0) || !std::isfinite(value))
    throw InputError(std::string("crack: ") + what + " must be a positive number of metres");
}

void require_resolution(const SheetResolution& resolution) {
  const bool by_count = resolution.triangles > 0,
             by_edge = resolution.edge > 0 && std::isfinite(resolution.edge);
  if (by_count == by_edge)
    throw InputError("crack: give either a positive number of triangles or a positive edge length");
  if (resolution.triangles > 10'000'000)
    throw InputError("crack: more than 10 million triangles asked for; lower `triangles`");
}

/// Orthonormal in-plane axes (first, second) with first × second = normal.
struct PlaneAxes {
  Vec3 first, second;
};

PlaneAxes plane_axes(const Vec3& normal, const std::optional<Vec3>& direction) {
  const double length = normal.norm();
  if (!(length > 0) || !std::isfinite(length))
    throw InputError("crack: the normal must be a finite vector that is not zero");
  const Vec3 n = normal / length;
  Vec3 start = Vec3::Zero();
  if (direction) {
    start = *direction;
  } else {
    int flattest = 0;
    for (int k = 1; k < 3; ++k)
      if (std::abs(n[k]) < std::abs(n[flattest])) flattest = k;
    start[flattest] = 1;
  }
  const double start_length = start.norm();
  const Vec3 in_plane = start - start.dot(n) * n;
  const double in_plane_length = in_plane.norm();
  if (!std::isfinite(start_length) || !(in_plane_length > 1e-6 * start_length))
    throw InputError("crack: the direction must be a finite vector that is not along the normal");
  const Vec3 first = in_plane / in_plane_length;
  return {first, cross(n, first)};
}

/// The lattice behind discs and ellipses: ring k is a hexagon with sides k, k+s, k, k, k+s, k (in edges)
/// around a middle segment of s edges; its nodes count counter-clockwise from the end on the positive first
/// axis.
class RingLattice {
 public:
  RingLattice(int rings, int middle) : rings_(rings), middle_(middle) {}

  int rings() const { return rings_; }
  int middle() const { return middle_; }
  int ring_size(int k) const { return 6 * k + 2 * middle_; }
  int triangle_count() const { return 6 * rings_ * rings_ + 4 * middle_ * rings_; }

  NodeId node(int k, int place) const {
    if (k == 0) {
      if (middle_ == 0) return NodeId(0);
      place %= 2 * middle_;
      return NodeId(place <= middle_ ? place : 2 * middle_ - place);
    }
    return NodeId(middle_ + 1 + 3 * k * (k - 1) + 2 * middle_ * (k - 1) + place % ring_size(k));
  }

  IdVector<TriId, std::array<NodeId, 3>> triangles() const {
    IdVector<TriId, std::array<NodeId, 3>> corners;
    for (int k = 1; k <= rings_; ++k) {
      int outer = 0, inner = 0;
      for (int side = 0; side < 6; ++side) {
        const int length = k + (side % 3 == 1 ? middle_ : 0);
        for (int j = 0; j < length; ++j) {
          const NodeId behind = node(k - 1, inner + j);
          corners.push_back({node(k, outer + j), node(k, outer + j + 1), behind});
          if (j + 1 < length) corners.push_back({behind, node(k, outer + j + 1), node(k - 1, inner + j + 1)});
        }
        outer += length;
        inner += length - 1;
      }
    }
    return corners;
  }

 private:
  int rings_, middle_;
};

/// Edges of the middle segment that make the front edges as long as the rings are wide (0 for a circle).
int middle_edges(int rings, double a, double b) {
  return static_cast<int>(std::lround(0.5 * rings * (ellipse_perimeter(a / b, 1.0) - 2 * std::numbers::pi)));
}

/// Rather more triangles than asked for than fewer than this share of them.
constexpr double kLeastShare = 0.9;

RingLattice lattice_for(double a, double b, const SheetResolution& resolution) {
  auto lattice = [&](int rings) { return RingLattice(rings, middle_edges(rings, a, b)); };
  if (resolution.edge > 0) {
    const double rings = std::round(b / resolution.edge);
    if (rings > 1000)
      throw InputError("crack: the edge length is less than a thousandth of the crack; raise it");
    return lattice(std::max(2, static_cast<int>(rings)));
  }
  int rings = 1;
  auto miss = [&](int k) { return std::abs(lattice(k).triangle_count() - resolution.triangles); };
  while (miss(rings + 1) <= miss(rings))
    ++rings;
  if (lattice(rings).triangle_count() < kLeastShare * resolution.triangles) ++rings;
  return lattice(rings);
}

TriMesh ringed_ellipse(double a, double b, const RingLattice& lattice) {
  const int rings = lattice.rings(), middle = lattice.middle();
  TriMesh mesh;
  for (int j = 0; j <= middle; ++j)
    mesh.positions.push_back({middle == 0 ? 0.0 : (a - b) * (middle - 2 * j) / middle, 0, 0});
  for (int k = 1; k <= rings; ++k) {
    const double share = static_cast<double>(k) / rings;
    const double ring_b = b * share, ring_a = middle == 0 ? a * share : (a - b) + ring_b;
    for (int j = 0; j < lattice.ring_size(k); ++j) {
      const Vec2 p = ellipse_point(j, lattice.ring_size(k), ring_a, ring_b);
      mesh.positions.push_back({p.x(), p.y(), 0});
    }
  }
  mesh.corners = lattice.triangles();
  return mesh;
}

void place(TriMesh& mesh, const Vec3& center, const PlaneAxes& axes) {
  for (Vec3& x : mesh.positions)
    x = center + x.x() * axes.first + x.y() * axes.second;
}

/// Front edges along the two sides of a rectangle.
struct SideCounts {
  int n, m;
  /// Two triangles for each cell between the nodes behind the front — four in the middle column or row of an
  /// odd number —, one for each front edge and one for each edge of that grid's rim.
  int triangle_count() const {
    const int columns = n - 1, rows = m - 1;
    const int middle_cells = columns % 2 * rows + rows % 2 * columns - columns % 2 * (rows % 2);
    return 2 * columns * rows + 2 * middle_cells + 2 * (n + m) + 2 * (columns + rows);
  }
};

SideCounts side_counts(double length1, double length2, const SheetResolution& resolution) {
  auto at_least_three = [](double x) { return std::max(3, static_cast<int>(std::lround(x))); };
  if (resolution.edge > 0) {
    if (std::max(length1, length2) > 3000 * resolution.edge)
      throw InputError("crack: the edge length is less than a three-thousandth of the crack; raise it");
    return {at_least_three(length1 / resolution.edge), at_least_three(length2 / resolution.edge)};
  }
  const bool first_is_short = length1 <= length2;
  const double ratio = first_is_short ? length2 / length1 : length1 / length2;
  auto counts = [&](int on_short) {
    const int on_long = at_least_three(on_short * ratio);
    return first_is_short ? SideCounts{on_short, on_long} : SideCounts{on_long, on_short};
  };
  SideCounts best = counts(3);
  auto miss = [&](const SideCounts& c) { return std::abs(c.triangle_count() - resolution.triangles); };
  for (int on_short = 4; counts(on_short - 2).triangle_count() < resolution.triangles; ++on_short)
    if (miss(counts(on_short)) < miss(best)) best = counts(on_short);
  return best;
}

/// Fills the grid of cells behind the front of a rectangle. The diagonals alternate and are mirrored at the
/// middles; a middle column or row of cells is divided crosswise, so that the mesh is its own mirror image.
void fill_grid(TriMesh& mesh, const std::vector<NodeId>& nodes, int n, int m) {
  const int columns = n - 1, rows = m - 1;
  auto at = [&](int i, int j) { return nodes[static_cast<std::size_t>(j * n + i)]; };
  auto beyond_middle = [](int i, int cells) { return cells % 2 == 1 && 2 * i > cells; };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const NodeId a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if (2 * i + 1 == columns || 2 * j + 1 == rows) {
        const NodeId middle = mesh.positions.add(
            0.25 * ((mesh.positions[a] + mesh.positions[c]) + (mesh.positions[b] + mesh.positions[d])));
        mesh.corners.insert(mesh.corners.end(),
                            {{a, b, middle}, {b, c, middle}, {c, d, middle}, {d, a, middle}});
      } else if (((i + j) % 2 == 0) != (beyond_middle(i, columns) != beyond_middle(j, rows))) {
        mesh.corners.insert(mesh.corners.end(), {{a, b, c}, {a, c, d}});
      } else {
        mesh.corners.insert(mesh.corners.end(), {{a, b, d}, {b, c, d}});
      }
    }
}

}  // namespace

TriMesh ellipse_crack(const Vec3& center, const Vec3& normal, double a, double b,
                      const SheetResolution& resolution, const std::optional<Vec3>& direction) {
  require_positive(a, "semi-axis a");
  require_positive(b, "semi-axis b");
  require_resolution(resolution);
  if (std::max(a, b) > 100 * std::min(a, b))
    throw InputError("crack: one axis of the ellipse is more than 100 times the other; use a rectangle");
  if (!center.allFinite()) throw InputError("crack: the center must be finite");
  PlaneAxes axes = plane_axes(normal, direction);
  if (a < b) {  // the middle segment lies along the longer axis
    std::swap(a, b);
    axes = {axes.second, -axes.first};
  }
  const RingLattice lattice = lattice_for(a, b, resolution);
  TriMesh mesh = ringed_ellipse(a, b, lattice);
  place(mesh, center, axes);
  return mesh;
}

TriMesh disc_crack(const Vec3& center, const Vec3& normal, double radius, const SheetResolution& resolution,
                   const std::optional<Vec3>& direction) {
  require_positive(radius, "radius");
  return ellipse_crack(center, normal, radius, radius, resolution, direction);
}

TriMesh rectangle_crack(const Vec3& center, const Vec3& edge1, const Vec3& edge2,
                        const SheetResolution& resolution) {
  const double length1 = edge1.norm(), length2 = edge2.norm();
  require_positive(length1, "first edge");
  require_positive(length2, "second edge");
  require_resolution(resolution);
  if (!center.allFinite()) throw InputError("crack: the center must be finite");
  if (!(cross(edge1, edge2).norm() > 1e-3 * length1 * length2))
    throw InputError("crack: the two edges of the rectangle must not be parallel");
  if (std::max(length1, length2) > 300 * std::min(length1, length2))
    throw InputError("crack: one edge of the rectangle is more than 300 times the other");
  const auto [n, m] = side_counts(length1, length2, resolution);

  TriMesh mesh;
  auto add = [&](double p, double q) { return mesh.positions.add(center + p * edge1 + q * edge2); };
  // Front nodes, counter-clockwise from the corner (−½, −½).
  std::vector<NodeId> front;
  for (int i = 0; i < n; ++i)
    front.push_back(add((2 * i - n) / (2.0 * n), -0.5));
  for (int j = 0; j < m; ++j)
    front.push_back(add(0.5, (2 * j - m) / (2.0 * m)));
  for (int i = n; i > 0; --i)
    front.push_back(add((2 * i - n) / (2.0 * n), 0.5));
  for (int j = m; j > 0; --j)
    front.push_back(add(-0.5, (2 * j - m) / (2.0 * m)));
  // Inner nodes: n × m of them, one behind the middle of each front edge; the corner ones serve two edges.
  constexpr double ring_height = 0.8;  // in front edge lengths
  const double edge1_length = length1 / n, edge2_length = length2 / m;
  // No wider than the shorter edge: of three edges or more across, the inner nodes keep the middle one's width.
  const double width =
      std::min(ring_height * 0.5 * (edge1_length + edge2_length), std::min(edge1_length, edge2_length));
  const double inner1 = 1 - 2 * width / length1, inner2 = 1 - 2 * width / length2;
  std::vector<NodeId> inner;
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i)
      inner.push_back(
          add(inner1 * (2 * i - (n - 1)) / (2.0 * (n - 1)), inner2 * (2 * j - (m - 1)) / (2.0 * (m - 1))));
  auto grid = [&](int i, int j) { return inner[static_cast<std::size_t>(j * n + i)]; };
  std::vector<NodeId> behind;  // per front edge
  for (int i = 0; i < n; ++i)
    behind.push_back(grid(i, 0));
  for (int j = 0; j < m; ++j)
    behind.push_back(grid(n - 1, j));
  for (int i = n - 1; i >= 0; --i)
    behind.push_back(grid(i, m - 1));
  for (int j = m - 1; j >= 0; --j)
    behind.push_back(grid(0, j));
  for (std::size_t e = 0; e < front.size(); ++e) {
    const std::size_t next = (e + 1) % front.size();
    mesh.corners.push_back({front[e], front[next], behind[e]});
    if (behind[e] != behind[next]) mesh.corners.push_back({behind[e], front[next], behind[next]});
  }
  fill_grid(mesh, inner, n, m);
  return mesh;
}

std::vector<Edge> boundary_edges(const TriMesh& mesh) {
  std::vector<Edge> boundary;
  for (const auto& [edge, count] : edge_uses(mesh.corners, mesh.node_count()))
    if (count == 1) boundary.push_back(edge);
  return boundary;
}

}  // namespace conchoid

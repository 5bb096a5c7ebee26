#include "conchoid/remesh/wall_resolution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>
#include <vector>

#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/mesh/wall_thickness.hpp"

namespace conchoid {
namespace {

constexpr double locking = 0.08, unpaired_locking = 0.006;  // of (h/t)², (h/t)⁴
constexpr double quadratic_locking = 6e-7;                  // of (h/t)⁵
constexpr double opposite = 0.2;                            // × h: nodes so near lie opposite each other
constexpr std::size_t most_samples = 50000;                 // triangles of a fine mesh that are measured
constexpr double edges_per_size = 10;   // of stout parts, beside the cube root of the volume
constexpr double telling_share = 0.05;  // of the surface
constexpr double triangles_margin =
    1.1;  // for sizes that grow from thin to stout, and for triangles that are not equilateral

/// h/t that shows least_shown.
double largest_edge_share() {
  return std::sqrt((1 / least_shown - 1) / locking);
}

/// Mean square edges of the triangles around each triangle: single ones scatter.
IdVector<TriId, double> smoothed_edges(const TriMesh& mesh) {
  IdVector<NodeId, double> squares(mesh.node_count(), 0.0), areas(mesh.node_count(), 0.0);
  for (TriId t(0); t.index() < mesh.triangle_count(); ++t.value) {
    const double h = mean_square_edge(mesh.triangle(t)), area = area_vector(mesh, t).norm();
    for (NodeId n : mesh.corners[t]) {
      squares[n] += area * h * h;
      areas[n] += area;
    }
  }
  IdVector<TriId, double> out(mesh.triangle_count(), 0.0);
  for (TriId t(0); t.index() < out.size(); ++t.value) {
    double square = 0, area = 0;
    for (NodeId n : mesh.corners[t]) {
      square += squares[n];
      area += areas[n];
    }
    out[t] = area > 0 ? std::sqrt(square / area) : 0;
  }
  return out;
}

struct Part {
  double key;  // sorted by it, largest first
  TriId triangle;
  double area;
};

double equilateral_triangles(double area, double edge) {
  return area * 4 / (std::numbers::sqrt3 * edge * edge);
}

/// Walls beneath the triangles of a mesh, or as many of them, evenly taken, as are enough.
struct WallSamples {
  WallSamples(const TriMesh& mesh, double reach) {
    const std::size_t stride = 1 + mesh.triangle_count() / most_samples;
    IdVector<TriId, double> reaches(mesh.triangle_count(), 0.0);
    for (std::size_t t = 0; t < reaches.size(); t += stride) {
      triangles.emplace_back(t);
      reaches[TriId(t)] = reach;
    }
    thickness = WallProbe(mesh).thickness(reaches);
  }
  std::vector<TriId> triangles;
  IdVector<TriId, double> thickness;
};

/// Whether most of the corners of some triangles have a node opposite.
bool are_paired(const TriMesh& mesh, const std::vector<Part>& triangles,
                const IdVector<TriId, double>& thickness, const IdVector<TriId, double>& edges) {
  const ClosestPointTree tree(mesh);
  std::size_t paired = 0;
  for (const Part& part : triangles) {
    const Vec3 across = -thickness[part.triangle] * unit_normal(mesh, part.triangle);
    for (const Vec3& corner : mesh.triangle(part.triangle)) {
      const Vec3 x = corner + across;
      const Triangle hit = mesh.triangle(tree.closest(x).triangle);
      paired += std::any_of(hit.begin(), hit.end(), [&](const Vec3& node) {
        return (node - x).norm() < opposite * edges[part.triangle];
      });
    }
  }
  return 2 * paired > 3 * triangles.size();
}

/// The triangle at which the sorted areas come to `area`; the last one if they are less.
TriId triangle_at(std::vector<Part> parts, double area) {
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.key > b.key; });
  for (const Part& part : parts)
    if ((area -= part.area) <= 0) return part.triangle;
  return parts.back().triangle;
}

long percent(double x) {
  return std::lround(100 * x);
}

/// Upward, to two digits.
std::size_t rounded_up(double count) {
  const double unit = std::pow(10, std::max(0.0, std::floor(std::log10(count)) - 1));
  return static_cast<std::size_t>(std::ceil(count / unit) * unit);
}

}  // namespace

double shown_bending(double edge_over_thickness, bool paired) {
  const double square = edge_over_thickness * edge_over_thickness;
  return 1 / (1 + square * (locking + (paired ? 0 : unpaired_locking) * square));
}

double shown_bending_by_quadratic(double edge_over_thickness) {
  return 1 / (1 + quadratic_locking * std::pow(edge_over_thickness, 5));
}

std::optional<std::size_t> CoarseWalls::advised_triangles() const {
  if (quadratic_by_themselves() && shown_by_quadratic() >= least_shown) return std::nullopt;
  return std::min(quadratic_triangles, most_quadratic_elements);
}

std::string CoarseWalls::text() const {
  std::ostringstream out;
  out.precision(2);
  out << here() << " show about " << percent(shown)
      << " % of the bending stress as linear ones, and cracks in it open less than they should; ";
  if (quadratic_by_themselves())
    out << "run.elements = \"auto\", quadratic ones, would show " << percent(shown_by_quadratic()) << " %";
  else
    out << quadratic_remedy();
  if (affordable())
    out << "; linear ones show " << percent(least_shown) << " % with body.remesh = " << wanted_triangles
        << ", or with edges of at most " << wanted_edge << " m there";
  return out.str();
}

std::string CoarseWalls::text_of_auto() const {
  if (!quadratic_by_themselves()) return text();
  std::ostringstream out;
  out.precision(2);
  out << here() << ": a run takes quadratic ones by itself (run.elements), which show "
      << (shown_by_quadratic() >= least_shown ? "about " : "as little as ") << percent(shown_by_quadratic())
      << " % of the bending stress; linear ones would show " << percent(shown) << " %";
  if (shown_by_quadratic() < least_shown) out << "; " << quadratic_remedy();
  return out.str();
}

std::string CoarseWalls::here() const {
  std::ostringstream out;
  out.precision(2);
  out << "elements of " << edge << " m on a wall of " << thickness << " m (" << percent(share)
      << " % of the surface)";
  return out.str();
}

std::string CoarseWalls::quadratic_remedy() const {
  std::ostringstream out;
  out.precision(2);
  if (quadratic_triangles <= most_quadratic_elements) {
    out << "with body.remesh = " << quadratic_triangles
        << " a run takes quadratic ones by itself, which show " << percent(least_shown) << " % or more";
    return out.str();
  }
  out << "for " << percent(least_shown) << " % it takes edges of at most " << quadratic_edge
      << " m, all over about " << quadratic_triangles << " triangles with run.elements = \"quadratic\" and "
      << std::lround(quadratic_bytes(static_cast<double>(quadratic_triangles)) / 1e9)
      << " GB of memory. Or ask for short edges only where it breaks: body.remesh = "
      << most_quadratic_elements << " and a [[region]] with edge = " << quadratic_edge;
  return out.str();
}

std::optional<CoarseWalls> coarse_walls(const TriMesh& elements) {
  const IdVector<TriId, double> edges = smoothed_edges(elements);
  const IdVector<TriId, double> thickness = WallProbe(elements).thickness(edges);
  const double stout_edge = std::cbrt(enclosed_volume(elements)) / edges_per_size;
  std::vector<Part> coarse, thin;
  double all = 0, part = 0, triangles = 0, quadratic = 0;
  for (TriId t(0); t.index() < edges.size(); ++t.value) {
    const double area = area_vector(elements, t).norm();
    const double edge = std::min(edges[t], wall_edge_share * thickness[t]);
    all += area;
    triangles += equilateral_triangles(area, edge);
    const bool stout = edges[t] <= largest_edge_share() * thickness[t];
    quadratic += equilateral_triangles(
        area, stout ? std::max(edges[t], stout_edge) : quadratic_wall_edge_share * thickness[t]);
    if (stout) continue;
    part += area;
    coarse.push_back({edges[t] / thickness[t], t, area});
    thin.push_back({1 / thickness[t], t, area});
  }
  if (coarse.empty() || part < telling_share * all) return std::nullopt;
  const bool paired = are_paired(elements, coarse, thickness, edges);
  const TriId typical = triangle_at(std::move(coarse), part / 2);
  const TriId thinnest = triangle_at(std::move(thin), std::min(part / 2, telling_share * all));
  return CoarseWalls{.share = part / all,
                     .edge = edges[typical],
                     .thickness = thickness[typical],
                     .paired = paired,
                     .shown = shown_bending(edges[typical] / thickness[typical], paired),
                     .wanted_edge = wall_edge_share * thickness[thinnest],
                     .wanted_triangles = rounded_up(triangles_margin * triangles),
                     .triangles = elements.triangle_count(),
                     .quadratic_edge = quadratic_wall_edge_share * thickness[thinnest],
                     .quadratic_triangles = rounded_up(std::max(
                         triangles_margin * quadratic, static_cast<double>(least_quadratic_elements)))};
}

std::optional<double> thinnest_wall(const TriMesh& body, double reach) {
  const WallSamples walls(body, reach);
  std::vector<Part> thin;
  double all = 0, part = 0;
  for (const TriId t : walls.triangles) {
    const double area = area_vector(body, t).norm();
    all += area;
    if (walls.thickness[t] > reach) continue;
    part += area;
    thin.push_back({1 / walls.thickness[t], t, area});
  }
  if (thin.empty() || part < telling_share * all) return std::nullopt;
  return walls.thickness[triangle_at(std::move(thin), telling_share * all)];
}

double triangles_with_edges(const TriMesh& body, double edge) {
  const WallSamples walls(body, edge / wall_edge_share);
  double measured = 0, count = 0;
  for (const TriId t : walls.triangles) {
    const double area = area_vector(body, t).norm();
    measured += area;
    count += equilateral_triangles(area, std::min(edge, wall_edge_share * walls.thickness[t]));
  }
  return measured > 0 ? count * surface_area(body) / measured : 0;
}

}  // namespace conchoid

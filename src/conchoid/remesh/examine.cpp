#include "conchoid/remesh/examine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "conchoid/intersect/self_intersection.hpp"
#include "conchoid/remesh/editable_mesh.hpp"
#include "conchoid/remesh/fill_holes.hpp"
#include "conchoid/remesh/tidy.hpp"

namespace conchoid {
namespace {

/// Four digits, for messages.
std::string rounded(double value) {
  std::ostringstream text;
  text.precision(4);
  text << value;
  return text.str();
}

bool uses_a_node_twice(const std::array<NodeId, 3>& c) {
  return c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
}

void measure(const TriMesh& mesh, SurfaceReport& report) {
  report.box = bounding_box(mesh);
  report.area = surface_area(mesh);
  report.shortest_edge = std::numeric_limits<double>::infinity();
  report.smallest_angle = report.shortest_edge;
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Triangle x = mesh.triangle(TriId(t));
    for (std::size_t k = 0; k < 3; ++k) {
      const double length = (x[(k + 1) % 3] - x[k]).norm();
      report.shortest_edge = std::min(report.shortest_edge, length);
      report.longest_edge = std::max(report.longest_edge, length);
      sum += length;
    }
    report.smallest_angle = std::min(report.smallest_angle, smallest_angle(x));
  }
  report.mean_edge = sum / (3.0 * static_cast<double>(mesh.triangle_count()));
}

/// Loops of edges with one triangle. Neighbours are oriented alike first: where they are not, an edge is left
/// over that is no hole.
std::vector<Hole> find_holes(TriMesh mesh) {
  orient_neighbours_alike(mesh);
  std::vector<Hole> holes;
  std::map<Edge, int> triangles_at;
  for (const auto& c : mesh.corners)
    for (std::size_t k = 0; k < 3; ++k)
      if (c[k] != c[(k + 1) % 3]) ++triangles_at[Edge(c[k], c[(k + 1) % 3])];
  for (const BoundaryLoop& loop : boundary_loops(mesh)) {
    Hole hole;
    bool open = false;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const NodeId p = loop[i], q = loop[(i + 1) % loop.size()];
      open = open || triangles_at[Edge(p, q)] == 1;
      hole.length += (mesh.positions[q] - mesh.positions[p]).norm();
      hole.center += mesh.positions[p] / static_cast<double>(loop.size());
    }
    hole.edges = loop.size();
    hole.first_node = loop.front();
    if (open) holes.push_back(hole);
  }
  return holes;
}

/// Triangles that use a node twice are points or segments of their neighbours and are left out.
void find_intersections(const TriMesh& mesh, SurfaceReport& report) {
  TriMesh proper;
  proper.positions = mesh.positions;
  std::vector<TriId> ids;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (!uses_a_node_twice(mesh.corners[TriId(t)])) {
      proper.corners.push_back(mesh.corners[TriId(t)]);
      ids.push_back(TriId(t));
    }
  for (const auto& [s, t] : self_intersections(proper, most_counted + 1)) {
    if (report.intersections.size() == most_counted) {
      report.more_intersections = true;
      break;
    }
    Intersection found{ids[s.index()], ids[t.index()]};
    for (TriId triangle : {found.s, found.t})
      found.where += centroid(mesh, triangle) / 2;
    report.intersections.push_back(found);
  }
}

/// What find_defects does not look for while something else is wrong.
void list_the_others(SurfaceReport& report) {
  const auto add = [&](DefectKind kind, const std::string& what, const std::string& remedy,
                       std::vector<TriId> at) {
    ++report.defect_counts[kind];
    report.defects.push_back({kind, what, remedy, std::move(at), {}});
  };
  if (!report.defect_counts.contains(DefectKind::self_intersection))
    for (const Intersection& at : report.intersections)
      add(DefectKind::self_intersection,
          "triangles " + std::to_string(at.s.value) + " and " + std::to_string(at.t.value) + " intersect",
          "repair the self-intersections, or remesh", {at.s, at.t});
  if (!report.defect_counts.contains(DefectKind::inside_out))
    for (const SurfacePart& part : report.parts)
      if (part.closed && part.inside_out())
        add(DefectKind::inside_out,
            "the component of triangle " + std::to_string(part.triangles.front().value) +
                (part.cavity() ? " is a cavity but is oriented outward" : " is oriented inward"),
            "flip its triangles", {part.triangles.front()});
}

std::optional<ResolutionAdvice> advise(const TriMesh& mesh, const SurfaceReport& report) {
  if (!(report.volume > 0)) return std::nullopt;
  ResolutionAdvice advice;
  const double edge = std::cbrt(report.volume) / 10;
  advice.crack = edge;
  double wanted = report.area / (std::sqrt(3.0) / 4 * edge * edge);
  if (report.usable()) {
    if (const auto wall = thinnest_wall(mesh, 2 * edge)) advice.crack = std::min(edge, *wall / 2);
    wanted = triangles_with_edges(mesh, edge);
  }
  advice.surface = std::clamp(report.mean_edge, advice.crack / 40, advice.crack / 5);
  if (report.coarse_walls)
    advice.remesh = report.coarse_walls->advised_triangles();
  else if (static_cast<double>(report.triangles) > 1.5 * wanted)
    advice.remesh = static_cast<std::size_t>(std::clamp(100 * std::round(wanted / 100), 100.0, 10000.0));
  return advice;
}

}  // namespace

UnitGuess guess_unit(double extent) {
  const std::string longest = "longest extent " + rounded(extent) + ": ";
  if (!(extent > 0)) return {"unknown", 1, "it has no extent"};
  if (extent < 0.01)
    return {"m", 1,
            longest + "less than a centimetre if these are metres; set body.scale unless it is that small"};
  if (extent <= 20) return {"m", 1, longest + "an object one can handle, if these are metres"};
  if (extent <= 500)
    return {"mm or cm", 0.001,
            longest + "large for metres; " + rounded(extent / 1000) + " m if these are mm, " +
                rounded(extent / 100) + " m if cm"};
  if (extent <= 5000)
    return {"mm", 0.001, longest + "too large for metres; " + rounded(extent / 1000) + " m if these are mm"};
  return {"µm or mm", 1e-6,
          longest + "too large for metres; " + rounded(extent / 1e6) + " m if these are µm, " +
              rounded(extent / 1000) + " m if mm"};
}

SurfaceReport examine(const TriMesh& mesh) {
  SurfaceReport report;
  report.triangles = mesh.triangle_count();
  report.nodes = mesh.node_count();
  report.defects = find_defects(mesh, most_counted);
  for (const MeshDefect& defect : report.defects)
    ++report.defect_counts[defect.kind];
  if (mesh.corners.empty() || report.defect_counts.contains(DefectKind::index_out_of_range) ||
      report.defect_counts.contains(DefectKind::not_finite))
    return report;
  measure(mesh, report);
  report.unit = guess_unit((report.box.high - report.box.low).maxCoeff());
  report.parts = surface_parts(mesh);
  for (const SurfacePart& part : report.parts)
    if (!part.cavity()) ++report.bodies;
  if (!report.usable()) {
    report.holes = find_holes(mesh);
    find_intersections(mesh, report);
    list_the_others(report);
  }
  TidyReport changes;
  const TriMesh tidy = report.usable() ? mesh : tidied(mesh, changes);
  report.volume = enclosed_volume(report.usable() ? mesh : holes_filled(tidy, boundary_loops(tidy)));
  if (report.usable()) report.coarse_walls = coarse_walls(mesh);
  report.advice = advise(mesh, report);
  return report;
}

std::string name_of(DefectKind kind) {
  switch (kind) {
    case DefectKind::index_out_of_range:
      return "corners without a node";
    case DefectKind::not_finite:
      return "nodes that are not finite";
    case DefectKind::repeated_node:
      return "triangles that use a node twice";
    case DefectKind::degenerate:
      return "triangles without area";
    case DefectKind::duplicate:
      return "duplicate triangles";
    case DefectKind::open_edge:
      return "open edges";
    case DefectKind::crowded_edge:
      return "edges with more than two triangles";
    case DefectKind::inconsistent_edge:
      return "edges between differently oriented triangles";
    case DefectKind::pinched_node:
      return "nodes where parts only touch";
    case DefectKind::unused_node:
      return "unused nodes";
    case DefectKind::inside_out:
      return "inside-out parts";
    case DefectKind::no_volume:
      return "parts without volume";
    case DefectKind::self_intersection:
      return "self-intersections";
    case DefectKind::empty:
      return "no triangles";
  }
  return "defects";
}

}  // namespace conchoid

#include "conchoid/remesh/local_edges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "conchoid/core/error.hpp"
#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/mesh/wall_thickness.hpp"
#include "conchoid/remesh/editable_mesh.hpp"
#include "conchoid/remesh/wall_resolution.hpp"

namespace conchoid {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double least_share = 0.05;       // of the surface: as coarse_walls() says
constexpr double longest_for_walls = 2;    // × the mean edge: of what is stout
constexpr double longest_for_limits = 20;  // × the mean edge: of what has no limit
constexpr double aimed =
    0.85;  // × triangles: edges come out a little longer than asked for, and grow by steps
constexpr int halvings = 40;
constexpr double most_places = 4e6;  // of a surface that are asked whether a limit holds

/// Where on a surface a limit holds, at points half its edge apart.
class LimitedPlaces {
 public:
  LimitedPlaces(const TriMesh& mesh, const EdgeLimit& limit)
      : edge_(limit.edge), places_(points_of(mesh, limit)), tree_(places_) {}

  /// Whether an edge is too long for what is near it.
  bool forbids(const Vec3& middle, double length) const {
    return length > edge_ && !places_.corners.empty() &&
           tree_.closest(middle).squared_distance < length * length;
  }

 private:
  static TriMesh points_of(const TriMesh& mesh, const EdgeLimit& limit) {
    const double apart = std::max(limit.edge / 2, std::sqrt(surface_area(mesh) / most_places));
    TriMesh points;
    for (TriId t(0); t.index() < mesh.triangle_count(); ++t.value) {
      const Triangle x = mesh.triangle(t);
      const double longest = std::max({(x[0] - x[1]).norm(), (x[1] - x[2]).norm(), (x[2] - x[0]).norm()});
      const int n = std::max(1, static_cast<int>(std::ceil(longest / apart)));
      for (int i = 0; i <= n; ++i)
        for (int j = 0; i + j <= n; ++j) {
          const Vec3 at = x[0] + (x[1] - x[0]) * i / n + (x[2] - x[0]) * j / n;
          if (!limit.holds(at)) continue;
          const NodeId place = points.positions.add(at);
          points.corners.push_back({place, place, place});
        }
    }
    return points;
  }

  double edge_;
  TriMesh places_;
  ClosestPointTree tree_;
};

/// The same surface with edges of at most `longest`, and of at most what limits ask for where they hold: nodes enough to
/// hold a field.
TriMesh divided(const TriMesh& mesh, double longest, const std::vector<EdgeLimit>& limits) {
  std::vector<LimitedPlaces> limited;
  for (const EdgeLimit& limit : limits)
    limited.emplace_back(mesh, limit);
  EditableMesh fine(mesh, longest);
  for (bool changed = true; changed;) {
    changed = false;
    for (const Edge& e : fine.edges()) {
      const double length = fine.length(e);
      const Vec3 middle = 0.5 * (fine.position(e.a) + fine.position(e.b));
      if (length > longest || std::any_of(limited.begin(), limited.end(),
                                          [&](const LimitedPlaces& l) { return l.forbids(middle, length); }))
        changed = fine.split(e, middle).valid() || changed;
    }
  }
  return fine.compact();
}

/// Edges that walls ask for, at the nodes; +∞ where the ones that come anyway are short enough.
/// @param edges  those [m]
IdVector<NodeId, double> wall_edges(const TriMesh& mesh, const IdVector<NodeId, double>& edges) {
  IdVector<TriId, double> reach(mesh.triangle_count(), 0.0);
  for (TriId t(0); t.index() < reach.size(); ++t.value)
    for (NodeId n : mesh.corners[t])
      reach[t] = std::max(reach[t], edges[n] / wall_edge_share);
  const IdVector<TriId, double> thickness = WallProbe(mesh).thickness(reach);
  IdVector<NodeId, double> density(mesh.node_count(), 0.0), areas(mesh.node_count(), 0.0);
  double thin = 0, all = 0;
  for (TriId t(0); t.index() < reach.size(); ++t.value) {
    const double area = area_vector(mesh, t).norm(), wanted = wall_edge_share * thickness[t];
    all += area;
    if (wanted < edges[mesh.corners[t][0]]) thin += area;
    for (NodeId n : mesh.corners[t]) {
      areas[n] += area;
      density[n] += area / (wanted * wanted);
    }
  }
  IdVector<NodeId, double> out(mesh.node_count(), infinite);
  if (thin < least_share * all) return out;
  for (NodeId n(0); n.index() < out.size(); ++n.value)
    if (density[n] > 0) out[n] = std::sqrt(areas[n] / density[n]);
  return out;
}

IdVector<NodeId, double> limits_at_nodes(const TriMesh& mesh, const std::vector<EdgeLimit>& limits) {
  IdVector<NodeId, double> out(mesh.node_count(), infinite);
  for (NodeId n(0); n.index() < out.size(); ++n.value)
    for (const EdgeLimit& limit : limits)
      if (limit.holds(mesh.positions[n])) out[n] = std::min(out[n], limit.edge);
  return out;
}

/// The x in [low, high] at which a falling count comes down to the target.
template <class Count>
double where_count_is(const Count& count, double target, double low, double high) {
  for (int i = 0; i < halvings; ++i) {
    const double middle = std::sqrt(low * high);
    (count(middle) > target ? low : high) = middle;
  }
  return high;
}

}  // namespace

std::optional<LocalEdges> local_edges(const SizeField& plain, double edge, std::size_t target,
                                      const RemeshSettings& settings) {
  if (!settings.any()) return std::nullopt;
  const double wanted = aimed * static_cast<double>(target);
  const double mean = edge * std::sqrt(plain.triangle_count(edge) / static_cast<double>(target));
  const SizeField field(divided(plain.samples(), edge, settings.limits), edge);
  const TriMesh& mesh = field.samples();
  IdVector<NodeId, double> plain_edges(mesh.node_count());
  for (NodeId n(0); n.index() < plain_edges.size(); ++n.value)
    plain_edges[n] = mean * field.values()[n];
  const IdVector<NodeId, double> limits = limits_at_nodes(mesh, settings.limits);
  const IdVector<NodeId, double> walls = settings.follow_thickness
                                             ? wall_edges(mesh, plain_edges)
                                             : IdVector<NodeId, double>(mesh.node_count(), infinite);
  bool idle = true;
  for (NodeId n(0); n.index() < walls.size() && idle; ++n.value)
    idle = walls[n] == infinite && limits[n] >= plain_edges[n];
  if (idle) return std::nullopt;

  const auto field_of = [&](double longest, double relaxed) {
    IdVector<NodeId, double> sizes(mesh.node_count());
    for (NodeId n(0); n.index() < sizes.size(); ++n.value)
      sizes[n] = std::min({field.values()[n], relaxed * walls[n] / longest, limits[n] / longest});
    return SizeField(field, longest, std::move(sizes));
  };
  const auto count = [&](double longest, double relaxed) {
    return field_of(longest, relaxed).triangle_count(longest);
  };
  double longest = longest_for_walls * mean, relaxed = 1;
  if (count(longest, relaxed) <= wanted) {
    longest = where_count_is([&](double x) { return count(x, 1); }, wanted, mean / 10, longest);
  } else if (count(longest, infinite) <= wanted) {
    relaxed = where_count_is([&](double x) { return count(longest, x); }, wanted, 1, 1e3);
  } else {
    relaxed = infinite;
    if (const double least = count(longest_for_limits * mean, infinite); least > wanted)
      throw InputError("remesh: the edges that regions ask for take about " +
                       std::to_string(std::lround(least / aimed)) + " triangles, more than the " +
                       std::to_string(target) + " asked for; raise body.remesh, or region.edge");
    longest = where_count_is([&](double x) { return count(x, infinite); }, wanted, longest,
                             longest_for_limits * mean);
  }
  return LocalEdges{field_of(longest, relaxed), longest};
}

}  // namespace conchoid

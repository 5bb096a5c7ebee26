#include "conchoid/remesh/remesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "conchoid/core/error.hpp"
#include "conchoid/core/interrupt.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/core/progress.hpp"
#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/remesh/decimate.hpp"
#include "conchoid/remesh/editable_mesh.hpp"
#include "conchoid/remesh/feature_lines.hpp"
#include "conchoid/remesh/size_field.hpp"

namespace conchoid {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double feature_angle = 40 * degree;

/// The lines as triangles without area, so that a ClosestPointTree finds points on them.
TriMesh lines_as_mesh(const TriMesh& mesh, const FeatureLines& features) {
  TriMesh lines;
  lines.positions = mesh.positions;
  for (const Edge& e : features.edges())
    lines.corners.push_back({e.a, e.b, e.b});
  return lines;
}

/// A surface during its remeshing, by the steps of isotropic remeshing. Lengths are relative to what the size
/// field asks for.
class Remesher {
 public:
  Remesher(const TriMesh& original, double edge)
      : edge_(edge),
        mesh_(original, 0.5 * edge),
        features_(original, feature_angle, 4 * edge),
        surface_(original),
        lines_(lines_as_mesh(original, features_)) {}

  /// Decimates to about `samples` triangles, takes the size field from these and chooses the edge length for
  /// `target` of them.
  void prepare(std::size_t samples, std::size_t target, const RemeshSettings& settings) {
    decimate(mesh_, features_, samples);
    size_.emplace(mesh_.compact(), edge_);
    if (auto local = local_edges(*size_, edge_, target, settings)) {
      size_ = std::move(local->field);
      edge_ = local->edge;
    }
    edge_ *= std::sqrt(size_->triangle_count(edge_) / static_cast<double>(target));
  }

  const EditableMesh& mesh() const { return mesh_; }
  double edge() const { return edge_; }
  void set_edge(double edge) { edge_ = edge; }

  void split_long_edges() {
    constexpr int most_passes = 24;  // halves a single edge as often
    bool changed = true;
    for (int pass = 0; pass < most_passes && changed; ++pass) {
      changed = false;
      for (const Edge& e : edges_by_length(4.0 / 3.0, 1e300, true))
        changed = split(e) || changed;
    }
  }

  void collapse_short_edges() {
    for (const Edge& e : edges_by_length(0, 4.0 / 5.0, false))
      if (exists(e) && relative_length(e) < 4.0 / 5.0) collapse(e);
  }

  /// Flips edges where that makes the smallest angle of the two triangles larger, until none does.
  void flip_edges() {
    for (int pass = 0; pass < 4; ++pass) {
      bool changed = false;
      for (const Edge& e : mesh_.edges()) {
        throw_if_interrupted();
        if (mesh_.has_edge(e.a, e.b) && flip_improves(e)) changed = mesh_.flip(e) || changed;
      }
      if (!changed) return;
    }
  }

  void smooth() {
    for (std::size_t i = 0; i < mesh_.node_slots(); ++i) {
      const NodeId n(i);
      if (!mesh_.alive(n) || features_.kind(n) == FeatureLines::Kind::corner) continue;
      const Vec3 here = mesh_.position(n), step = smoothing_step(n);
      if (!mesh_.move(n, projected(n, here + step))) mesh_.move(n, projected(n, here + 0.5 * step));
    }
  }

  /// Works on triangles with an angle below `angle` [rad]: flips, moves of their nodes, and collapses of
  /// their shortest edges.
  void open_small_angles(double angle) {
    for (int pass = 0; pass < 12; ++pass) {
      bool changed = false;
      const std::size_t slots =
          mesh_.triangle_slots();  // the steps add new ones: those are for the next pass
      for (std::size_t t = 0; t < slots; ++t)
        if (mesh_.alive(TriId(t)) && smallest_angle(mesh_.triangle(TriId(t))) < angle)
          changed = improve(TriId(t), pass >= 4) || changed;
      if (!changed) return;
    }
  }

  /// With nodes on the surface, triangles lie inside where it is convex: moves nodes along their normals
  /// until the triangles around each lie on both sides of the surface alike, so that the volume is kept.
  void balance_volume() {
    for (int pass = 0; pass < 4; ++pass)
      for (std::size_t i = 0; i < mesh_.node_slots(); ++i) {
        const NodeId n(i);
        if (!mesh_.alive(n) || features_.kind(n) != FeatureLines::Kind::free) continue;
        Vec3 normal = Vec3::Zero();
        double gap = 0, areas = 0;
        for (TriId t : mesh_.star(n)) {
          const Triangle x = mesh_.triangle(t);
          const Vec3 area = 0.5 * area_vector2(x[0], x[1], x[2]);
          normal += area;
          areas += area.norm();
          for (std::size_t k = 0; k < 3; ++k) {  // edge middles with equal weights: exact for quadratic gaps
            const Vec3 middle = 0.5 * (x[k] + x[(k + 1) % 3]);
            gap += area.dot(surface_.closest(middle).point - middle) / 3;
          }
        }
        mesh_.move(n, mesh_.position(n) + normal.normalized() * (gap / areas));
      }
  }

  /// Brings the number of triangles into [low, high] by the shortest or longest edges.
  void meet_count(std::size_t low, std::size_t high) {
    for (int pass = 0; pass < 20 && mesh_.triangle_count() > high; ++pass)
      for (const Edge& e : edges_by_length(0, 1e300, false)) {
        if (mesh_.triangle_count() <= high) break;
        if (exists(e)) collapse(e);
      }
    for (int pass = 0; pass < 20 && mesh_.triangle_count() < low; ++pass)
      for (const Edge& e : edges_by_length(0, 1e300, true)) {
        if (mesh_.triangle_count() >= low) break;
        split(e);
      }
  }

 private:
  /// The edge length wanted at x.
  double wanted(const Vec3& x) const { return edge_ * (*size_)(x); }
  double relative_length(const Edge& e) const {
    return mesh_.length(e) / wanted(0.5 * (mesh_.position(e.a) + mesh_.position(e.b)));
  }
  bool exists(const Edge& e) const {
    return mesh_.alive(e.a) && mesh_.alive(e.b) && mesh_.has_edge(e.a, e.b);
  }

  /// Edges with relative lengths above `low` and below `high`, sorted by these; ties by ids.
  std::vector<Edge> edges_by_length(double low, double high, bool longest_first) const {
    struct Entry {
      double length;
      Edge edge;
    };
    constexpr std::size_t edges_of_task = 256;
    std::vector<Entry> entries;
    for (const Edge& e : mesh_.edges())
      entries.push_back({0, e});
    parallel_for(entries.size(), edges_of_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        entries[i].length = relative_length(entries[i].edge);
    });
    std::erase_if(entries, [&](const Entry& x) { return !(x.length > low && x.length < high); });
    std::stable_sort(entries.begin(), entries.end(), [&](const Entry& x, const Entry& y) {
      return longest_first ? x.length > y.length : x.length < y.length;
    });
    std::vector<Edge> edges;
    for (const Entry& entry : entries)
      edges.push_back(entry.edge);
    return edges;
  }

  Vec3 projected(NodeId n, const Vec3& x) const {
    switch (features_.kind(n)) {
      case FeatureLines::Kind::free:
        return surface_.closest(x).point;
      case FeatureLines::Kind::crease:
        return lines_.closest(x).point;
      case FeatureLines::Kind::corner:
        break;
    }
    return mesh_.position(n);
  }

  bool split(const Edge& e) {
    const Vec3 middle = 0.5 * (mesh_.position(e.a) + mesh_.position(e.b));
    const bool on_line = features_.contains(e);
    NodeId node = mesh_.split(e, on_line ? lines_.closest(middle).point : surface_.closest(middle).point);
    if (!node.valid()) node = mesh_.split(e, middle);
    if (!node.valid()) return false;
    features_.was_split(e, node);
    return true;
  }

  bool collapse(const Edge& e) {
    const auto merge = features_.merge(e);
    if (!merge) return false;
    const auto [removed, kept, may_move] = *merge;
    std::vector<Vec3> places;
    if (may_move)
      places = {surface_.closest(0.5 * (mesh_.position(removed) + mesh_.position(kept))).point,
                mesh_.position(kept), mesh_.position(removed)};
    else
      places = {mesh_.position(kept)};
    for (const Vec3& at : places) {
      if (stretches(removed, kept, at)) continue;
      if (!mesh_.collapse(removed, kept, at)) continue;
      features_.was_collapsed(removed, kept);
      return true;
    }
    return false;
  }

  /// Whether a collapse would make an edge so long that it would be split again.
  bool stretches(NodeId removed, NodeId kept, const Vec3& at) const {
    const double longest = 1.4 * wanted(at);
    for (NodeId end : {removed, kept})
      for (NodeId n : mesh_.neighbours(end))
        if (n != removed && n != kept && (mesh_.position(n) - at).norm() > longest) return true;
    return false;
  }

  bool flip_improves(const Edge& e) const {
    if (features_.contains(e)) return false;
    const auto [forward, backward] = mesh_.triangles_at(e);
    const NodeId left = mesh_.opposite(forward, e), right = mesh_.opposite(backward, e);
    const Vec3 &a = mesh_.position(e.a), &b = mesh_.position(e.b), &l = mesh_.position(left),
               &r = mesh_.position(right);
    const double before =
        std::min(smallest_angle(mesh_.triangle(forward)), smallest_angle(mesh_.triangle(backward)));
    const double after = std::min(smallest_angle({l, a, r}), smallest_angle({r, b, l}));
    if (after < before + 0.5 * degree) return false;
    // The new edge must not leave the surface much farther than the old one does.
    const double old_distance = std::sqrt(surface_.closest(0.5 * (a + b)).squared_distance);
    const double new_distance = std::sqrt(surface_.closest(0.5 * (l + r)).squared_distance);
    return new_distance <= old_distance + 0.1 * wanted(a);
  }

  /// From a node toward the area-weighted centre of its star, in the tangent plane; on a crease toward the
  /// middle of its line neighbours.
  Vec3 smoothing_step(NodeId n) const {
    const Vec3& here = mesh_.position(n);
    if (features_.kind(n) == FeatureLines::Kind::crease) {
      const auto [before, after] = features_.along(n);
      return 0.5 * (mesh_.position(before) + mesh_.position(after)) - here;
    }
    Vec3 sum = Vec3::Zero(), normal = Vec3::Zero();
    double areas = 0;
    for (TriId t : mesh_.star(n)) {
      const Triangle x = mesh_.triangle(t);
      const Vec3 area = area_vector2(x[0], x[1], x[2]);
      sum += area.norm() * ((x[0] - here) + (x[1] - here) + (x[2] - here)) / 3;
      areas += area.norm();
      normal += area;
    }
    const Vec3 step = sum / areas;
    const double normal2 = normal.squaredNorm();
    return normal2 > 0 ? Vec3(step - normal * (normal.dot(step) / normal2)) : step;
  }

  double worst_angle_around(NodeId n) const {
    double worst = 4;
    for (TriId t : mesh_.star(n))
      worst = std::min(worst, smallest_angle(mesh_.triangle(t)));
    return worst;
  }

  /// Tries steps toward and away from the neighbours and keeps the best.
  bool relocate(NodeId n) {
    if (features_.kind(n) == FeatureLines::Kind::corner) return false;
    const Vec3 start = mesh_.position(n);
    Vec3 best = start;
    double best_angle = worst_angle_around(n);
    bool moved = false;
    std::vector<Vec3> steps = {smoothing_step(n)};
    for (NodeId other : mesh_.neighbours(n))
      for (double share : {0.1, 0.25, -0.1, -0.25})
        steps.push_back(share * (mesh_.position(other) - start));
    for (const Vec3& step : steps) {
      if (!mesh_.move(n, projected(n, start + step))) continue;
      const double angle = worst_angle_around(n);
      if (angle > best_angle + 0.1 * degree) {
        best_angle = angle;
        best = mesh_.position(n);
        moved = true;
      }
    }
    if (mesh_.position(n) != best) mesh_.move(n, best);
    return moved;
  }

  bool improve(TriId t, bool may_collapse) {
    const std::array<NodeId, 3> c = mesh_.corners(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge e(c[k], c[(k + 1) % 3]);
      if (flip_improves(e) && mesh_.flip(e)) return true;
    }
    bool changed = false;
    for (NodeId n : c)
      changed = relocate(n) || changed;
    if (changed || !may_collapse) return changed;
    std::array<Edge, 3> edges = {Edge(c[0], c[1]), Edge(c[1], c[2]), Edge(c[2], c[0])};
    return collapse(*std::min_element(edges.begin(), edges.end(), [&](const Edge& x, const Edge& y) {
      return mesh_.length(x) < mesh_.length(y);
    }));
  }

  double edge_;
  EditableMesh mesh_;
  FeatureLines features_;
  ClosestPointTree surface_, lines_;
  std::optional<SizeField> size_;
};

/// Rounds of the four steps; the edge length follows the count. Edges of the equilateral triangle of the
/// wanted area are a little longer than what comes out, which the feedback evens out.
void remesh_isotropically(Remesher& remesher, std::size_t target) {
  constexpr int most_rounds = 16, settled_rounds = 6;
  Progress progress("rounds of remeshing, at most", most_rounds);
  for (int round = 0; round < most_rounds; ++round) {
    remesher.split_long_edges();
    remesher.collapse_short_edges();
    remesher.flip_edges();
    for (int s = 0; s < 3; ++s)
      remesher.smooth();
    const double ratio = static_cast<double>(remesher.mesh().triangle_count()) / static_cast<double>(target);
    if (round >= settled_rounds && std::abs(ratio - 1) < 0.03) break;
    progress.advance();
    if (round >= 2) remesher.set_edge(remesher.edge() * std::clamp(std::sqrt(ratio), 0.8, 1.25));
  }
  remesher.flip_edges();
}

double one_way_distance(const TriMesh& from, const ClosestPointTree& to) {
  constexpr std::size_t samples_of_task = 512;
  std::vector<Vec3> samples(from.positions.begin(), from.positions.end());
  for (std::size_t t = 0; t < from.triangle_count(); ++t) {
    const Triangle x = from.triangle(TriId(t));
    samples.push_back(centroid(from, TriId(t)));
    for (std::size_t k = 0; k < 3; ++k)
      samples.push_back(0.5 * (x[k] + x[(k + 1) % 3]));
  }
  const auto squared = parallel_values(samples.size(), samples_of_task, [&](std::size_t i) {
    return to.closest(samples[i]).squared_distance;
  });
  return squared.empty() ? 0 : std::sqrt(*std::max_element(squared.begin(), squared.end()));
}

}  // namespace

TriangleCountError::TriangleCountError(int asked, std::size_t allowed)
    : ComputationError("remesh: " + std::to_string(asked) + " triangles cannot be met, the shape allows " +
                       std::to_string(allowed) + "; ask for about as many, or for more"),
      allowed_(allowed) {}

bool remesh_meets(int target_triangles, std::size_t triangles) {
  return std::abs(static_cast<double>(triangles) / target_triangles - 1) <= 0.1;
}

double sampled_hausdorff_distance(const TriMesh& a, const TriMesh& b) {
  return std::max(one_way_distance(a, ClosestPointTree(b)), one_way_distance(b, ClosestPointTree(a)));
}

TriMesh remesh(const TriMesh& detailed, int target_triangles, RemeshReport* report) {
  return remesh(detailed, target_triangles, {}, report);
}

TriMesh remesh_or_more(const TriMesh& detailed, int wanted, int most) {
  constexpr int attempts = 6;
  constexpr double rise = 1.2;  // of what is asked for
  for (int left = attempts;; --left)
    try {
      return remesh(detailed, wanted);
    } catch (const TriangleCountError& error) {
      wanted = std::max(static_cast<int>(error.allowed()), static_cast<int>(rise * wanted));
      if (left == 0 || wanted > most) throw;
    }
}

TriMesh remesh(const TriMesh& detailed, int target_triangles, const RemeshSettings& settings,
               RemeshReport* report) {
  if (target_triangles < 20) throw InputError("remesh: ask for at least 20 triangles");
  const auto target = static_cast<std::size_t>(target_triangles);
  const Vec3 center = bounding_box(detailed).center();
  TriMesh original = detailed;  // about the origin: no digits are lost to a far position
  for (Vec3& x : original.positions)
    x -= center;
  const double edge = std::sqrt(4 / std::numbers::sqrt3 * surface_area(original) / target_triangles);

  RemeshSettings about_origin = settings;
  for (EdgeLimit& limit : about_origin.limits)
    limit.holds = [&center, holds = limit.holds](const Vec3& x) { return holds(x + center); };
  Remesher remesher(original, edge);
  remesher.prepare(4 * target, target, about_origin);
  remesh_isotropically(remesher, target);
  remesher.open_small_angles(25 * degree);
  remesher.meet_count(target - target / 12, target + target / 12);
  remesher.open_small_angles(20 * degree);
  remesher.balance_volume();

  TriMesh result = remesher.mesh().compact();
  if (!remesh_meets(target_triangles, result.triangle_count()))
    throw TriangleCountError(target_triangles, result.triangle_count());
  if (report) {
    report->triangles = static_cast<int>(result.triangle_count());
    report->smallest_angle = 180;
    report->below_15_degrees = 0;
    for (std::size_t t = 0; t < result.triangle_count(); ++t) {
      const double angle = smallest_angle(result.triangle(TriId(t))) / degree;
      report->smallest_angle = std::min(report->smallest_angle, angle);
      report->below_15_degrees += angle < 15;
    }
    report->hausdorff_distance = sampled_hausdorff_distance(original, result);
  }
  for (Vec3& x : result.positions)
    x += center;
  return result;
}

}  // namespace conchoid

#include "conchoid/study/compare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "conchoid/mesh/box.hpp"
#include "conchoid/study/solid_overlap.hpp"
#include "conchoid/study/surface_distance.hpp"

namespace conchoid {
namespace {

constexpr double negligible_share = 0.02;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

bool same_box(const Box& a, const Box& b) {
  const double tolerance = 1e-6 * std::max(a.diagonal(), b.diagonal());
  return (a.low - b.low).norm() <= tolerance && (a.high - b.high).norm() <= tolerance;
}

double scene_diagonal(const RunData& a, const RunData& b) {
  if (a.document.body) return a.document.body->diagonal();
  if (a.crack.positions.empty()) return bounding_box(b.crack).diagonal();
  if (b.crack.positions.empty()) return bounding_box(a.crack).diagonal();
  return united(bounding_box(a.crack), bounding_box(b.crack)).diagonal();
}

std::vector<TriMesh> meshes_of(const std::vector<Fragment>& fragments) {
  std::vector<TriMesh> meshes;
  for (const Fragment& f : fragments)
    meshes.push_back(f.mesh);
  return meshes;
}

double crack_diagonal(const RunData& a, const RunData& b) {
  if (a.crack.triangle_count() == 0 && b.crack.triangle_count() == 0) return kNone;
  return bounding_box(a.crack.triangle_count() > 0 ? a.crack : b.crack).diagonal();
}

std::vector<double> volumes_of(const RunData& run) {
  std::vector<double> volumes;
  for (const FragmentRecord& f : run.document.fragments)
    volumes.push_back(f.volume);
  std::sort(volumes.rbegin(), volumes.rend());
  return volumes;
}

double volume_error(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.empty() || b.empty()) return kNone;
  double error = 0;
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i)
    error += std::abs((i < a.size() ? a[i] : 0) - (i < b.size() ? b[i] : 0));
  return error / std::accumulate(a.begin(), a.end(), 0.0);
}

// Over the frames of which there is something to say.
void average_history(Comparison& c) {
  double distance = 0, kink = 0, frames = 0, kinks = 0;
  for (const FrameComparison& f : c.history) {
    distance += f.front_distance;
    ++frames;
    if (std::isnan(f.kink_angle)) continue;
    kink += f.kink_angle * f.kink_angle;
    ++kinks;
  }
  c.front_distance = frames > 0 ? distance / frames : kNone;
  c.kink_angle_error = kinks > 0 ? std::sqrt(kink / kinks) : kNone;
}

// Sum over the pieces of `from`: volume, and volume × distance from the piece of `to` that overlaps best.
std::array<double, 2> weighted_distances(const std::vector<Fragment>& from, const std::vector<Fragment>& to) {
  constexpr int lines = 32;             // coarse: it only pairs
  constexpr std::size_t points = 4000;  // per piece
  double volume = 0, distance = 0;
  for (const Fragment& piece : from) {
    const Fragment* best = &to.front();
    double most = -1;
    for (const Fragment& other : to) {
      if (!overlap(bounding_box(piece.mesh), bounding_box(other.mesh))) continue;
      const double common = intersection_over_union(piece.mesh, other.mesh, lines);
      if (common > most) {
        most = common;
        best = &other;
      }
    }
    volume += piece.volume;
    distance += piece.volume * symmetric_distance(piece.mesh, best->mesh, points).mean;
  }
  return {volume, distance};
}

nlohmann::ordered_json by_mode(const Vec3& v) {
  return {{"I", v[0]}, {"II", v[1]}, {"III", v[2]}};
}

nlohmann::ordered_json history_json(const std::vector<FrameComparison>& history) {
  auto out = nlohmann::ordered_json::array();
  for (const FrameComparison& f : history)
    out.push_back({{"frame", f.frame},
                   {"crack_area", f.crack_area},
                   {"K", {by_mode(f.intensity[0]), by_mode(f.intensity[1])}},
                   {"front_distance", f.front_distance},
                   {"kink_angle", f.kink_angle}});
  return out;
}

}  // namespace

double fragment_chamfer(const std::vector<Fragment>& a, const std::vector<Fragment>& b) {
  if (a.empty() || b.empty()) return kNone;
  const auto of_a = weighted_distances(a, b), of_b = weighted_distances(b, a);
  return (of_a[1] + of_b[1]) / (of_a[0] + of_b[0]);
}

Vec3 sif_log_error(const std::vector<FrontRow>& a, const std::vector<FrontRow>& b) {
  const auto frames_a = front_averages(a), frames_b = front_averages(b);
  Vec3 sum = Vec3::Zero(), count = Vec3::Zero();
  for (const auto& [number, fa] : frames_a) {
    const auto found = frames_b.find(number);
    if (found == frames_b.end()) continue;
    const FrontAverage& fb = found->second;
    const double floor_a = negligible_share * fa.length, floor_b = negligible_share * fb.length;
    if (!(floor_a > 0 && floor_b > 0)) continue;
    for (int mode = 0; mode < 3; ++mode) {
      if (fa.intensity[mode] < floor_a && fb.intensity[mode] < floor_b) continue;
      sum[mode] +=
          std::abs(std::log(std::max(fa.intensity[mode], floor_a) / std::max(fb.intensity[mode], floor_b)));
      count[mode] += 1;
    }
  }
  Vec3 error = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  for (int mode = 0; mode < 3; ++mode)
    if (count[mode] > 0) error[mode] = sum[mode] / count[mode];
  return error;
}

Comparison compare(const RunData& a, const RunData& b) {
  Comparison c;
  c.bbox_diagonal = scene_diagonal(a, b);
  const bool crack_a = a.crack.triangle_count() > 0, crack_b = b.crack.triangle_count() > 0;
  if (crack_a != crack_b) {
    c.surface_mean = c.surface_p95 = c.bbox_diagonal;
  } else {
    const SurfaceDistance distance = symmetric_distance(a.crack, b.crack);
    c.surface_mean = distance.mean;
    c.surface_p95 = distance.p95;
  }
  c.frames = {a.document.frames, b.document.frames};
  c.sif_log_error = sif_log_error(a.front, b.front);
  const double area_a = surface_area(a.crack), area_b = surface_area(b.crack);
  c.area_ratio = area_a > 0 ? area_b / area_a : std::numeric_limits<double>::quiet_NaN();
  if (!crack_a && !crack_b) c.area_ratio = 1;
  c.largest_fragment_iou = largest_fragment_overlap(meshes_of(a.fragments), meshes_of(b.fragments));
  c.same_body = a.document.body.has_value() == b.document.body.has_value() &&
                (!a.document.body || same_box(*a.document.body, *b.document.body));
  c.crack_diagonal = crack_diagonal(a, b);
  c.stop = {a.document.stop, b.document.stop};
  c.volumes = {volumes_of(a), volumes_of(b)};
  c.volume_error = volume_error(c.volumes[0], c.volumes[1]);
  c.fragment_chamfer = fragment_chamfer(a.fragments, b.fragments);
  c.history = compare_frames(a, b);
  average_history(c);
  return c;
}

Comparison compare_runs(const std::filesystem::path& a, const std::filesystem::path& b) {
  return compare(read_run(a), read_run(b));
}

std::string comparison_json(const Comparison& c) {
  nlohmann::ordered_json out;
  out["surface_mean"] = c.surface_mean;
  out["surface_p95"] = c.surface_p95;
  out["bbox_diagonal"] = c.bbox_diagonal;
  out["frames"] = c.frames;
  out["sif_log_error"] = by_mode(c.sif_log_error);
  out["area_ratio"] = c.area_ratio;
  out["largest_fragment_iou"] = c.largest_fragment_iou;
  out["same_body"] = c.same_body;
  out["crack_diagonal"] = c.crack_diagonal;
  out["stop"] = {name(c.stop[0]), name(c.stop[1])};
  out["front_distance"] = c.front_distance;
  out["kink_angle_error"] = c.kink_angle_error;
  out["volumes"] = c.volumes;
  out["volume_error"] = c.volume_error;
  out["fragment_chamfer"] = c.fragment_chamfer;
  out["history"] = history_json(c.history);
  return out.dump();
}

}  // namespace conchoid

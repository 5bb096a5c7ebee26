#include "conchoid/study/compare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "conchoid/study/solid_overlap.hpp"
#include "conchoid/study/surface_distance.hpp"

namespace conchoid {
namespace {

constexpr double negligible_share = 0.02;

/// Front averages of one frame.
struct FrameIntensity {
  Vec3 mean = Vec3::Zero();  ///< of |K| per mode
  double length = 0;         ///< mean of √(K_I² + K_II² + K_III²)
  std::size_t nodes = 0;
};

std::map<int, FrameIntensity> front_averages(const std::vector<FrontRow>& rows) {
  std::map<int, FrameIntensity> frames;
  for (const FrontRow& row : rows) {
    FrameIntensity& f = frames[row.frame];
    f.mean += row.intensity.cwiseAbs();
    f.length += row.intensity.norm();
    ++f.nodes;
  }
  for (auto& [number, f] : frames) {
    f.mean /= static_cast<double>(f.nodes);
    f.length /= static_cast<double>(f.nodes);
  }
  return frames;
}

Box joined(const Box& a, const Box& b) {
  return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)};
}

bool same_box(const Box& a, const Box& b) {
  const double tolerance = 1e-6 * std::max(a.diagonal(), b.diagonal());
  return (a.low - b.low).norm() <= tolerance && (a.high - b.high).norm() <= tolerance;
}

double scene_diagonal(const RunData& a, const RunData& b) {
  if (a.document.body) return a.document.body->diagonal();
  if (a.crack.positions.empty()) return bounding_box(b.crack).diagonal();
  if (b.crack.positions.empty()) return bounding_box(a.crack).diagonal();
  return joined(bounding_box(a.crack), bounding_box(b.crack)).diagonal();
}

std::vector<TriMesh> meshes_of(const std::vector<Fragment>& fragments) {
  std::vector<TriMesh> meshes;
  for (const Fragment& f : fragments)
    meshes.push_back(f.mesh);
  return meshes;
}

}  // namespace

Vec3 sif_log_error(const std::vector<FrontRow>& a, const std::vector<FrontRow>& b) {
  const auto frames_a = front_averages(a), frames_b = front_averages(b);
  Vec3 sum = Vec3::Zero(), count = Vec3::Zero();
  for (const auto& [number, fa] : frames_a) {
    const auto found = frames_b.find(number);
    if (found == frames_b.end()) continue;
    const FrameIntensity& fb = found->second;
    const double floor_a = negligible_share * fa.length, floor_b = negligible_share * fb.length;
    if (!(floor_a > 0 && floor_b > 0)) continue;
    for (int mode = 0; mode < 3; ++mode) {
      if (fa.mean[mode] < floor_a && fb.mean[mode] < floor_b) continue;
      sum[mode] += std::abs(std::log(std::max(fa.mean[mode], floor_a) / std::max(fb.mean[mode], floor_b)));
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
  out["sif_log_error"] = {{"I", c.sif_log_error[0]}, {"II", c.sif_log_error[1]}, {"III", c.sif_log_error[2]}};
  out["area_ratio"] = c.area_ratio;
  out["largest_fragment_iou"] = c.largest_fragment_iou;
  out["same_body"] = c.same_body;
  return out.dump();
}

}  // namespace conchoid

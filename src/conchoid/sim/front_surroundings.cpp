#include "conchoid/sim/front_surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/mesh/ray_exit.hpp"
#include "conchoid/sim/crack_sizes.hpp"
#include "conchoid/sim/front_gaps.hpp"
#include "conchoid/sim/net_section.hpp"

namespace conchoid {
namespace {

Mat3 axes_of(const FrontFrame& frame) {
  Mat3 axes;
  axes << frame.e1, frame.e2, frame.e3;
  return axes;
}

// σ·e1, and σ22, σ33, σ23.
Vec3 traction(const Mat3& stress) {
  return stress.col(0);
}
Vec3 lateral(const Mat3& stress) {
  return {stress(1, 1), stress(2, 2), stress(1, 2)};
}

// Of the circle that touches the front's normal plane at x and passes through its neighbours: 1/R, in the mean.
double curvature(const FrontFrame& frame, const Vec3& x, const Vec3& before, const Vec3& after) {
  double sum = 0;
  int count = 0;
  for (const Vec3& y : {before, after}) {
    const Vec3 d = y - x;
    if (d.isZero(0)) continue;
    sum -= 2 * d.dot(frame.e2) / d.squaredNorm();
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

// Along ±e1, the diagonals ahead and behind, ±e3: pairs that reversing the normal or mirroring exchange.
template <class Exit>
std::array<double, kSides> distances_beside(const FrontFrame& f, const Exit& exit) {
  const Vec3 up = f.e1 / std::numbers::sqrt2, on = f.e2 / std::numbers::sqrt2;
  return {exit(f.e1),    exit(-f.e1),    exit(on + up), exit(on - up),
          exit(up - on), exit(-up - on), exit(f.e3),    exit(-f.e3)};
}

}  // namespace

FrontSurroundings::FrontSurroundings(const PreparedBody& body)
    : body_(body), walls_(body.surface), uncracked_(body) {}

void FrontSurroundings::measure(const CrackState& crack, const LoadCase& load, std::size_t version) {
  const std::vector<Mat3> stress = stress_at_points(crack, load, version);
  points_.assign(crack.points.size(), {});
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Point& p = points_[i];
    p.frame = crack.points[i].frame;
    const Mat3 axes = axes_of(p.frame);
    p.stress = axes.transpose() * stress[i] * axes;
    const Vec3& x = crack.sheet.mesh.positions[crack.points[i].node];
    p.ahead = exit_distance(body_.surface, walls_, x, p.frame.e2);
    p.beside = distances_beside(
        p.frame, [&](const Vec3& along) { return exit_distance(body_.surface, walls_, x, along); });
    p.wall = std::sqrt(uncracked_.surface().closest(x).squared_distance);
    p.seen = crack.sheet.frame;
  }
  measure_front(crack);
  measure_crack(crack);
}

// At nodes that are new in the sheet; the others keep theirs.
std::vector<Mat3> FrontSurroundings::stress_at_points(const CrackState& crack, const LoadCase& load,
                                                      std::size_t version) {
  if (version_ != version) stress_.clear();
  version_ = version;
  std::vector<NodeId> nodes;
  std::vector<Vec3> at;
  for (std::size_t n = 0; n < crack.node_in_cut.size(); ++n)
    if (crack.node_in_cut[NodeId(n)].valid() && !stress_.contains(NodeId(n))) {
      nodes.emplace_back(n);
      at.push_back(crack.sheet.mesh.positions[NodeId(n)]);
    }
  const std::vector<Mat3> found = uncracked_.at_points(std::move(at), load, version);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    stress_[nodes[k]] = found[k];
  std::vector<Mat3> out;
  for (const FrontPoint& point : crack.points)
    out.push_back(stress_.at(point.node));
  return out;
}

void FrontSurroundings::measure_front(const CrackState& crack) {
  for (const PointChain& chain : point_chains(crack)) {
    const std::size_t n = chain.points.size();
    const auto position = [&](std::size_t k) -> const Vec3& {
      return crack.sheet.mesh.positions[crack.points[chain.points[k]].node];
    };
    for (std::size_t k = 0; k < n; ++k) {
      Point& p = points_[chain.points[k]];
      p.curvature = curvature(p.frame, position(k), position(previous_index(k, n, chain.closed)),
                              position(next_index(k, n, chain.closed)));
    }
  }
}

// The ligament is what the edges of the fronts sweep straight ahead.
void FrontSurroundings::measure_crack(const CrackState& crack) {
  const std::vector<CrackSize> sizes = crack_sizes(crack);
  std::vector<double> width(points_.size(), 0.0);
  for (const PointChain& chain : point_chains(crack))
    for (std::size_t k = 0; k < edge_count(chain.points.size(), chain.closed); ++k) {
      const std::size_t i = chain.points[k],
                        j = chain.points[next_index(k, chain.points.size(), chain.closed)];
      const double length = (crack.sheet.mesh.positions[crack.points[i].node] -
                             crack.sheet.mesh.positions[crack.points[j].node])
                                .norm();
      width[i] += length / 2;
      width[j] += length / 2;
    }
  std::vector<double> of_crack;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (sizes[i].crack < 0) continue;
    of_crack.resize(std::max(of_crack.size(), static_cast<std::size_t>(sizes[i].crack) + 1), 0.0);
    of_crack[static_cast<std::size_t>(sizes[i].crack)] += width[i] * points_[i].ahead;
  }
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (sizes[i].crack < 0 || !(sizes[i].area > 0)) continue;
    points_[i].crack_radius = std::sqrt(sizes[i].area / std::numbers::pi);
    const double left = of_crack[static_cast<std::size_t>(sizes[i].crack)];
    points_[i].ligament_share = std::isfinite(left) ? left / (left + sizes[i].area) : 1;
  }
  measure_sections(crack, sizes);
}

void FrontSurroundings::measure_sections(const CrackState& crack, const std::vector<CrackSize>& sizes) {
  std::vector<double> ahead;
  for (const Point& p : points_)
    ahead.push_back(p.ahead);
  const std::vector<NetSection> sections = net_sections(crack, stress_, ahead);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (sizes[i].crack < 0) continue;
    Point& p = points_[i];
    const NetSection& section = sections[static_cast<std::size_t>(sizes[i].crack)];
    const Vec3& x = crack.sheet.mesh.positions[crack.points[i].node];
    const Mat3 to_frame = axes_of(p.frame).transpose();
    p.taken = to_frame * section.taken_over(x);
    p.force = to_frame * section.force;
    p.moment = to_frame * section.moment_about(x);
    p.arms = arm_intensity(p.moment[2], section.front, p.beside[0], p.beside[1]);
  }
}

bool FrontSurroundings::complete(const CrackState& crack, std::size_t i, NodeId node, Sample& s) const {
  const auto found = before_.find(node);
  if (found == before_.end()) return false;
  const Point &old = found->second, &now = points_[i];
  s.front_curvature = old.curvature;
  s.surface_distance = old.ahead;
  s.wall_distance = old.wall;
  s.traction = traction(old.stress);
  s.lateral = lateral(old.stress);
  s.driving = old.driving;
  s.driving_nearby = old.nearby;
  s.driving_slope = old.slope;
  s.driving_front = old.front;
  s.crack_radius = now.crack_radius;
  s.ligament_share = now.ligament_share;
  s.front_curvature_after = now.curvature;
  s.surface_distance_after = now.ahead;
  s.wall_distance_after = now.wall;
  s.traction_after = traction(now.stress);
  s.lateral_after = lateral(now.stress);
  s.taken_over = old.taken;
  s.taken_over_after = now.taken;
  s.crack_force = now.force;
  s.crack_moment = now.moment;
  s.arms = old.arms;
  s.arms_after = now.arms;
  s.beside = now.beside;
  s.turn = {now.frame.e2.dot(old.frame.e1), now.frame.e3.dot(old.frame.e1), now.frame.e2.dot(old.frame.e3)};
  return old.seen == crack.sheet.frame - 1;
}

void FrontSurroundings::remember(const CrackState& crack, const std::vector<FrontOpening>& openings) {
  for (const PointChain& chain : point_chains(crack)) {
    const std::size_t n = chain.points.size();
    const auto K = [&](std::size_t k) -> const Vec3& { return openings[chain.points[k]].intensity; };
    Vec3 mean = Vec3::Zero();
    for (std::size_t k = 0; k < n; ++k)
      mean += K(k) / static_cast<double>(n);
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = chain.points[k], a = previous_index(k, n, chain.closed),
                        b = next_index(k, n, chain.closed);
      Point& p = points_[i];
      p.driving = K(k);
      p.nearby = (K(a) + K(k) + K(b)) / 3;
      const double length = (crack.sheet.mesh.positions[crack.points[chain.points[b]].node] -
                             crack.sheet.mesh.positions[crack.points[chain.points[a]].node])
                                .norm();
      p.slope = length > 0 ? Vec3((K(b) - K(a)) / length) : Vec3::Zero();
      p.front = mean;
    }
  }
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (openings[i].known) before_[crack.points[i].node] = points_[i];
}

}  // namespace conchoid

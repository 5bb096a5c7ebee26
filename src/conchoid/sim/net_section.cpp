#include "conchoid/sim/net_section.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "conchoid/sim/front_gaps.hpp"

namespace conchoid {
namespace {

// × trace: a ligament that is all but a line does not turn without end.
constexpr double kLeastInertia = 1e-3;

// ∫ dA, ∫ y dA, ∫ y yᵀ dA.
struct Moments {
  double area = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();

  void add(const Triangle& t) {
    const double a = 0.5 * cross(t[1] - t[0], t[2] - t[0]).norm();
    const Vec3 sum = t[0] + t[1] + t[2];
    area += a;
    first += a / 3 * sum;
    second += a / 12 * (sum * sum.transpose());
    for (const Vec3& corner : t)
      second += a / 12 * (corner * corner.transpose());
  }
};

// Per node of the trimmed crack; null where nothing is known.
std::vector<const Mat3*> stress_in_cut(const CrackState& crack,
                                       const std::unordered_map<NodeId, Mat3>& stress) {
  std::vector<const Mat3*> known(crack.trimmed.node_count(), nullptr);
  for (std::size_t n = 0; n < crack.node_in_cut.size(); ++n)
    if (const NodeId in_cut = crack.node_in_cut[NodeId(n)]; in_cut.valid())
      if (const auto found = stress.find(NodeId(n)); found != stress.end())
        known[in_cut.index()] = &found->second;
  return known;
}

void add_forces(const CrackState& crack, const std::vector<int>& part,
                const std::unordered_map<NodeId, Mat3>& stress, std::vector<NetSection>& out) {
  const TriMesh& mesh = crack.trimmed;
  const std::vector<const Mat3*> known = stress_in_cut(crack, stress);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto& corners = mesh.corners[TriId(t)];
    Mat3 sum = Mat3::Zero();
    int count = 0;
    for (const NodeId c : corners)
      if (known[c.index()] != nullptr) {
        sum += *known[c.index()];
        ++count;
      }
    if (count == 0) continue;
    const Vec3 force = sum / count * area_vector(mesh, TriId(t));
    NetSection& section = out[static_cast<std::size_t>(part[corners[0].index()])];
    section.force += force;
    section.moment += cross(centroid(mesh, TriId(t)), force);
  }
}

// From each node of a front straight ahead to the surface; the ends at the mouth, which are no points, as their neighbours.
std::vector<std::optional<Vec3>> ways_ahead(const Front& front,
                                            const std::unordered_map<NodeId, std::size_t>& point_at,
                                            const CrackState& crack, const std::vector<double>& ahead) {
  const std::size_t n = front.nodes.size();
  std::vector<std::optional<Vec3>> ways(n);
  for (std::size_t k = 0; k < n; ++k)
    if (const auto found = point_at.find(front.nodes[k]); found != point_at.end())
      ways[k] = ahead[found->second] * crack.points[found->second].frame.e2;
  if (!front.closed && n > 1) {
    if (!ways.front()) ways.front() = ways[1];
    if (!ways.back()) ways.back() = ways[n - 2];
  }
  return ways;
}

std::vector<Moments> add_fronts(const CrackState& crack, const std::vector<int>& part,
                                const std::vector<double>& ahead, std::vector<NetSection>& out) {
  const TriMesh& mesh = crack.trimmed;
  const std::unordered_map<NodeId, std::size_t> point_at = points_by_cut_node(crack);
  std::vector<Moments> ligaments(out.size());
  for (const Front& front : crack.fronts) {
    const auto ways = ways_ahead(front, point_at, crack, ahead);
    const std::size_t n = front.nodes.size(), edges = front.closed ? n : n - 1;
    for (std::size_t k = 0; k < edges; ++k) {
      const std::size_t next = (k + 1) % n;
      if (!ways[k] || !ways[next]) continue;
      const auto of = static_cast<std::size_t>(part[front.nodes[k].index()]);
      const Vec3 &a = mesh.positions[front.nodes[k]], &b = mesh.positions[front.nodes[next]];
      out[of].front += (b - a).norm();
      ligaments[of].add({a, b, b + *ways[next]});
      ligaments[of].add({a, b + *ways[next], a + *ways[k]});
    }
  }
  return ligaments;
}

}  // namespace

Vec3 NetSection::taken_over(const Vec3& x) const {
  if (!(ligament > 0) || !std::isfinite(ligament)) return Vec3::Zero();
  return force / ligament + cross(turn, x - center);
}

std::vector<NetSection> net_sections(const CrackState& crack, const std::unordered_map<NodeId, Mat3>& stress,
                                     const std::vector<double>& ahead) {
  const std::vector<int> part = connected_parts(crack.trimmed);
  std::vector<NetSection> out(part.empty() ? 0 : 1 + *std::max_element(part.begin(), part.end()));
  add_forces(crack, part, stress, out);
  const std::vector<Moments> ligaments = add_fronts(crack, part, ahead, out);
  for (std::size_t c = 0; c < out.size(); ++c) {
    NetSection& section = out[c];
    const Moments& l = ligaments[c];
    section.ligament = l.area;
    if (!(l.area > 0) || !std::isfinite(l.area)) continue;
    section.center = l.first / l.area;
    const Mat3 about = l.second - l.area * section.center * section.center.transpose();
    Mat3 inertia = about.trace() * Mat3::Identity() - about;
    inertia += kLeastInertia * inertia.trace() * Mat3::Identity();
    section.turn = inertia.inverse() * section.moment_about(section.center);
  }
  return out;
}

double arm_intensity(double moment, double front, double above, double below) {
  if (!(front > 0 && above > 0 && below > 0)) return 0;
  return std::sqrt(12.0) * std::abs(moment) / front * (std::pow(above, -1.5) + std::pow(below, -1.5)) / 2;
}

}  // namespace conchoid

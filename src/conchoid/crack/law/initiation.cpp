#include "conchoid/crack/law/initiation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "conchoid/crack/length_factors.hpp"

namespace conchoid {

namespace {

/// ±v on the positive side of the first reference that is not perpendicular to it.
Vec3 with_fixed_sign(const Vec3& v, const std::array<Vec3, 3>& references) {
  for (const Vec3& reference : references) {
    const double c = v.dot(reference);
    if (std::abs(c) > kPerpendicularCosine * v.norm() * reference.norm()) return c > 0 ? v : Vec3(-v);
  }
  return v;
}

Vec3 in_plane(const Vec3& v, const Vec3& normal) {
  return v - v.dot(normal) * normal;
}

CrackSite make_site(const InitiationCandidate& c, double radius) {
  const Vec3 to_first = c.corners[0] - c.position, to_second = c.corners[1] - c.position;
  const std::array<Vec3, 3> references{to_first, to_second, c.inward_normal};
  CrackSite site;
  site.triangle = c.triangle;
  site.center = c.position;
  site.normal = with_fixed_sign(c.direction.normalized(), references);
  Vec3 inward = in_plane(c.inward_normal, site.normal);
  if (inward.norm() < 0.1) inward = in_plane(to_first / to_first.norm(), site.normal);
  site.inward = inward.normalized();
  site.side = with_fixed_sign(cross(site.normal, site.inward), references);
  site.radius = radius;
  // no node of the disc lies in the surface itself
  site.center += (c.on_crack ? kBranchDepth : -kDiscOutside) * radius * site.inward;
  site.severity = c.principal_stress / c.strength;
  return site;
}

bool closer_than(double distance, const Vec3& x, const std::vector<Vec3>& nodes) {
  return std::any_of(nodes.begin(), nodes.end(),
                     [&](const Vec3& node) { return (node - x).squaredNorm() < distance * distance; });
}

/// Among the candidates within 0.1 % of the most severe the least remote, of these the one with the lowest
/// triangle id; end if there is none.
auto next_candidate(const std::vector<InitiationCandidate>& left) {
  const auto severity = [](const InitiationCandidate& c) { return c.principal_stress / c.strength; };
  double largest = 0;
  for (const auto& c : left)
    largest = std::max(largest, severity(c));
  const auto is_equal = [&](const InitiationCandidate& c) {
    return severity(c) >= (1 - kEqualSeverity) * largest;
  };
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& c : left)
    if (is_equal(c)) nearest = std::min(nearest, c.remoteness);
  auto best = left.end();
  for (auto it = left.begin(); it != left.end(); ++it)
    if (is_equal(*it) && it->remoteness <= (1 + kEqualRemoteness) * nearest &&
        (best == left.end() || it->triangle < best->triangle))
      best = it;
  return best;
}

}  // namespace

std::vector<CrackSite> choose_sites(const std::vector<InitiationCandidate>& candidates,
                                    const std::vector<Vec3>& crack_nodes, const InitiationSettings& settings,
                                    const std::vector<Vec3>& front_nodes) {
  const auto is_free = [&](const InitiationCandidate& c) {
    if (!c.on_crack) return !closer_than(settings.min_distance, c.position, crack_nodes);
    return !closer_than(settings.min_distance, c.position, front_nodes) &&
           !closer_than(kBranchClearance * settings.resolution, make_site(c, settings.resolution).center,
                        crack_nodes);
  };
  std::vector<InitiationCandidate> left;
  for (const auto& c : candidates)
    if (c.principal_stress > c.strength && is_free(c)) left.push_back(c);
  std::vector<CrackSite> sites;
  while (sites.size() < settings.most && !left.empty()) {
    const auto best = next_candidate(left);
    sites.push_back(make_site(*best, settings.resolution));
    const TriId taken = best->triangle;
    std::erase_if(left, [&](const InitiationCandidate& c) {
      return c.triangle == taken || (c.position - sites.back().center).norm() < settings.min_distance;
    });
  }
  return sites;
}

TriMesh disc_sheet(const CrackSite& site) {
  TriMesh mesh;
  mesh.positions.push_back(site.center);
  for (int k = 1; k <= kDiscRings; ++k)
    for (int j = 0; j < 6 * k; ++j) {
      const double phi = 2 * std::numbers::pi * j / (6 * k);
      mesh.positions.push_back(site.center + site.radius * k / kDiscRings *
                                                 (std::cos(phi) * site.inward + std::sin(phi) * site.side));
    }
  const bool turned = cross(site.inward, site.side).dot(site.normal) < 0;
  const auto node = [](int ring, int j) {
    return NodeId(ring == 0 ? 0 : 1 + 3 * ring * (ring - 1) + j % (6 * ring));
  };
  const auto add = [&](NodeId a, NodeId b, NodeId c) {
    mesh.corners.push_back(turned ? std::array{a, c, b} : std::array{a, b, c});
  };
  for (int k = 1; k <= kDiscRings; ++k)
    for (int sector = 0; sector < 6; ++sector)
      for (int j = 0; j < k; ++j) {
        const int out = sector * k + j, in = sector * (k - 1) + j;
        add(node(k - 1, in), node(k, out), node(k, out + 1));
        if (j + 1 < k) add(node(k - 1, in), node(k, out + 1), node(k - 1, in + 1));
      }
  return mesh;
}

}  // namespace conchoid

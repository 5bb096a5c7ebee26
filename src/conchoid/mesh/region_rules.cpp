#include "conchoid/mesh/region_rules.hpp"

#include <algorithm>
#include <limits>

#include "conchoid/mesh/box.hpp"
#include "conchoid/mesh/closest_point.hpp"

namespace conchoid {
namespace {

bool of_material(const RegionRule& rule, const SurfaceAttributes& attributes, std::size_t t) {
  if (rule.material.empty()) return true;
  return t < attributes.material.size() &&
         attributes.materials[static_cast<std::size_t>(attributes.material[t])] == rule.material;
}

bool in_group(const RegionRule& rule, const SurfaceAttributes& attributes, std::size_t t) {
  if (rule.group.empty()) return true;
  return t < attributes.group.size() &&
         is_among(attributes.groups[static_cast<std::size_t>(attributes.group[t])], rule.group);
}

std::vector<char> wanted_by(const RegionRule& rule, const TriMesh& mesh,
                            const SurfaceAttributes& attributes) {
  std::vector<char> wanted(mesh.triangle_count());
  std::size_t nearest = wanted.size();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < wanted.size(); ++t) {
    const Triangle x = mesh.triangle(TriId(t));
    if (!of_material(rule, attributes, t) || !in_group(rule, attributes, t) ||
        !std::all_of(x.begin(), x.end(), [&](const Vec3& corner) { return rule.holds(corner); }))
      continue;
    wanted[t] = !rule.nearest;
    if (!rule.nearest) continue;
    const double distance = (closest_point_on_triangle(x, *rule.nearest) - *rule.nearest).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    nearest = t;
  }
  if (nearest < wanted.size()) wanted[nearest] = 1;
  return wanted;
}

}  // namespace

bool RegionRule::holds(const Vec3& x) const {
  return std::all_of(half_spaces.begin(), half_spaces.end(),
                     [&](const HalfSpace& h) { return h.contains(x); }) &&
         (!box || squared_distance(*box, x) == 0) && (!ball || ball->distance(x) <= 0) &&
         (!indenter || indenter->distance(x) <= reach);
}

double RoundBody::distance(const Vec3& x) const {
  const Vec3 d = x - center;
  return (axis ? Vec3(d - axis->dot(d) * *axis) : d).norm() - radius;
}

std::vector<Region> select_regions(const TriMesh& mesh, const std::vector<RegionRule>& rules,
                                   const SurfaceAttributes& attributes) {
  std::vector<Region> regions;
  std::vector<char> taken(mesh.triangle_count(), 0);
  for (const RegionRule& rule : rules) {
    regions.push_back({rule.name, {}});
    const std::vector<char> wanted = wanted_by(rule, mesh, attributes);
    for (std::size_t t = 0; t < wanted.size(); ++t) {
      if (!wanted[t] || taken[t]) continue;
      taken[t] = 1;
      regions.back().triangles.emplace_back(t);
    }
  }
  return regions;
}

}  // namespace conchoid

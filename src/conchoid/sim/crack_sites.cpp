#include "conchoid/sim/crack_sites.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "conchoid/bem/surface_stress.hpp"

namespace conchoid {
namespace {

constexpr double kAlongSurface = 0.9;  // cosine between σ1 and the surface normal above which no crack starts
constexpr double kAlongFace = 0.5;     // the same at the face of a crack
constexpr double kCrackDistance = 2;   // × r̄: from cracks that are there

struct WeakPoint {
  Vec3 position;
  double strength;
};

// The point of least strength in a triangle, among evenly spread ones.
WeakPoint weakest_point(const Triangle& x, double strength, const MaterialField& field) {
  constexpr int kParts = 8;
  WeakPoint weakest{Vec3::Zero(), std::numeric_limits<double>::infinity()};
  for (int i = 0; i < kParts; ++i)
    for (int j = 0; i + j < kParts; ++j) {
      const double a = (i + 1.0 / 3) / kParts, b = (j + 1.0 / 3) / kParts;
      const Vec3 at = a * x[0] + b * x[1] + (1 - a - b) * x[2];
      const double here = strength * field.at(at).value;
      if (here < weakest.strength) weakest = {at, here};
    }
  return weakest;
}

// Candidates for branches: faces of the crack's whole triangles away from its fronts.
std::vector<InitiationCandidate> find_branches(const PreparedBody& prepared, const CrackState& crack,
                                               const CrackedBody& body, double strength,
                                               const std::vector<Vec3>& front_nodes, double distance) {
  const auto whole = [&](const std::array<NodeId, 3>& c) {
    return std::all_of(c.begin(), c.end(), [&](NodeId n) {
      const NodeId of_sheet = crack.cut.sheet_node[n];
      return of_sheet.valid() && crack.node_in_cut[of_sheet] == n;
    });
  };
  std::vector<TriId> faces;
  for (std::size_t t = 0; t < crack.cut.sheet.size(); ++t) {
    const Vec3 x = centroid(crack.trimmed, TriId(t));
    if (whole(crack.cut.sheet[TriId(t)]) &&
        std::none_of(front_nodes.begin(), front_nodes.end(),
                     [&](const Vec3& y) { return (y - x).squaredNorm() < distance * distance; }))
      faces.push_back(TriId(t));
  }
  const std::vector<CrackFaceStress> stress = body.crack_face_stress(faces);
  const Vec3 center = prepared.infinite() ? Vec3(Vec3::Zero()) : bounding_box(prepared.surface).center();
  std::vector<InitiationCandidate> out;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    auto nodes = crack.cut.sheet[faces[i]];
    std::sort(nodes.begin(), nodes.end());
    const Vec3 n = unit_normal(crack.trimmed, faces[i]), x = centroid(crack.trimmed, faces[i]);
    const double local_strength = strength * prepared.strength.at(x).value;
    for (const double side : {1.0, -1.0}) {
      const PrincipalStress p = principal_stress(side > 0 ? stress[i].plus : stress[i].minus);
      if (p.value[0] <= local_strength || std::abs(p.direction.col(0).dot(n)) > kAlongFace) continue;
      const TriId id(prepared.surface.triangle_count() + 2 * faces[i].index() + (side > 0 ? 0 : 1));
      const auto& y = crack.cut.positions;
      out.push_back({x,
                     p.value[0],
                     p.direction.col(0),
                     side * n,
                     local_strength,
                     id,
                     {y[nodes[0]], y[nodes[1]], y[nodes[2]]},
                     (x - center).norm(),
                     true});
    }
  }
  return out;
}

// Per triangle of the body whether a crack's mouth runs through it or along it; division alone does not count.
std::vector<char> with_mouth(std::size_t count, const CutComplex& cut) {
  std::vector<char> out(count, 0);
  for (std::size_t t = 0; t < cut.surface.size(); ++t) {
    const auto& c = cut.surface[TriId(t)];
    for (int k = 0; k < 3; ++k)
      if (std::binary_search(cut.mouth.begin(), cut.mouth.end(), Edge(c[k], c[(k + 1) % 3])))
        out[cut.surface_parent[t].index()] = 1;
  }
  return out;
}

// Candidates for new cracks: free triangles that no crack cuts, pulled across rather than along their normal,
// where σ1 exceeds so many times the strength.
std::vector<InitiationCandidate> find_on_surface(const PreparedBody& prepared, const CrackState& crack,
                                                 const CrackedBody& body, double strength, double times) {
  const std::vector<char> cut = with_mouth(prepared.surface.triangle_count(), crack.cut);
  const Vec3 center = bounding_box(prepared.surface).center();
  std::vector<InitiationCandidate> out;
  const std::vector<Mat3> stress = body.surface_stress();
  for (std::size_t t = 0; t < stress.size(); ++t) {
    if (cut[t] || prepared.quiet[t] || body.body().kinds()[t].holds_all()) continue;
    const PrincipalStress p = principal_stress(stress[t]);
    const Vec3 n = unit_normal(prepared.surface, TriId(t));
    if (std::abs(p.direction.col(0).dot(n)) > kAlongSurface) continue;
    auto nodes = prepared.surface.corners[TriId(t)];
    std::sort(nodes.begin(), nodes.end());
    const auto& x = prepared.surface.positions;
    const auto [at, local_strength] =
        prepared.strength.homogeneous()
            ? WeakPoint{centroid(prepared.surface, TriId(t)), strength}
            : weakest_point({x[nodes[0]], x[nodes[1]], x[nodes[2]]}, strength, prepared.strength);
    if (p.value[0] <= times * local_strength) continue;
    out.push_back({at,
                   p.value[0],
                   p.direction.col(0),
                   -n,
                   local_strength,
                   TriId(t),
                   {x[nodes[0]], x[nodes[1]], x[nodes[2]]},
                   (at - center).norm()});
  }
  return out;
}

}  // namespace

StressPeak largest_stress(const PreparedBody& prepared, const CrackState& crack, const CrackedBody& body) {
  StressPeak peak;
  if (prepared.infinite()) return peak;
  const double near = kCrackDistance * prepared.crack_edge;
  const auto& nodes = crack.sheet.mesh.positions;
  for (const InitiationCandidate& c : find_on_surface(prepared, crack, body, prepared.material.strength, 0)) {
    const double ratio = c.principal_stress / c.strength;
    if (ratio > peak.ratio && std::none_of(nodes.begin(), nodes.end(), [&](const Vec3& x) {
          return (x - c.position).squaredNorm() < near * near;
        }))
      peak = {ratio, c.position};
  }
  return peak;
}

std::vector<CrackSite> find_crack_sites(const PreparedBody& prepared, const CrackState& crack,
                                        const CrackedBody& body, std::size_t most) {
  const auto& x = crack.sheet.mesh.positions;
  const std::vector<Vec3> taken(x.begin(), x.end());
  std::vector<Vec3> fronts;
  for (const SheetFront& front : crack.sheet.fronts)
    for (const NodeId n : front.nodes)
      fronts.push_back(x[n]);
  const InitiationSettings settings{prepared.crack_edge, kCrackDistance * prepared.crack_edge, most};
  const double strength = prepared.material.strength;
  std::vector<InitiationCandidate> candidates =
      find_branches(prepared, crack, body, strength, fronts, settings.min_distance);
  if (!prepared.infinite()) {
    const auto on_surface = find_on_surface(prepared, crack, body, strength, 1);
    candidates.insert(candidates.end(), on_surface.begin(), on_surface.end());
  }
  return choose_sites(candidates, taken, settings, fronts);
}

}  // namespace conchoid

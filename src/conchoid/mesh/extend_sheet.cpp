#include <algorithm>
#include <cmath>
#include <map>

#include "conchoid/core/error.hpp"
#include "conchoid/mesh/crack_meshes.hpp"

namespace conchoid {
namespace {

/// A boundary edge as its triangle runs through it, and the unit vector out of the triangle, in its plane.
struct Rim {
  NodeId from, to;
  Vec3 outward;
};

std::vector<Rim> rims_of(const TriMesh& sheet, const std::vector<Edge>& edges) {
  const std::vector<Edge> boundary = boundary_edges(sheet);
  for (const Edge& e : edges)
    if (!std::binary_search(boundary.begin(), boundary.end(), e))
      throw InputError("crack: edge " + std::to_string(e.a.value) + "–" + std::to_string(e.b.value) +
                       " is not a free edge of the sheet and cannot be extended");
  std::vector<Edge> wanted = edges;
  std::sort(wanted.begin(), wanted.end());
  std::vector<Rim> rims;
  for (const auto& c : sheet.corners)
    for (int k = 0; k < 3; ++k) {
      const NodeId from = c[k], to = c[(k + 1) % 3];
      if (!std::binary_search(wanted.begin(), wanted.end(), Edge(from, to))) continue;
      const Vec3 along = (sheet.positions[to] - sheet.positions[from]).normalized();
      const Vec3 inward = sheet.positions[c[(k + 2) % 3]] - sheet.positions[from];
      rims.push_back({from, to, -(inward - inward.dot(along) * along).normalized()});
    }
  return rims;
}

}  // namespace

TriMesh extend_sheet_beyond(const TriMesh& sheet, const std::vector<Edge>& edges, double length) {
  if (!(length > 0) || !std::isfinite(length))
    throw InputError("crack: the length of an extension must be positive");
  const std::vector<Rim> rims = rims_of(sheet, edges);
  struct Sum {
    Vec3 directions = Vec3::Zero();
    int count = 0;
  };
  std::map<NodeId, Sum> sums;
  for (const Rim& rim : rims)
    for (NodeId node : {rim.from, rim.to}) {
      sums[node].directions += rim.outward;
      ++sums[node].count;
    }
  TriMesh extended = sheet;
  std::map<NodeId, NodeId> beyond;
  for (const auto& [node, sum] : sums) {
    // The average of two unit vectors is shorter than they: divided by its square it reaches the strip's full
    // width, though never more than twice it, at the sharp corners of a rim.
    const Vec3 average = sum.directions / sum.count;
    const double squared = std::max(average.squaredNorm(), 0.25);
    beyond[node] = extended.positions.add(sheet.positions[node] + (length / squared) * average);
  }
  for (const Rim& rim : rims) {
    const NodeId a = rim.from, b = rim.to, c = beyond.at(rim.to), d = beyond.at(rim.from);
    // The strip runs through the shared edge the other way; the diagonal that does not depend on the order of
    // edges.
    if (a < b) {
      extended.corners.push_back({b, a, d});
      extended.corners.push_back({b, d, c});
    } else {
      extended.corners.push_back({b, a, c});
      extended.corners.push_back({a, d, c});
    }
  }
  return extended;
}

}  // namespace conchoid

#include "conchoid/surface/open_slits.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>

#include "conchoid/intersect/self_intersection.hpp"
#include "conchoid/intersect/unfold.hpp"
#include "conchoid/surface/slit_faces.hpp"

namespace conchoid {
namespace {

/// What lies around a node of a slit.
struct Corner {
  std::vector<Vec3> inward;    ///< unit normals of the slit's faces, into the material
  Mat3 walls = Mat3::Zero();   ///< Σ of angle n nᵀ over the other faces
  double angle = 0;            ///< of those
  Vec3 middle = Vec3::Zero();  ///< Σ of unit vectors from the node into those

  /// Away from the slit's faces, all of them, and along the other faces if that can be; length 1 or 0.
  Vec3 way() const {
    if (inward.empty())  // a node that fronts touch from several sides: one fan of faces each
      return middle.norm() > 1e-3 ? Vec3(middle.normalized()) : Vec3(Vec3::Zero());
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(angle > 0 ? Mat3(walls / angle) : walls);
    constexpr double flat = 0.03;  // share of a direction that walls which curve a little may have
    constexpr double least = 0.15;
    for (int kept = 2; kept >= 0; --kept) {
      Mat3 along = Mat3::Identity();
      for (int k = 3 - kept; k < 3; ++k)
        if (const Vec3 n = solver.eigenvectors().col(k); solver.eigenvalues()[k] > flat)
          along -= n * n.transpose();
      std::vector<Vec3> wanted;
      for (const Vec3& n : inward)
        wanted.push_back(along * n);
      const Vec3 d = common_direction(wanted);
      double share = 1;
      for (const Vec3& n : inward)
        share = std::min(share, d.dot(n));
      if (share > (kept > 0 ? least : 0)) return d;
    }
    return Vec3::Zero();
  }
};

/// Which way each node at a slit goes, 1 being half the slit's width.
/// @param opposite  the faces that lie on each one
IdVector<NodeId, Vec3> ways(const Fragment& f, const SharedPlaces& places,
                            const std::vector<std::vector<std::size_t>>& opposite) {
  // At a slit's front both of its faces have the node: there it stays between them.
  const auto parts_from = [&](NodeId n, const std::vector<std::size_t>& faces) {
    return !faces.empty() && std::none_of(faces.begin(), faces.end(), [&](std::size_t t) {
      const auto& c = f.mesh.corners[TriId(t)];
      return std::find(c.begin(), c.end(), n) != c.end();
    });
  };
  std::map<NodeId, Corner> corners;
  for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t) {
    const auto& c = f.mesh.corners[TriId(t)];
    const Vec3 normal = unit_normal(f.mesh, TriId(t));
    for (std::size_t k = 0; k < 3; ++k) {
      if (!places.shared[c[k]]) continue;
      Corner& corner = corners[c[k]];
      if (parts_from(c[k], opposite[t])) {
        if (!normal.isZero(0)) corner.inward.push_back(-normal);
        continue;
      }
      const Vec3 u = f.mesh.positions[c[(k + 1) % 3]] - f.mesh.positions[c[k]];
      const Vec3 v = f.mesh.positions[c[(k + 2) % 3]] - f.mesh.positions[c[k]];
      const double angle = std::atan2(cross(u, v).norm(), u.dot(v));
      corner.walls += angle * normal * normal.transpose();
      corner.angle += angle;
      corner.middle += (u + v).normalized();
    }
  }
  IdVector<NodeId, Vec3> way(f.mesh.node_count(), Vec3::Zero());
  for (const auto& [n, corner] : corners)
    way[n] = corner.way();
  return way;
}

/// Those of the faces that have a node at one of the places.
std::vector<TriId> faces_at(const TriMesh& mesh, const std::vector<TriId>& faces,
                            const IdVector<NodeId, char>& places_wanted, const SharedPlaces& places) {
  std::vector<TriId> out;
  for (const TriId t : faces) {
    const auto& c = mesh.corners[t];
    if (std::any_of(c.begin(), c.end(), [&](NodeId n) { return places_wanted[places.first[n]] != 0; }))
      out.push_back(t);
  }
  return out;
}

}  // namespace

bool open_slits(Fragment& f, double width) {
  const SharedPlaces places(f.mesh);
  const auto opposite = opposite_faces(f, places);
  const IdVector<NodeId, Vec3> way = ways(f, places, opposite);
  const IdVector<NodeId, Vec3> closed = f.mesh.positions;
  IdVector<NodeId, double> share(f.mesh.node_count(), 1.0);  // by place
  const auto move = [&] {
    for (std::size_t i = 0; i < f.mesh.node_count(); ++i)
      if (const NodeId n(i); !way[n].isZero(0))
        f.mesh.positions[n] = closed[n] + 0.5 * width * share[places.first[n]] * way[n];
  };
  if (std::all_of(way.begin(), way.end(), [](const Vec3& w) { return w.isZero(0); })) return true;
  std::vector<TriId> slit;  // what moves, and what lies on another face
  for (std::size_t t = 0; t < f.mesh.triangle_count(); ++t) {
    const auto& c = f.mesh.corners[TriId(t)];
    if (!opposite[t].empty() || std::any_of(c.begin(), c.end(), [&](NodeId n) { return !way[n].isZero(0); }))
      slit.emplace_back(t);
  }
  move();
  constexpr std::size_t most_pairs = 10000;
  constexpr int rounds = 5;
  std::vector<TriId> moved = slit;
  bool stuck = false;  // faces cross that do not move
  for (int round = 1;; ++round) {
    const auto crossing = self_intersections(f.mesh, moved, most_pairs);
    IdVector<NodeId, char> reached(f.mesh.node_count(), 0);
    bool any = false;
    for (const auto& [s, t] : crossing) {
      bool moves = false;
      for (const TriId face : {s, t})
        for (const NodeId n : f.mesh.corners[face])
          if (!way[n].isZero(0)) reached[places.first[n]] = moves = true;
      (moves ? any : stuck) = true;
    }
    if (!any || round > rounds) return !any && !stuck;
    for (std::size_t n = 0; n < reached.size(); ++n)
      if (reached[NodeId(n)]) share[NodeId(n)] = round == rounds ? 0 : 0.3 * share[NodeId(n)];
    move();
    // What did not cross and did not move does not cross now.
    moved = crossing.size() < most_pairs ? faces_at(f.mesh, slit, reached, places) : slit;
  }
}

}  // namespace conchoid

#include "conchoid/intersect/self_intersection.hpp"

#include <algorithm>
#include <cmath>

#include "conchoid/core/parallel.hpp"
#include "conchoid/intersect/expansion.hpp"
#include "conchoid/intersect/plane_cover.hpp"
#include "conchoid/intersect/plane_signs.hpp"
#include "conchoid/mesh/box_tree.hpp"
#include "conchoid/mesh/surface_parts.hpp"

namespace conchoid {
namespace {

/// Sign of ((b−a) × (c−a))·(d−a): + if d lies on the side of abc from which it is seen counter-clockwise.
/// Floating point with Shewchuk's error bound, exact expansions where that leaves the sign open.
int side_of_plane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 ab = b - a, ac = c - a, ad = d - a;
  double determinant = 0, magnitude = 0;
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3, m = (k + 2) % 3;
    const double p = ab[l] * ac[m], q = ab[m] * ac[l];
    determinant += ad[k] * (p - q);
    magnitude += std::abs(ad[k]) * (std::abs(p) + std::abs(q));
  }
  const double bound = (8 + 64 * unit_roundoff) * unit_roundoff * magnitude;
  if (determinant > bound) return 1;
  if (-determinant > bound) return -1;
  if (magnitude == 0) return 0;
  std::array<Expansion, 3> e_ab, e_ac, e_ad;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    e_ab[k] = Expansion::difference(b[i], a[i]);
    e_ac[k] = Expansion::difference(c[i], a[i]);
    e_ad[k] = Expansion::difference(d[i], a[i]);
  }
  Expansion exact;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
    exact += e_ad[k] * (e_ab[l] * e_ac[m] - e_ab[m] * e_ac[l]);
  }
  return exact.sign();
}

Projection projection_of(const Triangle& t) {
  const Vec3 n = area_vector2(t[0], t[1], t[2]).cwiseAbs();
  const int drop = n.x() >= n.y() && n.x() >= n.z() ? 0 : n.y() >= n.z() ? 1 : 2;
  return {(drop + 1) % 3, (drop + 2) % 3};
}

bool in_triangle(const Vec3& x, const Triangle& t, Projection pr) {
  const int s0 = turn(t[0], t[1], x, pr), s1 = turn(t[1], t[2], x, pr), s2 = turn(t[2], t[0], x, pr);
  return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

/// On which sides of t's plane the points lie.
std::array<int, 3> sides_of_plane(const Triangle& t, const Triangle& points) {
  return {side_of_plane(t[0], t[1], t[2], points[0]), side_of_plane(t[0], t[1], t[2], points[1]),
          side_of_plane(t[0], t[1], t[2], points[2])};
}

bool all_on_one_side(const std::array<int, 3>& side) {
  return side[0] != 0 && side[0] == side[1] && side[1] == side[2];
}

/// Closed segment against closed triangle, the sides of whose plane its ends lie on being known.
bool segment_meets_triangle(const Vec3& p, const Vec3& q, int p_side, int q_side, const Triangle& t) {
  if (p_side * q_side > 0) return false;
  if (p_side == 0 && q_side == 0) {
    const Projection pr = projection_of(t);
    if (in_triangle(p, t, pr) || in_triangle(q, t, pr)) return true;
    for (std::size_t k = 0; k < 3; ++k)
      if (coplanar_segments_meet(p, q, t[k], t[(k + 1) % 3], pr)) return true;
    return false;
  }
  const int s0 = side_of_plane(p, q, t[0], t[1]), s1 = side_of_plane(p, q, t[1], t[2]),
            s2 = side_of_plane(p, q, t[2], t[0]);
  return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

bool apart(const Triangle& a, const Triangle& b) {
  for (int k = 0; k < 3; ++k) {
    if (std::max({a[0][k], a[1][k], a[2][k]}) < std::min({b[0][k], b[1][k], b[2][k]})) return true;
    if (std::max({b[0][k], b[1][k], b[2][k]}) < std::min({a[0][k], a[1][k], a[2][k]})) return true;
  }
  return false;
}

/// Whether an edge of a has all of a on one side and all of b strictly on the other. `orientation` of a is not 0.
bool an_edge_parts(const Triangle& a, const Triangle& b, int orientation, Projection pr) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &from = a[k], &to = a[(k + 1) % 3];
    if (turn(from, to, b[0], pr) == -orientation && turn(from, to, b[1], pr) == -orientation &&
        turn(from, to, b[2], pr) == -orientation)
      return true;
  }
  return false;
}

/// Triangles in one plane are apart if and only if an edge of one of them parts them.
bool parted_in_plane(const Triangle& a, const Triangle& b) {
  const Projection pr = projection_of(a);
  const int of_a = turn(a[0], a[1], a[2], pr), of_b = turn(b[0], b[1], b[2], pr);
  return of_a != 0 && of_b != 0 && (an_edge_parts(a, b, of_a, pr) || an_edge_parts(b, a, of_b, pr));
}

/// Whether b lies beyond an edge of a, seen along a's normal, by more than round-off: no exact test is needed then,
/// which is slow where all lies almost in one plane.
bool clearly_beyond_an_edge(const Triangle& a, const Triangle& b) {
  const Vec3 normal = area_vector2(a[0], a[1], a[2]);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 edge = a[(k + 1) % 3] - a[k], out = cross(edge, normal);
    const Vec3 u = b[0] - a[k], v = b[1] - a[k], w = b[2] - a[k], own = a[(k + 2) % 3] - a[k];
    const double reach = u.cwiseAbs().maxCoeff() + v.cwiseAbs().maxCoeff() + w.cwiseAbs().maxCoeff() +
                         own.cwiseAbs().maxCoeff() + edge.cwiseAbs().maxCoeff();
    const double within = std::max({0.0, out.dot(own), out.dot(edge)});
    constexpr double clear = 1e-12;  // round-off stays below 1e-14
    if (std::min({out.dot(u), out.dot(v), out.dot(w)}) - within > clear * reach * out.cwiseAbs().sum())
      return true;
  }
  return false;
}

/// Triangles with no common node.
bool separate_triangles_meet(const Triangle& a, const Triangle& b) {
  if (apart(a, b) || clearly_beyond_an_edge(a, b) || clearly_beyond_an_edge(b, a)) return false;
  const std::array<int, 3> a_side = sides_of_plane(b, a);
  if (all_on_one_side(a_side)) return false;
  const std::array<int, 3> b_side = sides_of_plane(a, b);
  if (all_on_one_side(b_side)) return false;
  if (a_side == std::array{0, 0, 0} && b_side == std::array{0, 0, 0} && parted_in_plane(a, b)) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3;
    if (segment_meets_triangle(a[k], a[l], a_side[k], a_side[l], b) ||
        segment_meets_triangle(b[k], b[l], b_side[k], b_side[l], a))
      return true;
  }
  return false;
}

/// Triangles v p q and v b c with the common node v. A quick test finds a plane through v that has them on
/// different sides; if there is a further common point, then also one on the edge opposite of v in one of
/// them.
bool triangles_at_node_meet(const Vec3& v, const Vec3& p, const Vec3& q, const Vec3& b, const Vec3& c) {
  const Vec3 vp = (p - v).normalized(), vq = (q - v).normalized(), vb = (b - v).normalized(),
             vc = (c - v).normalized();
  const Vec3 across = (vp + vq).normalized() - (vb + vc).normalized();
  constexpr double clear = 1e-9;
  if (std::min(across.dot(vp), across.dot(vq)) > clear && std::max(across.dot(vb), across.dot(vc)) < -clear)
    return false;
  const int p_side = side_of_plane(v, b, c, p), q_side = side_of_plane(v, b, c, q);
  if (p_side * q_side > 0) return false;
  const int b_side = side_of_plane(v, p, q, b), c_side = side_of_plane(v, p, q, c);
  if (b_side * c_side > 0) return false;
  return segment_meets_triangle(p, q, p_side, q_side, {v, b, c}) ||
         segment_meets_triangle(b, c, b_side, c_side, {v, p, q});
}

/// Triangles a b c and b a d with the common edge ab meet elsewhere only if they are folded flat onto each
/// other.
bool triangles_at_edge_meet(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 n_c = area_vector2(a, b, c), n_d = area_vector2(b, a, d);
  if (n_c.dot(n_d) > 0) return false;
  if (side_of_plane(a, b, c, d) != 0) return false;
  const Projection pr = projection_of({a, b, c});
  return turn(a, b, c, pr) == turn(a, b, d, pr);
}

// A tree of the triangles within the box of some faces: the others touch none of these.
struct Neighbourhood {
  std::vector<TriId> ids;  // empty: all
  BoxTree tree;

  Neighbourhood(const TriMesh& mesh, const std::vector<TriId>& faces)
      : ids(within_box(mesh, faces)), tree(ids.empty() ? BoxTree(mesh) : BoxTree(submesh(mesh, ids))) {}
  TriId id(TriId of_tree) const { return ids.empty() ? of_tree : ids[of_tree.index()]; }

 private:
  static std::vector<TriId> within_box(const TriMesh& mesh, const std::vector<TriId>& faces) {
    std::vector<TriId> ids;
    if (faces.size() == mesh.triangle_count()) return ids;
    Box box = box_of(mesh.triangle(faces[0]));
    for (const TriId t : faces)
      box = united(box, box_of(mesh.triangle(t)));
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
      if (overlap(box, box_of(mesh.triangle(TriId(t))))) ids.emplace_back(t);
    return ids;
  }
};

}  // namespace

bool triangles_intersect(const TriMesh& mesh, TriId s, TriId t) {
  return triangles_intersect(mesh.positions, mesh.corners[s], mesh.corners[t]);
}

bool triangles_intersect(const IdVector<NodeId, Vec3>& positions, std::array<NodeId, 3> a,
                         std::array<NodeId, 3> b) {
  // Bring the common nodes to the front, in the same places of both.
  std::size_t common = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = common; j < 3; ++j)
      if (a[i] == b[j]) {
        std::swap(a[i], a[common]);
        std::swap(b[j], b[common]);
        ++common;
        break;
      }
  const auto x = [&](NodeId n) -> const Vec3& { return positions[n]; };
  switch (common) {
    case 0:
      return separate_triangles_meet({x(a[0]), x(a[1]), x(a[2])}, {x(b[0]), x(b[1]), x(b[2])});
    case 1:
      return triangles_at_node_meet(x(a[0]), x(a[1]), x(a[2]), x(b[1]), x(b[2]));
    case 2:
      return triangles_at_edge_meet(x(a[0]), x(a[1]), x(a[2]), x(b[2]));
    default:
      return true;
  }
}

std::vector<std::pair<TriId, TriId>> self_intersections(const TriMesh& mesh, std::size_t limit) {
  if (covers_plane_once(mesh)) return {};
  std::vector<TriId> all;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    all.emplace_back(t);
  return self_intersections(mesh, all, limit);
}

std::vector<std::pair<TriId, TriId>> self_intersections(const TriMesh& mesh, const std::vector<TriId>& faces,
                                                        std::size_t limit) {
  constexpr std::size_t kGrain = 256, kFirstGrains = 2;
  std::vector<std::pair<TriId, TriId>> found;
  if (faces.empty()) return found;
  const Neighbourhood around(mesh, faces);
  std::vector<char> asked(mesh.triangle_count(), 0);
  for (const TriId t : faces)
    asked[t.index()] = 1;
  const bool all = faces.size() == asked.size();
  const std::size_t n = faces.size();
  // Of all triangles the first pairs are those of the first triangles, so that few of a crumpled sheet are looked at; of
  // some, all have to be known first.
  std::size_t begin = 0, count = 0;
  for (std::size_t grains = kFirstGrains; begin < n && (found.size() < limit || !all);
       begin += count, grains *= 2) {
    count = std::min(n - begin, kGrain * grains);
    std::vector<std::vector<std::pair<TriId, TriId>>> of_grain((count + kGrain - 1) / kGrain);
    parallel_for(count, kGrain, [&](std::size_t from, std::size_t to) {
      auto& own = of_grain[from / kGrain];
      for (std::size_t i = begin + from; i < begin + to; ++i) {
        const TriId s = faces[i];
        const auto first = static_cast<std::ptrdiff_t>(own.size());
        around.tree.visit_overlapping(box_of(mesh.triangle(s)), [&](TriId near) {
          const TriId t = around.id(near);
          if ((s < t || (t < s && !asked[t.index()])) && triangles_intersect(mesh, s, t))
            own.emplace_back(std::min(s, t), std::max(s, t));
        });
        std::sort(own.begin() + first, own.end());
      }
    });
    for (const auto& own : of_grain)
      found.insert(found.end(), own.begin(), own.end());
  }
  if (!all) std::sort(found.begin(), found.end());
  if (found.size() > limit) found.resize(limit, {TriId(), TriId()});
  return found;
}

}  // namespace conchoid

#include "conchoid/intersect/predicates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "conchoid/core/parallel.hpp"
#include "conchoid/core/random.hpp"
#include "conchoid/intersect/expansion.hpp"
#include "conchoid/mesh/id_lists.hpp"

namespace conchoid {
namespace {

constexpr int stage_count = 4;
/// Displacements of one stage enter with exponent 4^stage or higher: coefficients below it are complete
/// without them.
constexpr int complete_below(int stage) {
  return stage == 0   ? 1
         : stage == 1 ? 4
         : stage == 2 ? 16
         : stage == 3 ? 64
                      : std::numeric_limits<int>::max();
}

/// Polynomial in ε with exact coefficients, exponents ascending.
class Polynomial {
 public:
  void add(int exponent, const Expansion& value) {
    if (value.is_zero()) return;
    auto at = std::lower_bound(terms_.begin(), terms_.end(), exponent,
                               [](const Term& t, int e) { return t.exponent < e; });
    if (at != terms_.end() && at->exponent == exponent)
      at->value += value;
    else
      terms_.insert(at, {exponent, value});
  }
  void drop_zeros() {
    std::erase_if(terms_, [](const Term& t) { return t.value.is_zero(); });
  }
  bool is_zero() const { return terms_.empty(); }
  int leading_exponent() const { return terms_.front().exponent; }
  const Expansion& leading() const { return terms_.front().value; }

  friend Polynomial operator-(Polynomial a, const Polynomial& b) {
    for (const Term& t : b.terms_)
      a.add(t.exponent, -t.value);
    a.drop_zeros();
    return a;
  }
  friend Polynomial operator+(Polynomial a, const Polynomial& b) {
    for (const Term& t : b.terms_)
      a.add(t.exponent, t.value);
    a.drop_zeros();
    return a;
  }
  friend Polynomial operator*(const Polynomial& a, const Polynomial& b) {
    Polynomial product;
    for (const Term& s : a.terms_)
      for (const Term& t : b.terms_)
        product.add(s.exponent + t.exponent, s.value * t.value);
    product.drop_zeros();
    return product;
  }

 private:
  struct Term {
    int exponent;
    Expansion value;
  };
  std::vector<Term> terms_;
};

double hash_component(std::uint32_t id, int axis) {
  return static_cast<double>(mix_bits(3ull * id + static_cast<std::uint64_t>(axis)) >> 44) - 524288.0;
}

/// Coordinate of p − origin as a polynomial; displacements up to `stage`.
Polynomial coordinate(const PerturbedPoint& p, const PerturbedPoint& origin, int axis, int stage) {
  Polynomial result;
  result.add(0, Expansion::difference(p.x[axis], origin.x[axis]));
  for (const auto& [point, sign] : {std::pair{&p, 1.0}, std::pair{&origin, -1.0}}) {
    if (stage >= (point->exponent == 1 ? 1 : 2)) result.add(point->exponent, sign * point->along[axis]);
    if (stage >= 3) result.add(16, sign * point->across[axis]);
    if (stage >= 4) result.add(64, sign * hash_component(point->id, axis));
  }
  result.drop_zeros();
  return result;
}

Polynomial determinant(const PerturbedPoint& a, const PerturbedPoint& b, const PerturbedPoint& c,
                       const PerturbedPoint& d, int stage) {
  std::array<std::array<Polynomial, 3>, 3> m;
  for (int axis = 0; axis < 3; ++axis) {
    m[0][axis] = coordinate(b, a, axis, stage);
    m[1][axis] = coordinate(c, a, axis, stage);
    m[2][axis] = coordinate(d, a, axis, stage);
  }
  const auto minor = [&](int i, int j) { return m[0][i] * m[1][j] - m[0][j] * m[1][i]; };
  return m[2][0] * minor(1, 2) + m[2][1] * minor(2, 0) + m[2][2] * minor(0, 1);
}

/// Leading term of the determinant, stage by stage.
Polynomial leading_determinant(const PerturbedPoint& a, const PerturbedPoint& b, const PerturbedPoint& c,
                               const PerturbedPoint& d) {
  for (int stage = 0; stage < stage_count; ++stage) {
    Polynomial det = determinant(a, b, c, d, stage);
    if (!det.is_zero() && det.leading_exponent() < complete_below(stage)) return det;
  }
  return determinant(a, b, c, d, stage_count);
}

struct Rounded {
  double value, magnitude;  ///< determinant and the sum of the absolute values of its products
};

Rounded rounded_determinant(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = c - a, w = d - a;
  const double uv_yz = u.y() * v.z(), uv_zy = u.z() * v.y();
  const double uv_zx = u.z() * v.x(), uv_xz = u.x() * v.z();
  const double uv_xy = u.x() * v.y(), uv_yx = u.y() * v.x();
  return {w.x() * (uv_yz - uv_zy) + w.y() * (uv_zx - uv_xz) + w.z() * (uv_xy - uv_yx),
          std::abs(w.x()) * (std::abs(uv_yz) + std::abs(uv_zy)) +
              std::abs(w.y()) * (std::abs(uv_zx) + std::abs(uv_xz)) +
              std::abs(w.z()) * (std::abs(uv_xy) + std::abs(uv_yx))};
}

/// The determinant at ε = 0, exactly.
Expansion exact_determinant(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  std::array<std::array<Expansion, 3>, 3> m;
  for (int axis = 0; axis < 3; ++axis) {
    m[0][axis] = Expansion::difference(b[axis], a[axis]);
    m[1][axis] = Expansion::difference(c[axis], a[axis]);
    m[2][axis] = Expansion::difference(d[axis], a[axis]);
  }
  const auto minor = [&](int i, int j) { return m[0][i] * m[1][j] - m[0][j] * m[1][i]; };
  return m[2][0] * minor(1, 2) + m[2][1] * minor(2, 0) + m[2][2] * minor(0, 1);
}

/// Coefficient of ε, where only the sheet moves; exact in sign if larger than 32 units of rounding of
/// `magnitude`.
Rounded rounded_first_order(const PerturbedPoint& a, const PerturbedPoint& b, const PerturbedPoint& c,
                            const PerturbedPoint& d) {
  const std::array<Vec3, 3> rows{b.x - a.x, c.x - a.x, d.x - a.x};
  const auto along = [](const PerturbedPoint& p) { return p.exponent == 1 ? p.along : Vec3(Vec3::Zero()); };
  const std::array<const PerturbedPoint*, 3> points{&b, &c, &d};
  Rounded sum{0, 0};
  for (int k = 0; k < 3; ++k) {
    const Vec3 step = along(*points[k]) - along(a);
    const Vec3 &v = rows[(k + 1) % 3], &w = rows[(k + 2) % 3];
    const Vec3 v_abs = v.cwiseAbs(), w_abs = w.cwiseAbs();
    sum.value += step.dot(cross(v, w));
    sum.magnitude += (along(*points[k]).cwiseAbs() + along(a).cwiseAbs())
                         .dot(Vec3(v_abs.y() * w_abs.z() + v_abs.z() * w_abs.y(),
                                   v_abs.z() * w_abs.x() + v_abs.x() * w_abs.z(),
                                   v_abs.x() * w_abs.y() + v_abs.y() * w_abs.x()));
  }
  return sum;
}

/// Exact lowest-order coefficient and its exponent.
struct Leading {
  int exponent;
  double value;
};
Leading leading_value(const PerturbedPoint& a, const PerturbedPoint& b, const PerturbedPoint& c,
                      const PerturbedPoint& d) {
  if (const Expansion at_rest = exact_determinant(a.x, b.x, c.x, d.x); !at_rest.is_zero())
    return {0, at_rest.estimate()};
  const Polynomial det = leading_determinant(a, b, c, d);
  if (det.is_zero()) return {std::numeric_limits<int>::max(), 0.0};
  return {det.leading_exponent(), det.leading().estimate()};
}

/// Corners in ascending id, so that every caller gets the same bits.
PerturbedTriangle sorted(PerturbedTriangle t) {
  std::sort(t.begin(), t.end(), [](const auto* x, const auto* y) { return x->id < y->id; });
  return t;
}

/// A triangle at a node.
struct Face {
  Vec3 normal;  ///< of length 1, zero without area; the same bits, up to the map, for a reflected mesh
  double area;
};

Face face(const TriMesh& mesh, TriId t) {
  const auto& corners = mesh.corners[t];
  auto c = corners;
  std::sort(c.begin(), c.end());
  const bool even = corners[1] == c[(std::find(c.begin(), c.end(), corners[0]) - c.begin() + 1) % 3];
  const Vec3 n = area_vector2(mesh.positions[c[0]], mesh.positions[c[1]], mesh.positions[c[2]]);
  const double area = n.norm();
  return {area > 0 ? Vec3((even ? 1 : -1) / area * n) : Vec3(Vec3::Zero()), area};
}

/// A direction on the outer side of all triangles of a star, where there is one: a surface that shrinks
/// against it opens even where two parts of it lie on each other, as the two faces of a crack do. Elsewhere (a
/// crack front) the sum of the normals. `star` loses the slivers.
Vec3 seen_by_all(std::vector<Face>& star) {
  constexpr double sliver = 1e-8, clearance = 0.05;
  constexpr int most_steps = 100;
  double largest = 0;
  for (const Face& face : star)
    largest = std::max(largest, face.area);
  std::erase_if(star, [&](const Face& face) { return !(face.area > sliver * largest); });
  Vec3 sum = Vec3::Zero();
  for (const Face& face : star)
    sum += face.normal;
  const auto hidden = [&](const Vec3& direction, const Face& face) {
    return !(direction.dot(face.normal) > clearance * direction.norm());
  };
  if (std::none_of(star.begin(), star.end(), [&](const Face& face) { return hidden(sum, face); })) return sum;
  Vec3 direction = sum;
  for (int step = 0; step < most_steps; ++step) {
    const auto worst = std::min_element(star.begin(), star.end(), [&](const Face& s, const Face& t) {
      return direction.dot(s.normal) < direction.dot(t.normal);
    });
    if (!hidden(direction, *worst)) return direction;
    direction += worst->normal;
  }
  return sum;
}

}  // namespace

PerturbedPoints::PerturbedPoints(const TriMesh& mesh, Role role, std::uint32_t first_id,
                                 const std::vector<NodeId>& nodes)
    : number_(mesh.node_count(), -1) {
  constexpr std::size_t points_of_task = 512;
  std::vector<NodeId> node;  // of each point
  for (const NodeId n : nodes)
    if (number_[n] < 0) {
      number_[n] = static_cast<std::int32_t>(node.size());
      node.push_back(n);
    }
  const auto has_point = [&](NodeId n) { return number_[n] >= 0; };
  std::vector<TriId> around;  // these nodes
  for (TriId t(0); t.index() < mesh.triangle_count(); ++t.value)
    if (std::any_of(mesh.corners[t].begin(), mesh.corners[t].end(), has_point)) around.push_back(t);
  const NodeLists<TriId> stars(node.size(), [&](const auto& put) {
    for (const TriId t : around)
      for (const NodeId n : mesh.corners[t])
        if (has_point(n)) put(NodeId(number_[n]), t);
  });
  points_ = parallel_values(node.size(), points_of_task, [&](std::size_t i) {
    const NodeId n = node[i];
    PerturbedPoint p;
    p.x = mesh.positions[n];
    p.exponent = role == Role::sheet ? 1 : 4;
    p.id = first_id + n.value;
    std::vector<Face> star;
    for (const TriId t : stars[NodeId(i)]) {
      auto c = mesh.corners[t];
      std::sort(c.begin(), c.end());
      for (const NodeId other : c) {
        if (other == n) continue;
        const auto key = (std::uint64_t(p.id) << 32) | (first_id + other.value);
        p.across += static_cast<double>(mix_bits(key) >> 54) * (mesh.positions[other] - p.x);
      }
      star.push_back(face(mesh, t));
    }
    const Vec3 out = seen_by_all(star);
    p.along = role == Role::surface ? Vec3(-out) : out;
    return p;
  });
}

int orientation(const PerturbedPoint& a, const PerturbedPoint& b, const PerturbedPoint& c,
                const PerturbedPoint& d) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon() / 2;
  constexpr double bound = (7.0 + 56.0 * epsilon) * epsilon;
  const Rounded det = rounded_determinant(a.x, b.x, c.x, d.x);
  if (det.value > bound * det.magnitude) return 1;
  if (det.value < -bound * det.magnitude) return -1;
  if (det.magnitude > 0)
    if (const int sign = exact_determinant(a.x, b.x, c.x, d.x).sign()) return sign;
  const Rounded first = rounded_first_order(a, b, c, d);
  if (std::abs(first.value) > 32 * epsilon * first.magnitude) return first.value > 0 ? 1 : -1;
  const Polynomial exact = leading_determinant(a, b, c, d);
  return exact.is_zero() ? 1 : exact.leading().sign();
}

Vec3 Crossing::point(const PerturbedPoint& p, const PerturbedPoint& q) const {
  if (to_p == 0) return p.x;
  if (to_q == 0) return q.x;
  return to_p <= to_q ? Vec3(p.x + to_p * (q.x - p.x)) : Vec3(q.x + to_q * (p.x - q.x));
}

bool pierces(const PerturbedPoint& p, const PerturbedPoint& q, const PerturbedTriangle& t) {
  const int s = orientation(p, q, *t[0], *t[1]);
  return s == orientation(p, q, *t[1], *t[2]) && s == orientation(p, q, *t[2], *t[0]);
}

Crossing crossing(const PerturbedPoint& p, const PerturbedPoint& q, const PerturbedTriangle& triangle) {
  const auto t = sorted(triangle);
  const Leading at_p = leading_value(*t[0], *t[1], *t[2], p), at_q = leading_value(*t[0], *t[1], *t[2], q);
  if (at_p.exponent > at_q.exponent) return {0.0, 1.0};
  if (at_q.exponent > at_p.exponent) return {1.0, 0.0};
  const double hp = std::abs(at_p.value), hq = std::abs(at_q.value);
  return {hp / (hp + hq), hq / (hp + hq)};
}

bool crosses_before(const PerturbedPoint& p, const PerturbedPoint& q, const PerturbedTriangle& first,
                    const PerturbedTriangle& second) {
  const Crossing f = crossing(p, q, first), s = crossing(p, q, second);
  const double left = f.to_p * s.to_q, right = s.to_p * f.to_q;
  if (std::abs(left - right) > 1e-13 * std::max(left, right)) return left < right;
  // h_p/h_q in both planes, all of them made positive
  const auto a = sorted(first), b = sorted(second);
  const int sign = orientation(*a[0], *a[1], *a[2], p) * orientation(*b[0], *b[1], *b[2], q);
  for (int stage = 0; stage <= stage_count; ++stage) {
    const Polynomial fp = determinant(*a[0], *a[1], *a[2], p, stage),
                     fq = determinant(*a[0], *a[1], *a[2], q, stage);
    const Polynomial sp = determinant(*b[0], *b[1], *b[2], p, stage),
                     sq = determinant(*b[0], *b[1], *b[2], q, stage);
    // |fp||sq| − |sp||fq|; fp·sq and sp·fq have the same sign, because p and q lie on different sides of both
    // planes
    const Polynomial product = fp * sq - sp * fq;
    if (!product.is_zero() && product.leading_exponent() < complete_below(stage))
      return product.leading().sign() * sign < 0;
  }
  return a[0]->id + a[1]->id + a[2]->id < b[0]->id + b[1]->id + b[2]->id;
}

}  // namespace conchoid

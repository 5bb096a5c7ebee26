#include "conchoid/quadrature/pair_integrals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

#include "conchoid/core/error.hpp"
#include "conchoid/quadrature/cases.hpp"
#include "conchoid/quadrature/far_points.hpp"
#include "conchoid/quadrature/triangle_rules.hpp"

namespace conchoid {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

double largest_coordinate(const Triangle& t) {
  return std::max({t[0].cwiseAbs().maxCoeff(), t[1].cwiseAbs().maxCoeff(), t[2].cwiseAbs().maxCoeff()});
}

/// Order of a pair that does not depend on which panel was named first: by ids, where these are equal by
/// coordinates.
bool in_order(const Panel& x, const Panel& y) {
  if (x.vertex != y.vertex) return x.vertex < y.vertex;
  for (int i = 0; i < 3; ++i) {
    const auto a = std::make_tuple(x.x[i].x(), x.x[i].y(), x.x[i].z());
    const auto b = std::make_tuple(y.x[i].x(), y.x[i].y(), y.x[i].z());
    if (a != b) return a < b;
  }
  return true;
}

SingleLayerPair to_pair(const Family& f) {
  return {f[0], {f[1], f[2], f[3], f[4], f[5], f[6]}};
}

DoubleLayerPair to_pair(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

/// Pairs that are not far.
Family other_single_layer(const Panel& x, const Panel& y, double tolerance) {
  switch (shared_corners(x, y).count) {
    case 3:
      return coincident_single_layer(x);
    case 2:
      return common_edge_single_layer(touching_pair(x, y), tolerance);
    case 1:
      return common_vertex_single_layer(touching_pair(x, y), tolerance);
    default:
      return near_single_layer(x, y, tolerance);
  }
}

/// From there on a rule on one panel with the closed form of the other is cheaper than rules on both.
constexpr int costly_degree = 11;

bool single_layer_is_far(FarDegrees degrees) {
  return degrees.enough() && (degrees.x < costly_degree || degrees.y < costly_degree);
}

/// Far pairs on their way, by their rules: as many as there are lanes are computed together.
template <class Result, class Compute, class Put>
class FarGroups {
 public:
  FarGroups(const Compute& compute, const Put& put) : compute_(compute), put_(put) {}

  void add(const PanelPair& pair, FarDegrees degrees, std::size_t at) {
    const std::size_t group = group_of(degrees), i = count_[group]++;
    pairs_[group][i] = pair;
    at_[group][i] = at;
    if (i + 1 == lanes) finish(degrees);
  }
  void finish() {
    for (int x = 0; x < kDegrees; ++x)
      for (int y = 0; y < kDegrees; ++y)
        if (count_[group_of({x, y})] > 0) finish({x, y});
  }

 private:
  static constexpr int kDegrees = max_degree + 1;
  static constexpr std::size_t kGroups = static_cast<std::size_t>(kDegrees) * kDegrees;

  static std::size_t group_of(FarDegrees degrees) {
    return static_cast<std::size_t>(degrees.x * kDegrees + degrees.y);
  }

  void finish(FarDegrees degrees) {
    const std::size_t group = group_of(degrees);
    std::array<Result, lanes> results;
    compute_(std::span<const PanelPair>(pairs_[group].data(), count_[group]), degrees, results.data());
    for (std::size_t i = 0; i < count_[group]; ++i)
      put_(at_[group][i], results[i]);
    count_[group] = 0;
  }

  const Compute& compute_;
  const Put& put_;
  std::array<unsigned char, kGroups> count_{};
  std::array<std::array<PanelPair, lanes>, kGroups> pairs_;  // as many as are counted
  std::array<std::array<std::size_t, lanes>, kGroups> at_;
};

/// X lies in the plane of Y, up to rounding.
bool in_one_plane(const Panel& x, const Panel& y) {
  const double noise = plane_noise(x, y);
  return std::all_of(x.x.begin(), x.x.end(),
                     [&](const Vec3& corner) { return std::abs(y.normal.dot(corner - y.x[0])) <= noise; });
}

Vec3 touching_double_layer(const TouchingPair& pair, int shared, double tolerance) {
  if (coplanar(pair.x, PanelPotential(pair.y, pair.normal_y, pair.noise), pair.noise)) return Vec3::Zero();
  const Vec3 turned =
      shared == 2 ? common_edge_double_layer(pair, tolerance) : common_vertex_double_layer(pair, tolerance);
  Vec3 result;
  for (int i = 0; i < 3; ++i)
    result[pair.y_corner[i]] = turned[i];
  return result;
}

/// Beyond this many radii a rule of degree 10 is exact to rounding, and the closed forms lose digits to
/// cancellation.
constexpr double far_point = 40;

bool is_far(const Vec3& x, const Panel& y) {
  return (x - y.center).norm() > far_point * y.radius;
}

PanelPotential potential_of(const Vec3& x, const Panel& y) {
  const double size = std::max(x.cwiseAbs().maxCoeff(), y.reach);
  return PanelPotential(y.x, y.normal, 8 * epsilon * size + y.noise);
}

}  // namespace

Panel make_panel(const Triangle& x, const std::array<NodeId, 3>& vertex) {
  Panel panel;
  panel.x = x;
  panel.vertex = vertex;
  const Vec3 area_vector = area_vector2(x[0], x[1], x[2]);
  const double double_area = area_vector.norm();
  panel.normal = area_vector / double_area;
  panel.area = 0.5 * double_area;
  panel.center = (x[0] + x[1] + x[2]) / 3;
  panel.radius =
      std::max({(x[0] - panel.center).norm(), (x[1] - panel.center).norm(), (x[2] - panel.center).norm()});
  panel.reach = largest_coordinate(x);
  panel.noise = 2 * epsilon * panel.radius * panel.radius * panel.radius / panel.area;
  return panel;
}

SharedCorners shared_corners(const Panel& x, const Panel& y) {
  SharedCorners shared;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (!x.vertex[i].valid() || x.vertex[i] != y.vertex[j]) continue;
      shared.in_x[shared.count] = i;
      shared.in_y[shared.count] = j;
      ++shared.count;
      break;
    }
  }
  return shared;
}

double plane_noise(const Panel& x, const Panel& y) {
  return 8 * epsilon * std::max(x.reach, y.reach) + x.noise + y.noise;
}

bool coplanar(const Triangle& x, const PanelPotential& y, double noise) {
  for (const Vec3& corner : x) {
    if (std::abs(y.height(corner)) > noise) return false;
  }
  return true;
}

TouchingPair touching_pair(const Panel& x, const Panel& y) {
  const SharedCorners shared = shared_corners(x, y);
  TouchingPair pair;
  pair.normal_x = x.normal;
  pair.normal_y = y.normal;
  pair.noise = plane_noise(x, y);
  pair.diameter = (x.center - y.center).norm() + x.radius + y.radius;
  std::array<int, 3> in_x, in_y;
  if (shared.count == 2) {
    in_x = {shared.in_x[0], shared.in_x[1], 3 - shared.in_x[0] - shared.in_x[1]};
    in_y = {shared.in_y[0], shared.in_y[1], 3 - shared.in_y[0] - shared.in_y[1]};
  } else {
    in_x = {shared.in_x[0], (shared.in_x[0] + 1) % 3, (shared.in_x[0] + 2) % 3};
    in_y = {shared.in_y[0], (shared.in_y[0] + 1) % 3, (shared.in_y[0] + 2) % 3};
  }
  const Vec3 origin = x.x[in_x[0]];
  for (int i = 0; i < 3; ++i) {
    pair.x[i] = x.x[in_x[i]] - origin;
    pair.y[i] = y.x[in_y[i]] - origin;
  }
  pair.x_corner = in_x;
  pair.y_corner = in_y;
  return pair;
}

PairIntegrator::PairIntegrator(double tolerance) : tolerance_(tolerance), far_(tolerance / 2) {
  if (!(tolerance >= 1e-11 && tolerance <= 1e-3)) {
    throw InputError("tolerance of the pair integrals must lie between 1e-11 and 1e-3");
  }
}

SingleLayerPair PairIntegrator::single_layer(const Panel& x, const Panel& y) const {
  const PanelPair pair{&x, &y};
  SingleLayerPair out;
  single_layer({&pair, 1}, &out);
  return out;
}

DoubleLayerPair PairIntegrator::double_layer(const Panel& x, const Panel& y) const {
  const PanelPair pair{&x, &y};
  DoubleLayerPair out;
  double_layer({&pair, 1}, &out);
  return out;
}

// Spheres around far panels do not meet, so that they share no corner.
void PairIntegrator::single_layer(std::span<const PanelPair> pairs, SingleLayerPair* out) const {
  const auto put = [&](std::size_t i, const Family& f) { out[i] = to_pair(f); };
  FarGroups<Family, decltype(far_single_layer), decltype(put)> groups(far_single_layer, put);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    PanelPair pair = pairs[i];
    if (!in_order(*pair.x, *pair.y)) std::swap(pair.x, pair.y);
    const FarDegrees degrees = far_degrees(far_, Layer::single, *pair.x, *pair.y);
    if (single_layer_is_far(degrees))
      groups.add(pair, degrees, i);
    else
      put(i, other_single_layer(*pair.x, *pair.y, tolerance_));
  }
  groups.finish();
}

void PairIntegrator::double_layer(std::span<const PanelPair> pairs, DoubleLayerPair* out) const {
  const auto put = [&](std::size_t i, const Vec3& v) { out[i] = to_pair(v); };
  FarGroups<Vec3, decltype(far_double_layer), decltype(put)> groups(far_double_layer, put);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Panel &x = *pairs[i].x, &y = *pairs[i].y;
    const FarDegrees degrees = far_degrees(far_, Layer::dbl, x, y);
    const int shared = degrees.enough() ? 0 : shared_corners(x, y).count;
    if (shared == 3 || (shared == 0 && in_one_plane(x, y)))
      put(i, Vec3::Zero());
    else if (shared > 0)
      put(i, touching_double_layer(touching_pair(x, y), shared, tolerance_));
    else if (degrees.enough())
      groups.add(pairs[i], degrees, i);
    else
      put(i, near_double_layer(x, y, tolerance_));
  }
  groups.finish();
}

bool same_integrals(const Panel& known_x, const Panel& known_y, const Panel& x, const Panel& y) {
  const SharedCorners before = shared_corners(known_x, known_y), now = shared_corners(x, y);
  if (before.count != now.count || in_order(known_x, known_y) != in_order(x, y)) return false;
  return std::equal(now.in_x.begin(), now.in_x.begin() + now.count, before.in_x.begin()) &&
         std::equal(now.in_y.begin(), now.in_y.begin() + now.count, before.in_y.begin());
}

SingleLayerPair single_layer_potential(const Vec3& x, const Panel& y) {
  if (!is_far(x, y)) return to_pair(potential_of(x, y).single_layer(x));
  Family sum = Family::Zero();
  for (const RulePoint& p : triangle_rule(10).points) {
    const Vec3 r = x - rule_point(y.x, p);
    const double square = r.squaredNorm(), value = p.weight * y.area / std::sqrt(square);
    sum[0] += value;
    sum.tail<6>() += symmetric_product(r, r, value / square);
  }
  return to_pair(sum);
}

DoubleLayerPair double_layer_potential(const Vec3& x, const Panel& y) {
  if (!is_far(x, y)) return to_pair(potential_of(x, y).double_layer(x));
  Vec3 sum = Vec3::Zero();
  for (const RulePoint& p : triangle_rule(10).points) {
    const Vec3 r = x - rule_point(y.x, p);
    const double square = r.squaredNorm();
    const double value = p.weight * y.area * y.normal.dot(x - y.x[0]) / (square * std::sqrt(square));
    sum += value * Vec3(p.l0, p.l1, p.l2);
  }
  return to_pair(sum);
}

}  // namespace conchoid

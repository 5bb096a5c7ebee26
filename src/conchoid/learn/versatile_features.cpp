#include "conchoid/learn/versatile_features.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "conchoid/crack/intensity/stress_intensity.hpp"
#include "conchoid/crack/law/criterion.hpp"

namespace conchoid {
namespace {

constexpr double kLeastGrowth = -4, kMostGrowth = 6;  // of ln S, in one frame
constexpr double kMostNetGrowth = 3;                  // of ln of what the ligament carries
// What reversing the normal (first) and mirroring (second) do to a quantity.
struct Parity {
  int reversed = 1, mirrored = 1;
  double sign(int image) const { return ((image & 1) ? reversed : 1) * ((image & 2) ? mirrored : 1); }
};
constexpr Parity even{1, 1}, two{-1, 1}, three{1, -1}, both{-1, -1};
constexpr std::array<Parity, 3> modes = {even, two, three};

struct Feature {
  const char* name;
  Parity parity;
};
constexpr std::array features_table = {Feature{"w_I", even},
                                       Feature{"w_II", two},
                                       Feature{"w_III", three},
                                       Feature{"nearby_I", even},
                                       Feature{"nearby_II", two},
                                       Feature{"nearby_III", three},
                                       Feature{"front_I", even},
                                       Feature{"front_II", two},
                                       Feature{"front_III", three},
                                       Feature{"slope_I", both},
                                       Feature{"slope_II", three},
                                       Feature{"slope_III", two},
                                       Feature{"turn_21", two},
                                       Feature{"turn_31", three},
                                       Feature{"turn_23", both},
                                       Feature{"kinked_I", even},
                                       Feature{"kinked_II", two},
                                       Feature{"r_before/r_bar", even},
                                       Feature{"r_after/r_bar", even},
                                       Feature{"ahead", even},
                                       Feature{"ahead_after", even},
                                       Feature{"wall", even},
                                       Feature{"wall_after", even},
                                       Feature{"curvature", even},
                                       Feature{"curvature_after", even},
                                       Feature{"r_bar/crack_radius", even},
                                       Feature{"ligament_share", even},
                                       Feature{"traction_I", even},
                                       Feature{"traction_II", two},
                                       Feature{"traction_III", three},
                                       Feature{"traction_after_I", even},
                                       Feature{"traction_after_II", two},
                                       Feature{"traction_after_III", three},
                                       Feature{"lateral_after_22", even},
                                       Feature{"lateral_after_33", even},
                                       Feature{"lateral_after_23", both},
                                       Feature{"stress_growth", even},
                                       Feature{"S/(S+stress)", even},
                                       Feature{"pull_12", two},
                                       Feature{"pull_13", three},
                                       Feature{"net_I", even},
                                       Feature{"net_II", two},
                                       Feature{"net_III", three},
                                       Feature{"taken_I", even},
                                       Feature{"taken_II", two},
                                       Feature{"taken_III", three},
                                       Feature{"net_growth", even},
                                       Feature{"net/stress", even},
                                       Feature{"net_12", two},
                                       Feature{"net_13", three},
                                       Feature{"force_I", even},
                                       Feature{"force_II", two},
                                       Feature{"force_III", three},
                                       Feature{"lever_I", three},
                                       Feature{"lever_II", both},
                                       Feature{"lever_III", even},
                                       Feature{"arms_growth", even},
                                       Feature{"S/(S+arms)", even},
                                       Feature{"across_distance", even},
                                       Feature{"across_lopsided", two},
                                       Feature{"ahead_across_distance", even},
                                       Feature{"ahead_across_lopsided", two},
                                       Feature{"behind_across_distance", even},
                                       Feature{"behind_across_lopsided", two},
                                       Feature{"along_distance", even},
                                       Feature{"along_lopsided", both},
                                       Feature{"poisson_ratio", even}};

Vec3 scaled(const Sample& s, const Vec3& K) {
  return {K[0], K[1], K[2] / std::sqrt(1 - s.poisson_ratio)};
}

// Its inverse.
Vec3 unscaled(const Sample& s, const Vec3& K) {
  return {K[0], K[1], K[2] * std::sqrt(1 - s.poisson_ratio)};
}

double size(const Sample& s, const Vec3& K) {
  return scaled(s, K).norm();
}

// S′.
double grown_size(double before, const Vec3& label) {
  return before * std::exp(std::clamp(label[0], kLeastGrowth, kMostGrowth));
}

// w_II that makes a front turn by −2 × half.
double shear_from(double half) {
  return kinking_intensity(-2 * half)[1];
}

// How fast that grows with half: dw_II/dθ = −K_I⁺ (K_I⁺ cos θ − 3 K_II sin θ) over the norm of (3 cos θ − 1, sin θ).
double shear_rate(double half) {
  const double angle = -2 * half, c = std::cos(angle), s = std::sin(angle);
  const auto [opened, slid] = kinking_intensity(angle);
  return 2 * opened * (opened * c - 3 * slid * s) / std::hypot(3 * c - 1, s);
}

// A vector over a size that may be zero.
Vec3 over(const Vec3& v, double by) {
  return by > 0 ? Vec3(v / by) : Vec3::Zero();
}

double closeness(double edge, double distance) {
  return edge / (edge + distance);
}

// |σ| of σ11 σ12 σ13 and σ22 σ33 σ23 (Frobenius).
double stress_size(const Vec3& traction, const Vec3& lateral) {
  return std::sqrt(traction[0] * traction[0] + lateral[0] * lateral[0] + lateral[1] * lateral[1] +
                   2 * (traction[1] * traction[1] + traction[2] * traction[2] + lateral[2] * lateral[2]));
}

// Angle from e1 of the greatest tension in a plane of e1, π/4 times −1 … 1.
double tension_angle(double normal, double across, double shear) {
  return shear == 0 && normal >= across ? 0 : 0.5 * std::atan2(2 * shear, normal - across);
}

// The frame after in that before, from three of its components: columns e1′, e2′, e3′.
Mat3 turned_frame(const Vec3& turn) {
  const double e21 = turn[0], e31 = turn[1], e23 = turn[2];
  const Vec3 e2(e21, std::sqrt(std::max(0.0, 1 - e21 * e21 - e23 * e23)), e23);
  Vec3 e3(0, 0, 1);
  e3 -= e3.dot(e2) * e2;
  if (!(e3.norm() > 0)) return Mat3::Identity();
  e3.normalize();
  // Turned about e2′ until e3′·e1 is right.
  const Vec3 a = cross(e2, e3);
  const double reach = std::hypot(e3[0], a[0]);
  if (reach > 0) {
    const double wanted = std::clamp(e31 / reach, -1.0, 1.0), phase = std::atan2(a[0], e3[0]);
    const double one = phase + std::acos(wanted), other = phase - std::acos(wanted);
    const auto wrapped = [](double x) { return std::remainder(x, 2 * std::numbers::pi); };
    const double angle = std::abs(wrapped(one)) < std::abs(wrapped(other)) ? one : other;
    e3 = std::cos(angle) * e3 + std::sin(angle) * a;
  }
  Mat3 frame;
  frame << cross(e2, e3), e2, e3;
  return frame;
}

// ln(after/before), where both are something.
double growth(double before, double after) {
  return before > 0 && after > 0 ? std::clamp(std::log(after / before), -kMostNetGrowth, kMostNetGrowth) : 0;
}

template <class Put>
void put_all(const Vec3& v, const Put& put) {
  for (int k = 0; k < 3; ++k)
    put(v[k]);
}

// @param S  of the K before; @param stress  |σ′|
template <class Put>
void put_net_section(const Sample& s, double S, double stress, const Put& put) {
  const Vec3 before = s.traction + s.taken_over, net = s.traction_after + s.taken_over_after;
  const double size = net.norm();
  put_all(over(net, size), put);
  put_all(over(s.taken_over_after, size + s.taken_over_after.norm()), put);
  put(growth(before.norm(), size));
  put(size + stress > 0 ? size / (size + stress) : 0);
  put(tension_angle(net[0], s.lateral_after[0], net[1]));
  put(tension_angle(net[0], s.lateral_after[1], net[2]));
  const double force = s.crack_force.norm();
  put_all(over(s.crack_force, force), put);
  put_all(over(s.crack_moment, force * s.crack_radius + s.crack_moment.norm()), put);
  put(growth(s.arms, s.arms_after));
  put(S + s.arms > 0 ? S / (S + s.arms) : 0);
}

// Pairs of sides: how close in the mean, and which of them is nearer: d/d⁻ − d/d⁺, d the smaller of both.
template <class Put>
void put_walls(const Sample& s, const Put& put) {
  for (std::size_t k = 0; k < kSides; k += 2) {
    const double one = s.beside[k], other = s.beside[k + 1], near = std::min(one, other);
    put((closeness(s.resolution, one) + closeness(s.resolution, other)) / 2);
    put(std::isfinite(near) && near > 0 ? near / other - near / one : 0);
  }
}

}  // namespace

std::vector<std::string> versatile_feature_names() {
  std::vector<std::string> names;
  for (const Feature& f : features_table)
    names.emplace_back(f.name);
  return names;
}

void versatile_features(const Sample& s, std::span<double> row) {
  std::size_t n = 0;
  const auto put = [&](double x) { row[n++] = x; };
  const double S = size(s, s.driving), r = s.resolution;
  const Vec3 w = over(scaled(s, s.driving), S), near = over(scaled(s, s.driving_nearby), S);
  put_all(w, put);
  put_all(near, put);
  put_all(over(scaled(s, s.driving_front), S), put);
  put_all(over(r * scaled(s, s.driving_slope), S), put);
  put_all(s.turn, put);
  const double kink = std::asin(std::clamp(s.turn[0], -1.0, 1.0)), c = std::cos(kink), h = std::cos(kink / 2);
  put(0.5 * h * (w[0] * (1 + c) - 3 * w[1] * std::sin(kink)));
  put(0.5 * h * (w[0] * std::sin(kink) + w[1] * (3 * c - 1)));
  put(s.distance_before / r);
  put(s.distance_after / r);
  for (const double distance :
       {s.surface_distance, s.surface_distance_after, s.wall_distance, s.wall_distance_after})
    put(closeness(r, distance));
  put(s.front_curvature * r);
  put(s.front_curvature_after * r);
  put(s.crack_radius > 0 ? r / s.crack_radius : 0);
  put(s.ligament_share);
  const double before = stress_size(s.traction, s.lateral),
               after = stress_size(s.traction_after, s.lateral_after);
  put_all(over(s.traction, before), put);
  put_all(over(s.traction_after, after), put);
  put_all(over(s.lateral_after, after), put);
  put(before > 0 && after > 0 ? std::log(after / before) : 0);
  const double load = after * std::sqrt(std::numbers::pi * s.crack_radius);
  put(S + load > 0 ? S / (S + load) : 0);
  put(tension_angle(s.traction_after[0], s.lateral_after[0], s.traction_after[1]));
  put(tension_angle(s.traction_after[0], s.lateral_after[1], s.traction_after[2]));
  put_net_section(s, S, after, put);
  put_walls(s, put);
  put(s.poisson_ratio);
}

void versatile_image(int image, std::span<double> row) {
  for (std::size_t c = 0; c < row.size(); ++c)
    row[c] *= features_table[c].parity.sign(image);
}

std::vector<std::string> versatile_label_names() {
  return {"ln S'/S", "-theta'/2", "w_III'"};
}

Vec3 versatile_label(const Sample& s) {
  const double before = size(s, s.driving), after = size(s, s.driving_after);
  if (!(before > 0 && after > 0)) return Vec3::Zero();
  const double turn = kink_angle(s.driving_after, {s.youngs_modulus, s.poisson_ratio});
  return {std::clamp(std::log(after / before), kLeastGrowth, kMostGrowth), -turn / 2,
          scaled(s, s.driving_after)[2] / after};
}

Vec3 versatile_label_image(int image, const Vec3& label) {
  Vec3 out = label;
  for (int k = 0; k < 3; ++k)
    out[k] *= modes[static_cast<std::size_t>(k)].sign(image);
  return out;
}

Vec3 versatile_driving(const Sample& s, const Vec3& label) {
  const double before = size(s, s.driving);
  if (!(before > 0)) return Vec3::Zero();
  Vec3 w(0, shear_from(label[1]), std::clamp(label[2], -1.0, 1.0));
  w[0] = std::sqrt(std::max(0.0, 1 - w[1] * w[1] - w[2] * w[2]));
  w.normalize();
  return unscaled(s, grown_size(before, label) * w);
}

Vec3 versatile_driving_spread(const Sample& s, const Vec3& label, const Vec3& label_spread) {
  const double shear = shear_rate(label[1]) * label_spread[1];
  return unscaled(s, grown_size(size(s, s.driving), label) * Vec3(0, shear, label_spread[2]));
}

Vec3 versatile_opening(const Sample& s, const Vec3& driving) {
  return turned_frame(s.turn) *
         opening_from_intensity(driving, s.distance_after, {s.youngs_modulus, s.poisson_ratio});
}

std::vector<std::string> versatile_fields() {
  return {"driving_I", "driving_after_I", "traction_I", "traction_after_I", "crack_radius", "wall_distance"};
}

}  // namespace conchoid

#include "conchoid/quadrature/potentials.hpp"

#include <algorithm>
#include <cmath>

namespace conchoid {

namespace {

/// ∫ 1/R along a segment seen from a point: s its coordinates along the line from the foot of the point, r
/// the distances of its ends, d2 = squared distance of the line. No branch subtracts nearly equal numbers. 0
/// where it diverges (the point lies on the segment): there it is always multiplied by a vanishing length.
double log_term(double s0, double s1, double r0, double r1, double length, double d2) {
  const double sum = r0 + r1;
  if (sum > 2 * length) return std::log1p(2 * length / (sum - length));
  double numerator, denominator;
  if (s0 >= 0) {
    numerator = r1 + s1;
    denominator = r0 + s0;
  } else if (s1 <= 0) {
    numerator = r0 - s0;
    denominator = r1 - s1;
  } else {
    numerator = (r1 + s1) * (r0 - s0);
    denominator = d2;
  }
  return denominator > 0 ? std::log(numerator / denominator) : 0.0;
}

/// [s/R] / d2 between the ends of a segment, = ∫ 1/R³.
double inverse_cube_term(double s0, double s1, double r0, double r1, double length, double d2) {
  if (s0 * s1 > 0) return length * (s0 + s1) / (r0 * r1 * (s1 * r0 + s0 * r1));
  return d2 > 0 ? (s1 / r1 - s0 / r0) / d2 : 0.0;
}

struct LineTerms {
  Vec3 along;         ///< unit direction a → b
  Vec3 offset;        ///< x minus its foot on the line
  double length, d2;  ///< of the segment; |offset|²
  double s0, s1;      ///< ends, along the line from the foot
  double r0, r1;      ///< distances of the ends
  double inverse_rise() const { return (r1 > 0 ? 1 / r1 : 0.0) - (r0 > 0 ? 1 / r0 : 0.0); }
};

LineTerms line_terms(const Vec3& x, const Vec3& a, const Vec3& b) {
  LineTerms line;
  const Vec3 ab = b - a;
  line.length = ab.norm();
  line.along = ab / line.length;
  const Vec3 to_a = a - x, to_b = b - x;
  line.s0 = line.along.dot(to_a);
  line.s1 = line.along.dot(to_b);
  line.r0 = to_a.norm();
  line.r1 = to_b.norm();
  line.offset = line.r0 <= line.r1 ? Vec3(line.s0 * line.along - to_a) : Vec3(line.s1 * line.along - to_b);
  line.d2 = line.offset.squaredNorm();
  return line;
}

}  // namespace

Eigen::Matrix<double, 6, 1> symmetric_product(const Vec3& a, const Vec3& b, double s) {
  Eigen::Matrix<double, 6, 1> r;
  r << s * a.x() * b.x(), s * a.y() * b.y(), s * a.z() * b.z(), 0.5 * s * (a.y() * b.z() + a.z() * b.y()),
      0.5 * s * (a.x() * b.z() + a.z() * b.x()), 0.5 * s * (a.x() * b.y() + a.y() * b.x());
  return r;
}

PanelPotential::PanelPotential(const Triangle& corners, const Vec3& normal, double noise)
    : corner_(corners), normal_(normal), noise_(noise) {
  const Vec3 area_vector = area_vector2(corners[0], corners[1], corners[2]);
  double_area_ = area_vector.norm();
  const double sense = area_vector.dot(normal) < 0 ? -1.0 : 1.0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 edge = corners[(i + 1) % 3] - corners[i];
    length_[i] = edge.norm();
    along_[i] = edge / length_[i];
    outward_[i] = sense * cross(along_[i], normal);
    height_[i] = double_area_ / length_[i];
  }
}

PanelPotential::Terms PanelPotential::terms(const Vec3& x, bool with_solid_angle) const {
  Terms q;
  const std::array<Vec3, 3> to = {corner_[0] - x, corner_[1] - x, corner_[2] - x};
  const std::array<double, 3> r = {to[0].norm(), to[1].norm(), to[2].norm()};
  const int nearest = r[0] <= r[1] ? (r[0] <= r[2] ? 0 : 2) : (r[1] <= r[2] ? 1 : 2);
  q.h = -normal_.dot(to[nearest]);
  if (std::abs(q.h) <= noise_) q.h = 0;
  const double height = std::abs(q.h);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const double s0 = along_[i].dot(to[i]), s1 = along_[i].dot(to[j]);
    const double p = outward_[i].dot(r[i] <= r[j] ? to[i] : to[j]);
    const double d2 = p * p + q.h * q.h;
    q.p[i] = p;
    q.f[i] = log_term(s0, s1, r[i], r[j], length_[i], d2);
    q.distance_rise[i] = length_[i] * (s0 + s1) / (r[i] + r[j]);
    q.distance_moment[i] = s1 * r[j] - s0 * r[i];
    if (with_solid_angle && height > 0) {
      const double d0 = d2 + height * r[i], d1 = d2 + height * r[j];
      q.solid_angle += std::atan2(p * (s1 * d0 - s0 * d1), d0 * d1 + p * p * s0 * s1);
    }
  }
  return q;
}

Family PanelPotential::single_layer(const Vec3& x) const {
  const Terms q = terms(x, true);
  const double cap = std::abs(q.h) * q.solid_angle;
  Vec3 log_sum = Vec3::Zero();
  double potential = -cap;
  Eigen::Matrix<double, 6, 1> tensor = Eigen::Matrix<double, 6, 1>::Zero();
  for (int i = 0; i < 3; ++i) {
    potential += q.p[i] * q.f[i];
    log_sum += q.f[i] * outward_[i];
    tensor -=
        symmetric_product(outward_[i], q.p[i] * q.f[i] * outward_[i] + q.distance_rise[i] * along_[i], 1.0);
  }
  tensor += symmetric_product(normal_, (cap - potential) * normal_ + (2 * q.h) * log_sum, 1.0);
  tensor.head<3>().array() += potential;
  Family result;
  result << potential, tensor;
  return result;
}

Vec3 PanelPotential::double_layer(const Vec3& x) const {
  const Terms q = terms(x, true);
  if (q.h == 0) return Vec3::Zero();
  const Vec3 log_sum = q.f[0] * outward_[0] + q.f[1] * outward_[1] + q.f[2] * outward_[2];
  const double omega = std::copysign(q.solid_angle, q.h);
  Vec3 result;
  for (int j = 0; j < 3; ++j) {
    const int e = (j + 1) % 3;
    result[j] = (q.p[e] * omega + q.h * outward_[e].dot(log_sum)) / height_[e];
  }
  return result;
}

Vec3 PanelPotential::gradient(const Vec3& x) const {
  const Terms q = terms(x, true);
  const double omega = q.h == 0 ? 0.0 : std::copysign(q.solid_angle, q.h);
  return -(omega * normal_ + q.f[0] * outward_[0] + q.f[1] * outward_[1] + q.f[2] * outward_[2]);
}

Vec3 PanelPotential::corner_functions(const Vec3& x) const {
  Vec3 result;
  for (int j = 0; j < 3; ++j) {
    const int e = (j + 1) % 3;
    result[j] = outward_[e].dot(corner_[e] - x) / height_[e];
  }
  return result;
}

double PanelPotential::height(const Vec3& x) const {
  return normal_.dot(x - corner_[0]);
}

Family line_single_layer(const Vec3& x, const Vec3& a, const Vec3& b) {
  const LineTerms q = line_terms(x, a, b);
  const double f = log_term(q.s0, q.s1, q.r0, q.r1, q.length, q.d2);
  const double cube = inverse_cube_term(q.s0, q.s1, q.r0, q.r1, q.length, q.d2);
  Family result;
  result << f, symmetric_product(q.offset, cube * q.offset + (2 * q.inverse_rise()) * q.along, 1.0) +
                   symmetric_product(q.along, q.along, f - cube * q.d2);
  return result;
}

LineField line_field(const Vec3& x, const Vec3& a, const Vec3& b) {
  const LineTerms q = line_terms(x, a, b);
  const double cube = inverse_cube_term(q.s0, q.s1, q.r0, q.r1, q.length, q.d2);
  const double f = log_term(q.s0, q.s1, q.r0, q.r1, q.length, q.d2);
  // With r = offset − s·along and ∫1/R³ = cube, ∫s/R³ = −[1/R], ∫s²/R³ = f − cube·d2; σ = (s − s0)/length.
  const double first = -q.inverse_rise();
  const double second = f - cube * q.d2;
  LineField field;
  field.total = cube * q.offset - first * q.along;
  field.toward_b =
      ((first - q.s0 * cube) / q.length) * q.offset - ((second - q.s0 * first) / q.length) * q.along;
  return field;
}

}  // namespace conchoid

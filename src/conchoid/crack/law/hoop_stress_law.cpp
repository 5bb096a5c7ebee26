#include "conchoid/crack/law/hoop_stress_law.hpp"

#include "conchoid/crack/law/criterion.hpp"

namespace conchoid {

double HoopStressLaw::drive(const Vec3& K) const {
  return effective_intensity(treated(K), m_);
}

double HoopStressLaw::direction(const Vec3& K) const {
  return kink_angle(treated(K), m_);
}

double HoopStressLaw::length(double drive, double toughness, double resolution) const {
  return advance_length(drive, toughness, resolution);
}

double HoopStressLaw::deflection(double fall, double drive, double toughness) const {
  return toughness_deflection(fall, drive, toughness);
}

/// Closed faces are seen to by effective_intensity() and kink_angle() themselves.
Vec3 HoopStressLaw::treated(const Vec3& K) const {
  return compressive_factor_ ? with_compressive_factor(K, *compressive_factor_) : K;
}

}  // namespace conchoid

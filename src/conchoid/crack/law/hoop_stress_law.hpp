#pragma once

#include <optional>

#include "conchoid/crack/law/growth_law.hpp"
#include "conchoid/elastic/constants.hpp"

namespace conchoid {

/// Maximum hoop stress (Erdogan & Sih 1963), with the speed and the deflection by toughness of criterion.hpp.
/// docs/theory.md (S4)–(S6), (S8)
class HoopStressLaw final : public GrowthLaw {
 public:
  /// @param compressive_factor  compressive over tensile strength, ≥ 1: compression drives the crack too
  ///     (with_compressive_factor). None: closed faces only slide (with_closed_faces).
  explicit HoopStressLaw(const ElasticConstants& m, std::optional<double> compressive_factor = std::nullopt)
      : m_(m), compressive_factor_(compressive_factor) {}

  double drive(const Vec3& K) const override;
  double direction(const Vec3& K) const override;
  double length(double drive, double toughness, double resolution) const override;
  double deflection(double fall, double drive, double toughness) const override;

 private:
  Vec3 treated(const Vec3& K) const;

  ElasticConstants m_;
  std::optional<double> compressive_factor_;
};

}  // namespace conchoid

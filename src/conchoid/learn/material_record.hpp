#pragma once

#include <string>

namespace conchoid {

/// The material of the runs that samples come from.
struct MaterialRecord {
  double youngs_modulus = 0;      ///< E [Pa]
  double poisson_ratio = 0;       ///< ν
  double density = 0;             ///< [kg/m³]
  double strength = 0;            ///< tensile strength [Pa]
  double toughness = 0;           ///< K_c [Pa√m]
  double compressive_factor = 0;  ///< ratio of compressive to tensile strength
  bool operator==(const MaterialRecord&) const = default;
};

/// As a JSON object: the names above and their values.
std::string json_text(const MaterialRecord& material);

}  // namespace conchoid

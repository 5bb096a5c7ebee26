#pragma once

#include <string_view>
#include <vector>

namespace conchoid {

/// Constants of a brittle material: representative values from handbooks; real ones scatter, most of all
/// strength.
struct NamedMaterial {
  std::string_view name;
  double youngs_modulus;  ///< [Pa]
  double poisson_ratio;
  double density;    ///< [kg/m³]
  double strength;   ///< tensile [Pa]
  double toughness;  ///< K_Ic [Pa√m]
  std::string_view source;
};

/// All of them, in alphabetical order.
const std::vector<NamedMaterial>& named_materials();
/// The material of that name, or nullptr.
const NamedMaterial* find_material(std::string_view name);

}  // namespace conchoid

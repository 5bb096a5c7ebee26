#include "conchoid/material/library.hpp"

#include <algorithm>

namespace conchoid {

const std::vector<NamedMaterial>& named_materials() {
  static const std::vector<NamedMaterial> materials = {
      {"ceramic", 372e9, 0.22, 3890, 262e6, 4.0e6,
       "sintered alumina, 99.5 % dense. E, ρ, tensile strength, K_Ic: Dowling, Mechanical Behavior of "
       "Materials, tables 3.10 and 8.2; ν: Callister & Rethwisch, Materials Science and Engineering, app. B"},
      {"concrete", 33e9, 0.20, 2400, 2.9e6, 1.19e6,
       "C30/37. E, ν, mean tensile strength: EN 1992-1-1, 3.1; ρ: Callister & Rethwisch, app. B; K_Ic: "
       "Dowling, table 8.2"},
      {"glass", 70e9, 0.20, 2500, 45e6, 0.75e6,
       "float glass. E, ν, ρ: EN 572-1; characteristic bending strength: EN 16612; K_Ic: Callister & "
       "Rethwisch, app. B"},
      {"ice", 9.3e9, 0.325, 917, 1.4e6, 0.1e6,
       "polycrystalline freshwater ice at −10 °C. E, ν: Gammon et al., J. Glaciol. 29 (1983); ρ: Schulson & "
       "Duval, Creep and Fracture of Ice, 2009; tensile strength, K_Ic: Petrovic, J. Mater. Sci. 38 (2003)"},
      {"marble", 49e9, 0.23, 2700, 6.9e6, 0.64e6,
       "Carrara. Atkinson & Meredith, in Fracture Mechanics of Rock, 1987"},
      {"plaster", 4.5e9, 0.24, 1100, 4.0e6, 0.13e6,
       "set gypsum, half of it pores. Vekinis, Ashby & Beaumont, J. Mater. Sci. 28 (1993); Coquard et al., "
       "J. "
       "Eur. Ceram. Soc. 17 (1997)"},
      {"sandstone", 14.4e9, 0.20, 2100, 1.2e6, 0.28e6,
       "Berea. E, ν: Detournay & Cheng, Comprehensive Rock Engineering II, 1993; tensile strength: Goodman, "
       "Introduction to Rock Mechanics, 1989; K_Ic: Atkinson, J. Geophys. Res. 89 (1984)"},
      {"soda-lime", 69e9, 0.23, 2500, 69e6, 0.76e6,
       "soda-lime glass, fresh surface. E, ν, ρ, flexural strength: Callister & Rethwisch, app. B; K_Ic: "
       "Dowling, table 8.2"},
  };
  return materials;
}

const NamedMaterial* find_material(std::string_view name) {
  const auto& all = named_materials();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const NamedMaterial& m) { return m.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace conchoid

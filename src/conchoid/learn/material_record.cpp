#include "conchoid/learn/material_record.hpp"

#include <nlohmann/json.hpp>

namespace conchoid {

std::string json_text(const MaterialRecord& m) {
  return nlohmann::json{{"youngs_modulus", m.youngs_modulus},
                        {"poisson_ratio", m.poisson_ratio},
                        {"density", m.density},
                        {"strength", m.strength},
                        {"toughness", m.toughness},
                        {"compressive_factor", m.compressive_factor}}
      .dump();
}

}  // namespace conchoid

#include "conchoid/sim/resolution_floor.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

/// Upward, to two digits.
double rounded_up(double x) {
  const double unit = std::pow(10, std::floor(std::log10(x)) - 1);
  return std::ceil(x / unit) * unit;
}

}  // namespace

void require_affordable(const std::string& where, const std::string& key, double edge, double area,
                        double most) {
  const double of_unit_edge = area * 4 / std::numbers::sqrt3;
  const double count = of_unit_edge / (edge * edge);
  if (!(count > most)) return;
  throw InputError(
      fmt::format("{}: {} = {:g} m is too fine: a crack of {:.3g} m² would have about {:.2g} triangles, "
                  "more than {:g}; use {:.2g} or more",
                  where, key, edge, area, count, most, rounded_up(std::sqrt(of_unit_edge / most))));
}

}  // namespace conchoid

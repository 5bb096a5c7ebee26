#include "conchoid/material/material_field.hpp"

namespace conchoid {

MaterialField::MaterialField(std::vector<FieldFactor> factors, const FieldFrame& frame) {
  for (FieldFactor& factor : factors) {
    const Vec3 at_rest = factor.placement.origin.value_or(frame.center);
    const Vec3 origin = frame.turn.transpose() * (at_rest - frame.shift) - frame.origin;
    factor.placement.axes = frame.turn.transpose() * factor.placement.axes;
    factors_.push_back({std::move(factor), origin});
  }
}

MaterialField::MaterialField(std::vector<FieldFactor> factors, const Vec3& center)
    : MaterialField(std::move(factors), FieldFrame{.center = center, .origin = center}) {}

FieldSample MaterialField::at(const Vec3& x) const {
  FieldSample product;
  for (const auto& [factor, origin] : factors_) {
    const Mat3& axes = factor.placement.axes;
    const Vec3 local = axes.transpose() * (x - origin);
    const FieldSample f = std::visit([&](const auto& kind) { return kind.at(local); }, factor.kind);
    product.gradient = f.value * product.gradient + product.value * (axes * f.gradient);
    product.value *= f.value;
  }
  return product;
}

}  // namespace conchoid

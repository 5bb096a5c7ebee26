#include "conchoid/material/material_field.hpp"

namespace conchoid {

MaterialField::MaterialField(std::vector<FieldFactor> factors, const Vec3& center) {
  for (FieldFactor& factor : factors) {
    const Vec3 origin = factor.placement.origin ? Vec3(*factor.placement.origin - center) : Vec3::Zero();
    factors_.push_back({std::move(factor), origin});
  }
}

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

#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "conchoid/material/grains.hpp"
#include "conchoid/material/layers.hpp"
#include "conchoid/material/noise.hpp"
#include "conchoid/material/voxels.hpp"

namespace conchoid {

/// Where a field lies in the body: the field's point ξ is at  origin + axes · ξ.
struct FieldPlacement {
  std::optional<Vec3> origin;    ///< [m], in the scene's coordinates; none: the centre of the body
  Mat3 axes = Mat3::Identity();  ///< columns: the field's axes, orthonormal (a mirror image is allowed)
};

/// One factor of a material field, as a scene gives it.
struct FieldFactor {
  std::variant<Layers, Grains, Noise, Voxels> kind;
  FieldPlacement placement;
};

/// Where a body lies in its material: a point x that is asked for has the rest position turn · (x + origin) +
/// shift; fields without a place of their own lie at `center`, at rest.
struct FieldFrame {
  Mat3 turn = Mat3::Identity();  ///< a rotation
  Vec3 shift = Vec3::Zero();     ///< [m]
  Vec3 center = Vec3::Zero();    ///< [m]
  Vec3 origin = Vec3::Zero();    ///< of the points asked for, in the body's coordinates [m]
};

/// How a constant of the material varies in the body: the product of factors, 1 everywhere without any.
/// Values > 0; value and gradient belong together (C¹). Moving, turning, mirroring or scaling the body and
/// the factors' lengths and placements carries the values along; by a power of two bit for bit.
class MaterialField {
 public:
  MaterialField() = default;
  MaterialField(std::vector<FieldFactor> factors, const FieldFrame& frame);
  /// A body at rest. @param center  of it, in the scene's coordinates: the origin of the points asked for
  MaterialField(std::vector<FieldFactor> factors, const Vec3& center);

  /// The field is 1 everywhere.
  bool homogeneous() const { return factors_.empty(); }
  /// @param x  relative to the body's centre [m]
  FieldSample at(const Vec3& x) const;

 private:
  struct Placed {
    FieldFactor factor;
    Vec3 origin;  // relative to the body's centre
  };
  std::vector<Placed> factors_;
};

}  // namespace conchoid

#pragma once

#include <Eigen/Core>

#include "conchoid/quadrature/potentials.hpp"

namespace conchoid {

/// Points in arrays, as many as a Kronrod rule has and one more, to fill the lanes.
struct Points {
  static constexpr int most = 16;
  int padded = most;  ///< how many are filled in, a multiple of the lanes
  alignas(32) double at[3][most];
};

/// N values at each of them.
template <int N>
struct PointValues {
  alignas(32) double of[N][Points::most];
};

/// The potentials of PanelPotential at several points at once.
class PointPotentials {
 public:
  explicit PointPotentials(const PanelPotential& panel);

  /// The single-layer family, tensors in the panel's own axes: they are turned once an integral is summed up.
  void single_layer(const Points& x, PointValues<7>& result) const;
  Family in_space(const Family& in_own_axes) const;
  const Mat3& axes() const { return axes_; }  ///< columns
  /// ∫_Y N_j n·(x−y)/R³ for the three corners.
  void double_layer(const Points& x, PointValues<3>& result) const;
  /// a · ∫_Y (y−x)/R³ dy.
  void gradient_along(const Vec3& a, const Points& x, PointValues<1>& result) const;

  /// What the integrals over panels in a parallel plane come down to at its edges (parallel.cpp): with m of the
  /// edges f of Y in own axes, h the height of x
  ///   a = Σ m ∫_f R ,  b = Σ m ∫_f log((R+|h|)/D) ,  V = ∫_Y 1/R ,  ψ = ∫_Y log((R+|h|)/D)
  /// as a₀ a₁ b₀ b₁ V ψ.
  /// @param D  any length of the size of the pair
  void contour(const Points& x, double D, PointValues<6>& result) const;

  /// Plain numbers, as the loops over points want them. Own axes: along edge 0, outward from it, normal.
  struct Numbers {
    double corner[3][3], normal[3], along[3][3], outward[3][3];  ///< [edge or corner][axis in space]
    double length[3], height[3];
    double m[3][2], t[3][2];  ///< outward and along, in own axes
    double noise;
  };

 private:
  Numbers q_;
  Mat3 axes_;
};

/// A segment's potentials at several points at once: as line_single_layer, and n·total and n·toward_b of
/// line_field.
void line_single_layer(const Points& x, const Vec3& a, const Vec3& b, PointValues<7>& result);
void line_field_along(const Vec3& n, const Points& x, const Vec3& a, const Vec3& b, PointValues<2>& result);

}  // namespace conchoid

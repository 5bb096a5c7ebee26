#pragma once

#include <Eigen/Core>
#include <array>

#include "conchoid/core/vec.hpp"

namespace conchoid {

/// One value of every member of the single-layer family: 1/R, then r_i r_j/R³ as xx yy zz yz xz xy.
using Family = Eigen::Matrix<double, 7, 1>;

/// s · (a bᵀ + b aᵀ)/2 in the order xx yy zz yz xz xy.
Eigen::Matrix<double, 6, 1> symmetric_product(const Vec3& a, const Vec3& b, double s);

/// The potentials of one flat triangle Y in closed form, at any point x whatsoever.
///
/// Notation, for a point x and its foot ρ in the plane of Y: h = n·(x−y) height, t and m the direction and
/// the outward in-plane normal of an edge, p = m·(edge−x) distance of ρ from the edge (> 0 inside), s± =
/// t·(ends−x), R± distances of the ends, f = ∫_edge 1/R, F = Σ m f, Ω the solid angle under which Y is seen
/// (≥ 0). Then (Wilton et al. 1984; Graglia 1993)
///   ∫_Y 1/R        = Σ p f − |h| Ω
///   ∫_Y r rᵀ/R³    = |h| Ω n nᵀ + h (n Fᵀ + F nᵀ) + (I − n nᵀ) ∫_Y 1/R − Σ (p f m mᵀ + (R₊−R₋)(m tᵀ + t
///   mᵀ)/2) ∫_Y N_j h/R³   = (p_e sgn(h) Ω + h m_e·F) / H_e,   e the edge opposite corner j, H_e its height.
///   docs/theory.md (Q3)
class PanelPotential {
 public:
  /// @param corners in either sense around the normal
  /// @param noise  heights |h| up to this count as 0: the rounding of the coordinates' own plane
  PanelPotential(const Triangle& corners, const Vec3& normal, double noise);

  /// ∫_Y of the single-layer family at x.
  Family single_layer(const Vec3& x) const;
  /// ∫_Y N_j n·(x−y)/R³ for the three corners; 0 in the plane of Y (principal value).
  Vec3 double_layer(const Vec3& x) const;
  /// ∫_Y (y−x)/R³ dy, the gradient of ∫_Y 1/R; in the plane of Y the principal value.
  Vec3 gradient(const Vec3& x) const;

  // The same with polynomial densities (polynomial_potentials.cpp), N_j as corner_functions(). With the foot ρ of
  // x, s = y − ρ, f, p, m, t as above and A = ∫ s/R, F = Σ m f, S = ∫ s sᵀ/R³ = I₀ (I − n nᵀ) − Σ (p f m + (R₊−R₋) t) mᵀ,
  //   ∫ (g·s) s sᵀ/R³ = A gᵀ + (g·A) (I − n nᵀ) − Σ [∫_e (g·s) s/R] mᵀ ,   ∫ s/R³ = −F.        docs/theory.md (Q6)
  /// ∫_Y of the single-layer family times 1, N_1, N_2: one column each.
  Eigen::Matrix<double, 7, 3> linear_single_layer(const Vec3& x) const;
  /// ∫_Y n·(x−y)/R³ times 1, N_1, N_2, N_1², N_1 N_2, N_2²; 0 in the plane of Y.
  Eigen::Matrix<double, 6, 1> quadratic_double_layer(const Vec3& x) const;
  /// ∫_Y (y−x)/R³ times 1, N_1, N_2: one column each.
  Eigen::Matrix<double, 3, 3> linear_gradient(const Vec3& x) const;
  /// The three corner functions N_j at the foot of x (affine beyond the panel).
  Vec3 corner_functions(const Vec3& x) const;

  double height(const Vec3& x) const;                     ///< n·(x − Y)
  const Vec3& corner(int i) const { return corner_[i]; }  ///< edge i runs from corner i to i+1
  const Vec3& edge_normal(int i) const { return outward_[i]; }
  const Vec3& edge_direction(int i) const { return along_[i]; }
  const Vec3& normal() const { return normal_; }
  double edge_length(int i) const { return length_[i]; }
  double double_area() const { return double_area_; }
  double noise() const { return noise_; }

 private:
  /// What every potential needs of one point.
  struct Terms {
    double h;
    double solid_angle = 0;
    std::array<double, 3> p, f, distance_rise, distance_moment;  ///< per edge; R₊−R₋, s₊R₊−s₋R₋
  };
  Terms terms(const Vec3& x, bool with_solid_angle) const;

  Triangle corner_;
  Vec3 normal_;
  std::array<Vec3, 3> along_, outward_;
  std::array<double, 3> length_, height_;
  double double_area_;
  double noise_;
};

/// ∫_{y ∈ ab} of the single-layer family at x.                                              docs/theory.md
/// (Q4)
Family line_single_layer(const Vec3& x, const Vec3& a, const Vec3& b);

/// ∫_{y ∈ ab} (x−y)/R³ ds and ∫_{y ∈ ab} σ (x−y)/R³ ds, σ running from 0 at a to 1 at b.
struct LineField {
  Vec3 total;
  Vec3 toward_b;
};
LineField line_field(const Vec3& x, const Vec3& a, const Vec3& b);

}  // namespace conchoid

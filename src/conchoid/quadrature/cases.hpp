#pragma once

#include <array>
#include <span>
#include <vector>

#include "conchoid/quadrature/far_rules.hpp"
#include "conchoid/quadrature/pair_integrals.hpp"
#include "conchoid/quadrature/potentials.hpp"

/// The cases a pair of panels falls into, one file each. All but the far one rest on one identity. Let c be a
/// point of both planes. The kernel k(x−y), homogeneous of degree q, is homogeneous about (c, c) in the four
/// variables of X×Y, so div(k·(x−c, y−c)) = (4+q) k, and the integral moves to the boundary of X×Y:
///
///   (4+q) ∫_X∫_Y k = Σ_{edges e of X} d_e ∫_e ∫_Y k  +  Σ_{edges e of Y} d_e ∫_e ∫_X k, docs/theory.md (Q5)
///
/// d_e = outward distance of edge e from c. The inner integrals are the closed forms of potentials.hpp; edges
/// that contain c drop out; what remains are integrals along edges, and where those still meet the other
/// panel in a point the same step is taken again. This is the radial integration of Sauter & Schwab's
/// regularising coordinates, carried to closed forms (Lenoir & Salles, SIAM J. Sci. Comput. 34, 2012). No
/// thinness of the panels and no dihedral angle makes it inexact.
namespace conchoid {

/// A pair as the touching cases see it: X = (x0 x1 x2) and Y = (y0 y1 y2) turned so that shared corners come
/// first (x0 = y0; common edge: also x1 = y1), and moved so that x0 is the origin.
struct TouchingPair {
  Triangle x, y;
  Vec3 normal_x, normal_y;
  std::array<int, 3> x_corner, y_corner;  ///< which corners of the original panels x[i] and y[i] are
  double noise;                           ///< heights that are rounding
  double diameter;                        ///< no two points of the pair are farther apart
};
TouchingPair touching_pair(const Panel& x, const Panel& y);

struct SharedCorners {
  int count = 0;
  std::array<int, 3> in_x{}, in_y{};
};
/// Corners with the same valid id. Invalid ids are never shared.
SharedCorners shared_corners(const Panel& x, const Panel& y);

/// Heights that are rounding of the coordinates' own plane: 0 as far as the side of a plane is concerned.
double plane_noise(const Panel& x, const Panel& y);
/// Every corner of X lies in the plane of Y up to `noise`.
bool coplanar(const Triangle& x, const PanelPotential& y, double noise);

Family coincident_single_layer(const Panel& x);

Family common_edge_single_layer(const TouchingPair& pair, double tolerance);
Vec3 common_edge_double_layer(const TouchingPair& pair, double tolerance);

Family common_vertex_single_layer(const TouchingPair& pair, double tolerance);
Vec3 common_vertex_double_layer(const TouchingPair& pair, double tolerance);

Family near_single_layer(const Panel& x, const Panel& y, double tolerance);
Vec3 near_double_layer(const Panel& x, const Panel& y, double tolerance);

/// Near pairs by cells on the smaller panel and closed forms of the other; false where that takes more than `budget`
/// points.
bool cells_single_layer(const Panel& x, const Panel& y, double tolerance, int budget, Family& sum);
bool cells_double_layer(const Panel& x, const Panel& y, double tolerance, int budget, Vec3& sum);

/// Two panels in parallel planes at the distance |h|, which may be 0. There Δ(R − |h| log(R+|h|)) = 1/R and
/// ∂_i ∂_j R = δ_ij/R − s_i s_j/R³ in the planes, so that both areas go over into their edges:    docs/theory.md (Q7)
///   ∫_X∫_Y 1/R = −Σ_e Σ_f (m_e·m_f) ∫_e∫_f (R − |h| log(R+|h|))
///   ∫_X∫_Y s sᵀ/R³ = I ∫_X∫_Y 1/R + Σ_e Σ_f m_e m_fᵀ ∫_e∫_f R ,   ∫_X∫_Y h s/R³ = −h Σ_e m_e ∫_e∫_Y 1/R
/// and with ψ = ∫_Y log(R+|h|), whose Laplacian is the solid angle of Y, by Green's second identity
///   ∫_X∫_Y N_j |h|/R³ = Σ_e ∫_e ( N_j m_e·∇ψ − (m_e·∇N_j) (ψ − |h| ∫_Y 1/R) )
/// The inner integral is a closed form, the integrand along e without singularities.
struct ParallelPair {
  const PanelPotential &x, &y;
  double diameter;  ///< no two points of the pair are farther apart
};
/// How many times larger than the integrals the terms are.
double parallel_loss(const ParallelPair& pair);
Family parallel_single_layer(const ParallelPair& pair, double tolerance);
Vec3 parallel_double_layer(const ParallelPair& pair, double tolerance);

/// Degrees of the triangle rules for X and Y that reach the tolerance; 0: none does.
struct FarDegrees {
  int x = 0, y = 0;
  bool enough() const { return x > 0 && y > 0; }
};
/// @param limits  of half the tolerance
FarDegrees far_degrees(const FarLimits& limits, Layer layer, const Panel& x, const Panel& y);
/// Pairs that take the same rules, up to `lanes` (lanes.hpp) of them side by side: the bits of one do not depend on the others.
void far_single_layer(std::span<const PanelPair> pairs, FarDegrees degrees, Family* out);
void far_double_layer(std::span<const PanelPair> pairs, FarDegrees degrees, Vec3* out);

}  // namespace conchoid

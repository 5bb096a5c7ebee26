#pragma once

#include <array>
#include <span>

#include "conchoid/core/ids.hpp"
#include "conchoid/core/vec.hpp"
#include "conchoid/quadrature/far_rules.hpp"

namespace conchoid {

/// A flat triangle as the integrals see it: geometry plus the vertex ids that tell which panels touch.
struct Panel {
  Triangle x;                    ///< corners
  std::array<NodeId, 3> vertex;  ///< two panels share a vertex exactly when they share its id
  Vec3 normal;                   ///< unit
  double area;
  Vec3 center;    ///< centroid
  double radius;  ///< of the sphere around `center` that holds the panel
  double reach;   ///< largest of the corners' coordinates, without sign
  double noise;   ///< rounding of the normal times the panel's size: large for thin panels [m]
};
Panel make_panel(const Triangle& x, const std::array<NodeId, 3>& vertex);

/// Two panels whose integrals are asked for.
struct PanelPair {
  const Panel *x, *y;
};

/// The seven numbers of a panel pair to which V and D reduce, R = |x−y|:
/// laplace = ∫_X∫_Y 1/R,  tensor = ∫_X∫_Y (x−y)_i (x−y)_j / R³ as xx yy zz yz xz xy.   docs/theory.md (Q1)
struct SingleLayerPair {
  double laplace = 0;
  std::array<double, 6> tensor{};
};

/// ∫_{x∈X} ∫_{y∈Y} N_j(y) ∂/∂n_y (1/R) for the three corner functions N_j of Y.          docs/theory.md (Q2)
/// ∂/∂n_y (1/R) = n_y·(x−y)/R³. Principal value: 0 when X and Y are coplanar.
using DoubleLayerPair = std::array<double, 3>;

/// Integrals over pairs of flat panels in any position: equal, sharing an edge or a vertex, close to,
/// touching or crossing each other without a shared vertex, or far apart. The case is chosen from vertex ids
/// and distance.
class PairIntegrator {
 public:
  /// @param tolerance  wanted relative error of a pair's integrals, 1e-3 … 1e-11
  explicit PairIntegrator(double tolerance = 1e-7);

  SingleLayerPair single_layer(const Panel& x, const Panel& y) const;
  DoubleLayerPair double_layer(const Panel& x, const Panel& y) const;

  /// The same of many pairs, to the last bit: far ones with the same rules are computed side by side, up to four times as fast.
  /// @pre one place in `out` for each
  void single_layer(std::span<const PanelPair> pairs, SingleLayerPair* out) const;
  void double_layer(std::span<const PanelPair> pairs, DoubleLayerPair* out) const;

 private:
  double tolerance_;
  FarLimits far_;
};

/// Whether the pair (x, y) has the integrals of (known_x, known_y) to the last bit, where the corners of the
/// panels are the same in the same order: the same vertices are shared, and the two stand in the same order.
bool same_integrals(const Panel& known_x, const Panel& known_y, const Panel& x, const Panel& y);

/// Potentials of one panel at a point x (closed forms), for stress and displacement inside:
/// ∫_Y 1/R, and its companions; used as the inner integral of near pairs and by tests as an oracle.
SingleLayerPair single_layer_potential(const Vec3& x, const Panel& y);
DoubleLayerPair double_layer_potential(const Vec3& x, const Panel& y);

}  // namespace conchoid

#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "conchoid/quadrature/potentials.hpp"

namespace conchoid {

/// A triangle one edge of which (corner 0 to corner 1) the integrand may be steep at.
struct GradedPiece {
  Triangle corners;
  double double_area;
};

/// Cuts `outer` along the edge lines of `source` seen down its normal, so that the potentials of a source at
/// a tiny gap are smooth inside each piece and steep only at its first edge. The pieces cover the triangle.
std::vector<GradedPiece> cut_along_edges(const Triangle& outer, const PanelPotential& source);

/// Nodes and weights of a composite Gauss rule on [0, 1] whose intervals shrink by 4 toward 0 (and by
/// symmetry toward 1).
struct GradedNode {
  double t, weight;
};
std::vector<GradedNode> graded_toward_start(int levels, int order);
std::vector<GradedNode> graded_toward_ends(int levels, int order);

/// ∫ over `outer` of a potential of `source`, a panel nearly parallel at a gap far below its size.
template <int N, class F>
Eigen::Matrix<double, N, 1> integrate_graded(const Triangle& outer, const PanelPotential& source,
                                             double tolerance, const F& potential) {
  const double gap = std::min({std::abs(source.height(outer[0])), std::abs(source.height(outer[1])),
                               std::abs(source.height(outer[2]))});
  // Finer than this the layer at an edge no longer counts.
  const int useful = static_cast<int>(std::ceil(-std::log2(tolerance) / 2)) + 1;
  // Each interval sees the steep edge from a third of its length: Gauss converges by 9 per point.
  const int order = static_cast<int>(std::ceil(-0.8 * std::log10(tolerance))) + 3;
  const auto levels = [&](double scale) {
    if (!(scale < 1)) return 0;
    return static_cast<int>(std::min(std::ceil(-std::log2(std::max(scale, 1e-300)) / 2), double(useful)));
  };
  std::vector<std::vector<GradedNode>> across, along;
  for (int k = 0; k <= useful; ++k) {
    across.push_back(graded_toward_start(k, order));
    along.push_back(graded_toward_ends(k, order));
  }
  Eigen::Matrix<double, N, 1> sum = Eigen::Matrix<double, N, 1>::Zero();
  for (const GradedPiece& piece : cut_along_edges(outer, source)) {
    const double length = (piece.corners[1] - piece.corners[0]).norm();
    const double height = piece.double_area / length;
    for (const GradedNode& a : across[static_cast<std::size_t>(levels(gap / height))]) {
      // At that depth the ends of the edge are felt on the scale of the depth, or of the gap where it is
      // larger.
      Eigen::Matrix<double, N, 1> row = Eigen::Matrix<double, N, 1>::Zero();
      for (const GradedNode& b :
           along[static_cast<std::size_t>(levels(std::max(a.t * height, gap) / length))]) {
        const Vec3 base = (1 - b.t) * piece.corners[0] + b.t * piece.corners[1];
        row += b.weight * potential((1 - a.t) * base + a.t * piece.corners[2]);
      }
      sum += (a.weight * (1 - a.t) * piece.double_area) * row;
    }
  }
  return sum;
}

}  // namespace conchoid

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "conchoid/bem/cracked_body.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/mesh/models.hpp"

namespace conchoid {
namespace {

/// Openings of a disc in a box of this height that is held at one side, pulled and sheared at the other.
std::vector<Vec3> openings(double height, int layers, const Vec3& center, double tolerance) {
  const TriMesh box = box_mesh({1, 1, height}, 6, 6, layers);
  BoundaryData data = free_surface(box);
  for (std::size_t t = 0; t < box.triangle_count(); ++t) {
    const double x = unit_normal(box, TriId(t)).x();
    if (x > 0.9) data.traction[t] = {1e6, 0, 5e5};
    if (x < -0.9) data.kind[t] = BoundaryKind::displacement;
  }
  CrackedBody body =
      make_cracked_body(box, data, {3.1e9, 0.327}, {}, BemSettings{.quadrature_tolerance = tolerance});
  const TriMesh disc = disc_crack(center, Vec3(1, 0.2, 0).normalized(), 0.25, {.edge = 0.08});
  body.set_crack(corefine(box, disc, {.merge = 0.1}));
  body.solve();
  return {body.opening().begin(), body.opening().end()};
}

double largest_move(double height, int layers, const Vec3& center) {
  const std::vector<Vec3> exact = openings(height, layers, center, 1e-9);
  const std::vector<Vec3> usual = openings(height, layers, center, BemSettings{}.quadrature_tolerance);
  double move = 0, largest = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    move = std::max(move, (usual[i] - exact[i]).norm());
    largest = std::max(largest, exact[i].norm());
  }
  return move / largest;
}

}  // namespace

TEST(CrackTolerance, IsAHundredTimesThatOfTheBodyUpToTheLoosestThatTheRulesKnow) {
  EXPECT_DOUBLE_EQ(crack_tolerance(1e-6), 1e-4);
  EXPECT_DOUBLE_EQ(crack_tolerance(1e-9), 1e-7);
  EXPECT_DOUBLE_EQ(crack_tolerance(1e-4), 1e-3);
}

TEST(CrackTolerance, MovesNoOpeningOfACrackInsideOrAtTheEdge) {
  EXPECT_LT(largest_move(1, 6, {0.05, 0.02, 0.03}), 1e-4);
  EXPECT_LT(largest_move(1, 6, {0.05, 0.02, 0.5}), 1e-4);
}

TEST(CrackTolerance, MovesNoOpeningInAWallThatBendsByAThousandth) {
  EXPECT_LT(largest_move(0.15, 1, {0.05, 0.5, 0.0}), 1e-3);
}

}  // namespace conchoid

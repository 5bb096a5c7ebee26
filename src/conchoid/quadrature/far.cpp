#include <algorithm>
#include <array>
#include <cmath>

#include "conchoid/quadrature/cases.hpp"
#include "conchoid/quadrature/far_points.hpp"
#include "conchoid/quadrature/triangle_rules.hpp"

// Lanes are pairs: four of them take the same rules at once, so that no lane is empty and nothing is summed across lanes.

namespace conchoid {

namespace {

/// Corners of four panels, by coordinate and corner.
struct CornerLanes {
  Lanes of[3][3];
};

/// Points of a rule on them.
struct PointLanes {
  Lanes at[3][max_points];
};

CONCHOID_INTO_CLONES void place(const CornerLanes& corners, const RuleArrays& rule, PointLanes& points) {
  for (int k = 0; k < 3; ++k) {
    const Lanes a = corners.of[k][0], b = corners.of[k][1], c = corners.of[k][2];
    for (int i = 0; i < rule.count; ++i)
      points.at[k][i] = rule.l[0][i] * a + rule.l[1][i] * b + rule.l[2][i] * c;
  }
}

/// Means over both panels of 1/R and of r₀², r₁², r₁r₂, r₀r₂, r₀r₁ over R³; r₂² is what the trace leaves, as r·r/R³ = 1/R.
CONCHOID_WIDE_CLONES void sum_single_layers(const CornerLanes& x, const RuleArrays& x_rule,
                                            const CornerLanes& y, const RuleArrays& y_rule, Lanes (&sum)[6]) {
  PointLanes x_points, y_points;
  place(x, x_rule, x_points);
  place(y, y_rule, y_points);
  Lanes s0{}, s1{}, s2{}, s3{}, s4{}, s5{};
  for (int i = 0; i < x_rule.count; ++i) {
    const Lanes x0 = x_points.at[0][i], x1 = x_points.at[1][i], x2 = x_points.at[2][i];
    const double wx = x_rule.weight[i];
    for (int j = 0; j < y_rule.count; ++j) {
      const Lanes r0 = x0 - y_points.at[0][j], r1 = x1 - y_points.at[1][j], r2 = x2 - y_points.at[2][j];
      Lanes r = r0 * r0 + r1 * r1 + r2 * r2;
      const Lanes inverse_square = 1 / r;  // beside the root, not after it
      take_root(r);
      const Lanes v = (wx * y_rule.weight[j]) * (r * inverse_square);
      const Lanes c = v * inverse_square;
      const Lanes c0 = c * r0, c1 = c * r1;
      s0 += v;
      s1 += c0 * r0;
      s2 += c1 * r1;
      s3 += c1 * r2;
      s4 += c0 * r2;
      s5 += c0 * r1;
    }
  }
  sum[0] = s0;
  sum[1] = s1;
  sum[2] = s2;
  sum[3] = s3;
  sum[4] = s4;
  sum[5] = s5;
}

/// Means over both panels of N_j n_y·(x−y)/R³ for the corners j of Y.
CONCHOID_WIDE_CLONES void sum_double_layers(const CornerLanes& x, const RuleArrays& x_rule,
                                            const CornerLanes& y, const RuleArrays& y_rule,
                                            const Lanes (&normal)[3], Lanes (&sum)[3]) {
  PointLanes x_points, y_points;
  place(x, x_rule, x_points);
  place(y, y_rule, y_points);
  Lanes height[max_points];  // of the points of X above Y, times their weights
  for (int i = 0; i < x_rule.count; ++i)
    height[i] = x_rule.weight[i] *
                (normal[0] * (x_points.at[0][i] - y.of[0][0]) + normal[1] * (x_points.at[1][i] - y.of[1][0]) +
                 normal[2] * (x_points.at[2][i] - y.of[2][0]));
  Lanes s0{}, s1{}, s2{};
  for (int j = 0; j < y_rule.count; ++j) {
    const Lanes y0 = y_points.at[0][j], y1 = y_points.at[1][j], y2 = y_points.at[2][j];
    Lanes of_point{};
    for (int i = 0; i < x_rule.count; ++i) {
      const Lanes r0 = x_points.at[0][i] - y0, r1 = x_points.at[1][i] - y1, r2 = x_points.at[2][i] - y2;
      Lanes r = r0 * r0 + r1 * r1 + r2 * r2;
      const Lanes inverse_square = 1 / r;
      take_root(r);
      of_point += height[i] * r * (inverse_square * inverse_square);
    }
    of_point = y_rule.weight[j] * of_point;
    s0 += y_rule.l[0][j] * of_point;
    s1 += y_rule.l[1][j] * of_point;
    s2 += y_rule.l[2][j] * of_point;
  }
  sum[0] = s0;
  sum[1] = s1;
  sum[2] = s2;
}

/// The pair that a lane is given: those that are left over take the last one.
const PanelPair& pair_of(std::span<const PanelPair> pairs, int lane) {
  return pairs[std::min(static_cast<std::size_t>(lane), pairs.size() - 1)];
}

void set_lane(CornerLanes& corners, int lane, const Triangle& t) {
  for (int k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i)
      corners.of[k][i][lane] = t[i][k];
}

void set_lanes(CornerLanes& x, CornerLanes& y, std::span<const PanelPair> pairs) {
  for (int lane = 0; lane < lanes; ++lane) {
    const PanelPair& pair = pair_of(pairs, lane);
    set_lane(x, lane, pair.x->x);
    set_lane(y, lane, pair.y->x);
  }
}

}  // namespace

FarDegrees far_degrees(const FarLimits& limits, Layer layer, const Panel& x, const Panel& y) {
  const double distance = (x.center - y.center).norm();
  return {limits.degree(layer, x.radius, distance - y.radius),
          limits.degree(layer, y.radius, distance - x.radius)};
}

void far_single_layer(std::span<const PanelPair> pairs, FarDegrees degrees, Family* out) {
  CornerLanes x, y;
  set_lanes(x, y, pairs);
  Lanes s[6];
  sum_single_layers(x, rule_arrays(degrees.x), y, rule_arrays(degrees.y), s);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    out[i] << s[0][i], s[1][i], s[2][i], s[0][i] - s[1][i] - s[2][i], s[3][i], s[4][i], s[5][i];
    out[i] *= pairs[i].x->area * pairs[i].y->area;
  }
}

void far_double_layer(std::span<const PanelPair> pairs, FarDegrees degrees, Vec3* out) {
  CornerLanes x, y;
  set_lanes(x, y, pairs);
  Lanes normal[3];
  for (int lane = 0; lane < lanes; ++lane)
    for (int k = 0; k < 3; ++k)
      normal[k][lane] = pair_of(pairs, lane).y->normal[k];
  Lanes s[3];
  sum_double_layers(x, rule_arrays(degrees.x), y, rule_arrays(degrees.y), normal, s);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    out[i] = pairs[i].x->area * pairs[i].y->area * Vec3(s[0][i], s[1][i], s[2][i]);
}

}  // namespace conchoid

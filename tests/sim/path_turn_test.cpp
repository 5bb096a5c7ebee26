#include "conchoid/sim/path_turn.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "conchoid/crack/closing/advance_fronts.hpp"
#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/crack/law/hoop_stress_law.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/sim/opening_source.hpp"
#include "sim/glassy.hpp"

// A disc in an unbounded body whose K asks for a path of known curvature: it grows into a bowl.
namespace conchoid {
namespace {

constexpr double kRadius = 1, kWay = 0.8;
const HoopStressLaw kHoop(test::glassy().elastic(), std::nullopt);

/// K of the hoop stress law's direction θ, far above K_c.
Vec3 asking_for(double angle) {
  const double K = 1e3 * test::glassy().toughness;
  return {K, -K * std::sin(angle) / (3 * std::cos(angle) - 1), 0};
}

struct Bowl {
  CrackState crack;
  FineFront fine;
  FrontHistory history;
  double edge;
  std::size_t given;  ///< nodes of a crack that did not start in the run

  Bowl(double r, bool started)
      : crack{sheet_of(disc_crack(Vec3::Zero(), Vec3::UnitZ(), kRadius, {.edge = r})), {}, {}, {}, {}, {}},
        fine(crack.sheet, {.resolution = r, .spacing = r / 10}),
        history(test::glassy(), MaterialField(), r),
        edge(r),
        given(started ? 0 : crack.sheet.mesh.node_count()) {}

  static CrackSheet sheet_of(const TriMesh& part) {
    CrackSheet sheet;
    append_part(sheet, part);
    return sheet;
  }

  /// One frame. @param angle(point)  that K asks for  @param least, most  turn foreseen [rad]
  template <class Angle>
  void frame(const Angle& angle, bool foresees, double& least, double& most) {
    update_crack(crack, TriMesh(), edge);
    std::vector<FrontOpening> openings(crack.points.size());
    std::vector<FrontStep> steps;
    least = std::numeric_limits<double>::infinity();
    most = -least;
    for (std::size_t i = 0; i < crack.points.size(); ++i) {
      const FrontPoint& point = crack.points[i];
      FrontDecision now;
      now.angle = angle(point);
      now.length = edge;
      openings[i].intensity = openings[i].node_intensity = asking_for(now.angle);
      EXPECT_NEAR(kHoop.direction(openings[i].intensity), now.angle, 1e-9);
      const double turn = further_turn({history, kHoop, crack.sheet, given}, point, now);
      least = std::min(least, turn);
      most = std::max(most, turn);
      steps.push_back({point.node, point.frame, now.angle, kHoop.drive(openings[i].intensity), edge,
                       foresees ? turn : 0});
    }
    history.remember(crack, openings);
    const Toughness K_c{test::glassy().toughness, Vec3::Zero()};
    advance_fronts(crack.sheet, fine, steps,
                   {std::make_shared<HoopStressLaw>(kHoop), [=](const Vec3&) { return K_c; }}, edge);
  }

  double height() const {
    double sum = 0;
    const auto& nodes = crack.sheet.fronts[0].nodes;
    for (const NodeId n : nodes)
      sum += crack.sheet.mesh.positions[n].z();
    return sum / static_cast<double>(nodes.size());
  }
};

/// Of the height of the bowl's rim over what it should be.
double error(double edge, bool foresees) {
  const double curvature = 0.9;
  Bowl bowl(edge, false);
  double least, most;
  for (int k = 0; k < static_cast<int>(std::lround(kWay / edge)); ++k)
    bowl.frame(
        [&](const FrontPoint& p) {
          return curvature * bowl.crack.sheet.travelled[p.node] - std::asin(p.frame.e2.z());
        },
        foresees, least, most);
  const double exact = (1 - std::cos(curvature * kWay)) / curvature;
  return std::abs(bowl.height() - exact) / exact;
}

TEST(PathTurn, APathOfKnownCurvatureIsFollowedToTheSecondOrder) {
  const double coarse = error(0.2, true), fine = error(0.1, true);
  EXPECT_LT(coarse, 0.12);
  EXPECT_GT(coarse / fine, 3);
  EXPECT_GT(error(0.1, false), 4 * fine);
}

TEST(PathTurn, ACrackThatStartedLiesAcrossTheTensionAtItsCentre) {
  double least, most;
  const auto bent = [](const FrontPoint&) { return 0.1; };
  Bowl started(0.2, true), given(0.2, false);
  started.frame(bent, true, least, most);
  EXPECT_GT(least, 0.08);  // the disc's edges are a little longer than the step
  EXPECT_LE(most, 0.1 + 1e-12);
  given.frame(bent, true, least, most);
  EXPECT_EQ(least, 0);
  EXPECT_EQ(most, 0);
}

TEST(PathTurn, ATurnToAndFroIsNoCurvature) {
  double least, most;
  Bowl bowl(0.2, true);
  for (const double angle : {0.1, -0.2, 0.2, -0.2}) {
    bowl.frame([=](const FrontPoint&) { return angle; }, true, least, most);
    if (angle == 0.1) continue;  // the first turn
    EXPECT_EQ(least, 0) << angle;
    EXPECT_EQ(most, 0) << angle;
  }
}

}  // namespace
}  // namespace conchoid

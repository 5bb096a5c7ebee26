#include "conchoid/sim/path_correction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "conchoid/crack/closing/advance_fronts.hpp"
#include "conchoid/crack/law/hoop_stress_law.hpp"
#include "conchoid/mesh/crack_meshes.hpp"

// Directions corrected by the frame on trial.
namespace conchoid {
namespace {

const ElasticConstants kGlassy{3.1e9, 0.327};
constexpr double kEdge = 0.2;

/// A penny crack in the infinite body under tension across and shear along it, solved.
struct Penny {
  PreparedBody body;
  GrowthModel growth{std::make_shared<HoopStressLaw>(kGlassy), [](const Vec3&) {
                       return Toughness{1e4, Vec3::Zero()};
                     }};
  CrackState crack;
  BemOpening bem;
  std::vector<FrontStep> steps;

  explicit Penny(double shear)
      : bem(make_body_operator({}, {}, kGlassy), {{}, {}, uniform_stress(stress(shear), 3.1e9, 0.327)}, {}) {
    body.crack_edge = kEdge;
    append_part(crack.sheet, disc_crack(Vec3::Zero(), Vec3::UnitZ(), 1, {.triangles = 150}));
    update_crack(crack, {}, kEdge);
    const auto openings = bem.open(crack);
    for (std::size_t i = 0; i < openings.size(); ++i)
      steps.push_back({crack.points[i].node, crack.points[i].frame,
                       growth.law->direction(openings[i].intensity),
                       growth.law->drive(openings[i].intensity)});
  }
  static Mat3 stress(double shear) {
    Mat3 s = Mat3::Zero();
    s(2, 2) = 1e6;
    s(0, 2) = s(2, 0) = shear;
    return s;
  }
  FineFront fine() const { return {crack.sheet, {.resolution = kEdge, .spacing = kEdge / 10}}; }
};

TEST(PathCorrection, ACrackThatGoesStraightOnIsLeftAlone) {
  Penny penny(0);
  const auto before = penny.steps;
  const std::size_t solved = penny.bem.body().opening().size();
  correct_directions(penny.steps, penny.crack, penny.fine(), penny.growth, penny.body, penny.bem);
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ(penny.steps[i].angle, before[i].angle);
  EXPECT_EQ(penny.bem.body().opening().size(), solved) << "nothing was solved again";
}

TEST(PathCorrection, EachPointThatTurnsDoesSoByHalfOfWhatItsSuccessorWould) {
  Penny penny(8e5);
  const auto before = penny.steps;
  CrackState next = penny.crack;
  FineFront markers = penny.fine();
  const AdvanceResult result = advance_fronts(next.sheet, markers, before, penny.growth, kEdge);
  update_crack(next, {}, kEdge);
  BemOpening solver(make_body_operator({}, {}, kGlassy), penny.bem.body().load(), {});
  const auto openings = solver.open(next);
  correct_directions(penny.steps, penny.crack, penny.fine(), penny.growth, penny.body, penny.bem);
  int compared = 0;
  double most = 0;
  for (const FrontSuccession& s : result.succession.at(0))
    for (std::size_t i = 0; i < next.points.size(); ++i)
      for (std::size_t k = 0; k < before.size(); ++k) {
        if (s.kind != FrontSuccession::Kind::moved || next.points[i].node != s.node ||
            before[k].node != s.first)
          continue;
        const double further = penny.growth.law->direction(openings[i].intensity);
        const double share = std::abs(before[k].angle) > 0.05 ? 0.5 : 0;
        EXPECT_NEAR(penny.steps[k].angle, before[k].angle + share * further, 1e-6);
        most = std::max(most, std::abs(further));
        ++compared;
      }
  EXPECT_GT(compared, 10);
  EXPECT_GT(most, 0.02);
}

}  // namespace
}  // namespace conchoid

#include "conchoid/crack/law/growth_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "conchoid/crack/closing/advance_fronts.hpp"
#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/crack/law/criterion.hpp"
#include "conchoid/crack/law/hoop_stress_law.hpp"
#include "crack_samples.hpp"

using namespace conchoid;
using namespace conchoid::testing;

namespace {

constexpr double kEdge = 0.2, kSpacing = 0.02, kToughness = 1e6;
const Vec3 kMixed(2e6, 1e6, 0);

/// A second law: opening alone drives the crack, always at the same speed and angle, whatever the toughness
/// around it.
class FixedDirectionLaw final : public GrowthLaw {
 public:
  FixedDirectionLaw(double angle, double share) : angle_(angle), share_(share) {}
  double drive(const Vec3& K) const override { return std::max(K[0], 0.0); }
  double direction(const Vec3&) const override { return angle_; }
  double length(double drive, double toughness, double resolution) const override {
    return drive < toughness ? 0 : share_ * resolution;
  }
  double deflection(double, double, double) const override { return 0; }

 private:
  double angle_, share_;
};

/// Tougher by 40 % at every distance kEdge above the plane of the disc.
Toughness rising(const Vec3& x) {
  return {kToughness * (1 + 0.4 * x.z() / kEdge), 0.4 * kToughness / kEdge * Vec3::UnitZ()};
}

/// A disc of radius 1 that grows under the same K all round, as a fracture would have it grow.
struct Grown {
  CrackSheet sheet;
  FineFront fine;
  Grown(const std::shared_ptr<const GrowthLaw>& law, const Vec3& K, int frames)
      : sheet([] {
          CrackSheet s;
          append_part(s, disc(1, 5));
          return s;
        }()),
        fine(sheet, {.resolution = kEdge, .spacing = kSpacing}) {
    for (int frame = 0; frame < frames; ++frame) {
      std::vector<FrontStep> steps;
      const auto at = front_frames(sheet, sheet.fronts[0]);
      for (std::size_t i = 0; i < at.size(); ++i)
        steps.push_back({sheet.fronts[0].nodes[i], at[i], law->direction(K), law->drive(K)});
      advance_fronts(sheet, fine, steps, {law, rising}, kEdge);
    }
  }
};

}  // namespace

TEST(GrowthLaw, OfFixedDirectionDrivesBothFronts) {
  const Grown flat(std::make_shared<FixedDirectionLaw>(0, 0.5), kMixed, 4);
  const double radius = 1 + 4 * 0.5 * kEdge;
  for (const Marker& m : flat.fine.curves()[0].markers) {
    EXPECT_EQ(m.position.z(), 0);  // neither K_II nor the fall of toughness turns it
    EXPECT_NEAR(m.position.norm(), radius, 0.012);
  }
  for (const NodeId n : flat.sheet.fronts[0].nodes)
    EXPECT_NEAR(flat.sheet.mesh.positions[n].norm(), radius, 0.012);

  const double angle = 0.3;
  const Grown cone(std::make_shared<FixedDirectionLaw>(angle, 0.5), kMixed, 1);
  for (const Marker& m : cone.fine.curves()[0].markers)
    EXPECT_NEAR(m.position.z(), 0.5 * kEdge * std::sin(angle), 0.02 * kEdge);

  const Grown still(std::make_shared<FixedDirectionLaw>(0, 0.5), Vec3(0.9e6, 5e6, 0), 2);
  EXPECT_EQ(still.sheet.mesh.triangle_count(), disc(1, 5).triangle_count());
}

TEST(GrowthLaw, OfHoopStressTurnsUnderTheSameLoad) {
  const Grown grown(kLaw, kMixed, 2);
  for (const Marker& m : grown.fine.curves()[0].markers)
    EXPECT_LT(m.position.z(), -0.2 * kEdge);
}

TEST(HoopStressLaw, IsTheCriterionWithClosedFacesOrCompression) {
  const ElasticConstants m{3.1e9, 0.327};
  const HoopStressLaw closed(m), published(m, 4);
  for (const Vec3& K : {Vec3(2e6, 1e6, -5e5), Vec3(-3e6, 2e5, 1e5), Vec3(-8e6, 0, 0), Vec3(1, 0, 0)}) {
    EXPECT_EQ(closed.drive(K), effective_intensity(K, m));
    EXPECT_EQ(closed.direction(K), kink_angle(K, m));
    EXPECT_EQ(published.drive(K), effective_intensity(with_compressive_factor(K, 4), m));
    EXPECT_EQ(published.direction(K), kink_angle(with_compressive_factor(K, 4), m));
  }
  EXPECT_EQ(closed.drive({-8e6, 0, 0}), 0);
  EXPECT_EQ(published.drive({-8e6, 0, 0}), 2e6);
  for (const GrowthLaw* law :
       {static_cast<const GrowthLaw*>(&closed), static_cast<const GrowthLaw*>(&published)})
    EXPECT_EQ(law->drive({1.5e6, 0, 0}), 1.5e6);  // what pure opening drives is K_I itself
  EXPECT_EQ(closed.length(2e6, 1e6, 0.1), advance_length(2e6, 1e6, 0.1));
  EXPECT_EQ(closed.deflection(0.3, 2e6, 1e6), toughness_deflection(0.3, 2e6, 1e6));
}

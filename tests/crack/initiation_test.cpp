#include "conchoid/crack/law/initiation.hpp"

#include <gtest/gtest.h>

#include "conchoid/crack/front/front.hpp"
#include "crack_samples.hpp"

using namespace conchoid;
using namespace conchoid::testing;

namespace {

/// A triangle on the top of a body (inward −z), pulled along x.
InitiationCandidate candidate(int triangle, double stress, const Vec3& at) {
  return {at,
          stress,
          Vec3::UnitX(),
          -Vec3::UnitZ(),
          1e6,
          TriId(triangle),
          {at + Vec3(-0.2, -0.1, 0), at + Vec3(0.2, -0.1, 0), at + Vec3(0, 0.2, 0)}};
}

InitiationCandidate mapped(InitiationCandidate c, const Mat3& map) {
  c.position = map * c.position;
  c.direction = map * c.direction;
  c.inward_normal = map * c.inward_normal;
  for (Vec3& x : c.corners)
    x = map * x;
  return c;
}

const InitiationSettings kOne{0.1, 0.1, 1};

}  // namespace

TEST(Initiation, StartsWhereStressExceedsStrengthMost) {
  const std::vector<InitiationCandidate> all{candidate(0, 0.9e6, {0, 0, 0}), candidate(1, 1.2e6, {1, 0, 0}),
                                             candidate(2, 1.5e6, {2, 0, 0})};
  const auto sites = choose_sites(all, {}, {0.1, 0.1, 5});
  ASSERT_EQ(sites.size(), 2u);
  EXPECT_EQ(sites[0].triangle, TriId(2));
  EXPECT_EQ(sites[1].triangle, TriId(1));
  EXPECT_DOUBLE_EQ(sites[0].severity, 1.5);
  EXPECT_TRUE(choose_sites({all[0]}, {}, kOne).empty());
}

TEST(Initiation, WithinAThousandthTheLowestTriangleGoesFirst) {
  const std::vector<InitiationCandidate> all{
      candidate(7, 1.5005e6, {2, 0, 0}), candidate(3, 1.4999e6, {1, 0, 0}), candidate(1, 1.49e6, {0, 0, 0})};
  EXPECT_EQ(choose_sites(all, {}, kOne)[0].triangle, TriId(3));
}

TEST(Initiation, KeepsItsDistance) {
  const std::vector<InitiationCandidate> all{candidate(0, 2e6, {0, 0, 0}), candidate(1, 1.9e6, {0.05, 0, 0}),
                                             candidate(2, 1.8e6, {1, 0, 0})};
  const auto sites = choose_sites(all, {}, {0.1, 0.1, 5});
  ASSERT_EQ(sites.size(), 2u);
  EXPECT_EQ(sites[1].triangle, TriId(2));
  const auto away = choose_sites(all, {Vec3(0.01, 0, 0)}, {0.1, 0.1, 5});
  ASSERT_EQ(away.size(), 1u);
  EXPECT_EQ(away[0].triangle, TriId(2));
}

TEST(Initiation, TheSignOfThePrincipalDirectionDoesNotMatter) {
  InitiationCandidate c = candidate(0, 2e6, {0, 0, 0});
  const auto plus = choose_sites({c}, {}, kOne)[0];
  c.direction = -c.direction;
  const auto minus = choose_sites({c}, {}, kOne)[0];
  EXPECT_EQ(plus.normal, minus.normal);
  EXPECT_EQ(plus.side, minus.side);
  EXPECT_EQ(plus.inward, Vec3(0, 0, -1));
}

TEST(Initiation, SitesAndDiscsTurnAndMirrorWithTheBody) {
  const InitiationCandidate c = candidate(0, 2e6, {0.3, 0.2, 1});
  const CrackSite site = choose_sites({c}, {}, kOne)[0];
  const TriMesh disc = disc_sheet(site);
  Mat3 mirror = Mat3::Identity();
  mirror(0, 0) = -1;
  for (const Mat3& map : {some_rotation(), Mat3(some_rotation() * mirror)}) {
    const TriMesh image = disc_sheet(choose_sites({mapped(c, map)}, {}, kOne)[0]);
    for (std::size_t i = 0; i < disc.node_count(); ++i)
      EXPECT_LT((image.positions[NodeId(i)] - map * disc.positions[NodeId(i)]).norm(), 1e-14);
    EXPECT_LT((unit_normal(image, TriId(0)) - map * unit_normal(disc, TriId(0))).norm(), 1e-13);
  }
}

TEST(Initiation, ADiscPullsAlongTheSurfaceStillHasItsAxes) {
  InitiationCandidate c = candidate(0, 2e6, {0, 0, 0});
  c.direction = Vec3::UnitZ();
  const CrackSite site = choose_sites({c}, {}, kOne)[0];
  EXPECT_NEAR(site.inward.dot(site.normal), 0, 1e-15);
  EXPECT_NEAR(site.inward.norm(), 1, 1e-15);
  EXPECT_EQ(site.normal, Vec3(0, 0, -1));
}

TEST(DiscSheet, HalfOfItSticksOutAndItIsSymmetric) {
  const CrackSite site = choose_sites({candidate(0, 2e6, {0, 0, 0})}, {}, kOne)[0];
  const TriMesh disc = disc_sheet(site);
  EXPECT_EQ(disc.triangle_count(), 24u);
  EXPECT_EQ(disc.node_count(), 19u);
  const auto fronts = find_fronts(disc, {});
  ASSERT_EQ(fronts.size(), 1u);
  EXPECT_EQ(fronts[0].nodes.size(), 12u);
  int inside = 0;
  for (const Vec3& x : disc.positions)
    inside += x.z() < -1e-12;
  EXPECT_EQ(inside, 8);  // of 19
  for (std::size_t t = 0; t < 24; ++t)
    EXPECT_LT((unit_normal(disc, TriId(t)) - site.normal).norm(), 1e-12);
  for (const Vec3& x : disc.positions) {  // mirror image about normal–inward plane is a node too
    const Vec3 image = x - 2 * x.dot(site.side) * site.side;
    EXPECT_TRUE(std::any_of(disc.positions.begin(), disc.positions.end(),
                            [&](const Vec3& y) { return (y - image).norm() < 1e-12; }));
  }
}

TEST(Initiation, ABranchStartsWholeBeneathItsFace) {
  InitiationCandidate c = candidate(3, 2e6, {0, 0, 0});
  c.on_crack = true;
  const std::vector<Vec3> crack{{-0.2, -0.1, 0}, {0.2, -0.1, 0}, {0, 0.2, 0}};
  const auto sites = choose_sites({c}, crack, {0.1, 0.2, 1}, {Vec3(0.5, 0, 0)});
  ASSERT_EQ(sites.size(), 1u);
  EXPECT_NEAR((sites[0].center - Vec3(0, 0, -0.115)).norm(), 0, 1e-15);
  for (const Vec3& x : disc_sheet(sites[0]).positions)
    EXPECT_LT(x.z(), -0.01);
  EXPECT_TRUE(choose_sites({c}, crack, {0.1, 0.2, 1}, {Vec3(0.15, 0, 0)}).empty()) << "too near the front";
  EXPECT_TRUE(choose_sites({c}, {Vec3(0, 0, -0.15)}, {0.1, 0.2, 1}).empty()) << "another crack is there";
}

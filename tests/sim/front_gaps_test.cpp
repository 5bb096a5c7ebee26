#include "conchoid/sim/front_gaps.hpp"

#include <gtest/gtest.h>

#include <set>

#include "conchoid/crack/law/criterion.hpp"
#include "conchoid/crack/law/hoop_stress_law.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/mesh/models.hpp"
#include "sim/glassy.hpp"

// Points of a front without a K of their own take it from their neighbours on the same connected front.
namespace conchoid {
namespace {

constexpr double kEdge = 0.1;  // r̄

CrackState crack_in_cube(const std::vector<TriMesh>& sheets) {
  CrackState crack;
  for (const TriMesh& sheet : sheets)
    append_part(crack.sheet, sheet);
  update_crack(crack, built_in_model("cube").mesh, kEdge);
  return crack;
}

TriMesh disc(const Vec3& center, double radius) {
  return disc_crack(center, Vec3::UnitZ(), radius, {.edge = kEdge});
}

std::vector<FrontOpening> unknown(std::size_t n) {
  std::vector<FrontOpening> out(n);
  for (FrontOpening& o : out)
    o.known = false;
  return out;
}

void tell(FrontOpening& o, double K) {
  o.known = true;
  o.intensity = o.node_intensity = {K, 0, 0};
}

std::vector<PointChain> chain(std::vector<std::size_t> points, bool closed) {
  return {{std::move(points), closed}};
}

TEST(FrontGaps, AGapTakesTheMeanOfItsNearestNeighbours) {
  auto openings = unknown(6);
  tell(openings[0], 1);
  tell(openings[5], 11);
  fill_gaps(chain({0, 1, 2, 3, 4, 5}, false), openings);
  const std::vector<double> expected = {1, 1, 1, 11, 11, 11};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(openings[i].intensity[0], expected[i]) << i;
    EXPECT_EQ(openings[i].node_intensity[0], expected[i]) << i;
    EXPECT_TRUE(openings[i].known);
  }
  auto odd = unknown(3);
  tell(odd[0], 1);
  tell(odd[2], 11);
  fill_gaps(chain({0, 1, 2}, false), odd);
  EXPECT_EQ(odd[1].intensity[0], 6);
}

TEST(FrontGaps, OnlyARingGoesRound) {
  for (const bool closed : {true, false}) {
    auto openings = unknown(5);
    tell(openings[3], 2);
    tell(openings[4], 10);
    fill_gaps(chain({0, 1, 2, 3, 4}, closed), openings);
    EXPECT_EQ(openings[0].intensity[0], closed ? 10 : 2)
        << "next to the last point of a ring, far from it else";
    EXPECT_EQ(openings[2].intensity[0], 2);
    EXPECT_EQ(openings[1].intensity[0], closed ? 6 : 2) << "two from either in the ring";
  }
}

TEST(FrontGaps, ChainsDoNotHearOfEachOther) {
  auto openings = unknown(6);
  tell(openings[1], 5);
  // Listed in turns, as no two fronts are: neighbours in the list are not neighbours on a front.
  fill_gaps({{{0, 2, 4}, true}, {{1, 3, 5}, true}}, openings);
  for (const std::size_t i : {1u, 3u, 5u})
    EXPECT_EQ(openings[i].intensity[0], 5) << i;
  for (const std::size_t i : {0u, 2u, 4u}) {
    EXPECT_FALSE(openings[i].known) << i;
    EXPECT_TRUE(openings[i].intensity.isZero(0)) << "it stays where it is";
  }
}

TEST(FrontGaps, NearestAreCountedAlongTheChainToBothSides) {
  using Nearest = std::vector<std::vector<std::size_t>>;
  const std::vector<char> known = {0, 0, 1, 0, 1, 0, 0};
  const std::vector<std::size_t> in_order = {0, 1, 2, 3, 4, 5, 6};
  EXPECT_EQ(nearest_known(chain(in_order, false), known), (Nearest{{2}, {2}, {}, {2, 4}, {}, {4}, {4}}));
  EXPECT_EQ(nearest_known(chain(in_order, true), known), (Nearest{{2}, {2}, {}, {2, 4}, {}, {4}, {4}}));
  EXPECT_EQ(nearest_known(chain(in_order, false), std::vector<char>(7, 0)), Nearest(7));
  EXPECT_EQ(nearest_known({{{5, 2, 0}, false}, {{1, 3}, false}}, known),
            (Nearest{{2}, {}, {}, {}, {}, {2}, {}}))
      << "chains do not hear of each other";
}

TEST(FrontGaps, AFrontInsideIsOneRing) {
  const CrackState crack = crack_in_cube({disc({0, 0, 0}, 0.2)});
  const auto chains = point_chains(crack);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_TRUE(chains[0].closed);
  EXPECT_EQ(chains[0].points.size(), crack.points.size());
}

TEST(FrontGaps, TwoCracksAreTwoRings) {
  const CrackState crack = crack_in_cube({disc({0, 0, -0.25}, 0.2), disc({0, 0, 0.25}, 0.2)});
  ASSERT_EQ(point_chains(crack).size(), 2u);
  for (const PointChain& c : point_chains(crack)) {
    std::set<int> fronts;
    for (const std::size_t i : c.points)
      fronts.insert(crack.points[i].front);
    EXPECT_EQ(fronts.size(), 1u);
  }
}

/// The disc is wider than the cube and narrower than its diagonal: one front of the sheet, four pieces of it
/// inside, one in each corner.
CrackState crack_with_four_corners() {
  return crack_in_cube({disc({0, 0, 0.03}, 0.6)});
}

int quadrant(const CrackState& crack, std::size_t point) {
  const Vec3& x = crack.sheet.mesh.positions[crack.points[point].node];
  return (x[0] > 0) + 2 * (x[1] > 0);
}

TEST(FrontGaps, AFrontThatLeavesTheBodyIsSeveral) {
  const CrackState crack = crack_with_four_corners();
  ASSERT_EQ(crack.sheet.fronts.size(), 1u);
  const auto chains = point_chains(crack);
  ASSERT_EQ(chains.size(), 4u);
  std::set<int> corners;
  std::size_t points = 0;
  for (const PointChain& c : chains) {
    EXPECT_FALSE(c.closed);
    points += c.points.size();
    for (const std::size_t i : c.points) {
      corners.insert(quadrant(crack, i));
      EXPECT_EQ(quadrant(crack, i), quadrant(crack, c.points[0]));
    }
  }
  EXPECT_EQ(points, crack.points.size());
  EXPECT_EQ(corners.size(), 4u);
}

// Two corners were solved in the frame before, with different K; of the others nothing is known.
TEST(FrontGaps, WhatOneCornerKnowsIsNotCarriedToAnother) {
  const CrackState crack = crack_with_four_corners();
  const MaterialSpec material = test::glassy();
  FrontHistory history(material, {}, kEdge);
  auto before = unknown(crack.points.size());
  std::array<bool, 4> told{};
  for (std::size_t i = 0; i < before.size(); ++i) {
    bool& once = told[static_cast<std::size_t>(quadrant(crack, i))];
    if (quadrant(crack, i) < 2 && !once) tell(before[i], quadrant(crack, i) == 0 ? 1e6 : 3e6);
    once = true;
  }
  history.remember(crack, before);
  const auto carried = carried_openings(crack, history, HoopStressLaw(material.elastic(), {}));
  for (std::size_t i = 0; i < carried.size(); ++i) {
    const int corner = quadrant(crack, i);
    EXPECT_EQ(carried[i].known, corner < 2) << "corner " << corner;
    EXPECT_DOUBLE_EQ(carried[i].intensity[0], corner == 0   ? 1e6
                                              : corner == 1 ? 3e6
                                                            : 0)
        << "corner " << corner;
  }
}

// Where the published treatment of compression drives a front, it also drives one that is carried.
TEST(CarriedOpenings, KeepTheDriveThatMovedThem) {
  const CrackState crack = crack_with_four_corners();
  const MaterialSpec material = test::glassy();
  FrontHistory history(material, {}, kEdge);
  std::vector<FrontOpening> pressed(crack.points.size());
  for (FrontOpening& o : pressed)
    o.intensity = o.node_intensity = {-8e6, 0, 0};
  history.remember(crack, pressed);
  const HoopStressLaw closed(material.elastic(), {}), published(material.elastic(), 2.0);
  EXPECT_EQ(carried_openings(crack, history, closed)[0].intensity, Vec3::Zero());
  EXPECT_DOUBLE_EQ(carried_openings(crack, history, published)[0].intensity[0],
                   published.drive({-8e6, 0, 0}));
  EXPECT_GT(published.drive({-8e6, 0, 0}), 0);
}

}  // namespace
}  // namespace conchoid

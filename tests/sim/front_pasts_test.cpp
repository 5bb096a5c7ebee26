#include "conchoid/sim/front_pasts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "conchoid/crack/front/sheet.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/sim/opening_source.hpp"

namespace conchoid {
namespace {

constexpr double kEdge = 0.05;

/// A disc wider than the cube and narrower than its diagonal: one front of the sheet, four pieces of it inside.
CrackState crack_with_four_corners() {
  CrackState crack;
  append_part(crack.sheet, disc_crack({0, 0, 0.03}, Vec3::UnitZ(), 0.6, {.edge = kEdge}));
  update_crack(crack, built_in_model("cube").mesh, kEdge);
  return crack;
}

/// That remembers the correlation nodes of these points of the crack, as they were a frame before.
FrontHistory history_of(const CrackState& crack, const std::vector<std::size_t>& points) {
  FrontHistory history({}, {}, kEdge);
  CrackState before = crack;
  before.points.clear();
  for (const std::size_t i : points) {
    before.points.push_back(crack.points[i]);
    before.points.back().node = crack.points[i].correlation;
  }
  history.remember(before, std::vector<FrontOpening>(points.size()));
  return history;
}

TEST(FrontPasts, APointComesFromItsCorrelationNode) {
  const CrackState crack = crack_with_four_corners();
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < crack.points.size(); ++i)
    all.push_back(i);
  const auto pasts = front_pasts(crack, history_of(crack, all));
  for (const std::size_t i : all) {
    EXPECT_TRUE(pasts[i].own);
    EXPECT_EQ(pasts[i].nodes, std::vector<NodeId>{crack.points[i].correlation});
  }
}

TEST(FrontPasts, OfTwoThatComeFromOneNodeTheNearerIsIt) {
  CrackState crack = crack_with_four_corners();
  crack.points[1].correlation = crack.points[0].correlation;
  crack.points[1].distance = 1.1 * crack.points[0].distance;
  const auto pasts = front_pasts(crack, history_of(crack, {0}));
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_TRUE(pasts[i].correlation);
    EXPECT_EQ(pasts[i].nodes, std::vector<NodeId>{crack.points[0].correlation});
  }
  EXPECT_TRUE(pasts[0].own);
  EXPECT_FALSE(pasts[1].own);
}

TEST(FrontPasts, OneWithoutTakesThatOfItsNearestNeighboursOnItsFront) {
  const CrackState crack = crack_with_four_corners();
  const PointChain chain = point_chains(crack)[0];
  ASSERT_GE(chain.points.size(), 4u);
  const auto correlation = [&](std::size_t at) { return crack.points[chain.points[at]].correlation; };
  const std::size_t last = chain.points.size() - 1;
  const auto pasts = front_pasts(crack, history_of(crack, {chain.points[0], chain.points[2]}));
  EXPECT_FALSE(pasts[chain.points[1]].own);
  EXPECT_EQ(pasts[chain.points[1]].nodes, (std::vector<NodeId>{correlation(0), correlation(2)}));
  EXPECT_EQ(pasts[chain.points[last]].nodes, std::vector<NodeId>{correlation(2)}) << "at the end";
}

TEST(FrontPasts, AFrontThatHasJustComeIntoTheBodyTakesThatOfTheNearestNode) {
  const CrackState crack = crack_with_four_corners();
  const auto chains = point_chains(crack);
  ASSERT_EQ(chains.size(), 4u);
  std::vector<std::size_t> others;
  for (std::size_t c = 1; c < 4; ++c)
    others.insert(others.end(), chains[c].points.begin(), chains[c].points.end());
  const auto pasts = front_pasts(crack, history_of(crack, others));
  const auto& x = crack.sheet.mesh.positions;
  for (const std::size_t i : chains[0].points) {
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t k : others)
      least = std::min(least, (x[crack.points[k].correlation] - x[crack.points[i].node]).norm());
    ASSERT_EQ(pasts[i].nodes.size(), 1u);
    EXPECT_EQ((x[pasts[i].nodes[0]] - x[crack.points[i].node]).norm(), least);
  }
}

TEST(FrontPasts, WhereNothingWasThereIsNone) {
  const CrackState crack = crack_with_four_corners();
  for (const FrontPast& past : front_pasts(crack, history_of(crack, {})))
    EXPECT_TRUE(past.nodes.empty());
}

}  // namespace
}  // namespace conchoid

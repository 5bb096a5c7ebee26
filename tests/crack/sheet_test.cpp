#include "conchoid/crack/front/sheet.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "conchoid/core/error.hpp"
#include "crack_samples.hpp"

using namespace conchoid;
using namespace conchoid::testing;

namespace {

CrackSheet sheet_of(const TriMesh& mesh) {
  CrackSheet sheet;
  append_part(sheet, mesh);
  return sheet;
}

std::vector<FrontMotion> forward(const CrackSheet& sheet, double length, int every = 1) {
  std::vector<FrontMotion> motions;
  for (const SheetFront& front : sheet.fronts) {
    const auto frames = front_frames(sheet, front);
    for (std::size_t i = 0; i < front.nodes.size(); ++i)
      if (i % static_cast<std::size_t>(every) == 0)
        motions.push_back({front.nodes[i], length * frames[i].e2});
  }
  return motions;
}

/// Every edge walked at most once in each direction, the once-walked ones are exactly the fronts, and no
/// triangle is flat.
void expect_sound(const CrackSheet& sheet) {
  std::set<std::pair<NodeId, NodeId>> walked;
  for (std::size_t t = 0; t < sheet.mesh.triangle_count(); ++t) {
    const auto& c = sheet.mesh.corners[TriId(t)];
    double longest = 0;
    for (int k = 0; k < 3; ++k) {
      EXPECT_TRUE(walked.insert({c[k], c[(k + 1) % 3]}).second);
      longest = std::max(longest, (sheet.mesh.positions[c[k]] - sheet.mesh.positions[c[(k + 1) % 3]]).norm());
    }
    EXPECT_GT(2 * area_vector(sheet.mesh, TriId(t)).norm(), 1e-3 * longest * longest);
  }
  std::set<std::pair<NodeId, NodeId>> open, fronts;
  for (const auto& [a, b] : walked)
    if (!walked.contains({b, a})) open.insert({a, b});
  for (const SheetFront& front : sheet.fronts)
    for (std::size_t i = 0; i < front.nodes.size(); ++i)
      fronts.insert({front.nodes[i], front.nodes[(i + 1) % front.nodes.size()]});
  EXPECT_EQ(open, fronts);
  EXPECT_EQ(sheet.state.size(), sheet.mesh.node_count());
  EXPECT_EQ(sheet.triangle_birth.size(), sheet.mesh.triangle_count());
}

std::vector<double> front_edges(const CrackSheet& sheet, const SheetFront& front) {
  std::vector<double> lengths;
  for (std::size_t i = 0; i < front.nodes.size(); ++i)
    lengths.push_back((sheet.mesh.positions[front.nodes[(i + 1) % front.nodes.size()]] -
                       sheet.mesh.positions[front.nodes[i]])
                          .norm());
  return lengths;
}

}  // namespace

TEST(Sheet, InitialCorrelationNodesLieRightBehindTheFront) {
  const CrackSheet sheet = sheet_of(disc(1, 5));
  ASSERT_EQ(sheet.fronts.size(), 1u);
  for (NodeId node : sheet.fronts[0].nodes) {
    ASSERT_TRUE(sheet.correlation[node].valid());
    EXPECT_NEAR(sheet.mesh.positions[sheet.correlation[node]].norm(), 0.8, 1e-12);
    EXPECT_LT((sheet.mesh.positions[sheet.correlation[node]] - sheet.mesh.positions[node]).norm(), 0.24);
  }
}

TEST(Advance, AUniformlyGrowingDiscStaysADisc) {
  CrackSheet sheet = sheet_of(disc(1, 6));
  const double edge = 1.0 / 6;
  double radius = 1;
  for (int frame = 0; frame < 12; ++frame) {
    const std::size_t old_front = sheet.fronts[0].nodes.size();
    const std::size_t old_triangles = sheet.mesh.triangle_count();
    const AdvanceResult result = advance(sheet, forward(sheet, 0.6 * edge), edge);
    radius += 0.6 * edge;
    expect_sound(sheet);
    const std::size_t inserted = sheet.fronts[0].nodes.size() - old_front;
    EXPECT_EQ(sheet.mesh.triangle_count() - old_triangles, 2 * old_front + inserted);
    EXPECT_TRUE(result.arrested.empty());
    for (double length : front_edges(sheet, sheet.fronts[0])) {
      EXPECT_LT(length, 1.42 * edge);
      EXPECT_GT(length, 0.5 * edge);
    }
    for (NodeId node : sheet.fronts[0].nodes)
      EXPECT_NEAR(sheet.mesh.positions[node].norm(), radius, 0.02 * radius);
  }
  EXPECT_NEAR(surface_area(sheet.mesh) / (std::numbers::pi * radius * radius), 1, 0.02);
  EXPECT_EQ(sheet.frame, 12);
}

TEST(Advance, TheAreaOfAGrowingDiscConverges) {
  std::vector<double> errors;
  for (int rings : {4, 8, 16}) {
    CrackSheet sheet = sheet_of(disc(1, rings));
    const double edge = 1.0 / rings;
    for (int frame = 0; frame < rings; ++frame)
      advance(sheet, forward(sheet, edge), edge);
    errors.push_back(std::abs(surface_area(sheet.mesh) / (4 * std::numbers::pi) - 1));
  }
  EXPECT_LT(errors[1], 0.6 * errors[0]);
  EXPECT_LT(errors[2], 0.6 * errors[1]);
}

TEST(Advance, TheOldFrontBecomesTheCorrelationNodes) {
  CrackSheet sheet = sheet_of(disc(1, 5));
  const SheetFront old = sheet.fronts[0];
  const AdvanceResult result = advance(sheet, forward(sheet, 0.1), 0.2, {.smoothing = 0});
  ASSERT_EQ(result.succession[0].size(), old.nodes.size());
  for (std::size_t i = 0; i < old.nodes.size(); ++i) {
    const FrontSuccession& s = result.succession[0][i];
    EXPECT_EQ(s.kind, FrontSuccession::Kind::moved);
    EXPECT_EQ(s.first, old.nodes[i]);
    EXPECT_EQ(sheet.correlation[s.node], old.nodes[i]);
    EXPECT_NEAR(sheet.travelled[s.node], 0.1, 1e-12);
    EXPECT_EQ(sheet.node_birth[s.node], 1);
  }
}

TEST(Advance, MovedAndUnmovedNodesMayAlternate) {
  CrackSheet sheet = sheet_of(disc(1, 6));
  const std::size_t before = sheet.mesh.triangle_count();
  advance(sheet, forward(sheet, 0.05, 2), 1.0 / 6);
  expect_sound(sheet);
  EXPECT_EQ(sheet.mesh.triangle_count() - before, 36u);  // one triangle per edge
  EXPECT_EQ(sheet.fronts[0].nodes.size(), 36u);
  advance(sheet, forward(sheet, 0.05, 3), 1.0 / 6);
  expect_sound(sheet);
}

TEST(Advance, NothingMovesNothingGrows) {
  CrackSheet sheet = sheet_of(disc(1, 3));
  const std::size_t before = sheet.mesh.triangle_count();
  const SheetFront front = sheet.fronts[0];
  const AdvanceResult result = advance(sheet, {}, 0.3);
  EXPECT_EQ(sheet.mesh.triangle_count(), before);
  EXPECT_EQ(sheet.fronts[0].nodes, front.nodes);
  EXPECT_EQ(result.succession[0][0].kind, FrontSuccession::Kind::kept);
}

TEST(Advance, AMirroredSheetGrowsTheMirrorImageNodeByNode) {
  TriMesh mesh = disc(1, 6);
  CrackSheet one = sheet_of(mesh), two = sheet_of(mirrored(mesh));
  for (int frame = 0; frame < 5; ++frame) {
    const auto length = [&](NodeId n) { return 0.04 + 0.02 * (n.value * 7 % 5); };
    for (CrackSheet* sheet : {&one, &two}) {
      auto motions = forward(*sheet, 1);
      for (FrontMotion& m : motions)
        m.displacement *= length(m.node);
      advance(*sheet, motions, 1.0 / 6);
    }
    ASSERT_EQ(one.mesh.node_count(), two.mesh.node_count());
    ASSERT_EQ(one.mesh.triangle_count(), two.mesh.triangle_count());
  }
  const TriMesh image = mirrored(two.mesh);
  for (std::size_t i = 0; i < one.mesh.node_count(); ++i)
    EXPECT_LT((image.positions[NodeId(i)] - one.mesh.positions[NodeId(i)]).norm(), 1e-12);
  const auto sorted = [](std::array<NodeId, 3> c) {
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    return c;
  };
  for (std::size_t t = 0; t < one.mesh.triangle_count(); ++t)
    EXPECT_EQ(sorted(image.corners[TriId(t)]), sorted(one.mesh.corners[TriId(t)]));
  expect_sound(one);
}

TEST(Advance, ScalingByAPowerOfTwoKeepsTheBits) {
  TriMesh mesh = disc(1, 5);
  CrackSheet one = sheet_of(mesh), two = sheet_of(transformed(mesh, 16 * Mat3::Identity()));
  for (int frame = 0; frame < 4; ++frame) {
    advance(one, forward(one, 0.15), 0.2);
    advance(two, forward(two, 16 * 0.15), 16 * 0.2);
  }
  ASSERT_EQ(one.mesh.node_count(), two.mesh.node_count());
  EXPECT_EQ(one.mesh.corners, two.mesh.corners);
  for (std::size_t i = 0; i < one.mesh.node_count(); ++i)
    EXPECT_EQ(two.mesh.positions[NodeId(i)], 16 * one.mesh.positions[NodeId(i)]);
}

TEST(Advance, ShortEdgesMerge) {
  TriMesh mesh = disc(1, 4);  // two front nodes drawn together
  Vec3& x = mesh.positions[NodeId(38)];
  x = mesh.positions[NodeId(37)] + 0.2 * (x - mesh.positions[NodeId(37)]);
  CrackSheet sheet = sheet_of(mesh);
  const AdvanceResult result = advance(sheet, forward(sheet, 0.1), 0.35, {.smoothing = 0, .split_above = 3});
  expect_sound(sheet);
  EXPECT_EQ(sheet.fronts[0].nodes.size(), 23u);
  EXPECT_EQ(result.succession[0][0].kind, FrontSuccession::Kind::merged);
}

TEST(Advance, AClosingRingShrinksToNothing) {
  TriMesh mesh = disc(1, 6);  // an annulus whose inner front (radius 1/3) grows inwards
  mesh.corners.erase(mesh.corners.begin(), mesh.corners.begin() + 24);
  CrackSheet sheet = sheet_of(mesh);
  ASSERT_EQ(sheet.fronts.size(), 2u);
  const auto in = [&] {
    std::vector<FrontMotion> motions;
    const SheetFront* inner = nullptr;
    for (const SheetFront& f : sheet.fronts)
      if (sheet.mesh.positions[f.nodes[0]].norm() < 0.9) inner = &f;
    if (!inner) return motions;
    for (NodeId n : inner->nodes)
      motions.push_back({n, -0.1 * sheet.mesh.positions[n].normalized()});
    return motions;
  };
  for (int frame = 0; frame < 3; ++frame) {
    advance(sheet, in(), 1.0 / 6);
    expect_sound(sheet);
  }
  EXPECT_EQ(sheet.fronts.size(), 1u);
  EXPECT_NEAR(surface_area(sheet.mesh), surface_area(disc(1, 6)), 1e-3);
}

TEST(Advance, FrontsThatMeetAreArrested) {
  CrackSheet sheet;
  append_part(sheet, disc(1, 5));
  append_part(sheet, transformed(disc(1, 5), Mat3::Identity(), {2.25, 0, 0}));
  std::size_t arrested = 0;
  for (int frame = 0; frame < 4; ++frame) {
    std::vector<FrontMotion> motions;
    for (const FrontMotion& m : forward(sheet, 0.1))
      if (sheet.state[m.node] == FrontState::active) motions.push_back(m);
    arrested += advance(sheet, motions, 0.2).arrested.size();
    expect_sound(sheet);
  }
  EXPECT_GE(arrested, 4u);
  double left = -10, right = 10;  // the first disc's tip and the second's, near the line between the centres
  for (const Vec3& x : sheet.mesh.positions)
    if (std::abs(x.y()) < 0.3) {
      if (x.x() < 1.125) left = std::max(left, x.x());
      if (x.x() > 1.125) right = std::min(right, x.x());
    }
  EXPECT_LT(left, right);
  EXPECT_LT(right - left, 0.25 + 1e-12);
}

TEST(Advance, AnOpenFrontLeavesTwoMouthSides) {
  const TriMesh mesh = rectangle(1, 4, 2, 8);
  std::vector<Edge> mouth;
  const auto node = [](int i, int j) { return NodeId(j * 3 + i); };
  for (int i = 0; i < 2; ++i)
    mouth.insert(mouth.end(), {Edge(node(i, 0), node(i + 1, 0)), Edge(node(i, 8), node(i + 1, 8))});
  for (int j = 0; j < 8; ++j)
    mouth.emplace_back(node(0, j), node(0, j + 1));
  std::sort(mouth.begin(), mouth.end());
  CrackSheet sheet;
  append_part(sheet, mesh, mouth);
  ASSERT_EQ(sheet.fronts.size(), 1u);
  EXPECT_FALSE(sheet.fronts[0].closed);
  advance(sheet, forward(sheet, 0.5), 0.5);
  EXPECT_EQ(sheet.fronts[0].nodes.size(), 9u);
  EXPECT_NEAR(surface_area(sheet.mesh), 6, 1e-12);
}

TEST(Advance, ReentrantCornersNeverTurnTrianglesOver) {
  TriMesh mesh = rectangle(3, 3, 6, 6);  // a square hole of 1 × 1 in the middle, edges 0.5
  std::erase_if(mesh.corners, [&](const auto& c) {
    const Vec3 x = (mesh.positions[c[0]] + mesh.positions[c[1]] + mesh.positions[c[2]]) / 3.0;
    return (x - Vec3(1.5, 1.5, 0)).cwiseAbs().maxCoeff() < 0.5;
  });
  CrackSheet sheet = sheet_of(mesh);
  for (int frame = 0; frame < 4; ++frame) {
    advance(sheet, forward(sheet, 0.2), 0.5);
    expect_sound(sheet);
    for (std::size_t t = 0; t < sheet.mesh.triangle_count(); ++t)
      EXPECT_GT(area_vector(sheet.mesh, TriId(t)).z(), 0);
  }
}

TEST(Advance, KinkedFrontsKeepAFixedAngle) {
  CrackSheet sheet = sheet_of(rectangle(2, 2, 4, 4));
  std::vector<FrontMotion> motions;
  const auto frames = front_frames(sheet, sheet.fronts[0]);
  for (std::size_t i = 0; i < frames.size(); ++i)
    motions.push_back(
        {sheet.fronts[0].nodes[i], 0.4 * (std::cos(1.2) * frames[i].e2 + std::sin(1.2) * frames[i].e1)});
  advance(sheet, motions, 0.5, {.smoothing = 0});
  expect_sound(sheet);
  for (NodeId n : sheet.fronts[0].nodes)
    EXPECT_NEAR(sheet.mesh.positions[n].z(), 0.4 * std::sin(1.2), 1e-12);
}

TEST(Advance, RefusesNodesThatAreOnNoFront) {
  CrackSheet sheet = sheet_of(disc(1, 3));
  EXPECT_THROW(advance(sheet, {{NodeId(0), Vec3::UnitX()}}, 0.3), InputError);
  EXPECT_THROW(advance(sheet, {{NodeId(1000), Vec3::UnitX()}}, 0.3), InputError);
  const NodeId node = sheet.fronts[0].nodes[0];
  EXPECT_THROW(advance(sheet, {{node, Vec3(NAN, 0, 0)}}, 0.3), InputError);
}

#include "conchoid/surface/cut_slivers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "conchoid/intersect/self_intersection.hpp"
#include "conchoid/surface/open_slits.hpp"
#include "conchoid/surface/separation.hpp"
#include "intersect/cut_shapes.hpp"

namespace conchoid {
namespace {

using namespace shapes;

double lowest(const CutComplex& cut) {
  double least = 1e30;
  for (const auto* layer : {&cut.surface, &cut.sheet})
    for (const auto& c : *layer) {
      const Vec3 &a = cut.positions[c[0]], &b = cut.positions[c[1]], &d = cut.positions[c[2]];
      const double longest = std::max({(b - a).norm(), (d - b).norm(), (a - d).norm()});
      least = std::min(least, area_vector2(a, b, d).norm() / longest);
    }
  return least;
}

double surface_area(const CutComplex& cut) {
  double area = 0;
  for (const auto& c : cut.surface)
    area += 0.5 * area_vector2(cut.positions[c[0]], cut.positions[c[1]], cut.positions[c[2]]).norm();
  return area;
}

std::vector<double> volumes(const CutComplex& cut) {
  std::vector<double> v = glue(cut).volume;
  std::sort(v.begin(), v.end());
  return v;
}

// A sheet in a plane of mesh edges, nearly in one, and nearly through nodes.
TEST(CutSlivers, AlongEdgesOfTheSurface) {
  constexpr double smallest = 1e-4;
  for (const double offset : {0.0, 3e-6, -3e-6, 3e-5})
    for (const double turn : {0.0, 1e-5}) {
      const TriMesh body = cube(4);
      const TriMesh plane = sheet(-0.8, 0.8, -0.8, 0.8, 9, 9,
                                  [&](double u, double v) { return Vec3(u, v, offset + turn * u); });
      CutComplex cut = corefine(body, plane);
      const std::vector<double> before = volumes(cut);
      ASSERT_LT(lowest(cut), 0.5 * smallest) << "the cut has no slivers to remove";
      remove_slivers(cut, body, plane, smallest);
      EXPECT_GE(lowest(cut), smallest) << offset << ' ' << turn;
      EXPECT_NEAR(surface_area(cut), 6.0, 1e-12);
      const std::vector<double> after = volumes(cut);
      ASSERT_EQ(after.size(), 2u);
      EXPECT_NEAR(after[0] + after[1], 1.0, 1e-14);
      EXPECT_NEAR(after[0], before[0], 2 * smallest);
      for (std::size_t n = 0; n < cut.surface_node_count; ++n)
        EXPECT_EQ(cut.positions[NodeId(n)], body.positions[NodeId(n)]);
    }
}

TEST(CutSlivers, StayInTheSurfaceOfARoundBody) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  constexpr double smallest = 2e-4;
  const TriMesh body = icosphere(3);
  std::size_t before = 0, after = 0;
  const auto slivers = [&](const CutComplex& cut) {
    std::size_t count = 0;
    for (const auto* layer : {&cut.surface, &cut.sheet})
      for (const auto& c : *layer) {
        const Vec3 &a = cut.positions[c[0]], &b = cut.positions[c[1]], &d = cut.positions[c[2]];
        count += area_vector2(a, b, d).norm() <
                 smallest * std::max({(b - a).norm(), (d - b).norm(), (a - d).norm()});
      }
    return count;
  };
  for (int k = 0; k < 40; ++k) {
    // planes through three nodes of the body: slivers without area at all
    const auto node = [&] { return body.positions[NodeId(random() % body.node_count())]; };
    const Vec3 a = node(), b = node(), c = node();
    const Vec3 n = cross(b - a, c - a);
    if (n.norm() < 0.1) continue;
    const Vec3 u = (b - a).normalized(), v = cross(n, u).normalized();
    const double bend = k % 2 ? 0.02 * uniform(random) : 0;
    const TriMesh through = sheet(-3, 3, -3, 3, 31, 31, [&](double s, double t) {
      return Vec3(a + s * u + t * v + bend * s * (s - (b - a).norm()) * n.normalized());
    });
    CutComplex cut = corefine(body, through);
    const double area = surface_area(cut);
    const auto volume = volumes(cut);
    before += slivers(cut);
    remove_slivers(cut, body, through, smallest);
    after += slivers(cut);
    EXPECT_NEAR(surface_area(cut), area, 1e-11 * area);
    const auto now = volumes(cut);
    ASSERT_EQ(now.size(), volume.size());
    for (std::size_t i = 0; i < now.size(); ++i)
      EXPECT_NEAR(now[i], volume[i], 4 * smallest);
  }
  EXPECT_GT(before, 200u);
  EXPECT_LE(after, before / 8);  // those that stay slice off caps lower than `smallest`: a matter of solids
}

TEST(CutSlivers, AProperCutIsLeftAlone) {
  const TriMesh body = cube(3);
  const TriMesh plane = sheet(-0.83, 0.77, -0.8, 0.81, 5, 5, [](double u, double v) {
    return Vec3(u, v, 0.0713 + 0.0517 * u + 0.0131 * v);
  });
  const CutComplex cut = corefine(body, plane);
  CutComplex same = cut;
  remove_slivers(same, body, plane, 1e-9);
  EXPECT_EQ(same.surface, cut.surface);
  EXPECT_EQ(same.sheet, cut.sheet);
  EXPECT_EQ(same.positions, cut.positions);
  EXPECT_EQ(same.mouth, cut.mouth);
}

}  // namespace
}  // namespace conchoid

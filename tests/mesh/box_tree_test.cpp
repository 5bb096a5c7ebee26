#include "conchoid/mesh/box_tree.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "mesh/mesh_checks.hpp"

// The tree against looking at every triangle.
namespace conchoid {
namespace {

std::vector<TriId> all_overlapping(const TriMesh& mesh, const Box& box) {
  std::vector<TriId> found;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (overlap(box_of(mesh.triangle(TriId(t))), box)) found.push_back(TriId(t));
  return found;
}

std::vector<std::pair<TriId, TriId>> all_overlapping(const TriMesh& a, const TriMesh& b) {
  std::vector<std::pair<TriId, TriId>> found;
  for (std::size_t s = 0; s < a.triangle_count(); ++s)
    for (const TriId t : all_overlapping(b, box_of(a.triangle(TriId(s)))))
      found.emplace_back(TriId(s), t);
  return found;
}

/// Coordinates on a coarse lattice: many boxes touch, many triangles are the same or flat.
TriMesh on_a_lattice(std::size_t triangles, unsigned seed) {
  TriMesh mesh = random_soup(triangles, seed);
  for (Vec3& x : mesh.positions)
    x = (4 * x).array().round().matrix() / 4;
  return mesh;
}

}  // namespace

TEST(BoxTree, FindsTheTrianglesThatABoxMeets) {
  for (const TriMesh& mesh : {random_soup(300, 1), on_a_lattice(300, 2)}) {
    std::vector<Box> boxes;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
      boxes.push_back(box_of(mesh.triangle(TriId(t))));
    const BoxTree tree(mesh), of_boxes(boxes);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1.2, 1.2);
    for (int i = 0; i < 500; ++i) {
      const Vec3 p(uniform(random), uniform(random), uniform(random));
      const Vec3 q = p + 0.3 * Vec3(uniform(random), uniform(random), uniform(random));
      const Box box{p.cwiseMin(q), p.cwiseMax(q)};
      ASSERT_EQ(tree.overlapping(box), all_overlapping(mesh, box));
      ASSERT_EQ(of_boxes.overlapping(box), all_overlapping(mesh, box));
    }
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      const Box own = box_of(mesh.triangle(TriId(t)));
      ASSERT_EQ(tree.overlapping(own), all_overlapping(mesh, own)) << "boxes that touch meet";
    }
  }
}

TEST(BoxTree, PairsOfTwoMeshesComeAscendingWhicheverIsLarger) {
  const TriMesh large = on_a_lattice(200, 4), small = random_soup(70, 5);
  EXPECT_EQ(overlapping_boxes(large, small), all_overlapping(large, small));
  EXPECT_EQ(overlapping_boxes(small, large), all_overlapping(small, large));
  EXPECT_FALSE(overlapping_boxes(small, large).empty());
}

TEST(BoxTree, VisitsWhateverMayBeAsNearAsTheBound) {
  const TriMesh mesh = on_a_lattice(400, 6);
  const BoxTree tree(mesh);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  std::size_t visited = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 x(uniform(random), uniform(random), uniform(random));
    // By distances from boxes, so that ties are ties to the last bit: all of the nearest are seen.
    std::vector<TriId> nearest, seen;
    double least = std::numeric_limits<double>::infinity(), bound = least;
    const auto distance = [&](TriId t) { return squared_distance(box_of(mesh.triangle(t)), x); };
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
      least = std::min(least, distance(TriId(t)));
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
      if (distance(TriId(t)) == least) nearest.push_back(TriId(t));
    tree.visit_near(x, bound, [&](TriId t) {
      ++visited;
      if (distance(t) == least) seen.push_back(t);
      return bound = std::min(bound, distance(t));
    });
    std::sort(seen.begin(), seen.end());
    ASSERT_EQ(seen, nearest);
  }
  EXPECT_LT(visited, 300u * 400u / 4) << "far boxes are passed over";
}

TEST(BoxTree, OfNothingFindsNothing) {
  const BoxTree tree{TriMesh()};
  EXPECT_TRUE(tree.overlapping({Vec3::Constant(-1), Vec3::Constant(1)}).empty());
  tree.visit_near(Vec3::Zero(), 1e300, [](TriId) -> double { throw std::logic_error("visited"); });
  EXPECT_TRUE(overlapping_boxes(TriMesh(), random_soup(5, 8)).empty());
}

}  // namespace conchoid

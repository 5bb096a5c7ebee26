#include "conchoid/crack/fine/face_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "conchoid/crack/closing/advance_fronts.hpp"
#include "conchoid/crack/fine/fine_front.hpp"
#include "crack_samples.hpp"

using namespace conchoid;
using namespace conchoid::testing;

namespace {

FaceGrid grid_of(const TriMesh& mesh, double cell) {
  FaceGrid grid(cell);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    grid.take(mesh, TriId(t), static_cast<int>(t) % 3);
  return grid;
}

/// Every triangle tried: the path's first crossing by signed volumes.
std::optional<double> first_by_force(const TriMesh& mesh, const Vec3& from, const Vec3& to) {
  std::optional<double> best;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Triangle x = mesh.triangle(TriId(t));
    const Vec3 n = area_vector2(x[0], x[1], x[2]).normalized();
    const double a = n.dot(from - x[0]), b = n.dot(to - x[0]);
    if (a * b > 0 || std::abs(b - a) <= 0.2 * (to - from).norm()) continue;
    const auto side = [&](int k) { return cross(x[k] - from, x[(k + 1) % 3] - from).dot(to - from) > 0; };
    if (side(0) != side(1) || side(1) != side(2)) continue;
    const double s = a / (a - b);
    if (!best || s < *best) best = s;
  }
  return best;
}

TriMesh shaken_sheet() {
  TriMesh mesh = rectangle(2, 2, 20, 20);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-0.04, 0.04);
  for (Vec3& x : mesh.positions)
    x += Vec3(any(random), any(random), 3 * any(random));
  return mesh;
}

}  // namespace

TEST(FaceGrid, FindsWhatTryingEveryTriangleFinds) {
  const TriMesh mesh = shaken_sheet();
  for (double cell : {0.05, 0.2, 1.0}) {
    const FaceGrid grid = grid_of(mesh, cell);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-0.5, 2.5), step(-0.3, 0.3);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 from(any(random), any(random), 0.5 * step(random));
      const Vec3 to = from + Vec3(step(random), step(random), step(random));
      const auto found = grid.first_hit(mesh, from, to, {});
      const auto expected = first_by_force(mesh, from, to);
      ASSERT_EQ(found.has_value(), expected.has_value()) << i;
      if (!found) continue;
      ++hits;
      EXPECT_NEAR(found->fraction, *expected, 1e-12);
      EXPECT_EQ(found->part, static_cast<int>(found->triangle.index()) % 3);
    }
    EXPECT_GT(hits, 200);
  }
}

TEST(FaceGrid, OwnTrianglesAndGrazedOnesAreNotInTheWay) {
  const TriMesh mesh = rectangle(1, 1, 1, 1);
  const FaceGrid grid = grid_of(mesh, 0.5);
  const Vec3 above(0.7, 0.2, 0.1), below(0.7, 0.2, -0.1), far(3.7, 0.2, -0.1);
  EXPECT_TRUE(grid.first_hit(mesh, above, below, {}));
  EXPECT_FALSE(grid.first_hit(mesh, above, below, std::array{NodeId(1)}));
  EXPECT_TRUE(grid.first_hit(mesh, above, below, std::array{NodeId(2)}));
  EXPECT_FALSE(grid.first_hit(mesh, Vec3(0, 0.2, 0.05), Vec3(1, 0.2, -0.05), {}));
  EXPECT_FALSE(grid.first_hit(mesh, above, far - Vec3(0, 0, 0.2), {}));
}

namespace {

constexpr double kEdge = 0.2, kSpacing = 0.02, kToughness = 1e6;

struct Cracks {
  CrackSheet sheet;
  FineFront fine;
  explicit Cracks(const std::vector<TriMesh>& parts)
      : sheet([&] {
          CrackSheet s;
          for (const TriMesh& part : parts)
            append_part(s, part);
          return s;
        }()),
        fine(sheet, {.resolution = kEdge, .spacing = kSpacing}) {}

  /// All active nodes of front `moving` go on at `angle`.
  void frames(int count, std::size_t moving, double angle) {
    for (int i = 0; i < count && moving < sheet.fronts.size(); ++i) {
      std::vector<FrontStep> steps;
      const SheetFront& front = sheet.fronts[moving];
      const auto frames = front_frames(sheet, front);
      for (std::size_t k = 0; k < front.nodes.size(); ++k)
        if (sheet.state[front.nodes[k]] == FrontState::active)
          steps.push_back({front.nodes[k], frames[k], angle, 2 * kToughness});
      if (!steps.empty())
        advance_fronts(sheet, fine, steps,
                       {kLaw,
                        [](const Vec3&) {
                          return Toughness{kToughness, Vec3::Zero()};
                        }},
                       kEdge);
    }
  }
};

}  // namespace

TEST(FineFront, StopsJustBehindTheFaceOfAnotherCrack) {
  // A disc in the plane z = 0 grows towards a wall in the plane x = 1.
  TriMesh wall = rectangle(4, 4, 20, 20);
  for (Vec3& x : wall.positions)
    x = Vec3(1, x.x() - 2, x.y() - 2);
  Cracks cracks({disc(0.4, 2), wall});
  cracks.frames(8, 0, 0);
  double farthest = -1, back = 0;
  for (const MarkerCurve& curve : cracks.fine.curves())
    for (const Marker& m : curve.markers)
      if (curve.part == 0) {
        farthest = std::max(farthest, m.position.x());
        back = std::min(back, m.position.x());
      }
  EXPECT_GT(farthest, 1);
  EXPECT_LT(farthest, 1 + kSpacing);
  EXPECT_LT(back, -1.2);  // away from the wall it has grown on
  EXPECT_FALSE(cracks.fine.stopped_nodes().empty());
  for (NodeId n : cracks.fine.stopped_nodes())
    EXPECT_EQ(cracks.sheet.state[n], FrontState::arrested);
}

TEST(FineFront, ACrackThatCurlsUpStopsBeforeItself) {
  // A strip whose front turns by 34° in every frame comes round to its own face.
  Cracks cracks({rectangle(1, 0.4, 5, 2)});
  cracks.frames(14, 0, 0.6);
  std::size_t arrested = 0;
  for (const MarkerCurve& curve : cracks.fine.curves())
    for (const Marker& m : curve.markers)
      arrested += m.arrested ? 1 : 0;
  EXPECT_GT(arrested, 10u);
}

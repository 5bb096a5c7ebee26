#include "conchoid/study/compare.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "conchoid/core/context.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/study/solid_overlap.hpp"
#include "conchoid/study/surface_distance.hpp"
#include "io/samples.hpp"

using namespace conchoid;

namespace {

TriMesh moved(TriMesh mesh, const Vec3& by) {
  for (Vec3& x : mesh.positions)
    x += by;
  return mesh;
}

/// The cube broken at z = height, with a front that carries K times (K_I, K_II, K_III) = (1, 0.5, 0).
RunData run_of(double height, int frames, double K) {
  RunData run;
  run.document.body = Box{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};
  run.document.frames = frames;
  run.crack = sheet(16, height);
  for (int frame = 1; frame <= frames; ++frame)
    for (int node = 0; node < 5; ++node) {
      FrontRow row;
      row.frame = frame;
      row.node = node;
      row.intensity = K * Vec3(node % 2 ? 1 : -1, 0.5, 1e-9 * node);
      run.front.push_back(row);
    }
  run.fragments = broken_cube(height);
  for (const Fragment& f : run.fragments)
    run.document.fragments.push_back(fragment_record(f));
  return run;
}

}  // namespace

TEST(SurfaceDistance, ParallelSheetsAreAsFarApartAsTheyWereMoved) {
  const auto d = symmetric_distance(sheet(7, 0), sheet(10, 0.125));
  EXPECT_NEAR(d.mean, 0.125, 1e-15);
  EXPECT_NEAR(d.p95, 0.125, 1e-15);
}

TEST(SurfaceDistance, SameSurfaceHasNoneWhateverItsTriangles) {
  EXPECT_EQ(symmetric_distance(sheet(5, 0.2), sheet(5, 0.2)).p95, 0);
  EXPECT_LT(symmetric_distance(sheet(5, 0.2), sheet(8, 0.2)).p95, 1e-16);
}

TEST(SurfaceDistance, SidewaysShiftLeavesAStripUncovered) {
  // A strip of width 1/4 sticks out on each side: distances there run from 0 to 1/4, mean 1/8, over a quarter
  // of the area.
  const auto d = symmetric_distance(sheet(8, 0), moved(sheet(8, 0), {0.25, 0, 0}));
  EXPECT_NEAR(d.mean, 0.125 / 4, 2e-4);
  EXPECT_NEAR(d.p95, 0.20, 2e-3);
}

TEST(SurfaceDistance, MixtureOfTriangleSizesDoesNotBiasTheMean) {
  // The plane x-y, finely meshed where the other surface is near and coarsely where it is far: sheets in an
  // open wedge.
  TriMesh wedge = sheet(1, 0);
  for (Vec3& x : wedge.positions)
    x.z() = x.x() + 0.5;  // height 0 … 1 over the plane
  TriMesh plane;
  for (double x : {-0.5, -0.49, -0.48, -0.47, -0.3, 0.5})
    for (double y : {-0.5, 0.5})
      plane.positions.add({x, y, 0});
  for (int i = 0; i < 5; ++i) {
    plane.corners.add({NodeId(2 * i), NodeId(2 * i + 2), NodeId(2 * i + 3)});
    plane.corners.add({NodeId(2 * i), NodeId(2 * i + 3), NodeId(2 * i + 1)});
  }
  // From the wedge (uniform in x) down to the plane: distance = height, mean 1/2, 95 % below 0.95.
  EXPECT_NEAR(one_sided_distance(wedge, plane).mean, 0.5, 1e-3);
  EXPECT_NEAR(one_sided_distance(wedge, plane).p95, 0.95, 1e-3);
  // From the plane up to the wedge: (x + 1/2)/√2 wherever the foot lies on it, mean 1/(2√2).
  EXPECT_NEAR(one_sided_distance(plane, wedge).mean, 0.5 / std::sqrt(2.0), 1e-3);
}

TEST(SolidOverlap, BoxesHaveTheRatioOfTheirVolumes) {
  const TriMesh unit = box({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(intersection_over_union(unit, unit), 1);
  EXPECT_NEAR(intersection_over_union(unit, box({0, 0, 0}, {1, 1, 2})), 0.5, 2e-3);
  EXPECT_NEAR(intersection_over_union(unit, moved(unit, {0.5, 0, 0})), 1.0 / 3.0, 2e-3);
  EXPECT_NEAR(intersection_over_union(unit, moved(unit, {0.5, 0.5, 0.5})), 1.0 / 15.0, 2e-3);
  EXPECT_EQ(intersection_over_union(unit, moved(unit, {2, 0, 0})), 0);
  EXPECT_EQ(intersection_over_union(unit, TriMesh{}), 0);
  EXPECT_TRUE(std::isnan(intersection_over_union(TriMesh{}, TriMesh{})));
}

TEST(SolidOverlap, HoleInsideCounts) {
  // A cube with a cubic hole of half its edge: 7/8 of the full one.
  TriMesh hollow = box({0, 0, 0}, {1, 1, 1});
  const TriMesh hole = box({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75});
  for (const Vec3& x : hole.positions)
    hollow.positions.add(x);
  for (const auto& c : hole.corners)
    hollow.corners.add({NodeId(c[0].value + 8), NodeId(c[2].value + 8), NodeId(c[1].value + 8)});
  EXPECT_NEAR(intersection_over_union(hollow, box({0, 0, 0}, {1, 1, 1})), 7.0 / 8.0, 3e-3);
}

TEST(SolidOverlap, HalvesAreMatchedByPlaceNotByRank) {
  const std::vector<TriMesh> a{box({0, 0, 0}, {1, 1, 0.51}), box({0, 0, 0.51}, {1, 1, 1})};
  const std::vector<TriMesh> b{box({0, 0, 0.49}, {1, 1, 1}),
                               box({0, 0, 0}, {1, 1, 0.49})};  // the other half is larger
  EXPECT_NEAR(largest_fragment_overlap(a, b), 0.49 / 0.51, 2e-3);
}

TEST(SifLogError, FactorsPerModeAndSilentModes) {
  const RunData a = run_of(0, 4, 1e6), b = run_of(0, 6, 1.1e6);
  const Vec3 error = sif_log_error(a.front, b.front);
  EXPECT_NEAR(error[0], std::log(1.1), 1e-12);
  EXPECT_NEAR(error[1], std::log(1.1), 1e-12);
  EXPECT_TRUE(std::isnan(error[2]));  // mode III is noise in both runs
  EXPECT_TRUE(std::isnan(sif_log_error(a.front, {})[0]));
  RunData torn = a;
  for (FrontRow& row : torn.front)
    row.intensity[2] = row.intensity.norm();
  const double noticed = sif_log_error(a.front, torn.front)[2];
  EXPECT_GT(noticed, std::log(10));
  EXPECT_TRUE(std::isfinite(noticed));
}

TEST(Compare, IdenticalRunsDifferInNothing) {
  const RunData a = run_of(0.1, 5, 1e6);
  const Comparison c = compare(a, a);
  EXPECT_EQ(c.surface_mean, 0);
  EXPECT_EQ(c.surface_p95, 0);
  EXPECT_DOUBLE_EQ(c.bbox_diagonal, std::sqrt(3.0));
  EXPECT_EQ(c.frames, (std::array<int, 2>{5, 5}));
  EXPECT_EQ(c.sif_log_error[0], 0);
  EXPECT_EQ(c.area_ratio, 1);
  EXPECT_EQ(c.largest_fragment_iou, 1);
  EXPECT_TRUE(c.same_body);
}

TEST(Compare, SheetMovedByATenth) {
  const Comparison c = compare(run_of(0, 5, 1e6), run_of(0.1, 6, 1e6));
  EXPECT_NEAR(c.surface_mean, 0.1, 1e-12);
  EXPECT_NEAR(c.surface_p95, 0.1, 1e-12);
  EXPECT_NEAR(c.area_ratio, 1, 1e-12);
  EXPECT_NEAR(c.largest_fragment_iou, 0.5 / 0.6, 3e-3);
  EXPECT_EQ(c.frames, (std::array<int, 2>{5, 6}));
}

TEST(Compare, OrderOfTheRunsOnlyTurnsTheRatios) {
  const RunData a = run_of(0, 5, 1e6);
  RunData b = run_of(0.1, 6, 2e6);
  b.crack = sheet(3, 0.1);
  for (Vec3& x : b.crack.positions)
    x *= 0.5;
  const Comparison ab = compare(a, b), ba = compare(b, a);
  EXPECT_DOUBLE_EQ(ab.surface_mean, ba.surface_mean);
  EXPECT_DOUBLE_EQ(ab.surface_p95, ba.surface_p95);
  EXPECT_DOUBLE_EQ(ab.area_ratio * ba.area_ratio, 1);
  EXPECT_DOUBLE_EQ(ab.sif_log_error[0], ba.sif_log_error[0]);
  EXPECT_DOUBLE_EQ(ab.largest_fragment_iou, ba.largest_fragment_iou);
}

TEST(Compare, AMissingCrackIsADiagonalAway) {
  const RunData a = run_of(0, 5, 1e6);
  RunData none = a;
  none.crack = {};
  EXPECT_DOUBLE_EQ(compare(a, none).surface_mean, std::sqrt(3.0));
  EXPECT_EQ(compare(none, none).surface_mean, 0);
  EXPECT_EQ(compare(none, none).area_ratio, 1);
  RunData other = a;
  other.document.body->high.x() = 2;
  EXPECT_FALSE(compare(a, other).same_body);
}

TEST(Compare, SameNumbersForEveryThreadCountAndForTwiceTheSize) {
  const RunData a = run_of(0.05, 5, 1e6), b = run_of(0.1, 6, 2e6);
  const auto compared = [&](int threads) {
    return ExecutionContext(threads).run([&] { return comparison_json(compare(a, b)); });
  };
  const std::string one = compared(1);
  EXPECT_EQ(compared(2), one);
  const auto doubled = [](RunData run) {
    for (Vec3& x : run.crack.positions)
      x *= 2;
    for (Fragment& f : run.fragments)
      for (Vec3& x : f.mesh.positions)
        x *= 2;
    run.document.body->low *= 2;
    run.document.body->high *= 2;
    return run;
  };
  const Comparison small = compare(a, b), large = compare(doubled(a), doubled(b));
  EXPECT_EQ(large.surface_mean, 2 * small.surface_mean);
  EXPECT_EQ(large.surface_p95, 2 * small.surface_p95);
  EXPECT_EQ(large.largest_fragment_iou, small.largest_fragment_iou);
}

namespace {

/// A crack that grows as a half disc about the middle of the edge x = −½, the front at `step` × frame, tilted
/// by `tilt` about y; kink angles all `kink`.
RunData half_disc(int frames, double step, double tilt, double kink) {
  RunData run = run_of(0, frames, 1e6);
  run.front.clear();
  run.document.timings.clear();
  constexpr int points = 40;
  for (int frame = 1; frame <= frames; ++frame) {
    const double r = step * frame;
    for (int i = 0; i <= points; ++i) {
      const double phi = (i - points / 2.0) / points * 3.0;
      FrontRow row;
      row.frame = frame;
      row.node = i;
      const double x = r * std::cos(phi);
      row.position = {-0.5 + x * std::cos(tilt), r * std::sin(phi), x * std::sin(tilt)};
      row.intensity = Vec3(2e6, 0, 0);
      row.speed = 1;
      row.kink_angle = kink;
      run.front.push_back(row);
    }
    FrameRecord record;
    record.frame = frame;
    record.crack_area = 1.5 * r * r;
    run.document.timings.push_back(record);
  }
  return run;
}

}  // namespace

TEST(Compare, OverTheCracksOwnDiagonal) {
  RunData small = run_of(0, 5, 1e6), moved_up = run_of(0.1, 5, 1e6);
  for (RunData* run : {&small, &moved_up})
    for (Vec3& x : run->crack.positions)
      x.head<2>() *= 0.1;
  const Comparison c = compare(small, moved_up);
  EXPECT_NEAR(c.surface_mean, 0.1, 1e-12);
  EXPECT_NEAR(c.crack_diagonal, 0.1 * std::sqrt(2.0), 1e-12);
  RunData none = small;
  none.crack = {};
  EXPECT_NEAR(compare(none, small).crack_diagonal, 0.1 * std::sqrt(2.0), 1e-12);
  EXPECT_TRUE(std::isnan(compare(none, none).crack_diagonal));
}

// The front of the faster run lies ahead by the difference of the radii, in every frame that both have.
TEST(Compare, FrontsAndAreaOverFrames) {
  const Comparison c = compare(half_disc(4, 0.1, 0, 0.1), half_disc(6, 0.12, 0, 0.15));
  ASSERT_EQ(c.history.size(), 4u);
  double mean = 0;
  for (const FrameComparison& f : c.history) {
    EXPECT_NEAR(f.front_distance, 0.02 * f.frame, 2e-4 * f.frame);
    EXPECT_DOUBLE_EQ(f.crack_area[1] / f.crack_area[0], 1.44);
    EXPECT_EQ(f.intensity[0][0], 2e6);
    EXPECT_NEAR(f.kink_angle, 0.05, 1e-12);
    mean += f.front_distance / 4;
  }
  EXPECT_DOUBLE_EQ(c.front_distance, mean);
  EXPECT_NEAR(c.kink_angle_error, 0.05, 1e-12);
}

// Two fronts of the same radius in planes that include an angle: the ends meet, the middle is apart by
// 2 r sin(angle/2).
TEST(Compare, TurnedFront) {
  const double angle = 0.2;
  const Comparison c = compare(half_disc(3, 0.1, 0, 0), half_disc(3, 0.1, angle, 0));
  for (const FrameComparison& f : c.history) {
    const double r = 0.1 * f.frame, chord = 2 * r * std::sin(angle / 2);
    EXPECT_LT(f.front_distance, chord);
    EXPECT_GT(f.front_distance, 0.5 * chord);
  }
  EXPECT_EQ(c.kink_angle_error, 0);
}

TEST(Compare, PointsThatStayHaveNoKink) {
  RunData a = half_disc(2, 0.1, 0, 0.3), b = half_disc(2, 0.1, 0, 0);
  for (FrontRow& row : b.front)
    row.speed = 0;
  EXPECT_TRUE(std::isnan(compare(a, b).kink_angle_error));
  b.front.clear();
  EXPECT_TRUE(compare(a, b).history.empty());
  EXPECT_TRUE(std::isnan(compare(a, b).front_distance));
}

TEST(Compare, StopVolumesAndChamferOfTheFragments) {
  RunData a = run_of(0, 5, 1e6), b = run_of(0.1, 6, 1e6);
  a.document.stop = StopReason::separated;
  b.document.stop = StopReason::arrested;
  const Comparison c = compare(a, b);
  EXPECT_EQ(c.stop[0], StopReason::separated);
  EXPECT_EQ(c.stop[1], StopReason::arrested);
  ASSERT_EQ(c.volumes[1].size(), 2u);
  EXPECT_NEAR(c.volumes[1][0], 0.6, 1e-12);
  EXPECT_NEAR(c.volume_error, 0.2, 1e-12);
  // Per pair a face of a share of 1/4 … 1/3 of the surface is 0.1 apart, and strips of the sides up to that.
  EXPECT_GT(c.fragment_chamfer, 0.1 / 5);
  EXPECT_LT(c.fragment_chamfer, 0.1 / 2);
  EXPECT_EQ(compare(a, a).fragment_chamfer, 0);
  EXPECT_EQ(compare(a, a).volume_error, 0);
  RunData whole = a;
  whole.fragments.clear();
  whole.document.fragments.clear();
  EXPECT_TRUE(std::isnan(compare(a, whole).fragment_chamfer));
  EXPECT_TRUE(std::isnan(compare(a, whole).volume_error));
}

TEST(Compare, RunFoldersAndJson) {
  const TemporaryFolder scratch;
  for (const auto& [name, run] : {std::pair("a", run_of(0, 5, 1e6)), std::pair("b", run_of(0.1, 6, 1e6))}) {
    RunFolder folder(scratch / name);
    folder.write_front_csv(run.front);
    folder.write_crack(run.crack);
    folder.write_fragments(run.fragments);
    folder.write_run_json(run.document);
  }
  const Comparison c = compare_runs(scratch / "a", scratch / "b");
  EXPECT_EQ(comparison_json(c), comparison_json(compare(run_of(0, 5, 1e6), run_of(0.1, 6, 1e6))));
  const auto json = nlohmann::json::parse(comparison_json(c));
  EXPECT_EQ(json["frames"], nlohmann::json({5, 6}));
  EXPECT_NEAR(json["surface_mean"].get<double>(), 0.1, 1e-12);
  EXPECT_TRUE(json["sif_log_error"]["III"].is_null());
  EXPECT_EQ(json["history"].size(), 5u);
  EXPECT_EQ(json["history"][0]["K"].size(), 2u);
  EXPECT_TRUE(json["history"][0]["crack_area"][0].is_null());
  EXPECT_TRUE(json["kink_angle_error"].is_null());
  EXPECT_EQ(json["stop"].size(), 2u);
  for (const char* key : {"crack_diagonal", "front_distance", "volumes", "volume_error", "fragment_chamfer"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_THROW(compare_runs(scratch / "a", scratch / "c"), InputError);
}

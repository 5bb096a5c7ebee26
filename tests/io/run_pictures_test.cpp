#include "conchoid/io/run_pictures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "conchoid/core/error.hpp"
#include "io/samples.hpp"

using namespace conchoid;

namespace {

/// The cube broken at z = 0 by a front that came from −x; K grew in proportion to the way.
RunData broken_run() {
  RunData run;
  run.document.method = "bem";
  run.document.stop = StopReason::separated;
  run.document.frames = 5;
  run.crack = sheet(10, 0);
  run.fragments = broken_cube(0);
  for (const Fragment& f : run.fragments)
    run.document.fragments.push_back(fragment_record(f));
  for (int frame = 1; frame <= 5; ++frame)
    for (int k = 0; k <= 4; ++k) {
      FrontRow row;
      row.frame = frame;
      row.position = {-0.5 + 0.2 * frame, -0.5 + 0.25 * k, 0};
      row.intensity = {3e5 * frame, 0, -4e5 * frame};
      run.front.push_back(row);
    }
  return run;
}

RunFolder write_frames(const std::filesystem::path& path) {
  RunFolder folder(path);
  for (int frame = 1; frame <= 5; ++frame) {
    FrameData data;
    data.body = box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
    data.crack = sheet(4, 0);
    data.opening.resize(data.crack.node_count(), Vec3(0, 0, 1e-6 * frame));
    folder.write_frame(frame, data);
  }
  return folder;
}

}  // namespace

TEST(RunPictures, IntensityIsThatOfTheFrontAsItCameBy) {
  const PicturePanel panel = run_panel(broken_run(), "", {.view = RunView::intensity});
  EXPECT_EQ(panel.value_name, "|K| [MPa√m]");
  const PictureMesh& crack = panel.meshes.back();
  ASSERT_EQ(crack.node_value.size(), crack.mesh.node_count());
  for (std::size_t n = 0; n < crack.node_value.size(); ++n) {
    const double x = crack.mesh.positions[NodeId(n)].x();
    const double nearest = std::clamp(std::round((x + 0.5) / 0.2), 1.0, 5.0);
    EXPECT_NEAR(crack.node_value[n], 0.5 * nearest, 0.35) << x;
  }
  EXPECT_LT(panel.meshes[0].opacity, 1);
}

TEST(RunPictures, CrackAloneIsNothingElse) {
  const RunData run = broken_run();
  const PicturePanel panel = run_panel(run, "", {.view = RunView::crack});
  ASSERT_EQ(panel.meshes.size(), 1u);
  EXPECT_EQ(panel.meshes[0].mesh.corners, run.crack.corners);
}

TEST(RunPictures, OpeningOfTheLastFrameExaggerated) {
  const TemporaryFolder scratch;
  write_frames(scratch / "run");
  const RunData run = broken_run();
  const PicturePanel panel = run_panel(run, scratch / "run", {.view = RunView::opening, .exaggerate = 1e4});
  ASSERT_EQ(panel.meshes.size(), 3u);                   // two faces, and the body
  EXPECT_NEAR(panel.meshes[0].node_value[3], 5, 1e-9);  // µm
  EXPECT_NEAR(panel.meshes[0].mesh.positions[NodeId(0)].z() - panel.meshes[1].mesh.positions[NodeId(0)].z(),
              1e4 * 5e-6, 1e-12);
}

TEST(RunPictures, ContactSheetEndsWithTheLastFrame) {
  const TemporaryFolder scratch;
  write_frames(scratch / "run");
  const auto panels = frame_panels(broken_run(), scratch / "run", 3, {});
  ASSERT_EQ(panels.size(), 3u);
  EXPECT_EQ(panels[0].title, "frame 1");
  EXPECT_EQ(panels[1].title, "frame 3");
  EXPECT_EQ(panels[2].title, "frame 5");
  EXPECT_TRUE(panels[0].legend);
  EXPECT_FALSE(panels[2].legend);
  EXPECT_NEAR(panels[1].meshes[0].node_value[0], 3, 1e-9);
  const auto by_intensity = frame_panels(broken_run(), scratch / "run", 64, {.view = RunView::intensity});
  EXPECT_EQ(by_intensity.size(), 5u);
  EXPECT_NEAR(by_intensity[0].meshes[0].node_value.back(), 0.5,
              1e-9);  // the first frame knows no later front
}

TEST(RunPictures, APieceThatHasComeOffHasNoOpening) {
  const TemporaryFolder scratch;
  RunFolder folder = write_frames(scratch / "run");
  FrameData data;
  data.body = box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  data.crack = sheet(4, 0);
  data.opening.resize(data.crack.node_count(), Vec3(0, 0, 1e3));
  folder.write_frame(6, data);
  const PicturePanel panel = run_panel(broken_run(), scratch / "run", {.view = RunView::opening});
  EXPECT_NEAR(panel.meshes[0].node_value[0], 5, 1e-9);  // of frame 5
  const auto panels = frame_panels(broken_run(), scratch / "run", 6, {});
  EXPECT_TRUE(panels[5].meshes[0].node_value.empty());
  EXPECT_FALSE(panels[5].meshes[0].face_kind.empty());
}

TEST(RunPictures, WithoutFramesThereIsAMessage) {
  const TemporaryFolder scratch;
  EXPECT_THROW(frame_panels(broken_run(), scratch / "nowhere", 3, {}), InputError);
  EXPECT_THROW(run_view_from_name("smoke"), InputError);
}

TEST(RunPictures, UpIsYOnlyWhereTheBodyIsTallestAlongIt) {
  RunDocument run;
  EXPECT_EQ(usual_up(run), Vec3::UnitZ());
  run.body = Box{Vec3(0, 0, 0), Vec3(1, 2, 1)};
  EXPECT_EQ(usual_up(run), Vec3::UnitY());
  run.body = Box{Vec3(0, 0, 0), Vec3(1, 1.1, 1)};
  EXPECT_EQ(usual_up(run), Vec3::UnitZ());
  run.body = Box{Vec3(0, 0, 0), Vec3(3, 2, 1)};
  EXPECT_EQ(usual_up(run), Vec3::UnitZ());
}

TEST(RunPictures, AChipLeavesItsNotch) {
  // A chip in the middle of a face: its centre is hardly away from that of the body.
  std::vector<Fragment> pieces(2);
  pieces[0].mesh = box({-0.5, -0.5, -0.05}, {0.5, 0.5, 0.05});
  pieces[1].mesh = box({-0.05, -0.05, 0.0}, {0.05, 0.05, 0.05});
  for (Fragment& f : pieces) {
    f.volume = f.mass = enclosed_volume(f.mesh);
    f.center_of_mass = bounding_box(f.mesh).center();
    f.face_kind.assign(f.mesh.triangle_count(), FaceKind::original);
  }
  for (std::size_t t = 0; t < pieces[1].mesh.triangle_count(); ++t)
    if (unit_normal(pieces[1].mesh, TriId(t)).z() < 0.9) pieces[1].face_kind[t] = FaceKind::fracture;
  const std::vector<PictureMesh> apart = exploded(pieces, 0.25);
  EXPECT_GE((apart[1].offset - apart[0].offset).z(), 0.05) << "by its height at least";
  EXPECT_TRUE(exploded(pieces, 0)[1].offset.isZero(0));
}

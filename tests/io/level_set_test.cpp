#include "conchoid/io/level_set.hpp"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetMeasure.h>

#include <numbers>

#include "conchoid/core/context.hpp"
#include "io/samples.hpp"

using namespace conchoid;

TEST(FragmentsVdb, OpenVdbFindsEveryPieceWithItsVolume) {
  const TemporaryFolder folder;
  auto pieces = broken_cube(0.1);
  for (Fragment& f : pieces)  // far from the origin: no figures are lost
    for (Vec3& x : f.mesh.positions)
      x += Vec3(1000, -2000, 3000);
  write_fragments_vdb(folder / "f.vdb", pieces, 0.02);
  openvdb::initialize();
  openvdb::io::File file((folder / "f.vdb").string());
  file.open();
  const auto grids = file.getGrids();
  ASSERT_EQ(grids->size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>((*grids)[i]);
    EXPECT_EQ(grid->getName(), i == 0 ? "fragment_000" : "fragment_001");
    EXPECT_EQ(grid->getGridClass(), openvdb::GRID_LEVEL_SET);
    EXPECT_NEAR(openvdb::tools::levelSetVolume(*grid), pieces[i].volume, 0.01 * pieces[i].volume);
    EXPECT_NEAR(openvdb::tools::levelSetArea(*grid), surface_area(pieces[i].mesh),
                0.03 * surface_area(pieces[i].mesh));
    const Vec3 inside = bounding_box(pieces[i].mesh).center();
    const auto accessor = grid->getConstAccessor();
    const auto at = [&](const Vec3& x) {
      return accessor.getValue(openvdb::Coord::round(grid->transform().worldToIndex({x[0], x[1], x[2]})));
    };
    EXPECT_LT(at(inside), 0);
    EXPECT_GT(at(inside + Vec3(1, 0, 0)), 0);
    EXPECT_NEAR(at(inside + Vec3(0.5, 0, 0)), 0, 0.011);
  }
}

TEST(FragmentsVdb, SameBytesForEveryThreadCount) {
  const TemporaryFolder folder;
  std::string bytes[2];
  for (int threads = 1; threads <= 2; ++threads) {
    ExecutionContext(threads).run([&] { write_fragments_vdb(folder / "f.vdb", broken_cube(0.1), 0.01); });
    bytes[threads - 1] = file_content(folder / "f.vdb");
  }
  EXPECT_GT(bytes[0].size(), 10000u);
  EXPECT_TRUE(bytes[0] == bytes[1]);
}

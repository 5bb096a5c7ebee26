#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <fstream>
#include <limits>

#include "conchoid/core/error.hpp"
#include "conchoid/material/voxels.hpp"
#include "temporary_folder.hpp"

// Files written by OpenVDB itself.
namespace conchoid {
namespace {

namespace fs = std::filesystem;

class Vdb : public testing::Test {
 protected:
  Vdb() { openvdb::initialize(); }

  /// 4 × 3 × 2 voxels of edge 0.5 from index (10, −1, 3): 1 + i + 10 j + 100 k, counted from the first.
  static openvdb::FloatGrid::Ptr grid(const std::string& name) {
    auto grid = openvdb::FloatGrid::create(1.0f);
    grid->setName(name);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
    auto write = grid->getAccessor();
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 2; ++k)
          write.setValue({10 + i, -1 + j, 3 + k}, static_cast<float>(1 + i + 10 * j + 100 * k));
    return grid;
  }
  fs::path write(const openvdb::GridPtrVec& grids) const {
    const fs::path path = folder_ / "field.vdb";
    openvdb::io::File file(path.string());
    file.write(grids);
    file.close();
    return path;
  }
  void expect_refused(const fs::path& path, const std::string& name, const std::string& said) const {
    try {
      read_vdb(path, name);
      ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(path.filename().string()), std::string::npos) << error.what();
    }
  }

  test::TemporaryFolder folder_;
};

TEST_F(Vdb, TheBoxOfActiveVoxelsIsReadWhereItLies) {
  const auto grid = read_vdb(write({Vdb::grid("K")}), "");
  EXPECT_EQ(grid->size, (std::array{4, 3, 2}));
  EXPECT_EQ(grid->at(0, 0, 0), 1);
  EXPECT_EQ(grid->at(3, 1, 1), 114);
  const Vec3 second_voxel(0.5 * 11, -0.5, 1.5);  // i = 1
  EXPECT_LT((grid->to_index * second_voxel + grid->offset - Vec3::UnitX()).norm(), 1e-12);
}

TEST_F(Vdb, GridsAreChosenByName) {
  auto strong = grid("strength");
  strong->getAccessor().setValue({10, -1, 3}, 7);
  const fs::path path = write({grid("toughness"), strong});
  EXPECT_EQ(read_vdb(path, "strength")->at(0, 0, 0), 7);
  EXPECT_EQ(read_vdb(path, "toughness")->at(0, 0, 0), 1);
  expect_refused(path, "", "\"toughness\"");
  expect_refused(path, "density", "no grid \"density\"");
}

TEST_F(Vdb, DoubleGridsAndTurnedOnesAreRead) {
  auto grid = openvdb::DoubleGrid::create(1.0);
  grid->setName("K");
  openvdb::math::Mat4d map = openvdb::math::Mat4d::identity();
  map.preRotate(openvdb::math::Z_AXIS, 0.5);
  map.setTranslation({1, 2, 3});
  grid->setTransform(openvdb::math::Transform::createLinearTransform(map));
  grid->getAccessor().setValue({0, 0, 0}, 2.0);
  grid->getAccessor().setValue({5, 0, 0}, 3.0);
  const auto read = read_vdb(write({grid}), "K");
  const openvdb::Vec3d x = grid->indexToWorld(openvdb::Vec3d(5, 0, 0));
  EXPECT_LT((read->to_index * Vec3(x[0], x[1], x[2]) + read->offset - 5 * Vec3::UnitX()).norm(), 1e-12);
}

TEST_F(Vdb, WhatIsNoFieldIsRefused) {
  auto negative = grid("K");
  negative->getAccessor().setValue({11, 0, 3}, -1);
  expect_refused(write({negative}), "K", "(11, 0, 3)");
  auto nan = grid("K");
  nan->getAccessor().setValue({11, 0, 3}, std::numeric_limits<float>::quiet_NaN());
  expect_refused(write({nan}), "K", "positive");
  expect_refused(write({openvdb::FloatGrid::create(1)}), "", "no active voxels");
  expect_refused(write({openvdb::Vec3SGrid::create()}), "", "no grid of numbers");
  auto huge = grid("K");
  huge->getAccessor().setValue({100000, 100000, 3}, 1);
  expect_refused(write({huge}), "K", "resample");
}

TEST_F(Vdb, DamagedAndForeignFilesAreRefused) {
  const fs::path path = write({grid("K")});
  fs::resize_file(path, fs::file_size(path) / 2);
  expect_refused(path, "K", ".vdb");
  std::ofstream(path) << "ply\nformat ascii 1.0\n";
  expect_refused(path, "K", ".vdb");
  std::ofstream(path).close();
  expect_refused(path, "K", ".vdb");
}

}  // namespace
}  // namespace conchoid

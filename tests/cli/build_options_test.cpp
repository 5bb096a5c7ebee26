// What a program says that was built without a part.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "cli/program.hpp"

using namespace conchoid::test;

namespace {

const std::string kCube =
    "[body]\nmodel = \"cube\"\n[material]\nyoungs_modulus = 3.1e9\npoisson_ratio = 0.327\n";

void expect_refused(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                    const std::string& option) {
  const Outcome outcome = run_program(arguments, folder.path());
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("rebuild it with -D" + option + "=ON"), std::string::npos) << outcome.err;
}

}  // namespace

TEST(BuildOptions, WhatWasLeftOutIsRefusedBeforeAnyWork) {
  const TemporaryFolder folder;
  folder.write("cube.toml", kCube);
  folder.write("field.toml", kCube + "[material.toughness_field]\nkind = \"vdb\"\nfile = \"grains.vdb\"\n");
  folder.write("spec.toml",
               kCube + "[database]\nregions = [\"z+\", \"z-\"]\nmagnitude = [8e7, 1e8]\nruns = 2\n");
  folder.write("grains.vdb", "voxels");
  if (!CONCHOID_WITH_VDB) {
    expect_refused(folder, {"run", "field.toml"}, "CONCHOID_WITH_VDB");
    expect_refused(folder, {"run", "cube.toml", "--format", "vdb"}, "CONCHOID_WITH_VDB");
  }
  if (!CONCHOID_WITH_LEARNING) {
    expect_refused(folder, {"database", "generate", "spec.toml", "--out", "cube.h5"},
                   "CONCHOID_WITH_LEARNING");
    expect_refused(folder, {"forest", "train", "cube.h5", "--out", "cube.forest"}, "CONCHOID_WITH_LEARNING");
  }
  if (!CONCHOID_WITH_PICTURES) {
    ASSERT_EQ(run_program({"run", "cube.toml", "--frames", "1", "--out", "cube"}, folder.path()).status, 0);
    expect_refused(folder, {"picture", "cube", "--out", "cube.png"}, "CONCHOID_WITH_PICTURES");
  }
  if (!CONCHOID_WITH_MPI) {
    setenv("PMI_SIZE", "2", 1);  // as a launcher does
    expect_refused(folder, {"database", "generate", "spec.toml", "--out", "cube.h5"}, "CONCHOID_WITH_MPI");
    unsetenv("PMI_SIZE");
  }
  EXPECT_EQ(files_below(folder.path()).size() > 4, !CONCHOID_WITH_PICTURES) << "nothing is left behind";
}

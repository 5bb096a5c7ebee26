// What the dynamic linker loads for a command: it takes longer to load OpenVDB than to break the cube.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "cli/program.hpp"

using namespace conchoid::test;

namespace {

/// What the linker says about the libraries that a command of the program loads.
std::string loaded(const TemporaryFolder& folder, const std::string& command) {
  const std::string call = "cd '" + folder.path().string() + "' && LD_DEBUG=files '" CONCHOID_BINARY "' " +
                           command + " >out 2>loaded </dev/null";
  EXPECT_EQ(std::system(call.c_str()), 0) << call << folder.read("loaded");
  return folder.read("loaded");
}

void expect_light(const std::string& loaded) {
  ASSERT_NE(loaded.find("calling init: "), std::string::npos) << "the linker says nothing";
  for (const char* heavy : {"libopenvdb", "libembree", "libxgboost", "libhdf5", "libpng", "conchoid_"})
    EXPECT_EQ(loaded.find(heavy), std::string::npos) << heavy;
}

}  // namespace

TEST(Start, HelpLoadsNothingHeavy) {
  const TemporaryFolder folder;
  expect_light(loaded(folder, "help"));
}

TEST(Start, ARunLoadsWhatItUses) {
  const TemporaryFolder folder;
  folder.write("cube.toml",
               "[body]\nmodel = \"cube\"\n[material]\nyoungs_modulus = 3.1e9\npoisson_ratio = 0.327\n"
               "[resolution]\ncrack = 0.2\nsurface = 0.05\n[run]\nframes = 2\n"
               "[[boundary]]\nregion = \"z+\"\ntraction = [0.0, 0.0, 1.0e8]\n"
               "[[boundary]]\nregion = \"z-\"\ntraction = [0.0, 0.0, -1.0e8]\n");
  expect_light(loaded(folder, "run cube.toml --out run"));
  if (CONCHOID_WITH_VDB) {
    const std::string all = loaded(folder, "run cube.toml --out level-sets --format vdb");
    EXPECT_NE(all.find("libopenvdb"), std::string::npos);
    EXPECT_EQ(all.find("libembree"), std::string::npos);
  }
}

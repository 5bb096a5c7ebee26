#include "conchoid/core/atomic_file.hpp"

#include <gtest/gtest.h>

#include "conchoid/core/error.hpp"
#include "temporary_folder.hpp"

using namespace conchoid;
namespace fs = std::filesystem;

namespace {

class AtomicFileTest : public testing::Test {
 protected:
  std::ptrdiff_t files() const {
    return std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator());
  }

  test::TemporaryFolder folder_;
};

}  // namespace

TEST_F(AtomicFileTest, AppearsOnlyWhenCommitted) {
  AtomicFile file(folder_ / "a.txt");
  file.stream() << "whole";
  EXPECT_FALSE(fs::exists(folder_ / "a.txt"));
  file.commit();
  EXPECT_EQ(folder_.read("a.txt"), "whole");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFileTest, AnErrorLeavesTheOldFileAndNothingElse) {
  folder_.write("a.txt", "old");
  try {
    AtomicFile file(folder_ / "a.txt");
    file.stream() << "half of the n";
    throw ComputationError("interrupted");
  } catch (const ComputationError&) {
  }
  EXPECT_EQ(folder_.read("a.txt"), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFileTest, AFolderThatDoesNotExistIsTheUsersError) {
  try {
    AtomicFile file(folder_ / "nowhere/a.txt");
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("nowhere/a.txt"), std::string::npos) << error.what();
  }
}

TEST_F(AtomicFileTest, AFolderInTheWayIsRefused) {
  fs::create_directories(folder_ / "taken/inside");
  AtomicFile file(folder_ / "taken");
  file.stream() << "x";
  EXPECT_THROW(file.commit(), InputError);
}

TEST_F(AtomicFileTest, AFullDiskIsAWriteError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this machine";
  // The temporary file's stream is made to write to a device that is always full.
  AtomicFile file(folder_ / "a.txt");
  std::ofstream full("/dev/full");
  static_cast<std::ofstream&>(file.stream()).swap(full);
  file.stream() << "x";
  EXPECT_THROW(file.commit(), WriteError);
  EXPECT_FALSE(fs::exists(folder_ / "a.txt"));
}

#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

// Bodies from a scanner, as users have them: see data/README.md.
namespace conchoid::test {

struct Scan {
  std::string name;
  std::filesystem::path file;
  std::size_t triangles;
  int elements;  ///< boundary elements that show its shape
};
inline void PrintTo(const Scan& scan, std::ostream* out) {
  *out << scan.file;
}

/// The Armadillo in 4,076 triangles, which comes with the tests, and the one in 99,976, where somebody has put
/// it beside the checkout.
inline std::vector<Scan> scans() {
  std::vector<Scan> found = {
      {"Small", std::filesystem::path(CONCHOID_SOURCE_DIR) / "tests/data/armadillo.ply", 4076, 1500}};
  const std::filesystem::path whole = std::filesystem::path(CONCHOID_SHARED_MODELS) / "armadillo.ply";
  if (std::filesystem::exists(whole)) found.push_back({"Whole", whole, 99976, 1000});
  return found;
}

/// Parameter of the tests that run on every scan there is.
class ScanTest : public testing::TestWithParam<Scan> {};

inline std::string scan_name(const testing::TestParamInfo<Scan>& info) {
  return info.param.name;
}

}  // namespace conchoid::test

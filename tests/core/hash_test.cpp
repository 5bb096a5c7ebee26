#include "conchoid/core/hash.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace conchoid;

namespace {
std::string hash_of(const std::vector<double>& a, const std::vector<double>& b) {
  ContentHash hash;
  hash.add(a);
  hash.add(b);
  return hash.hex();
}
}  // namespace

TEST(ContentHash, SameContentSameDigits) {
  EXPECT_EQ(hash_of({1, 2}, {3}), hash_of({1, 2}, {3}));
  EXPECT_EQ(hash_of({1, 2}, {3}).size(), 32u);
}

TEST(ContentHash, NoticesTheLastBitAndWhereArraysEnd) {
  EXPECT_NE(hash_of({1, 2}, {3}), hash_of({1, 2}, {std::nextafter(3.0, 4.0)}));
  EXPECT_NE(hash_of({1, 2}, {3}), hash_of({1}, {2, 3}));
  EXPECT_NE(hash_of({1, 2}, {}), hash_of({1}, {2}));
}

TEST(ContentHash, IgnoresTheSignOfZero) {
  EXPECT_EQ(hash_of({0.0}, {}), hash_of({-0.0}, {}));
}

TEST(ContentHash, TextAndVectorsCount) {
  ContentHash a, b;
  const std::vector<Vec3> v = {{1, 2, 3}}, w = {{1, 3, 2}};
  a.add(std::span<const Vec3>(v));
  b.add(std::span<const Vec3>(w));
  EXPECT_NE(a.hex(), b.hex());
  const std::string before = a.hex();
  a.add("arrested");
  EXPECT_NE(a.hex(), before);
}

#include "conchoid/core/byte_order.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

using namespace conchoid;

TEST(ByteOrder, IsWhatWasAskedForOnEveryMachine) {
  std::string bytes;
  append_bytes(bytes, std::uint32_t{0x01020304});
  append_bytes(bytes, std::uint16_t{0x0506}, std::endian::big);
  append_bytes(bytes, std::uint8_t{7}, std::endian::big);
  append_bytes(bytes, 1.0f);
  EXPECT_EQ(bytes, std::string("\x04\x03\x02\x01\x05\x06\x07\x00\x00\x80\x3f", 11));
}

TEST(ByteOrder, ValuesComeBackBitForBit) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    std::string bytes = "xyz";  // at an odd place
    append_bytes(bytes, std::int64_t{-2}, order);
    append_bytes(bytes, 0.1, order);
    append_bytes(bytes, -std::numeric_limits<float>::infinity(), order);
    const std::string_view all = bytes;
    EXPECT_EQ(from_bytes<std::int64_t>(all.substr(3), order), -2);
    EXPECT_EQ(from_bytes<double>(all.substr(11), order), 0.1);
    EXPECT_EQ(from_bytes<float>(all.substr(19), order), -std::numeric_limits<float>::infinity());
  }
}

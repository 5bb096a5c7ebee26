#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <ostream>
#include <string_view>

namespace conchoid {

/// Value of type T from the first bytes of `bytes` in the given byte order; the caller has checked that they
/// are there.
template <class T>
T from_bytes(std::string_view bytes, std::endian order) {
  std::array<char, sizeof(T)> raw;
  std::copy_n(bytes.begin(), sizeof(T), raw.begin());
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<T>(raw);
}

/// Writes a value in little endian order.
template <class T>
void write_little_endian(std::ostream& out, T value) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (std::endian::native != std::endian::little) std::reverse(raw.begin(), raw.end());
  out.write(raw.data(), raw.size());
}

}  // namespace conchoid

#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <string_view>

namespace conchoid {

/// Appends the bytes of a plain value. Files of ours are little endian on every machine.
template <class T>
void append_bytes(std::string& bytes, T value, std::endian order = std::endian::little) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

/// Value of type T from the first bytes of `bytes`; the caller has checked that they are there.
template <class T>
T from_bytes(std::string_view bytes, std::endian order = std::endian::little) {
  std::array<char, sizeof(T)> raw;
  std::copy_n(bytes.begin(), sizeof(T), raw.begin());
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<T>(raw);
}

}  // namespace conchoid

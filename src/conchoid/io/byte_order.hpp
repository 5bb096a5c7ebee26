#pragma once

#include <bit>
#include <cstring>
#include <string>

namespace conchoid {

static_assert(std::endian::native == std::endian::little,
              "binary files are written as the bytes lie in memory");

/// Appends the bytes of a plain value, little-endian.
template <class T>
void append_bytes(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

}  // namespace conchoid

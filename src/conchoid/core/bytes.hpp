#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "conchoid/core/byte_order.hpp"

namespace conchoid {

/// xxHash (XXH64) of bytes.
std::uint64_t hash_bytes(std::string_view bytes, std::uint64_t seed = 0);
/// 16 hexadecimal digits.
std::string hex(std::uint64_t value);

/// Bytes of a whole file. Throws InputError if it cannot be read.
std::string read_bytes(const std::filesystem::path& path);
/// Writes a whole file so that it appears complete or not at all.
void write_bytes(const std::filesystem::path& path, std::string_view bytes);

/// Thrown by ByteReader where the bytes end too early; the caller knows the file's name and turns it into an
/// InputError.
struct OutOfBytes : std::runtime_error {
  OutOfBytes() : std::runtime_error("unexpected end of data") {}
};

/// Whether numbers lie in memory as they are written.
template <class T>
inline constexpr bool kWrittenAsItLies = std::endian::native == std::endian::little && sizeof(T) >= 4;

/// Appends numbers in little-endian order whatever the machine.
class ByteWriter {
 public:
  template <class T>
  void put(T value) {
    append_bytes(bytes_, to_bits(value));
  }
  template <class T>
  void put_all(std::span<const T> values) {
    if constexpr (kWrittenAsItLies<T>) {
      bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    } else {
      for (const T& v : values)
        put(v);
    }
  }
  /// Length first, then the characters.
  void put_text(std::string_view text) {
    put(static_cast<std::uint64_t>(text.size()));
    bytes_.append(text);
  }
  void put_raw(std::string_view text) { bytes_.append(text); }
  const std::string& bytes() const { return bytes_; }

  template <class T>
  static auto to_bits(T value) {
    if constexpr (std::floating_point<T>) {
      if constexpr (sizeof(T) == 4)
        return std::bit_cast<std::uint32_t>(value);
      else
        return std::bit_cast<std::uint64_t>(value);
    } else if constexpr (sizeof(T) == 8) {
      return static_cast<std::uint64_t>(value);
    } else {
      return static_cast<std::uint32_t>(value);
    }
  }

 private:
  std::string bytes_;
};

/// Reads what ByteWriter wrote; throws OutOfBytes instead of reading past the end.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <class T>
  T get() {
    using Bits = decltype(ByteWriter::to_bits(T{}));
    const auto bits = from_bytes<Bits>(get_raw(sizeof(Bits)));
    if constexpr (std::floating_point<T>)
      return std::bit_cast<T>(bits);
    else
      return static_cast<T>(bits);
  }
  template <class T>
  std::vector<T> get_all(std::size_t n) {
    if (n > rest_.size() / sizeof(decltype(ByteWriter::to_bits(T{})))) throw OutOfBytes();
    std::vector<T> values(n);
    get_into(std::span(values));
    return values;
  }
  template <class T>
  void get_into(std::span<T> values) {
    if constexpr (kWrittenAsItLies<T>) {
      const std::string_view raw = get_raw(values.size_bytes());
      if (!raw.empty()) std::memcpy(values.data(), raw.data(), raw.size());
    } else {
      for (T& v : values)
        v = get<T>();
    }
  }
  std::string get_text() { return std::string(get_raw(get<std::uint64_t>())); }
  std::string_view get_raw(std::size_t n) {
    if (n > rest_.size()) throw OutOfBytes();
    const std::string_view part = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return part;
  }
  std::size_t left() const { return rest_.size(); }

 private:
  std::string_view rest_;
};

}  // namespace conchoid

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "conchoid/core/vec.hpp"

namespace conchoid {

/// Hash (XXH3, 128 bits) of a stream of numbers and text, for "same inputs, same bits". Every add() counts
/// its length too, so moving an element from one array to the next changes the hash. The sign of zero is
/// ignored.
class ContentHash {
 public:
  ContentHash();
  ~ContentHash();
  ContentHash(ContentHash&&) noexcept;
  ContentHash& operator=(ContentHash&&) noexcept;

  void add(std::span<const double> values);
  void add(std::span<const std::int32_t> values);
  void add(std::span<const Vec3> values);
  void add(std::string_view text);
  void add(double value) { add(std::span<const double>(&value, 1)); }
  void add(std::uint64_t value);
  /// 32 hexadecimal digits of everything added so far.
  std::string hex() const;

 private:
  void add_bytes(const void* data, std::size_t size);
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace conchoid

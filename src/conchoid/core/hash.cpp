#include "conchoid/core/hash.hpp"

#define XXH_INLINE_ALL
#include <fmt/format.h>
#include <xxhash.h>

namespace conchoid {

struct ContentHash::State {
  XXH3_state_t xxh;
};

ContentHash::ContentHash() : state_(std::make_unique<State>()) {
  XXH3_128bits_reset(&state_->xxh);
}
ContentHash::~ContentHash() = default;
ContentHash::ContentHash(ContentHash&&) noexcept = default;
ContentHash& ContentHash::operator=(ContentHash&&) noexcept = default;

void ContentHash::add_bytes(const void* data, std::size_t size) {
  XXH3_128bits_update(&state_->xxh, data, size);
}

void ContentHash::add(std::uint64_t value) {
  add_bytes(&value, sizeof value);
}

void ContentHash::add(std::span<const double> values) {
  add(static_cast<std::uint64_t>(values.size()));
  for (double value : values) {
    value += 0.0;  // −0 becomes 0
    add_bytes(&value, sizeof value);
  }
}

void ContentHash::add(std::span<const std::int32_t> values) {
  add(static_cast<std::uint64_t>(values.size()));
  add_bytes(values.data(), values.size_bytes());
}

void ContentHash::add(std::span<const Vec3> values) {
  add(static_cast<std::uint64_t>(values.size()));
  for (const Vec3& v : values)
    add(std::span<const double>(v.data(), 3));
}

void ContentHash::add(std::string_view text) {
  add(static_cast<std::uint64_t>(text.size()));
  add_bytes(text.data(), text.size());
}

std::string ContentHash::hex() const {
  const XXH128_hash_t digest = XXH3_128bits_digest(&state_->xxh);
  return fmt::format("{:016x}{:016x}", digest.high64, digest.low64);
}

}  // namespace conchoid

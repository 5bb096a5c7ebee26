#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace conchoid {

/// A 0-based id that cannot be mistaken for another kind of id. Default: invalid (−1).
template <class Tag>
struct Id {
  std::int32_t value = -1;

  constexpr Id() = default;
  constexpr explicit Id(std::int32_t v) : value(v) {}
  constexpr explicit Id(std::size_t v) : value(static_cast<std::int32_t>(v)) {}

  constexpr bool valid() const { return value >= 0; }
  constexpr std::size_t index() const { return static_cast<std::size_t>(value); }
  friend constexpr auto operator<=>(Id, Id) = default;
};

using NodeId = Id<struct NodeTag>;
using TriId = Id<struct TriTag>;

/// std::vector indexed by one kind of id only.
template <class IdType, class T>
class IdVector : public std::vector<T> {
 public:
  using std::vector<T>::vector;
  T& operator[](IdType id) { return std::vector<T>::operator[](id.index()); }
  const T& operator[](IdType id) const { return std::vector<T>::operator[](id.index()); }
  /// Appends and returns the new element's id.
  IdType add(T value) {
    this->push_back(std::move(value));
    return IdType(this->size() - 1);
  }
};

}  // namespace conchoid

template <class Tag>
struct std::hash<conchoid::Id<Tag>> {
  std::size_t operator()(conchoid::Id<Tag> id) const noexcept { return std::hash<std::int32_t>{}(id.value); }
};

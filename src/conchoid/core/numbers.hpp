#pragma once

#include <charconv>
#include <string>

namespace conchoid {

/// Shortest decimal text that reads back as the same double, whatever the locale.
inline std::string shortest(double value) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  return std::string(text, end);
}

}  // namespace conchoid

#pragma once

#include <charconv>
#include <string>

namespace conchoid {

/// Appends the shortest decimal text that reads back as the same number, whatever the locale.
template <class Number>
void append_shortest(std::string& to, Number value) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  to.append(text, end);
}

inline std::string shortest(double value) {
  std::string text;
  append_shortest(text, value);
  return text;
}

}  // namespace conchoid

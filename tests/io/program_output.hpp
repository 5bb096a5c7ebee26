#pragma once

#include <array>
#include <cstdio>
#include <string>
#include <utility>

/// A program's exit status (as wait() gives it, −1 if it could not be started) and what it writes to stdout.
inline std::pair<int, std::string> result_of(const std::string& command) {
  std::string text;
  std::FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return {-1, ""};
  std::array<char, 4096> part;
  for (std::size_t n; (n = std::fread(part.data(), 1, part.size(), pipe)) > 0;)
    text.append(part.data(), n);
  return {pclose(pipe), text};
}

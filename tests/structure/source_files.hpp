#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace conchoid {

inline const std::filesystem::path kSource = CONCHOID_SOURCE_DIR;

inline std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);)
    lines.push_back(line);
  return lines;
}

/// Headers and sources in a folder and those below it, sorted.
inline std::vector<std::filesystem::path> code_below(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::exists(folder)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".hpp" || entry.path().extension() == ".cpp")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// What stands between the brackets or quotes of a file's #include lines.
inline std::vector<std::string> includes_of(const std::filesystem::path& file) {
  static const std::regex directive(R"(^\s*#\s*include\s*["<]([^">]+)[">])");
  std::vector<std::string> result;
  for (const std::string& line : lines_of(file)) {
    std::smatch match;
    if (line.find('#') != std::string::npos && std::regex_search(line, match, directive))
      result.push_back(match[1]);
  }
  return result;
}

}  // namespace conchoid

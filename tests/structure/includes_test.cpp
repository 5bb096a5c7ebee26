// Precompiled headers hide a missing #include: the file compiles all the same, until somebody includes it
// elsewhere or builds without them. So what a file names of the standard library is looked up here.
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "structure/source_files.hpp"

namespace conchoid {
namespace {

namespace fs = std::filesystem;

/// Headers that are precompiled, and the names of namespace std that are looked for.
const std::map<std::string, std::vector<std::string>> kNames = {
    {"algorithm",
     {"sort",        "stable_sort", "min",    "max",         "clamp",       "find_if", "count",
      "count_if",    "any_of",      "all_of", "none_of",     "copy",        "copy_n",  "fill",
      "transform",   "reverse",     "unique", "lower_bound", "upper_bound", "rotate",  "min_element",
      "max_element", "minmax",      "find",   "includes",    "nth_element"}},
    {"array", {"array"}},
    {"chrono", {"chrono"}},
    {"cmath",
     {"abs", "sqrt", "pow", "sin", "cos", "tan", "atan2", "acos", "exp", "log", "hypot", "floor", "ceil",
      "round", "lround", "isfinite", "ldexp", "nextafter", "copysign"}},
    {"cstdint", {"int32_t", "uint32_t", "int64_t", "uint64_t", "uint8_t", "uint16_t"}},
    {"filesystem", {"filesystem"}},
    {"fstream", {"ifstream", "ofstream", "fstream"}},
    {"functional", {"function", "hash"}},
    {"limits", {"numeric_limits"}},
    {"map", {"map", "multimap"}},
    {"memory", {"unique_ptr", "shared_ptr", "make_unique", "make_shared"}},
    {"numbers", {"numbers"}},
    {"numeric", {"iota", "accumulate", "inner_product", "partial_sum"}},
    {"optional", {"optional", "nullopt"}},
    {"random", {"mt19937", "mt19937_64", "uniform_real_distribution", "normal_distribution"}},
    {"set", {"set", "multiset"}},
    {"span", {"span"}},
    {"sstream", {"stringstream", "istringstream", "ostringstream"}},
    {"string", {"string", "to_string"}},
    {"string_view", {"string_view"}},
    {"unordered_map", {"unordered_map"}},
    {"vector", {"vector"}}};

/// A line without its comment and without what is inside quotes.
std::string bare(const std::string& line) {
  std::string out;
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (quoted && line[i] == '\\')
      ++i;
    else if (line[i] == '"')
      quoted = !quoted;
    else if (!quoted && line.compare(i, 2, "//") == 0)
      break;
    else if (!quoted)
      out += line[i];
  }
  return out;
}

/// Identifiers that follow "std::".
std::set<std::string> standard_names(const fs::path& file) {
  std::set<std::string> names;
  for (const std::string& line : lines_of(file)) {
    const std::string code = bare(line);
    for (std::size_t at = code.find("std::"); at != std::string::npos; at = code.find("std::", at)) {
      at += 5;
      std::size_t end = at;
      while (end < code.size() && (std::isalnum(static_cast<unsigned char>(code[end])) || code[end] == '_'))
        ++end;
      names.insert(code.substr(at, end - at));
    }
  }
  return names;
}

class Includes {
 public:
  /// Everything that a file includes itself or through headers of the project.
  const std::set<std::string>& of(const fs::path& file) {
    const auto [found, fresh] = known_.emplace(file, std::set<std::string>{});
    if (!fresh) return found->second;
    std::set<std::string> all;
    for (const std::string& include : includes_of(file)) {
      all.insert(include);
      for (const fs::path& folder : {kSource / "src", kSource / "tests", file.parent_path()})
        if (fs::exists(folder / include)) {
          const std::set<std::string>& more = of((folder / include).lexically_normal());
          all.insert(more.begin(), more.end());
          break;
        }
    }
    return known_[file] = all;
  }

 private:
  std::map<fs::path, std::set<std::string>> known_;
};

}  // namespace

TEST(Headers, EveryFileIncludesWhatItNames) {
  Includes includes;
  int files = 0;
  for (const char* folder : {"src", "apps", "tests", "bench"})
    for (const fs::path& file : code_below(kSource / folder)) {
      ++files;
      const std::set<std::string> names = standard_names(file);
      for (const auto& [header, of_header] : kNames)
        for (const std::string& name : of_header)
          EXPECT_TRUE(!names.contains(name) || includes.of(file).contains(header))
              << file << " names std::" << name << " and does not include <" << header << ">";
    }
  EXPECT_GT(files, 100);
}

}  // namespace conchoid

#include "conchoid/learn/shipped.hpp"

#include <algorithm>
#include <array>

#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

namespace fs = std::filesystem;

// The program lies in the build folder, or in bin/ of what was installed.
std::vector<fs::path> folders() {
  std::vector<fs::path> all;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error)
    for (const char* from_program : {"databases", CONCHOID_DATABASES_FROM_PROGRAM})
      all.push_back((program.parent_path() / from_program).lexically_normal());
  all.emplace_back(CONCHOID_SOURCE_DATABASES);
  all.emplace_back(CONCHOID_INSTALLED_DATABASES);
  return all;
}

constexpr std::array kKinds = {"forest", "boosted", "network"};

std::string known_names() {
  std::string names;
  for (const std::string& name : shipped_names())
    names += (names.empty() ? "" : ", ") + name;
  return names;
}

}  // namespace

const std::vector<std::string>& shipped_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const std::string kind : kKinds)
      for (const char* trained_on : {"cube", "cylinder", "bar", "edge-crack", "armadillo", "versatile"})
        all.push_back(trained_on + (kind == "forest" ? "" : "." + kind));
    return all;
  }();
  return names;
}

std::string_view standard_database(std::string_view kind) {
  return std::find(kKinds.begin(), kKinds.end(), kind) != kKinds.end() ? "versatile" : "";
}

fs::path shipped_file(std::string_view name) {
  const bool names_kind = name.find('.') != std::string_view::npos;
  std::string looked_in;
  for (const fs::path& folder : folders()) {
    const fs::path file = folder / (std::string(name) + (names_kind ? "" : ".forest"));
    if (fs::exists(file)) return file;
    looked_in += (looked_in.empty() ? "" : ", ") + folder.string();
  }
  throw InputError("the database \"" + std::string(name) + "\" comes with conchoid, but is not in " +
                   looked_in + "; install it again, or train one with `conchoid forest train`");
}

fs::path database_file(const std::string& name_or_file, std::string_view kind) {
  if (fs::exists(name_or_file)) return name_or_file;
  const auto& names = shipped_names();
  for (const std::string& name : {name_or_file + "." + std::string(kind), name_or_file})
    if (std::find(names.begin(), names.end(), name) != names.end()) return shipped_file(name);
  throw InputError(name_or_file + ": is no file, and no database that comes with conchoid; those are " +
                   known_names() + "; another is a file written by `conchoid forest train`");
}

}  // namespace conchoid

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "structure/source_files.hpp"

namespace conchoid {
namespace {

namespace fs = std::filesystem;

using Rooms = std::map<std::string, std::set<std::string>>;

std::set<std::string> words_of(const std::string& text) {
  static const std::regex word("[a-z]+");
  return {std::sregex_token_iterator(text.begin(), text.end(), word), std::sregex_token_iterator()};
}

/// The table "room | may include" of docs/architecture.md.
Rooms documented_rooms() {
  Rooms rooms;
  bool inside = false;
  for (const std::string& line : lines_of(kSource / "docs/architecture.md")) {
    if (line.starts_with("| room | may include |"))
      inside = true;
    else if (inside && !line.starts_with("|"))
      break;
    else if (inside && !line.starts_with("|---")) {
      const std::size_t bar = line.find('|', 1);
      for (const std::string& room : words_of(line.substr(0, bar)))
        rooms[room] = words_of(line.substr(bar));
    }
  }
  return rooms;
}

/// A room sees itself, what it may include, and what these may include.
std::set<std::string> visible_from(const std::string& room, const Rooms& rooms) {
  std::set<std::string> seen = {room};
  std::vector<std::string> open = {room};
  while (!open.empty()) {
    const auto found = rooms.find(open.back());
    open.pop_back();
    if (found == rooms.end()) continue;
    for (const std::string& next : found->second)
      if (seen.insert(next).second) open.push_back(next);
  }
  return seen;
}

std::string room_of_include(const std::string& include) {
  if (!include.starts_with("conchoid/")) return {};
  const std::size_t begin = std::string("conchoid/").size(), slash = include.find('/', begin);
  return slash == std::string::npos ? std::string() : include.substr(begin, slash - begin);
}

void expect_only(const fs::path& folder, const std::set<std::string>& visible) {
  for (const fs::path& file : code_below(folder))
    for (const std::string& include : includes_of(file)) {
      const std::string room = room_of_include(include);
      EXPECT_TRUE(room.empty() || visible.contains(room)) << file << " includes " << include;
    }
}

}  // namespace

TEST(Rooms, TheDocumentedRoomsAreTheFolders) {
  std::set<std::string> folders;
  for (const auto& entry : fs::directory_iterator(kSource / "src/conchoid"))
    if (entry.is_directory()) folders.insert(entry.path().filename());
  std::set<std::string> documented;
  for (const auto& [room, uses] : documented_rooms())
    documented.insert(room);
  for (const char* program : {"apps", "bench"})
    EXPECT_EQ(documented.erase(program), 1u) << program;
  EXPECT_EQ(folders, documented);
}

TEST(Rooms, EveryRoomIncludesOnlyWhatItMay) {
  const Rooms rooms = documented_rooms();
  ASSERT_FALSE(rooms.empty());
  for (const auto& [room, uses] : rooms) {
    const fs::path inside = kSource / "src/conchoid" / room;
    expect_only(fs::exists(inside) ? inside : kSource / room, visible_from(room, rooms));
  }
}

TEST(Rooms, TheTableHasNoCircles) {
  const Rooms rooms = documented_rooms();
  for (const auto& [room, uses] : rooms)
    for (const std::string& used : uses)
      EXPECT_FALSE(visible_from(used, rooms).contains(room)) << room << " and " << used;
}

TEST(Rooms, SolverAndCracksDoNotKnowEachOther) {
  const Rooms rooms = documented_rooms();
  EXPECT_FALSE(visible_from("crack", rooms).contains("bem"));
  EXPECT_FALSE(visible_from("bem", rooms).contains("crack"));
  EXPECT_FALSE(visible_from("learn", rooms).contains("bem"));
}

TEST(Headers, HeavyOnesStayInSourceFiles) {
  static const std::regex heavy(
      "^(CLI/|toml|nlohmann/|openvdb/|embree|H5|hdf5|xgboost|spdlog|tbb/|png|tiny_gltf|fmt/)");
  for (const fs::path& file : code_below(kSource / "src"))
    if (file.extension() == ".hpp") {
      for (const std::string& include : includes_of(file))
        EXPECT_FALSE(std::regex_search(include, heavy)) << file << " includes " << include;
    }
}

TEST(Headers, AreIncludedOnceAndExist) {
  for (const char* folder : {"src", "apps", "tests", "bench"})
    for (const fs::path& file : code_below(kSource / folder)) {
      if (file.extension() == ".hpp") {
        const auto lines = lines_of(file);
        EXPECT_NE(std::find(lines.begin(), lines.end(), "#pragma once"), lines.end()) << file;
      }
      for (const std::string& include : includes_of(file))
        EXPECT_TRUE(!include.starts_with("conchoid/") || fs::exists(kSource / "src" / include))
            << file << " includes " << include;
    }
}

}  // namespace conchoid

#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "structure/source_files.hpp"

// Pages that others are sent to exist.
namespace conchoid {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> pages() {
  std::vector<fs::path> found;
  for (const char* folder : {".", "docs", "docs/study", "bench/results", "databases", "examples"})
    for (const auto& entry : fs::directory_iterator(kSource / folder))
      if (entry.path().extension() == ".md") found.push_back(entry.path());
  return found;
}

TEST(Links, PointToFilesThatAreThere) {
  static const std::regex link(R"(\]\(([^)\s]+)\)|<img[^>]*src="([^"]+)\")");
  std::size_t checked = 0;
  for (const fs::path& page : pages())
    for (const std::string& line : lines_of(page))
      for (auto at = std::sregex_iterator(line.begin(), line.end(), link); at != std::sregex_iterator();
           ++at) {
        std::string target = (*at)[1].matched ? (*at)[1].str() : (*at)[2].str();
        if (target.find("://") != std::string::npos || target.starts_with("#") ||
            target.starts_with("mailto:"))
          continue;
        target = target.substr(0, target.find('#'));
        EXPECT_TRUE(fs::exists(page.parent_path() / target)) << page << ": " << target;
        ++checked;
      }
  EXPECT_GT(checked, 20u);
}

}  // namespace
}  // namespace conchoid

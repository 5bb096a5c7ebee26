#include "conchoid/sim/settings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "conchoid/mesh/models.hpp"

using namespace conchoid;

TEST(Settings, EveryKeyIsListedOnceInAKnownTable) {
  std::set<std::string_view> tables;
  for (const SettingTable& t : setting_tables())
    tables.insert(t.name);
  std::set<std::pair<std::string_view, std::string_view>> keys;
  for (const Setting& s : settings()) {
    EXPECT_TRUE(tables.contains(s.table)) << s.table;
    EXPECT_TRUE(keys.emplace(s.table, s.key).second) << s.table << "." << s.key;
    EXPECT_FALSE(s.help.empty()) << s.key;
  }
}

TEST(Settings, TheModelsAreTheBuiltInOnes) {
  const auto& choices = find_setting("body", "model")->choices;
  const std::set<std::string> known(built_in_model_names().begin(), built_in_model_names().end());
  EXPECT_EQ(std::set<std::string>(choices.begin(), choices.end()), known);
}

TEST(Settings, RangesIncludeTheirEndsOrNot) {
  const SettingRange poisson = find_setting("material", "poisson_ratio")->range;
  EXPECT_FALSE(poisson.contains(0.5));
  EXPECT_FALSE(poisson.contains(-1));
  EXPECT_TRUE(poisson.contains(0.4999));
  EXPECT_EQ(poisson.text(), "> -1 and < 0.5");
  EXPECT_TRUE(find_setting("material", "compressive_factor")->range.contains(1));
}

TEST(Settings, TheNearestNameIsSuggested) {
  EXPECT_EQ(nearest_name("tougness", {"toughness", "strength"}), "toughness");
  EXPECT_EQ(nearest_name("colour", {"toughness", "strength"}), "");
}

TEST(Settings, TheDocumentationHoldsThisTable) {
  std::ifstream in(CONCHOID_SOURCE_DIR "/docs/scene.md");
  std::ostringstream page;
  page << in.rdbuf();
  EXPECT_NE(page.str().find(settings_markdown()), std::string::npos)
      << "docs/scene.md is out of date: put the output of `conchoid help-scene --markdown` into it";
}

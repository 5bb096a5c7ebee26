#include "conchoid/learn/shipped.hpp"

#include <gtest/gtest.h>

#include "conchoid/core/error.hpp"
#include "conchoid/learn/regressor.hpp"
#include "temporary_folder.hpp"

namespace conchoid {
namespace {

TEST(Shipped, EveryDatabaseIsFoundByNameAndReads) {
  std::uintmax_t bytes = 0;
  for (const std::string_view name : shipped_names()) {
    const std::filesystem::path file = database_file(std::string(name));
    const auto regressor = load_regressor(file);
    const auto dot = name.find('.');
    EXPECT_EQ(regressor->name(), dot == std::string_view::npos ? "forest" : name.substr(dot + 1));
    EXPECT_EQ(regressor->feature_set(), FeatureSet::versatile) << name;
    EXPECT_GT(regressor->provenance().runs, 20u) << name;
    EXPECT_FALSE(regressor->provenance().spec.empty()) << name;
    EXPECT_LT(std::filesystem::file_size(file), std::uintmax_t{5} << 20) << name;
    bytes += std::filesystem::file_size(file);
  }
  EXPECT_LT(bytes, std::uintmax_t{30} << 20);
}

TEST(Shipped, TheStandardOneKnowsManyClassesOfBodies) {
  for (const std::string_view kind : {"forest", "boosted", "network"}) {
    const auto regressor = load_regressor(database_file(std::string(standard_database(kind)), kind));
    EXPECT_EQ(regressor->name(), kind);
    EXPECT_GE(regressor->provenance().models.size(), 9u);
  }
  EXPECT_EQ(standard_database("ridge"), "");
}

TEST(Shipped, ANameGivesTheKindThatAMethodNeeds) {
  EXPECT_EQ(database_file("cube", "boosted"), shipped_file("cube.boosted"));
  EXPECT_EQ(database_file("cube", "forest"), shipped_file("cube"));
  EXPECT_EQ(database_file("cube", "network"), shipped_file("cube.network"));
  EXPECT_EQ(database_file("cube.boosted", "forest"), shipped_file("cube.boosted"));
  EXPECT_EQ(database_file("cube"), shipped_file("cube"));
}

TEST(Shipped, AFileOfTheUsersGoesFirst) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "my.forest";
  std::filesystem::copy_file(shipped_file("bar"), file);
  EXPECT_EQ(database_file(file.string()), file);
}

TEST(Shipped, AnUnknownNameIsAnsweredWithTheKnownOnes) {
  try {
    database_file("teapot");
    FAIL();
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.rfind("teapot: ", 0), 0u) << text;
    for (const std::string_view name : shipped_names())
      EXPECT_NE(text.find(name), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace conchoid

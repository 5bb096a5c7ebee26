#include "conchoid/core/byte_cache.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "conchoid/core/bytes.hpp"
#include "conchoid/core/error.hpp"
#include "temporary_folder.hpp"

namespace conchoid {
namespace {

using test::TemporaryFolder;

std::string only_file(const TemporaryFolder& folder) {
  std::string found;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    found = entry.path().string();
  return found;
}

std::optional<std::string> recalled(const ByteCache& cache, const std::string& name) {
  const std::optional<KeptBytes> kept = cache.recall(name);
  return kept ? std::optional<std::string>(kept->bytes) : std::nullopt;
}

}  // namespace

TEST(ByteCache, GivesBackWhatWasKept) {
  const TemporaryFolder folder;
  const ByteCache cache(folder / "new" / "deeper");
  EXPECT_FALSE(cache.recall("a"));
  cache.keep("a", std::string("x\0y", 3));
  cache.keep("empty", "");
  EXPECT_EQ(recalled(cache, "a"), std::string("x\0y", 3));
  EXPECT_EQ(recalled(ByteCache(folder / "new" / "deeper"), "empty"), "");
}

TEST(ByteCache, DamagedAndForeignFilesAreMadeAgain) {
  const TemporaryFolder folder;
  const ByteCache cache(folder.path());
  cache.keep("a", "some bytes that were costly to make");
  const std::string file = only_file(folder), whole = read_bytes(file);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    std::ofstream(file, std::ios::binary) << whole.substr(0, length);
    EXPECT_FALSE(cache.recall("a")) << "cut at " << length;
  }
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x21);
    std::ofstream(file, std::ios::binary) << changed;
    EXPECT_FALSE(cache.recall("a")) << "changed at " << at;
  }
  std::filesystem::rename(file, (folder / "b.cache").string());
  write_bytes(folder / "b.cache", whole);
  EXPECT_FALSE(cache.recall("b")) << "bears the name a";
  cache.keep("a", "again");
  EXPECT_EQ(recalled(cache, "a"), "again");
}

TEST(ByteCache, ManyWritersAndReadersNeverSeeHalfAFile) {
  const TemporaryFolder folder;
  const std::string content(300000, 'c');
  std::vector<std::jthread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      const ByteCache cache(folder.path());
      for (int k = 0; k < 20; ++k) {
        const auto kept = cache.recall("a");
        EXPECT_TRUE(!kept || kept->bytes == content);
        cache.keep("a", content);
      }
    });
  threads.clear();
  EXPECT_EQ(recalled(ByteCache(folder.path()), "a"), content);
}

TEST(ByteCache, WhatWasRecalledOutlivesItsFile) {
  const TemporaryFolder folder;
  const ByteCache cache(folder.path());
  const std::string content(100000, 'c');
  cache.keep("a", content);
  const std::optional<KeptBytes> kept = cache.recall("a");
  ASSERT_TRUE(kept);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(kept->bytes.data()) % 64, 0U);
  cache.keep("a", "another");
  std::filesystem::remove(only_file(folder));
  EXPECT_EQ(kept->bytes, content);
}

TEST(ByteCache, AFolderThatCannotBeMadeIsRefused) {
  const TemporaryFolder folder;
  folder.write("file", "no folder");
  EXPECT_THROW(ByteCache(folder / "file"), InputError);
  EXPECT_THROW(ByteCache(folder / "file" / "below"), InputError);
}

TEST(ByteCache, NamesTellWhatThingsWereMadeFrom) {
  EXPECT_EQ(cache_name("mesh", "abc"), cache_name("mesh", "abc"));
  EXPECT_NE(cache_name("mesh", "abc"), cache_name("mesh", "abd"));
  EXPECT_NE(cache_name("mesh", "abc"), cache_name("operator", "abc"));
}

}  // namespace conchoid

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "ingest/files/zip_directory.hpp"

#include "archive_writer.hpp"
#include "reading.hpp"

namespace farlod::ingest::test {
namespace {

TEST(ZipDirectory, NamesEachFileAndItsLock) {
  const auto listings = zip_listings(write_file("a.zip", zip_of({{"a/b.gml", "x"}, {"c", "y", 0, true}})));
  ASSERT_EQ(listings.size(), 2u);
  EXPECT_EQ(listings[0].name, "a/b.gml");
  EXPECT_FALSE(listings[0].is_locked);
  EXPECT_EQ(listings[1].name, "c");
  EXPECT_TRUE(listings[1].is_locked);
}

/// Whatever is cut off or overwritten: no byte outside of the file is asked for.
TEST(ZipDirectory, StaysWithinADamagedFile) {
  const std::string whole = zip_of({{"a/b.gml", "x"}, {"c", "y"}});
  for (std::size_t bytes = 0; bytes < whole.size(); ++bytes)
    EXPECT_TRUE(zip_listings(write_file("a.zip", whole.substr(0, bytes))).empty()) << bytes;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = '\xFF';
    EXPECT_LE(zip_listings(write_file("a.zip", damaged)).size(), 2u) << at;
  }
}

TEST(ZipDirectory, KnowsNamesThatLeadOutside) {
  for (const char* name : {"/a", "\\a", "C:/a", "C:a", "..", "../a", "a/../../b", "a/..", "a\\..\\b"})
    EXPECT_TRUE(leads_outside(name)) << name;
  for (const char* name : {"a", "a/b", "a..b", "..a", "a../b", "./a", ""}) EXPECT_FALSE(leads_outside(name)) << name;
}

/// As archives of more than 65,535 files or 4 GiB are written: the usual end says nothing.
TEST(ZipDirectory, OfTheLargeFormatIsRead) {
  using zip_parts::put;
  std::string zip = zip_of({{"a.gml", "a"}, {"../b.gml", "b"}});
  const std::size_t end = zip.rfind("PK\5\6");
  const std::string sizes = zip.substr(end + 12, 8), comment = zip.substr(end + 20);
  std::string large = "PK\6\6";
  put(large, 44, 4), put(large, 0, 4);
  for (int k = 0; k < 7; ++k) put(large, 0, 4);
  large.resize(40, '\0');
  large += sizes.substr(0, 4) + std::string(4, '\0') + sizes.substr(4, 4) + std::string(4, '\0');
  std::string pointer = "PK\6\7";
  put(pointer, 0, 4), put(pointer, static_cast<std::uint32_t>(end), 4), put(pointer, 0, 4), put(pointer, 1, 4);
  const std::string small = std::string("PK\5\6") + std::string(4, '\0') + std::string(12, '\xFF') + comment;
  const auto listings = zip_listings(write_file("large.zip", zip.substr(0, end) + large + pointer + small));
  ASSERT_EQ(listings.size(), 2U);
  EXPECT_EQ(listings[1].name, "../b.gml");
}

}  // namespace
}  // namespace farlod::ingest::test

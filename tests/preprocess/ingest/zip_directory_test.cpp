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

}  // namespace
}  // namespace farlod::ingest::test

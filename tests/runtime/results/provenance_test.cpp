// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/provenance.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::Pair;

TEST(Xxh3OfFile, IsThatOfItsBytes) {
  const scenes::TemporaryFolder folder;
  std::ofstream(folder.file("empty"));
  // The test vector of xxHash for no bytes
  EXPECT_EQ(xxh3_of_file(folder.file("empty")), "2d06800538d394c2");
  // Longer than what is read at a time
  std::ofstream(folder.file("a")) << std::string(200'000, 'a');
  std::ofstream(folder.file("b")) << std::string(199'999, 'a') << 'b';
  EXPECT_EQ(xxh3_of_file(folder.file("a")).size(), 16U);
  EXPECT_NE(xxh3_of_file(folder.file("a")), xxh3_of_file(folder.file("b")));
}

TEST(Xxh3OfFile, IsEmptyOfNoFile) {
  const scenes::TemporaryFolder folder;
  EXPECT_EQ(xxh3_of_file(folder.file("missing")), "");
}

TEST(EntriesOf, LeavesOutWhatIsEmpty) {
  EXPECT_THAT(entries_of({"Far-LoD 1", "town.farlod", "0123", "--grid 1"}),
              ElementsAre(Pair("software", "Far-LoD 1"), Pair("package", "town.farlod"), Pair("package_manifest_xxh3", "0123"),
                          Pair("settings", "--grid 1")));
  EXPECT_THAT(entries_of({"Far-LoD 1", "", "", ""}), ElementsAre(Pair("software", "Far-LoD 1")));
}

}  // namespace
}  // namespace farlod

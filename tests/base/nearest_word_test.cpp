// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "base/nearest_word.hpp"

#include <gmock/gmock.h>

#include <array>

#include "base/unread_file.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::EndsWith;

const std::array<std::string, 6> words{"grid", "grid-like", "height", "neighborhood", "roofs", "svf"};

std::string text_of_nearest(const std::string& misspelt) { return nearest_word(misspelt, words).value_or("none"); }

TEST(NearestWord, IsAFewEditsAway) {  // (1)
  EXPECT_EQ(text_of_nearest("grd"), "grid") << "left out";
  EXPECT_EQ(text_of_nearest("griid"), "grid") << "put in";
  EXPECT_EQ(text_of_nearest("grit"), "grid") << "changed";
  EXPECT_EQ(text_of_nearest("gird"), "grid") << "swapped";
  EXPECT_EQ(text_of_nearest("neigbourhood"), "neighborhood") << "two";
  EXPECT_EQ(text_of_nearest("SVF"), "svf");
  EXPECT_EQ(text_of_nearest("hieght"), "height");
}

TEST(NearestWord, IsTheOnlyOneThatGoesOn) {  // (2)
  EXPECT_EQ(text_of_nearest("neigh"), "neighborhood");
  EXPECT_EQ(text_of_nearest("ne"), "none");
  EXPECT_EQ(text_of_nearest("gri"), "grid") << "of two that go on, the one that is near";
}

TEST(NearestWord, IsNoneWhereAllAreFar) {
  EXPECT_EQ(text_of_nearest("time"), "none");
  EXPECT_EQ(text_of_nearest("g"), "none");
  EXPECT_EQ(text_of_nearest(""), "none");
  EXPECT_EQ(nearest_word("grid", {}), std::nullopt);
  EXPECT_EQ(did_you_mean("time", words), "");
  EXPECT_EQ(did_you_mean("grd", words), "; did you mean grid?");
}

TEST(UnreadFile, TellsWhatItIs) {
  const scenes::TemporaryFolder folder;
  folder.write("town.gml", "text");
  folder.write("empty.gml", "");
  const auto text_of = [&](const std::string& name) { return why_unread(folder.file(name)); };
  EXPECT_THAT(text_of("twon.gml"), EndsWith("twon.gml does not exist; did you mean " + folder.file("town.gml").string() + "?"));
  EXPECT_THAT(text_of("else.tif"), EndsWith("else.tif does not exist. Check the path."));
  EXPECT_THAT(text_of("empty.gml"), EndsWith("empty.gml is empty: 0 bytes. Was the download cut short?"));
  EXPECT_THAT(why_unread(folder.path()), EndsWith(" is a folder: give a file."));
  EXPECT_EQ(why_unread("https://example.org/a.gml"),
            "https://example.org/a.gml is an address of the web: download the file first, and name that.");
}

}  // namespace
}  // namespace farlod

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/house_rules.hpp"

#include <gmock/gmock.h>

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const std::string authors = " SPDX-FileCopyrightText: The Far-LoD authors";
const std::string apache = " SPDX-License-Identifier: Apache-2.0";
const std::string gpl = " SPDX-License-Identifier: GPL-3.0-or-later";

TEST(HouseRules, EachFileNamesItsLicence) { EXPECT_THAT(files_without_licence(read_source_tree(FARLOD_SOURCE_DIR)), IsEmpty()); }

TEST(HouseRules, NoFileIsTooLong) { EXPECT_THAT(files_too_long(read_source_tree(FARLOD_SOURCE_DIR)), IsEmpty()); }

TEST(HouseRules, FileNamesSayWhatIsInside) {
  EXPECT_THAT(files_with_empty_names(read_source_tree(FARLOD_SOURCE_DIR)), IsEmpty());
}

TEST(HouseRules, NothingIsLeftForLater) { EXPECT_THAT(files_with_notes_to_self(read_source_tree(FARLOD_SOURCE_DIR)), IsEmpty()); }

TEST(HouseRules, AMissingOrWrongLicenceIsFound) {
  EXPECT_THAT(files_without_licence({{"runtime/good.cpp", {"//" + authors, "//" + apache}},
                                     {"preprocess/good.cpp", {"//" + authors, "//" + gpl}},
                                     {"scripts/good", {"#!/usr/bin/env bash", "#" + authors, "#" + apache}},
                                     {"runtime/gpl.cpp", {"//" + authors, "//" + gpl}},
                                     {"preprocess/apache.cpp", {"//" + authors, "//" + apache}},
                                     {"runtime/late.cpp", {"#pragma once", "//" + authors, "//" + apache}},
                                     {"runtime/empty.cpp", {}}}),
              ElementsAre("runtime/gpl.cpp", "preprocess/apache.cpp", "runtime/late.cpp", "runtime/empty.cpp"));
}

TEST(HouseRules, ALongFileIsFound) {
  EXPECT_THAT(files_too_long({{"a.cpp", std::vector<std::string>(400)}, {"b.cpp", std::vector<std::string>(401)}}),
              ElementsAre("b.cpp"));
}

TEST(HouseRules, AnEmptyNameIsFound) {
  EXPECT_THAT(
      files_with_empty_names(
          {{"runtime/utils.hpp", {}}, {"runtime/grid_helpers.cpp", {}}, {"runtime/common/a.cpp", {}}, {"runtime/grid.cpp", {}}}),
      ElementsAre("runtime/utils.hpp", "runtime/grid_helpers.cpp", "runtime/common/a.cpp"));
}

TEST(HouseRules, ANoteToSelfIsFound) {
  const std::string word = std::string("TO") + "DO";
  EXPECT_THAT(files_with_notes_to_self({{"a.cpp", {"// " + word + ": later"}}, {"b.cpp", {"// done"}}}), ElementsAre("a.cpp"));
}

}  // namespace
}  // namespace farlod

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "ingest/model_builder/lod_choice.hpp"

#include <gtest/gtest.h>

namespace farlod::ingest {
namespace {

using Lods = std::vector<std::vector<double>>;
using Chosen = std::vector<std::optional<double>>;

TEST(LodChoice, TheBestIsTheHighestUpToThree) {
  EXPECT_EQ(choose_lods(Lods{{0, 1, 2}}, {}), Chosen{2.0});
  EXPECT_EQ(choose_lods(Lods{{1.2, 2.2, 1.3}}, {}), Chosen{2.2});
  EXPECT_EQ(choose_lods(Lods{{2, 3.3, 4}}, {}), Chosen{3.3});
}

TEST(LodChoice, LevelZeroIsOnlyTakenWhenAskedFor) {
  EXPECT_EQ(choose_lods(Lods{{0}}, {}), Chosen{std::nullopt});
  EXPECT_EQ(choose_lods(Lods{{0, 2}}, {.exactly = 0}), Chosen{0.0});
}

TEST(LodChoice, ARefinedLevelBelongsToItsWholeNumber) {
  EXPECT_EQ(choose_lods(Lods{{1.2, 1.3, 2.2}}, {.exactly = 1}), Chosen{1.3});
  EXPECT_EQ(choose_lods(Lods{{1.2}}, {.exactly = 2}), Chosen{std::nullopt});
}

TEST(LodChoice, APartThatLacksTheLevelGivesItsBest) {
  EXPECT_EQ(choose_lods(Lods{{2}, {1, 2}, {1}}, {}), (Chosen{2.0, 2.0, 1.0}));
}

TEST(LodChoice, TheCoarserShellAroundThePartsIsNotTaken) {
  EXPECT_EQ(choose_lods(Lods{{1}, {2}}, {}), (Chosen{std::nullopt, 2.0}));
}

TEST(LodChoice, ListsWhatThereIs) {
  EXPECT_EQ(list_lods(Lods{{2}, {1, 2.2}}), "1, 2, 2.2");
  EXPECT_EQ(list_lods(Lods{{}}), "none");
}

}  // namespace
}  // namespace farlod::ingest

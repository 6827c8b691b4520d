// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/explicit_in_patch.hpp"

#include <gtest/gtest.h>

namespace farlod {
namespace {

TEST(ExplicitInPatch, BothBitsAreSet) {
  const ReceiverPatches patches(20.0, 2, {0.0F, 10.0F});
  const package::ExplicitOccluder occluder{0, 0b0101, 0b10};
  EXPECT_TRUE(is_explicit_in(occluder, patches, patches.number(0, 1)));
  EXPECT_TRUE(is_explicit_in(occluder, patches, patches.number(2, 1)));
  EXPECT_FALSE(is_explicit_in(occluder, patches, patches.number(1, 1)));
  EXPECT_FALSE(is_explicit_in(occluder, patches, patches.number(0, 0)));
}

}  // namespace
}  // namespace farlod

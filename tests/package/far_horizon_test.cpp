// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/far_horizon.hpp"

#include <gtest/gtest.h>

namespace farlod {
namespace {

FarHorizon three_layers() { return {ReceiverPatches(20.0, 1, {-2.0F, 3.0F, 9.5F}), AzimuthBins{8}, {}, {}, {}, {}, {}}; }

TEST(FarHorizon, HeightsMeetTheExplicitEdgesOfTheirLayersAndOfTheOneAbove) {
  const FarHorizon map = three_layers();
  EXPECT_EQ(map.layers_met_from(0.0F, 0.0F) & 0b111U, 0b011U);
  EXPECT_EQ(map.layers_met_from(3.0F, 9.4F) & 0b111U, 0b110U);
  EXPECT_EQ(map.layers_met_from(0.0F, 3.0F) & 0b111U, 0b111U);
  EXPECT_EQ(map.layers_met_from(9.5F, 400.0F) & 0b111U, 0b100U);
}

TEST(FarHorizon, BelowTheLowestLevelItIsMetAsInTheLowestLayer) {
  EXPECT_EQ(three_layers().layers_met_from(-9.0F, -5.0F) & 0b111U, 0b011U);
}

TEST(FarHorizon, FloorAboveIsReachedEvenly) {
  const FarHorizon map = three_layers();
  EXPECT_EQ(map.floor_above(0, -2.0F), std::pair(1U, 0.0F));
  EXPECT_EQ(map.floor_above(0, 0.5F), std::pair(1U, 0.5F));
  EXPECT_EQ(map.floor_above(2, 50.0F), std::pair(2U, 0.0F));
}

}  // namespace
}  // namespace farlod

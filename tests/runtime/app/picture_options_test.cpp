// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/picture_options.hpp"

#include <gtest/gtest.h>

#include <chrono>

namespace farlod {
namespace {

/// A map of sunshine could be that of any day, and nobody could tell how high its receivers stand.
TEST(PictureOptions, SayWhenAndHowHigh) {
  SvfOptions options;
  EXPECT_EQ(conditions_of(options, "svf"), "1.5 m above the ground");
  options.sunshine = SunPeriod{std::chrono::sys_days(std::chrono::year{2026} / 6 / 21)};
  EXPECT_EQ(conditions_of(options, "sunlit_h"), "2026-06-21, 1.5 m above the ground");
  options.sunshine->days = 365;
  options.placing = {HeightAbove::highest_surface, 0.05};
  EXPECT_EQ(conditions_of(options, "sunlit_total_h"), "2026, on the surface");
  EXPECT_EQ(conditions_of(options, "svf"), "On the surface");
  options.placing.height_m = 2.0;
  options.light = LightSource{.period = "2026-06/08"};
  EXPECT_EQ(conditions_of(options, "irradiation"), "2026-06/08, clear sky, 2 m above the surface");
  options.light->weather_file = "town.epw";
  EXPECT_EQ(conditions_of(options, "shade"), "2026-06/08, 2 m above the surface");
  options.light->period.clear();
  options.placing = {HeightAbove::sea_level, 30.0};
  EXPECT_EQ(conditions_of(options, "irradiance"), "All of the weather, 30 m above sea level");
}

}  // namespace
}  // namespace farlod

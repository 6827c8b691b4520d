// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/city_settings.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <set>

#include "farlod/error.hpp"
#include "generator/city_layout.hpp"
#include "generator/keyed_random.hpp"

namespace farlod {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(CitySettings, DefaultsAreUsable) { EXPECT_NO_THROW(check(CitySettings{})); }

TEST(CitySettings, EachSettingIsRefusedBeyondItsRangeAndTheMessageNamesIt) {
  int settings_seen = 0;
  const CitySettings defaults;
  CitySettings::describe(defaults, [&](std::string_view wanted, auto, SettingRange, auto&&...) {
    ++settings_seen;
    CitySettings settings;
    CitySettings::describe(settings, [&](std::string_view name, auto& value, SettingRange range, auto&&...) {
      if (name == wanted) value = static_cast<std::decay_t<decltype(value)>>(range.high + 1.0);
    });
    EXPECT_THAT([&] { check(settings); }, ThrowsMessage<InvalidArgument>(HasSubstr("--" + std::string(wanted) + " is")))
        << wanted;
  });
  EXPECT_GT(settings_seen, 0);
}

TEST(CitySettings, RefusesOnPrismsWhatNeedsRoofsOrStoreys) {
  CitySettings eaves, balconies, facades;
  eaves.eaves_m = 0.5, balconies.balconies = true, facades.facade_details = true;
  for (auto& [settings, name] : {std::pair{&eaves, "--eaves"}, {&balconies, "--balconies"}, {&facades, "--facade-details"}}) {
    EXPECT_THAT([&s = *settings] { check(s); }, ThrowsMessage<InvalidArgument>(HasSubstr(name)));
    settings->lod = 2;
    EXPECT_NO_THROW(check(*settings));
  }
}

TEST(CitySettings, AHillsideIsTheOnlyGround) {
  CitySettings settings{.hillside = true};
  EXPECT_NO_THROW(check(settings));
  settings.terrain_relief_m = 20.0;
  EXPECT_THAT([&] { check(settings); }, ThrowsMessage<InvalidArgument>(HasSubstr("--terrain-relief")));
}

TEST(CitySettings, FacadesAreLevelOfDetail3) {
  CitySettings settings{.lod = 2};
  EXPECT_EQ(written_lod(settings), 2);
  settings.facade_details = true;
  EXPECT_EQ(written_lod(settings), 3);
}

TEST(CitySettings, RefusesWhatIsNotANumber) {
  CitySettings settings{.size_m = std::numeric_limits<double>::quiet_NaN()};
  EXPECT_THROW(check(settings), InvalidArgument);
}

TEST(CitySettings, RefusesStreetsThatLeaveNoRoomForBlocks) {
  CitySettings settings;
  settings.street_width_m = 0.26 * settings.street_spacing_m;
  EXPECT_THAT([&] { check(settings); }, ThrowsMessage<InvalidArgument>(HasSubstr("--street-width")));
  settings.street_width_m = 0.25 * settings.street_spacing_m;
  EXPECT_NO_THROW(check(settings));
}

TEST(CitySettings, RefusesACrsInDegrees) {
  CitySettings settings{.epsg = 4326};
  EXPECT_THAT([&] { check(settings); }, ThrowsMessage<InvalidArgument>(HasSubstr("degrees")));
}

TEST(CitySettings, ReadsEpsgCodes) {
  EXPECT_EQ(epsg_code("EPSG:25832"), 25832);
  EXPECT_EQ(epsg_code("epsg:2263"), 2263);
  for (const char* text : {"", "EPSG:", "25832", "EPSG:x", "EPSG:25832 ", "EPSG:-1", "ESRI:102100", "EPSG:99999999999"})
    EXPECT_FALSE(epsg_code(text)) << text;
}

TEST(KeyedRandom, SameKeySameNumbersOnEveryMachine) {
  // The first outputs of SplitMix64 for the state that the empty key gives, as its authors publish them for seed 0
  KeyedRandom random({});
  EXPECT_EQ(random.bits(), 0xE220A8397B1DCDAFU);
  EXPECT_EQ(random.bits(), 0x6E789E6AA1B965F4U);
  EXPECT_EQ(random.bits(), 0x06C45D188009454FU);
}

TEST(KeyedRandom, NeighboringKeysShareNoNumbers) {
  std::set<std::uint64_t> seen;
  for (std::uint64_t i = 0; i < 50; ++i)
    for (std::uint64_t j = 0; j < 50; ++j) EXPECT_TRUE(seen.insert(KeyedRandom({1, i, j}).bits()).second) << i << ' ' << j;
}

TEST(KeyedRandom, NumbersStayInTheirIntervalAndFillIt) {
  KeyedRandom random({7});
  constexpr int draws = 10000, faces = 6;
  int counts[faces] = {};
  double sum = 0.0;
  for (int k = 0; k < draws; ++k) {
    const double x = random.between(-2.0, 3.0);
    ASSERT_TRUE(x >= -2.0 && x < 3.0);
    sum += x;
    const int face = random.whole(1, faces);
    ASSERT_TRUE(face >= 1 && face <= faces);
    ++counts[face - 1];
  }
  // Five standard deviations of the mean of a uniform, and of a binomial count: the draws are fixed, so this is no gamble
  EXPECT_LT(std::abs(sum / draws - 0.5), 5.0 * 5.0 / std::sqrt(12.0 * draws));
  const double share = 1.0 / faces;
  for (const int count : counts) EXPECT_LT(std::abs(count - draws * share), 5.0 * std::sqrt(draws * share * (1.0 - share)));
}

TEST(KeyedRandom, ChanceKnowsNeverAndAlways) {
  KeyedRandom random({3});
  for (int k = 0; k < 1000; ++k) {
    EXPECT_FALSE(random.chance(0.0));
    EXPECT_TRUE(random.chance(1.0));
  }
}

TEST(UrbanField, StaysBetweenNothingAndTheHeartOfTheCore) {
  CitySettings settings{.size_m = 6000.0};
  const UrbanField field(settings);
  for (double x = -3000.0; x <= 3000.0; x += 97.0)
    for (double y = -3000.0; y <= 3000.0; y += 97.0) {
      EXPECT_GT(field.urbanity({x, y}), 0.0);
      EXPECT_LE(field.urbanity({x, y}), 1.0);
    }
}

TEST(UrbanField, CitiesHaveACoreAndVillagesHaveNone) {
  CitySettings settings;
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    settings.seed = seed;
    settings.size_m = 120.0;
    EXPECT_LT(UrbanField(settings).urbanity({}), UrbanField::core_urbanity);
    settings.size_m = 400.0;
    EXPECT_GE(UrbanField(settings).urbanity({}), UrbanField::core_urbanity);
    settings.size_m = 4000.0;
    EXPECT_GE(UrbanField(settings).urbanity({}), UrbanField::core_urbanity);
  }
}

TEST(UrbanField, GroundStaysWithinItsRelief) {
  CitySettings settings;
  EXPECT_EQ(UrbanField(settings).ground_m({123.0, 456.0}), 0.0);
  settings.terrain_relief_m = 40.0;
  const UrbanField field(settings);
  double low_m = 40.0, high_m = 0.0;
  for (double x = -5000.0; x <= 5000.0; x += 50.0) {
    const double ground_m = field.ground_m({x, 0.5 * x});
    EXPECT_TRUE(ground_m >= 0.0 && ground_m <= 40.0);
    low_m = std::min(low_m, ground_m), high_m = std::max(high_m, ground_m);
  }
  EXPECT_GT(high_m - low_m, 20.0) << "hills of less than half the relief";
}

TEST(UrbanField, HillsidesRiseAndFallBy10To25Percent) {
  CitySettings settings{.hillside = true};
  const UrbanField field(settings);
  constexpr double step_m = 0.5;
  // A difference of two heights of at most 24 m, divided by the step
  constexpr double rounding = 4.0 * 24.0 * 2.2e-16 / step_m;
  int steps = 0, kinks = 0, rising = 0;
  for (double t = -4000.0; t < 4000.0; t += step_m, ++steps) {
    const double low_m = field.ground_m({0.96 * t, 0.28 * t}),
                 high_m = field.ground_m({0.96 * (t + step_m), 0.28 * (t + step_m)});
    EXPECT_TRUE(low_m >= 0.0 && low_m <= 24.0);
    const double slope = std::abs(high_m - low_m) / step_m;
    EXPECT_LE(slope, 0.25 + rounding);
    kinks += slope < 0.10 - rounding ? 1 : 0;
    rising += high_m > low_m ? 1 : 0;
    EXPECT_NEAR(field.ground_m({0.96 * t - 28.0, 0.28 * t + 96.0}), low_m, 1e-9) << "contours are straight";
  }
  // A ridge or a valley at least every 240 m and at most every 96 m
  EXPECT_LE(kinks, static_cast<int>(steps * step_m / 96.0) + 1);
  EXPECT_NEAR(rising, 0.5 * steps, 0.2 * steps);
}

}  // namespace
}  // namespace farlod

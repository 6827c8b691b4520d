// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/city_settings.hpp"
#include "farlod/error.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace farlod {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

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
  CitySettings settings;
  settings.hillside = true;
  EXPECT_NO_THROW(check(settings));
  settings.terrain_relief_m = 20.0;
  EXPECT_THAT([&] { check(settings); }, ThrowsMessage<InvalidArgument>(HasSubstr("--terrain-relief")));
}

TEST(CitySettings, FacadesAreLevelOfDetail3) {
  CitySettings settings;
  settings.lod = 2;
  EXPECT_EQ(written_lod(settings), 2);
  settings.facade_details = true;
  EXPECT_EQ(written_lod(settings), 3);
}

TEST(CitySettings, RefusesWhatIsNotANumber) {
  CitySettings settings;
  settings.size_m = std::numeric_limits<double>::quiet_NaN();
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
  CitySettings settings;
  settings.epsg = 4326;
  EXPECT_THAT([&] { check(settings); }, ThrowsMessage<InvalidArgument>(HasSubstr("degrees")));
}

TEST(CitySettings, ReadsEpsgCodes) {
  EXPECT_EQ(epsg_code("EPSG:25832"), 25832);
  EXPECT_EQ(epsg_code("epsg:2263"), 2263);
  for (const char* text : {"", "EPSG:", "25832", "EPSG:x", "EPSG:25832 ", "EPSG:-1", "ESRI:102100", "EPSG:99999999999"})
    EXPECT_FALSE(epsg_code(text)) << text;
}

}  // namespace
}  // namespace farlod

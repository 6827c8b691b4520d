// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "ingest/footprints/footprint_heights.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "city/height_limits.hpp"
#include "ingest/footprints/height_text.hpp"

namespace farlod::ingest {
namespace {

constexpr double foot_m = 0.3048;

/// One feature of a table: what its fields say, texts or numbers.
struct Feature {
  std::vector<std::pair<std::string, FieldValue>> fields;

  Feature& text(const std::string& name, const std::string& value) {
    fields.push_back({name, {std::nullopt, value, true}});
    return *this;
  }
  Feature& number(const std::string& name, double value) {
    fields.push_back({name, {value, {}, true}});
    return *this;
  }
  Feature& empty(const std::string& name) {
    fields.push_back({name, {}});
    return *this;
  }
  [[nodiscard]] std::variant<PrismExtent, Unraised> asked(const FootprintSettings& settings = {}) const {
    std::vector<std::string> names;
    for (const auto& [name, value] : fields) names.push_back(name);
    return FootprintHeights(names, settings).of([&](std::size_t field) { return fields[field].second; });
  }
  [[nodiscard]] PrismExtent extent(const FootprintSettings& settings = {}) const {
    const auto answer = asked(settings);
    EXPECT_TRUE(std::holds_alternative<PrismExtent>(answer)) << std::get<Unraised>(answer).detail;
    return std::get<PrismExtent>(answer);
  }
  [[nodiscard]] Unraised reason(const FootprintSettings& settings = {}) const {
    const auto answer = asked(settings);
    EXPECT_TRUE(std::holds_alternative<Unraised>(answer));
    return std::get<Unraised>(answer);
  }
};

TEST(FootprintHeights, AreTrustedInOneOrder) {
  FootprintSettings settings;
  settings.height_field = "Survey";
  settings.storeys_field = "Flats";
  settings.default_height_m = 5.0;
  Feature all =
      Feature().number("flats", 4).number("levels", 8).number("height", 20).number("building:height", 30).number("survey", 40);
  EXPECT_EQ(all.extent(settings).top_m, 40.0);
  // One after the other falls silent
  for (const auto& [silent, next_m] : std::vector<std::pair<std::string, double>>{
           {"survey", 30}, {"building:height", 20}, {"height", 4 * 3.0}, {"flats", 8 * 3.0}, {"levels", 5}}) {
    for (auto& [name, value] : all.fields)
      if (name == silent) value = {};
    EXPECT_EQ(all.extent(settings).top_m, next_m) << silent;
  }
  settings.default_height_m.reset();
  EXPECT_EQ(all.reason(settings).code, ProblemCode::no_height);
}

TEST(FootprintHeights, ATextThatIsNoLengthSaysNothing) {
  const Feature feature = Feature().text("height", "high").text("building:levels", "3");
  EXPECT_EQ(feature.extent().top_m, 9.0);
  EXPECT_EQ(Feature().text("height", "").text("building:levels", "1-3").reason().code, ProblemCode::no_height);
  EXPECT_EQ(Feature().number("height", std::numeric_limits<double>::quiet_NaN()).number("floors", 1).extent().top_m, 3.0);
}

TEST(FootprintHeights, StoreysAreAsHighAsToldAndRoofLevelsAreNone) {
  FootprintSettings settings;
  settings.floor_height_m = 3.5;
  EXPECT_EQ(Feature().text("Building:Levels", "4").text("roof:levels", "2").extent(settings).top_m, 14.0);
  EXPECT_FALSE(FootprintHeights({"roof:levels", "name"}, settings).can_tell());
  EXPECT_TRUE(FootprintHeights({"name", "NUM_FLOORS"}, settings).can_tell());
}

TEST(FootprintHeights, AColumnsNameMayTellFeet) {
  FootprintSettings settings;
  settings.height_field = "roof_FT";
  EXPECT_EQ(Feature().number("roof_ft", 100).extent(settings).top_m, 100 * foot_m);
  EXPECT_EQ(Feature().text("roof_ft", "100").extent(settings).top_m, 100 * foot_m);
  EXPECT_EQ(Feature().text("roof_ft", "30 m").extent(settings).top_m, 30.0);
  EXPECT_EQ(Feature().number("height_feet", 10).extent().top_m, 10 * foot_m);
  settings.height_field = "loft";
  EXPECT_EQ(Feature().number("loft", 100).extent(settings).top_m, 100.0);
}

TEST(FootprintHeights, APartThatHangsBeginsAboveItsBase) {
  const PrismExtent arch = Feature().number("height", 20).text("min_height", "12 m").extent();
  EXPECT_EQ(arch.base_m, 12.0);
  EXPECT_EQ(arch.top_m, 20.0);
  EXPECT_EQ(arch.height_reference, HeightReference::on_ground);
  EXPECT_EQ(Feature().text("building:levels", "5").text("building:min_level", "4").extent().base_m, 12.0);
  EXPECT_EQ(Feature().text("building:levels", "5").text("min_level", "1").extent().base_m, 0.0);
  EXPECT_EQ(Feature().number("height", 9).number("min_height", -3).extent().base_m, 0.0);
  EXPECT_EQ(Feature().number("height", 9).number("min_height", 9).reason().code, ProblemCode::height_not_positive);
  FootprintSettings settings;
  settings.base_field = "ground";
  EXPECT_EQ(Feature().number("height", 20).number("min_height", 12).number("ground", 100).extent(settings).base_m, 112.0);
}

TEST(FootprintHeights, ARoofsElevationCountsFromTheBaseOrReachesDown) {
  FootprintSettings settings;
  settings.roof_field = "eaves";
  const PrismExtent free = Feature().number("eaves", 120).number("height", 7).extent(settings);
  EXPECT_EQ(free.top_m, 120.0);
  EXPECT_EQ(free.base_m, 120.0 - provisional_height_m);
  EXPECT_EQ(free.height_reference, HeightReference::down_to_ground);
  EXPECT_EQ(Feature().empty("eaves").number("height", 7).extent(settings).top_m, 7.0);
  settings.base_field = "ground";
  const PrismExtent held = Feature().number("eaves", 120).number("ground", 100).extent(settings);
  EXPECT_EQ(held.base_m, 100.0);
  EXPECT_EQ(held.top_m, 120.0);
  EXPECT_EQ(held.height_reference, HeightReference::elevation);
  EXPECT_EQ(Feature().number("eaves", 99).number("ground", 100).reason(settings).code, ProblemCode::height_not_positive);
  EXPECT_EQ(Feature().number("eaves", 120).empty("ground").reason(settings).code, ProblemCode::no_height);
}

TEST(FootprintHeights, NumbersThatNoBuildingHasAreAbsurd) {
  for (const double absurd : {-9999.0, 9999.0, 99999.0, highest_building_m + 0.5})
    EXPECT_EQ(Feature().number("height", absurd).reason().code, ProblemCode::absurd_height) << absurd;
  EXPECT_EQ(Feature().number("height", highest_building_m).extent().top_m, highest_building_m);
  for (const double low : {0.0, -3.0})
    EXPECT_EQ(Feature().number("height", low).reason().code, ProblemCode::height_not_positive) << low;
  EXPECT_EQ(Feature().number("levels", 0).reason().code, ProblemCode::height_not_positive);
  EXPECT_EQ(Feature().number("levels", 9999).reason().code, ProblemCode::absurd_height);
}

TEST(FootprintHeights, ElevationsAreThoseOfTheEarth) {
  FootprintSettings settings;
  settings.roof_field = "roof";
  EXPECT_EQ(Feature().number("roof", 4150).extent(settings).top_m, 4150.0);  // El Alto
  for (const double absurd : {-9999.0, highest_elevation_m + 1, lowest_elevation_m - 1})
    EXPECT_EQ(Feature().number("roof", absurd).reason(settings).code, ProblemCode::absurd_height) << absurd;
  settings.base_field = "ground";
  EXPECT_EQ(Feature().number("roof", 20).number("ground", -9999).reason(settings).code, ProblemCode::absurd_height);
  EXPECT_EQ(Feature().empty("roof").number("height", 9).number("ground", -9999).reason(settings).code,
            ProblemCode::absurd_height);
  EXPECT_EQ(Feature().number("roof", 3000).number("ground", 10).reason(settings).code, ProblemCode::absurd_height);
}

TEST(FootprintHeights, OfEqualNamesTheFirstCounts) {
  EXPECT_EQ(Feature().number("Height", 7).number("HEIGHT", 9).extent().top_m, 7.0);
}

TEST(FootprintHeights, ReasonsSayWhatTheTableSays) {
  EXPECT_EQ(Feature().text("height", "high").empty("levels").reason().detail, "height is \"high\", levels is empty");
  EXPECT_EQ(Feature().number("height", -3).reason().detail, "height is -3");
}

TEST(HeightText, ReadsWhatPeopleWrite) {
  EXPECT_EQ(length_m_from("~12"), 12.0);
  EXPECT_EQ(length_m_from(" ~ 12 m"), 12.0);
  EXPECT_EQ(length_m_from("56 ft"), 56 * foot_m);
  EXPECT_EQ(length_m_from("56", LengthUnit::foot), 56 * foot_m);
  EXPECT_EQ(length_m_from("10-12"), std::nullopt);
  EXPECT_EQ(length_m_from("~"), std::nullopt);
  EXPECT_EQ(number_from("2,5"), 2.5);
  EXPECT_EQ(number_from("~3 "), 3.0);
  for (const char* text : {"", "3 m", "2;3", "1-3", "three"}) EXPECT_EQ(number_from(text), std::nullopt) << text;
}

}  // namespace
}  // namespace farlod::ingest

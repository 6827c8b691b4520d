// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <functional>
#include <string>
#include <vector>

#include "farlod/error.hpp"
#include "reading.hpp"
#include "small_cities.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod::ingest::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr int houses_of_row = 12;

/// A row of houses of 10 m × 12 m, whose fields are what `fields_of` says.
std::string row_of_houses(const std::function<std::string(int)>& fields_of, int houses = houses_of_row) {
  std::vector<std::string> features;
  for (int n = 0; n < houses; ++n) {
    const double x = 690'000.0 + 30.0 * n, y = 5'335'000.0;
    const auto corner = [&](double dx, double dy) { return "[" + std::to_string(x + dx) + "," + std::to_string(y + dy) + "]"; };
    features.push_back(feature(
        fields_of(n), "Polygon",
        "[[" + corner(0, 0) + "," + corner(10, 0) + "," + corner(10, 12) + "," + corner(0, 12) + "," + corner(0, 0) + "]]"));
  }
  return collection(features, R"("crs":{"type":"name","properties":{"name":"EPSG:25832"}},)");
}

std::string houses_with(const std::string& field, const std::function<double(int)>& value_of, int houses) {
  return row_of_houses([&](int n) { return "\"" + field + "\":" + std::to_string(value_of(n)); }, houses);
}

IngestSettings named(const std::string& field) {
  IngestSettings settings;
  settings.footprints.height_field = field;
  return settings;
}

IngestSettings named_storeys(const std::string& field) {
  IngestSettings settings;
  settings.footprints.storeys_field = field;
  return settings;
}

/// What is said of a field with such values.
std::string doubt_about(const std::string& field, const std::function<double(int)>& value_of,
                        IngestSettings (*as)(const std::string&) = named, int houses = houses_of_row) {
  const Reading r = read_text("a.geojson", houses_with(field, value_of, houses), as(field));
  for (const Problem& problem : r.report.problems())
    if (problem.code == ProblemCode::implausible_size) return problem.detail;
  return "no doubt";
}

TEST(DoubtfulHeights, StoreysAreToldByTheirName) {
  const auto up_to_8 = [](int n) { return 2.0 + n / 2; };
  EXPECT_THAT(doubt_about("Etagen", up_to_8), AllOf(HasSubstr("Etagen holds whole numbers, of which a typical one is 5"),
                                                    HasSubstr("--storeys-field Etagen"), HasSubstr("--floor-height")));
  EXPECT_EQ(doubt_about("h", up_to_8), "no doubt") << "heights in whole metres";
  EXPECT_EQ(doubt_about("Etagen", [](int n) { return 2.5 + n; }), "no doubt");
}

TEST(DoubtfulHeights, SmallWholeNumbersAreToldByAnyName) {
  EXPECT_THAT(doubt_about("KAISU", [](int n) { return 1.0 + n % 3; }), HasSubstr("are they storeys?"));
  EXPECT_THAT(doubt_about("code", [](int n) { return 1.0 + n % 3; }), HasSubstr("storeys, or codes"));
  EXPECT_EQ(doubt_about("h", [](int n) { return 2.8 + n % 3; }), "no doubt");
}

/// A town of up to 9 storeys in a field whose name says nothing.
TEST(DoubtfulHeights, StoreysAreToldByAnyNameWhereMetresWouldBeTooLow) {
  constexpr int town = 100;
  const auto storeys = [](int n) { return n % 20 == 0 ? 2.0 : n % 25 == 3 ? 1.0 : 3.0 + n % 7; };
  for (const std::string name : {"n_niv", "height"})
    EXPECT_THAT(doubt_about(name, storeys, named, town),
                AllOf(HasSubstr(name + " holds whole numbers, of which a typical one is 6, and they were read as metres"),
                      HasSubstr("are they storeys"), HasSubstr("--storeys-field " + name)));
  EXPECT_THAT(doubt_about("n_niv", storeys, named, 20), HasSubstr("--storeys-field n_niv"));
  EXPECT_THAT(doubt_about(
                  "n_niv", [&](int n) { return storeys(n) + (n == 50 || n == 51 ? 0.5 : 0.0); }, named, town),
              HasSubstr("--storeys-field n_niv"))
      << "two attics of 100";
  EXPECT_EQ(doubt_about(
                "n_niv", [&](int n) { return storeys(n) + (n % 25 == 10 ? 0.5 : 0.0); }, named, town),
            "no doubt")
      << "four fractions of 100";
}

TEST(DoubtfulHeights, WholeMetresAreNoStoreys) {
  constexpr int town = 100;
  const auto in_town = [](const std::function<double(int)>& value_of) { return doubt_about("h", value_of, named, town); };
  EXPECT_EQ(in_town([](int n) { return 3.0 + n % 7; }), "no doubt") << "houses and garages";
  EXPECT_EQ(in_town([](int n) { return n < 2 ? 2.0 : 3.0 + n % 7; }), "no doubt") << "two open halls";
  EXPECT_EQ(in_town([](int n) { return n % 20 == 0 ? 2.0 : 8.0 + n % 9; }), "no doubt") << "a town of 12 m";
  EXPECT_EQ(in_town([](int n) { return 7.0 + n % 25; }), "no doubt") << "feet";
}

TEST(DoubtfulHeights, AreasAndOtherNumbersAreTold) {
  EXPECT_THAT(doubt_about("area", [](int n) { return 60.0 + 5.0 * n; }), HasSubstr("as large as the areas of the outlines"));
  // Half of the town would be towers of 130 m and more, on 10 m × 12 m: a street's numbers
  EXPECT_THAT(doubt_about("number", [](int n) { return 10.0 + 25.0 * n; }),
              AllOf(HasSubstr("a typical one is 160"), HasSubstr("another unit"), HasSubstr("--height-field")));
  EXPECT_EQ(doubt_about("h", [](int n) { return n == 0 ? 160.0 : 10.0 + n; }), "no doubt");
}

/// They were 3 m each, whatever the field holds.
TEST(DoubtfulStoreys, HeightsAreToldByTheirFractions) {
  const auto heights = [](int n) { return 2.2 + 1.3 * n; };
  EXPECT_THAT(doubt_about("TAKASA", heights, named_storeys),
              AllOf(HasSubstr("TAKASA holds numbers with fractions, of which a typical one is 10"),
                    HasSubstr("--height-field TAKASA in place of --storeys-field")));
  EXPECT_EQ(doubt_about(
                "levels", [](int n) { return 1.5 + n % 5; }, named_storeys),
            "no doubt")
      << "attics";
  EXPECT_EQ(doubt_about(
                "levels", [](int n) { return 1.0 + n; }, named_storeys),
            "no doubt");
}

TEST(DoubtfulStoreys, AreasAndNumbersAreToldByWhatTheyMake) {
  EXPECT_THAT(doubt_about(
                  "area", [](int n) { return 60.0 + 5.0 * n; }, named_storeys),
              AllOf(HasSubstr("area holds values of which a typical one is 90, and they were read as storeys of 3 m"),
                    HasSubstr("--storeys-field")));
  EXPECT_THAT(doubt_about(
                  "year", [](int n) { return n < 2 ? 3.0 : 1950.0 + n; }, named_storeys),
              HasSubstr("a typical one is 195"));
}

TEST(DoubtfulHeights, CodesAreToldByTheirOnes) {
  const auto of_use = [](int n) { return n % 20 == 0 ? 1.0 : 5.0 + n % 7; };
  EXPECT_THAT(doubt_about("YOUTO", of_use, named, 60),
              AllOf(HasSubstr("YOUTO holds whole numbers from 1 to 11, of which 5 % are 1"), HasSubstr("are they codes")));
  EXPECT_EQ(doubt_about("h", of_use), "no doubt") << "a few";
  EXPECT_EQ(doubt_about(
                "h", [&](int n) { return of_use(n) + 1.0; }, named, 60),
            "no doubt")
      << "whole metres";
}

TEST(DoubtfulHeights, ValuesThatNoBuildingHasCount) {
  const auto many_beyond = [](int n) { return n < 2 ? 20.0 : 4000.0 + n; };
  EXPECT_THAT(doubt_about("id", many_beyond), HasSubstr("a typical one is 40"));
  EXPECT_EQ(doubt_about("h", [](int n) { return n < 6 ? 9.5 + n : 9999.0; }), "no doubt") << "9999 means unknown";
}

TEST(DoubtfulHeights, FeetAreToldByTheNameOfTheirField) {
  const auto some = [](int n) { return 20.5 + n; };
  EXPECT_THAT(doubt_about("heightft", some), AllOf(HasSubstr("are they feet?"), HasSubstr("rename it to height_ft")));
  for (const std::string name : {"height_ft", "HeightFt", "height (ft)", "HEIGHTFEET"}) {
    const Reading r = read_text("a.geojson", houses_with(name, some, houses_of_row), named(name));
    EXPECT_THAT(r.source.notes, ElementsAre(HasSubstr("12 heights are of the field " + name + ", which is in feet")));
    EXPECT_NEAR(r.city().points_of(r.city().buildings()[0])[0].z, 20.5 * 0.3048, 1e-9) << name;
  }
}

TEST(NamedHeightField, WithoutAnyNumberIsRefused) {
  const std::string text = row_of_houses([](int) { return R"("street":"East 86th","height":9)"; });
  EXPECT_THAT(scenes::refusal_of<InputError>([&] { (void)read_text("a.geojson", text, named("street")); }),
              AllOf(HasSubstr("the field street has a number in no feature"), HasSubstr("fields with numbers: height"),
                    HasSubstr("--height-field")));
}

TEST(NamedHeightField, IsToldWhereOthersTakeItsPlace) {
  const Reading r =
      read_text("a.geojson", row_of_houses([](int n) { return n < 2 ? R"("h":7,"height":9)" : R"("height":9.5)"; }), named("h"));
  EXPECT_THAT(r.source.notes, ElementsAre(HasSubstr("10 heights are of the field height, where h has none")));
}

}  // namespace
}  // namespace farlod::ingest::test

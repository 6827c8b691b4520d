// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "plausibility/elevations_as_heights.hpp"

#include <gmock/gmock.h>

#include <functional>
#include <random>
#include <vector>

#include "farlod/error.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod::plausibility {
namespace {

using scenes::refusal_of;
using testing::HasSubstr;

double within(std::mt19937& random, double low, double high) { return std::uniform_real_distribution(low, high)(random); }

/// A town by the heights and the plans of its buildings, on ground that rises and falls by 5 m.
struct SmallTown {
  double least_m = 6.0, most_m = 18.0;      ///< true heights
  double least_m2 = 60.0, most_m2 = 250.0;  ///< plans
  double ground_m = 0.0;
  int count = 40;

  /// `said`: what the table has for a building of this height on this ground.
  [[nodiscard]] std::vector<SaidHeight> table(const std::function<SaidHeight(double height_m, double ground_m)>& said) const {
    std::mt19937 random(7);
    std::vector<SaidHeight> heights;
    for (int n = 0; n < count; ++n) {
      SaidHeight h = said(within(random, least_m, most_m), ground_m + within(random, -5.0, 5.0));
      h.plan_m2 = within(random, least_m2, most_m2);
      heights.push_back(h);
    }
    return heights;
  }
};

SaidHeight elevation(double height_m, double ground_m) { return {ground_m + height_m}; }
SaidHeight height(double height_m, double) { return {height_m}; }
SaidHeight elevation_of_outline(double height_m, double ground_m) { return {ground_m + height_m, 0.0, ground_m + height_m}; }
SaidHeight elevation_on_ground(double height_m, double ground_m) { return {ground_m + height_m, 0.0, {}, ground_m}; }
SaidHeight height_on_ground(double height_m, double ground_m) { return {height_m, 0.0, {}, ground_m}; }

std::string sign(const std::vector<SaidHeight>& heights, const std::string& field = "h") {
  return sign_of_elevations(heights, field).value_or("");
}

TEST(ElevationsAsHeights, OutlinesLieAtThem) {
  EXPECT_THAT(sign(SmallTown{.ground_m = 110.0}.table(elevation_of_outline)), HasSubstr("outlines of the buildings lie"));
  EXPECT_THAT(sign(SmallTown{.ground_m = 110.0, .count = 6}.table(elevation_of_outline)), HasSubstr("outlines"));
  EXPECT_THAT(sign(SmallTown{.ground_m = 2.0}.table(elevation_of_outline), "ELEV_ROOF"), HasSubstr("outlines"));
  EXPECT_EQ(sign(SmallTown{}.table([](double h, double) {
              return SaidHeight{h, 0.0, h};
            })),
            "")
      << "outlines that were lifted to the heights of their buildings";
  EXPECT_EQ(sign(SmallTown{.ground_m = 110.0, .count = 2}.table(elevation_of_outline)), "") << "two buildings";
}

TEST(ElevationsAsHeights, OutlinesMayBeInFeet) {
  EXPECT_THAT(sign(SmallTown{.ground_m = 110.0}.table([](double h, double g) {
                return SaidHeight{g + h, 0.0, (g + h) / 0.3048};
              })),
              HasSubstr("outlines"));
}

TEST(ElevationsAsHeights, AreCalledSo) {
  EXPECT_THAT(sign(SmallTown{.ground_m = 60.0}.table(elevation), "Elevation"), HasSubstr("called an elevation"));
  EXPECT_EQ(sign(SmallTown{.ground_m = 60.0}.table(height), "Elevation"), "") << "heights, whatever they are called";
}

TEST(ElevationsAsHeights, AllBuildingsWouldBeNeedles) {
  EXPECT_THAT(sign(SmallTown{.ground_m = 520.0}.table(elevation)), HasSubstr("six times as high as they are wide"));
  EXPECT_EQ(sign(SmallTown{.least_m = 100.0, .most_m = 130.0, .least_m2 = 700.0, .most_m2 = 1200.0}.table(height)), "")
      << "an estate of towers";
  EXPECT_EQ(sign(SmallTown{.least_m = 6.0, .most_m = 400.0, .least_m2 = 400.0, .most_m2 = 3000.0}.table(height)), "")
      << "Manhattan";
}

TEST(ElevationsAsHeights, OfAFewBuildingsAreAboveAllChimneys) {
  for (const int count : {2, 3, 4}) {
    EXPECT_THAT(sign(SmallTown{.ground_m = 520.0, .count = count}.table(elevation)), HasSubstr("higher than any chimney"));
    EXPECT_EQ(sign(SmallTown{.least_m = 150.0, .most_m = 419.0, .least_m2 = 60.0, .count = count}.table(height)), "")
        << "chimneys of a power station";
  }
  EXPECT_EQ(sign(SmallTown{.least_m = 430.0, .most_m = 830.0, .least_m2 = 20e3, .most_m2 = 30e3, .count = 2}.table(height)), "");
}

TEST(ElevationsAsHeights, MayBeHeightsInAnotherUnit) {
  const auto heights = SmallTown{.least_m = 600.0, .most_m = 900.0}.table(height);
  EXPECT_THAT(refusal_of<InputError>([&] { require_heights("a.shp", "h", heights); }), HasSubstr("convert them to metres"));
}

TEST(ElevationsAsHeights, StandOnTheirGround) {
  EXPECT_THAT(sign(SmallTown{.ground_m = 40.0}.table(elevation_on_ground)), HasSubstr("elevation of a house"));
  EXPECT_EQ(sign(SmallTown{.ground_m = 40.0}.table(height_on_ground)), "");
  EXPECT_EQ(sign(SmallTown{.ground_m = 0.0}.table(elevation_on_ground)), "") << "at the sea nothing tells them apart";
  EXPECT_EQ(
      sign(SmallTown{.least_m = 100, .most_m = 125, .least_m2 = 700, .most_m2 = 1200, .ground_m = 95}.table(height_on_ground)),
      "")
      << "towers on ground that is as high as they are";
}

constexpr double small_m = 12.0, large_m = 50.0;

/// Prisms from 0 to the height of the table, as the reader makes them of footprints without a base.
LocatedCity raised(const std::vector<SaidHeight>& heights, double width_m) {
  LocatedCity city;
  city.sources = {"town.shp"};
  for (std::size_t n = 0; n < heights.size(); ++n) {
    const double x = 2.0 * width_m * static_cast<double>(n), top = heights[n].height_m;
    city.city.begin_building(std::to_string(n), HeightReference::on_ground, 0, Foot::on_ground);
    for (const double z : {0.0, top}) {
      city.city.begin_facet(SurfaceKind::unknown, 0);
      city.city.add_ring(std::vector<Point3d>{{x, 0, z}, {x + width_m, 0, z}, {x + width_m, 9, z}, {x, 9, z}});
    }
  }
  return city;
}

/// What is told of heights on level ground.
std::string doubt(const std::vector<SaidHeight>& heights, double ground_m, double width_m = large_m) {
  Report report;
  SurveyedGround ground{[&](Point2d) { return std::optional(ground_m); }, {}, true};
  for (const Point2d corner : {Point2d{-10.0, -10.0}, Point2d{1e4, 1e4}}) ground.extent_city.add(corner);
  report_heights_above_ground(raised(heights, width_m), ground, report);
  return report.problems().empty() ? "" : report.problems().front().detail;
}

std::string refused(const std::vector<SaidHeight>& heights, double ground_m) {
  return refusal_of<InputError>([&] { (void)doubt(heights, ground_m, small_m); });
}

TEST(ElevationsAsHeights, AreKnownByTheTerrain) {
  EXPECT_THAT(refused(SmallTown{.ground_m = 40.0}.table(elevation), 40.0), HasSubstr("town.shp: its heights are elevations"));
  EXPECT_EQ(refused(SmallTown{}.table(height), 40.0), "no refusal");
  EXPECT_EQ(refused(std::vector<SaidHeight>(40, SaidHeight{50.0}), 40.0), "no refusal") << "a default height";
}

TEST(ElevationsAsHeights, OfLargeBuildingsAreDoubtedWhereNoneIsLow) {
  const SmallTown town{.ground_m = 100.0};
  EXPECT_THAT(doubt(town.table(elevation), 100.0),
              testing::AllOf(HasSubstr("40 heights, typically 11"), HasSubstr("typically 100.0 m"), HasSubstr("--roof-field")));
  EXPECT_EQ(doubt(town.table(height), 100.0), "");
  EXPECT_EQ(doubt(SmallTown{}.table(height), 10.0), "") << "near the sea";
  EXPECT_EQ(doubt(SmallTown{.most_m = 60.0}.table(height), 16.0), "") << "a town of high and low buildings";
  EXPECT_EQ(doubt(SmallTown{.ground_m = 300.0}.table(elevation), 100.0), "") << "200 m above the ground";
  EXPECT_EQ(doubt(SmallTown{.ground_m = 100.0, .count = 9}.table(elevation), 100.0), "");
  EXPECT_EQ(doubt(std::vector<SaidHeight>(40, SaidHeight{50.0}), 40.0), "") << "a default height";
}

}  // namespace
}  // namespace farlod::plausibility

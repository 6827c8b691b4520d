// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "plausibility/described_twice.hpp"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "city/city_model.hpp"

namespace farlod::plausibility {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// Houses of 12 m × 15 m, every 30 m, of a file of their own.
struct File {
  int columns = 10, rows = 10;
  Point2d place = {};
  Point2d size_m{12.0, 15.0};
  double base_m = 100.0, height_m = 9.0;
  HeightReference reference = HeightReference::elevation;
};

void add_level(CityModel& city, Point2d low, Point2d size_m, double z) {
  const Point2d high = low + size_m;
  city.begin_facet(SurfaceKind::unknown, 0);
  city.add_ring(std::vector<Point3d>{{low.x, low.y, z}, {high.x, low.y, z}, {high.x, high.y, z}, {low.x, high.y, z}});
}

std::string told(const std::vector<File>& files) {
  LocatedCity located;
  for (const File& file : files) {
    const auto source = static_cast<std::uint32_t>(located.sources.size());
    located.sources.emplace_back(1, static_cast<char>('a' + source));
    for (int row = 0; row < file.rows; ++row)
      for (int column = 0; column < file.columns; ++column) {
        const Point2d low = file.place + Point2d{30.0 * column, 30.0 * row};
        located.city.begin_building("house", file.reference, source);
        add_level(located.city, low, file.size_m, file.base_m);
        add_level(located.city, low, file.size_m, file.base_m + file.height_m);
      }
  }
  Report report;
  report_described_twice(located, report);
  std::string details;
  for (const Problem& p : report.problems()) details += p.source + ": " + p.detail + "\n";
  return details;
}

TEST(DescribedTwice, IsToldOnceOfEachTwoFiles) {
  EXPECT_EQ(told({{}, {}}), "b: 100 of the 100 buildings in the extent of a are there, too: give one of the two files\n");
  EXPECT_THAT(told({{}, {}, {}}), AllOf(HasSubstr("b: 100"), HasSubstr("c: 100 of the 100 buildings in the extent of a"),
                                        HasSubstr("c: 100 of the 100 buildings in the extent of b")));
}

TEST(DescribedTwice, OutlinesAndHeightsNeedNotBeTheSame) {
  EXPECT_THAT(told({{}, {.place = {0.6, -0.4}, .size_m = {11.0, 15.5}, .base_m = 98.0, .height_m = 13.0}}), HasSubstr("b: "));
  // One file divides what is a block in the other: blocks of 27 m in every direction hold a house each
  EXPECT_THAT(told({{.size_m = {6.0, 7.0}}, {.place = {-1.0, -1.0}, .size_m = {27.0, 27.0}}}),
              HasSubstr("a: 100 of the 100 buildings in the extent of b"));
}

TEST(DescribedTwice, FootprintsAreComparedByTheirPlaces) {
  const File footprints{.base_m = 0.0, .height_m = 8.0, .reference = HeightReference::on_ground};
  EXPECT_THAT(told({{}, footprints}), HasSubstr("b: 100 of the 100"));
}

TEST(DescribedTwice, TilesOfACityAreNotTold) {
  EXPECT_THAT(told({{}, {.place = {300.0, 0.0}}}), IsEmpty());
  // They share the houses of a column, which are the whole of what lies in both extents
  EXPECT_THAT(told({{.columns = 30}, {.columns = 30, .place = {29 * 30.0, 0.0}}}), IsEmpty());
}

TEST(DescribedTwice, OtherThingsOfTheSamePlaceAreNotTold) {
  const File garages{.place = {14.0, 0.0}, .size_m = {5.0, 6.0}, .height_m = 3.0};
  EXPECT_THAT(told({{}, garages}), IsEmpty());
  const File bridges{.columns = 2, .rows = 2, .size_m = {12.0, 28.0}, .base_m = 112.0, .height_m = 2.0};
  EXPECT_THAT(told({{}, bridges}), IsEmpty());
  const File ground_mesh{.columns = 1, .rows = 1, .size_m = {400.0, 400.0}, .base_m = 95.0, .height_m = 6.0};
  EXPECT_THAT(told({{}, ground_mesh}), IsEmpty());
  EXPECT_THAT(told({{}, {.columns = 2, .rows = 1}}), IsEmpty()) << "two are too few";
}

}  // namespace
}  // namespace farlod::plausibility

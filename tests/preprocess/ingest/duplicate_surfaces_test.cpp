// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "ingest/model_builder/city_model_builder.hpp"

namespace farlod::ingest {
namespace {

const Ring square{{0, 0, 3}, {4, 0, 3}, {4, 4, 3}, {0, 4, 3}};
const Ring hole{{1, 1, 3}, {1, 2, 3}, {2, 2, 3}};

Ring turned(Ring ring, std::ptrdiff_t by) {
  std::rotate(ring.begin(), ring.begin() + by, ring.end());
  return ring;
}
Ring reversed(Ring ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

/// Facets of a building of two polygons.
std::size_t facets_of(const Rings& a, const Rings& b, std::uint16_t part_of_b = 0) {
  Report report;
  CityModelBuilder builder("town.gml", report);
  builder.begin_building("house");
  Rings first = a, second = b;
  builder.add_polygon(first, RingEnd::implied, {.surface = {}, .name = {}});
  builder.add_polygon(second, RingEnd::implied, {.part = part_of_b, .surface = {}, .name = {}});
  builder.end_building();
  return builder.take_city().facets().size();
}

TEST(DuplicateSurfaces, AreLeftOutWhereverTheirRingsBegin) {
  for (std::ptrdiff_t by = 0; by < 4; ++by) {
    Report report;
    CityModelBuilder builder("town.gml", report);
    builder.begin_building("house");
    for (const Ring& ring : {square, turned(square, by)}) {
      Rings rings{ring};
      builder.add_polygon(rings, RingEnd::implied, {.surface = {}, .name = {}});
    }
    builder.end_building();
    EXPECT_EQ(builder.take_city().facets().size(), 1U) << by;
    ASSERT_EQ(report.problems().size(), 1U);
    const Problem& problem = report.problems()[0];
    EXPECT_EQ(problem.code, ProblemCode::duplicate_surface);
    EXPECT_EQ(problem.place, "house");
    EXPECT_EQ(problem.ring, "polygon 1, ring 0 (outer)");
    EXPECT_EQ(problem.position, turned(square, by).front());
  }
}

TEST(DuplicateSurfaces, AreNeitherTheOtherSideNorAnotherPartsNorAnotherHole) {
  EXPECT_EQ(facets_of({square}, {square}), 1U);
  EXPECT_EQ(facets_of({square}, {reversed(square)}), 2U) << "a wall has two sides";
  EXPECT_EQ(facets_of({square}, {square}, 1), 2U) << "two parts may share a wall";
  EXPECT_EQ(facets_of({square, hole}, {square}), 2U);
  EXPECT_EQ(facets_of({square, hole}, {square, turned(hole, 1)}), 1U);
  EXPECT_EQ(facets_of({square}, {{square[0], square[2], square[1], square[3]}}), 2U) << "the same corners in another order";
}

TEST(DuplicateSurfaces, TheTwoZerosAreOne) {
  Ring negative = square;
  negative[0].x = -0.0;
  EXPECT_EQ(facets_of({square}, {negative}), 1U);
}

TEST(DuplicateSurfaces, AreOnlySoughtWithinABuilding) {
  Report report;
  CityModelBuilder builder("town.gml", report);
  for (const char* id : {"left", "right"}) {
    Rings rings{square};
    builder.begin_building(id);
    builder.add_polygon(rings, RingEnd::implied, {.surface = {}, .name = {}});
    builder.end_building();
  }
  EXPECT_TRUE(report.problems().empty());
  EXPECT_EQ(builder.take_city().facets().size(), 2U);
}

}  // namespace
}  // namespace farlod::ingest

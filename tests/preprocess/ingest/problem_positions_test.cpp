// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "ingest/model_builder/city_model_builder.hpp"

namespace farlod::ingest {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Ring triangle_at(const Point3d& p) { return {p, p + Point3d{4, 0, 0}, p + Point3d{0, 4, 0}, p}; }

struct Writing {
  Report report;
  CityModelBuilder builder{"town.gml", report};

  void polygon(Ring outer) {
    Rings rings{std::move(outer)};
    builder.add_polygon(rings, RingEnd::repeats_first, {});
  }
  [[nodiscard]] std::optional<Point3d> position(std::size_t n) const { return report.problems().at(n).position; }
};

TEST(ProblemPositions, OfABadRingAreItsFirstVertex) {
  Writing w;
  w.builder.begin_building("house");
  w.polygon(triangle_at({1, 2, 3}));
  w.polygon({{7, 8, 9}, {7, 8, 9}, {7, 8, 9}});
  w.builder.end_building();
  EXPECT_EQ(w.position(0), (Point3d{7, 8, 9}));
  EXPECT_EQ(w.report.problems()[0].ring, "polygon 1, ring 0 (outer)");
}

TEST(ProblemPositions, NameTheRing) {
  Writing w;
  w.builder.begin_building("house");
  const Ring hole{{1.1, 2.1, 3}, {1.2, 2.1, 3}, {1.1, 2.2, 3}, {1.1, 2.1, 3}};
  Rings rings{triangle_at({1, 2, 3}), hole, {{7, 8, 9}}};
  w.builder.add_polygon(rings, RingEnd::repeats_first, {.surface = {}, .name = "roof"});
  w.polygon({{5, 6, 7}, {5, 6, 7}, {9, 6, 7}, {9, 9, 7}, {5, 6, 7}});
  w.polygon({{1, 6, 7}, {9, 6, 7}, {9, 9, 7}});
  w.builder.end_building();
  ASSERT_EQ(w.report.problems().size(), 3U);
  EXPECT_EQ(w.report.problems()[0].ring, "polygon roof, ring 2 (hole)");
  EXPECT_EQ(w.report.problems()[1].code, ProblemCode::repeated_vertex);
  EXPECT_EQ(w.report.problems()[1].ring, "polygon 1, ring 0 (outer)");
  EXPECT_EQ(w.position(1), (Point3d{5, 6, 7}));
  EXPECT_EQ(w.report.problems()[2].code, ProblemCode::ring_not_closed);
  EXPECT_EQ(w.report.problems()[2].ring, "polygon 2, ring 0 (outer)");
}

TEST(ProblemPositions, AreNumbersWhateverTheRingHolds) {
  Writing w;
  w.builder.begin_building("house");
  w.polygon({{nan, 8, 9}, {5, 1e12, 9}, {5, 6, 7}, {nan, 8, 9}});
  w.polygon({{nan, nan, nan}});
  w.builder.end_building();
  ASSERT_EQ(w.report.problems().size(), 3U);
  EXPECT_EQ(w.report.problems()[2].code, ProblemCode::no_geometry);
  for (std::size_t n = 0; n < 3; ++n) EXPECT_EQ(w.position(n), (Point3d{5, 6, 7})) << n;
}

TEST(ProblemPositions, OfAWholeBuildingAreItsFirstVertex) {
  Writing w;
  for (const double x : {10.0, 20.0}) {
    w.builder.begin_building("twin");
    w.polygon(triangle_at({x, 2, 3}));
    w.polygon(triangle_at({x, 2, 30}));
    w.builder.end_building();
  }
  ASSERT_EQ(w.report.count(ProblemCode::repeated_id), 1U);
  EXPECT_EQ(w.position(0), (Point3d{20, 2, 3}));
}

TEST(ProblemPositions, OfOpenRingsAreAtTheGreatestGap) {
  Writing w;
  w.builder.begin_building("house");
  w.polygon(triangle_at({1, 2, 3}));
  for (const double leg_m : {1.0, 5.0, 2.0}) w.polygon({{leg_m, 0, 0}, {leg_m, 9, 0}, {2 * leg_m, 0, 0}});
  w.builder.end_building();
  ASSERT_EQ(w.report.count(ProblemCode::ring_not_closed), 1U);
  EXPECT_EQ(w.position(0), (Point3d{5, 0, 0}));
}

TEST(ProblemPositions, AreNotGuessedForABuildingWithoutVertices) {
  Writing w;
  w.builder.begin_building("full");
  w.polygon(triangle_at({1, 2, 3}));
  w.builder.end_building();
  w.builder.begin_building("empty");
  w.builder.end_building();
  ASSERT_EQ(w.report.count(ProblemCode::no_geometry), 1U);
  EXPECT_FALSE(w.position(0));
}

}  // namespace
}  // namespace farlod::ingest

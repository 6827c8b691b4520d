// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "ingest/mesh/planar_faces.hpp"
#include "ingest/model_builder/city_model_builder.hpp"
#include "ingest/model_builder/ring_cleaning.hpp"

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

using Numbers = std::vector<std::uint32_t>;

FaceCorners faces(const std::vector<std::vector<Point3d>>& polygons) {
  FaceCorners mesh;
  for (const auto& polygon : polygons) {
    mesh.points.insert(mesh.points.end(), polygon.begin(), polygon.end());
    mesh.end_face();
  }
  return mesh;
}

/// A square of edge 10 m cut along its diagonal; one corner lifted.
FaceCorners folded_square(double lift_m) {
  return faces({{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}}, {{0, 0, 0}, {10, 10, 0}, {0, 10, lift_m}}});
}

TEST(PlanarFaces, TrianglesOfASquareAreOneFace) { EXPECT_EQ(number_planar_faces(folded_square(0.0)), (Numbers{0, 0})); }

TEST(PlanarFaces, RoundingDoesNotSplitAFace) {
  // Mirrored in the diagonal, the apex of the other triangle has the coordinates (1, -1, 1) among its corners. All four points
  // may be half a step off, and the normal is upright: 4 · ½ step is the limit
  EXPECT_EQ(number_planar_faces(folded_square(1.99 * coordinate_rounding_m)), (Numbers{0, 0}));
  EXPECT_EQ(number_planar_faces(folded_square(2.05 * coordinate_rounding_m)), (Numbers{0, 1}));
}

TEST(PlanarFaces, ParallelFacesWithoutACommonEdgeStayApart) {
  EXPECT_EQ(number_planar_faces(faces({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{1, 0, 0}, {2, 0, 0}, {1, -1, 0}}})), (Numbers{0, 1}));
}

TEST(PlanarFaces, AThinFaceJoinsOneNeighborAndLinksNone) {
  const Point3d a{0, 0, 0}, b{10, 0, 0}, on_edge{5, 0, 0};
  const FaceCorners mesh = faces({{a, b, {5, 10, 0}}, {a, on_edge, b}, {on_edge, a, {2, 0, -10}}});
  EXPECT_EQ(number_planar_faces(mesh), (Numbers{0, 1, 1}));
}

TEST(PlanarFaces, UnreadablePointsJoinNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const FaceCorners mesh =
      faces({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 0}, {1, 0, 0}, {0, nan, 1}}, {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}});
  EXPECT_EQ(number_planar_faces(mesh), (Numbers{0, 1, 2}));
}

TEST(PlanarFaces, WeldingFindsEqualPoints) {
  const std::vector<Point3d> points{{1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {-0.0, 0, 0}};
  const Numbers numbers = weld(points);
  EXPECT_EQ(numbers[0], numbers[2]);
  EXPECT_EQ(numbers[1], numbers[3]);
  EXPECT_NE(numbers[0], numbers[1]);
}

const Point3d a{0, 0, 0}, b{1, 0, 0}, c{1, 1, 0}, d{0, 1, 0};

TEST(RingCleaning, TakesTheClosingPointAway) {
  Ring ring{a, b, c, d, a};
  const RingFindings findings = clean_ring(ring, RingEnd::repeats_first);
  EXPECT_EQ(findings.state, RingState::usable);
  EXPECT_FALSE(findings.was_open);
  EXPECT_EQ(findings.repeated_vertices, 0u);
  EXPECT_EQ(ring, (Ring{a, b, c, d}));
}

TEST(RingCleaning, ClosesAnOpenRingAndTellsTheGap) {
  Ring ring{a, b, c, d};
  const RingFindings findings = clean_ring(ring, RingEnd::repeats_first);
  EXPECT_TRUE(findings.was_open);
  EXPECT_EQ(findings.gap, 1.0);
  EXPECT_EQ(ring, (Ring{a, b, c, d}));
}

TEST(RingCleaning, AnImpliedEndIsNotOpen) {
  Ring ring{a, b, c};
  EXPECT_FALSE(clean_ring(ring, RingEnd::implied).was_open);
}

TEST(RingCleaning, TakesRepeatedVerticesOutAcrossTheEndToo) {
  Ring ring{a, a, b, c, c, c, d, a};
  const RingFindings findings = clean_ring(ring, RingEnd::implied);
  EXPECT_EQ(findings.repeated_vertices, 4u);
  EXPECT_EQ(ring, (Ring{a, b, c, d}));
}

TEST(RingCleaning, ThreePointsMustDiffer) {
  for (Ring ring : {Ring{}, Ring{a}, Ring{a, b}, Ring{a, b, a}, Ring{a, b, a, b}, Ring{a, a, a, a}})
    EXPECT_EQ(clean_ring(ring, RingEnd::repeats_first).state, RingState::too_few_points);
  Ring spike{a, b, a, c};
  EXPECT_EQ(clean_ring(spike, RingEnd::implied).state, RingState::usable);
}

TEST(RingCleaning, CoordinatesMustBeFiniteAndOnEarth) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 2.0 * farthest_coordinate}) {
    Ring ring{a, b, {1.0, bad, 0.0}};
    EXPECT_EQ(clean_ring(ring, RingEnd::implied).state, RingState::unreadable_coordinate);
  }
}

using Lods = std::vector<std::vector<double>>;
using Chosen = std::vector<std::optional<double>>;

TEST(LodChoice, TheBestIsTheHighestUpToThree) {
  EXPECT_EQ(choose_lods(Lods{{0, 1, 2}}, {}), Chosen{2.0});
  EXPECT_EQ(choose_lods(Lods{{1.2, 2.2, 1.3}}, {}), Chosen{2.2});
  EXPECT_EQ(choose_lods(Lods{{2, 3.3, 4}}, {}), Chosen{3.3});
}

TEST(LodChoice, LevelZeroIsOnlyTakenWhenAskedFor) {
  EXPECT_EQ(choose_lods(Lods{{0}}, {}), Chosen{std::nullopt});
  EXPECT_EQ(choose_lods(Lods{{0, 2}}, {.exactly = 0}), Chosen{0.0});
}

TEST(LodChoice, ARefinedLevelBelongsToItsWholeNumber) {
  EXPECT_EQ(choose_lods(Lods{{1.2, 1.3, 2.2}}, {.exactly = 1}), Chosen{1.3});
  EXPECT_EQ(choose_lods(Lods{{1.2}}, {.exactly = 2}), Chosen{std::nullopt});
}

TEST(LodChoice, APartThatLacksTheLevelGivesItsBest) {
  EXPECT_EQ(choose_lods(Lods{{2}, {1, 2}, {1}}, {}), (Chosen{2.0, 2.0, 1.0}));
}

TEST(LodChoice, TheCoarserShellAroundThePartsIsNotTaken) {
  EXPECT_EQ(choose_lods(Lods{{1}, {2}}, {}), (Chosen{std::nullopt, 2.0}));
}

TEST(LodChoice, ListsWhatThereIs) {
  EXPECT_EQ(list_lods(Lods{{2}, {1, 2.2}}), "1, 2, 2.2");
  EXPECT_EQ(list_lods(Lods{{}}), "none");
}

}  // namespace
}  // namespace farlod::ingest

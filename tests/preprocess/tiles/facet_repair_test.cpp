// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/facet_repair.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tiles/building_pieces.hpp"
#include "tiles/facet_triangulation.hpp"

namespace farlod::tiles {
namespace {

using Ring = std::vector<Point3d>;
using Rings = std::vector<Ring>;

const std::vector<Point3d> roof{{0, 0, 5}, {10, 0, 5}, {10, 8, 5}, {0, 8, 5}}, court{{2, 2, 5}, {2, 4, 5}, {4, 4, 5}};
const std::vector<Point3d> court_with_spike{{2, 2, 5}, {2, 4, 5}, {4, 4, 5}, {6, 6, 5}, {4, 4, 5}};

struct Repair {
  CityModel city;
  RepairedFacet facet;

  explicit Repair(const Rings& rings) {
    city.begin_building("house");
    city.begin_facet(SurfaceKind::roof, 0);
    for (const auto& ring : rings) city.add_ring(ring);
    facet = repaired_rings(city, city.facets()[0]);
  }
  [[nodiscard]] Rings rings() const {
    Rings copies;
    for (const auto ring : facet.rings) copies.emplace_back(ring.begin(), ring.end());
    return copies;
  }
};

TEST(FacetRepair, LeavesGoodRingsWhereTheyAre) {
  const Repair repair({roof, court});
  EXPECT_TRUE(repair.facet.findings.empty());
  EXPECT_EQ(repair.facet.rings[1].data(), repair.city.ring(repair.city.facets()[0], 1).data());
}

TEST(FacetRepair, PutsTheOuterRingFirst) { EXPECT_EQ(Repair({court, roof}).rings(), (Rings{roof, court})); }

TEST(FacetRepair, TakesSpikesOutOfHolesToo) {
  const Repair repair({roof, court_with_spike});
  EXPECT_EQ(repair.rings()[1].size(), 3U);
  ASSERT_EQ(repair.facet.findings.size(), 1U);
  EXPECT_EQ(repair.facet.findings[0].code, ProblemCode::spike);
  EXPECT_EQ(repair.facet.findings[0].ring, 1U);
  EXPECT_EQ(repair.facet.findings[0].position, (Point3d{6, 6, 5}));
  EXPECT_EQ(repair.facet.findings[0].detail, "vertex 3 of ring 1 lies 2.828 m out on a way that is run there and back");
}

TEST(FacetRepair, CountsRingsAsTheFacetHasThem) {
  const Repair repair({roof, court, court, court});
  EXPECT_EQ(repair.rings(), (Rings{roof, court}));
  ASSERT_EQ(repair.facet.findings.size(), 2U);
  EXPECT_EQ(repair.facet.findings[1].ring, 3U);
  EXPECT_EQ(name_of_ring(3), ", ring 3 (hole)");
}

/// Coordinates below 16, normals of length 1 of which the largest part is at least 1/√3: a dozen sums and products, one quotient.
constexpr double projection_rounding_m = 12 * 16 * 1.7321 * std::numeric_limits<double>::epsilon();

TEST(FacetProjection, LiftsBackWhatItLaidFlat) {
  const Point3d origin{1, -2, 3};
  for (const Point3d& n : {Point3d{0.1, 0.2, 1}, {1, 0.2, -0.3}, {0.3, -1, 0.2}, {-1, 0.1, 0.1}, {0.2, 1, 0.9}, {0, 0, -1}}) {
    const Point3d normal = normalized(n), u = normalized(cross(normal, Point3d{0.3, 0.4, -0.5})), v = cross(normal, u);
    for (const FacetProjection& project :
         {FacetProjection::dropping_a_coordinate(normal), FacetProjection::onto_plane(origin, normal)})
      for (const Point2d in_plane : {Point2d{0, 0}, {5, 0}, {-3, 7}, {0.25, -8}}) {
        const Point3d p = origin + in_plane.x * u + in_plane.y * v;
        EXPECT_LE(norm(project.lift(project(p), origin) - p), projection_rounding_m);
      }
  }
}

TEST(FacetProjection, TellsWhetherItMirrors) {
  const Point3d origin{1, -2, 3};
  for (const Point3d& n :
       {Point3d{0.1, 0.2, 1}, {0.1, 0.2, -1}, {1, 0.2, -0.3}, {-1, 0.2, -0.3}, {0.3, 1, 0.2}, {0.3, -1, 0.2}}) {
    const Point3d normal = normalized(n), u = normalized(cross(normal, Point3d{0.3, 0.4, -0.5})), v = cross(normal, u);
    for (const FacetProjection& project :
         {FacetProjection::dropping_a_coordinate(normal), FacetProjection::onto_plane(origin, normal)}) {
      const Point2d a = project(origin), b = project(origin + u) - a, c = project(origin + v) - a;
      EXPECT_EQ(b.x * c.y - b.y * c.x < 0.0, project.is_mirrored());
    }
  }
}

TEST(FacetProjection, KeepsDistancesInItsOwnPlaneOnly) {
  const Point3d normal = normalized(Point3d{0, -1, 1}), along_slope{0, 3, 3};
  const FacetProjection flat = FacetProjection::onto_plane({}, normal),
                        from_above = FacetProjection::dropping_a_coordinate(normal);
  EXPECT_NEAR(norm(flat(along_slope)), norm(along_slope), projection_rounding_m);
  EXPECT_EQ(norm(from_above(along_slope)), 3.0);
}

/// On a slope, so that the plane of the facet is none of the coordinate planes.
Ring square(double x, double y, double edge_m) {
  const auto on_slope = [](double u, double v) { return Point3d{u, v, 0.25 * u + 0.5 * v}; };
  return {on_slope(x, y), on_slope(x + edge_m, y), on_slope(x + edge_m, y + edge_m), on_slope(x, y + edge_m)};
}
Ring reversed(Ring ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

RingPlaces places(const Rings& rings) {
  const std::vector<std::span<const Point3d>> spans(rings.begin(), rings.end());
  return places_of_rings(spans);
}

/// The rings that are misplaced, whichever way the holes run.
std::vector<std::size_t> misplaced(Rings rings) {
  std::vector<std::size_t> found;
  for (const MisplacedHole& hole : places(rings).misplaced) found.push_back(hole.ring);
  for (std::size_t k = 1; k < rings.size(); ++k) rings[k] = reversed(rings[k]);
  std::vector<std::size_t> found_again;
  for (const MisplacedHole& hole : places(rings).misplaced) found_again.push_back(hole.ring);
  EXPECT_EQ(found, found_again);
  return found;
}

using Numbers = std::vector<std::size_t>;

TEST(MisplacedHoles, AreNoneWhereHolesLieWithin) {
  EXPECT_EQ(misplaced({square(0, 0, 8), square(1, 1, 2), square(4, 4, 2)}), Numbers{});
  EXPECT_EQ(misplaced({square(0, 0, 8), square(0, 0, 2)}), Numbers{}) << "a hole may touch the outer ring";
  EXPECT_EQ(misplaced({square(0, 0, 8), square(1, 1, 2), square(3, 1, 2)}), Numbers{}) << "and another hole";
  EXPECT_FALSE(places({square(0, 0, 8), square(1, 1, 2)}).true_outer);
}

TEST(MisplacedHoles, LieOutside) {
  EXPECT_EQ(misplaced({square(0, 0, 8), square(20, 0, 2), square(1, 1, 2)}), Numbers{1});
  EXPECT_EQ(misplaced({square(0, 0, 8), square(8, 0, 8)}), Numbers{1}) << "beside the outer ring, and touching it";
  // In the notch of an L: the boxes overlap
  const Ring l{{0, 0, 0}, {8, 0, 0}, {8, 2, 0}, {2, 2, 0}, {2, 8, 0}, {0, 8, 0}};
  EXPECT_EQ(misplaced({l, {{4, 4, 0}, {6, 4, 0}, {6, 6, 0}}}), Numbers{1});
  EXPECT_EQ(misplaced({l, {{8, 2, 0}, {2, 8, 0}, {2, 2, 0}}}), Numbers{1}) << "all corners on the outer ring";
}

TEST(MisplacedHoles, AreNotThoseThatCross) {
  EXPECT_EQ(misplaced({square(0, 0, 8), square(7, 1, 2)}), Numbers{}) << "a courtyard that sticks out";
  // A cross of two bars: no corner of one lies in the other
  const Ring lying{{0, 3, 0}, {9, 3, 0}, {9, 6, 0}, {0, 6, 0}}, standing{{3, 0, 0}, {6, 0, 0}, {6, 9, 0}, {3, 9, 0}};
  EXPECT_EQ(misplaced({lying, standing}), Numbers{});
  EXPECT_FALSE(places({lying, standing}).true_outer);
}

TEST(MisplacedHoles, AreTheOuterRingOrAnotherHoleOnceMore) {
  Ring turned = square(0, 0, 8);
  std::rotate(turned.begin(), turned.begin() + 2, turned.end());
  EXPECT_EQ(misplaced({square(0, 0, 8), turned}), Numbers{1});
  EXPECT_EQ(misplaced({square(0, 0, 8), square(1, 1, 2), square(1, 1, 2)}), Numbers{2});
  EXPECT_EQ(misplaced({square(0, 0, 8), square(1, 1, 2), square(1, 1, 2), square(1, 1, 2)}), (Numbers{2, 3}));
}

TEST(MisplacedHoles, LieWithinAnotherHole) {
  EXPECT_EQ(misplaced({square(0, 0, 8), square(1, 1, 5), square(2, 2, 1)}), Numbers{2});
  EXPECT_EQ(misplaced({square(0, 0, 8), square(2, 2, 1), square(1, 1, 5)}), Numbers{1});
}

TEST(MisplacedHoles, ThatSurroundTheFirstRingAreTheOuterOne) {
  const RingPlaces exchanged = places({square(1, 1, 2), square(0, 0, 8), square(4, 4, 2)});
  EXPECT_EQ(exchanged.true_outer, 1U);
  EXPECT_TRUE(exchanged.misplaced.empty());
}

TEST(MisplacedHoles, OfAFacetWithoutAreaAreNotTested) {
  EXPECT_EQ(misplaced({{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, square(5, 5, 1)}), Numbers{});
}

const Point3d a{0, 0, 5}, b{10, 0, 5}, c{10, 8, 5}, d{0, 8, 5};

/// A ring turned about the origin: what lay on a line does so no longer, by the last bits.
Ring turned(Ring ring, double angle_rad) {
  for (Point3d& p : ring)
    p = {std::cos(angle_rad) * p.x - std::sin(angle_rad) * p.y, std::sin(angle_rad) * p.x + std::cos(angle_rad) * p.y, p.z};
  return ring;
}

TEST(Spikes, AreTakenOutWhereverTheRingBegins) {
  const Point3d foot{10, 4, 5}, tip{14, 4, 5};
  for (std::ptrdiff_t begin = 0; begin < 7; ++begin) {
    Ring ring{a, b, foot, tip, foot, c, d};
    std::rotate(ring.begin(), ring.begin() + begin, ring.end());
    const Ring given = turned(ring, 0.3);
    const auto despiked = without_spikes(given);
    ASSERT_TRUE(despiked) << begin;
    EXPECT_EQ(despiked->ring.size(), 5U);
    ASSERT_EQ(despiked->spikes.size(), 1U);
    EXPECT_EQ(given[despiked->spikes[0].vertex], turned({tip}, 0.3)[0]);
    EXPECT_EQ(despiked->spikes[0].tip, turned({tip}, 0.3)[0]);
    constexpr double rounding_m = 16 * 2.3e-16 * 14;  // of a few sums and products of numbers up to 14
    EXPECT_NEAR(despiked->spikes[0].length_m, 4.0, rounding_m);
  }
}

TEST(Spikes, MayComeBackPartOfTheWayOrFarther) {
  EXPECT_EQ(without_spikes(Ring{a, {14, 0, 5}, b, c, d})->ring, (Ring{a, b, c, d}));
  EXPECT_EQ(without_spikes(Ring{{2, 0, 5}, {14, 0, 5}, a, {0, -3, 5}, {14, -3, 5}, {14, -1, 5}, {2, -1, 5}})->spikes.size(), 1U);
}

TEST(Spikes, OfSeveralVerticesAreTakenOutFromTheTip) {
  const Point3d foot{10, 4, 5}, knee{14, 4, 5}, tip{14, 9, 5};
  const Ring hooked{a, b, foot, knee, tip, knee, foot, c, d};
  for (std::ptrdiff_t begin = 0; begin < 9; ++begin) {
    Ring ring = hooked;
    std::rotate(ring.begin(), ring.begin() + begin, ring.end());
    const auto despiked = without_spikes(ring);
    ASSERT_TRUE(despiked) << begin;
    Ring left = despiked->ring;
    std::rotate(left.begin(), std::find(left.begin(), left.end(), a), left.end());
    EXPECT_EQ(left, (Ring{a, b, foot, c, d})) << begin;
    ASSERT_EQ(despiked->spikes.size(), 2U) << begin;
    EXPECT_EQ(despiked->spikes[0].tip, tip) << begin;
    EXPECT_EQ(despiked->spikes[1].tip, knee) << begin;
  }
}

TEST(Spikes, AreAsNarrowAsFilesRound) {
  const auto with_width = [](double width_m) { return Ring{a, b, {10, 4, 5}, {14, 4, 5}, {10, 4 + width_m, 5}, c, d}; };
  EXPECT_TRUE(without_spikes(with_width(0.9 * spike_width_m)));
  EXPECT_FALSE(without_spikes(with_width(1.1 * spike_width_m)));
}

TEST(Spikes, AreNoHonestCorners) {
  EXPECT_FALSE(without_spikes(Ring{a, b, c, d}));
  EXPECT_FALSE(without_spikes(Ring{a, b, {10, 8, 5}, {5, 8, 5}, d})) << "a vertex on a straight side";
  EXPECT_FALSE(without_spikes(Ring{a, b, c, {0, 0.01, 5}})) << "an acute gore";
  EXPECT_FALSE(without_spikes(Ring{a, b, {10, 4, 5}, {10.005, 4, 5}, {10, 4.0008, 5}, c, d})) << "half a centimetre";
  // A slit of half a millimetre is thin, but no corner of it turns back
  EXPECT_FALSE(without_spikes(Ring{a, b, {10, 0.0005, 5}, {0, 0.0005, 5}}));
  // A keyhole's bridge is run there and back, but around something
  EXPECT_FALSE(
      without_spikes(Ring{a, b, c, d, {0, 4, 5}, {4, 4, 5}, {4, 5, 5}, {6, 5, 5}, {6, 3, 5}, {4, 3, 5}, {4, 4, 5}, {0, 4, 5}}));
}

TEST(Spikes, OfALongCombAreTakenOutOneByOne) {
  // With the cost of the whole ring for each, this would take minutes
  constexpr int teeth = 100000;
  Ring comb{a, b};
  for (int k = 1; k <= teeth; ++k) {
    const Point3d foot{10, 8.0 * k / (teeth + 1), 5}, tip = foot + Point3d{1, 0, 0};
    comb.insert(comb.end(), {foot, tip, foot});
  }
  comb.insert(comb.end(), {c, d});
  const auto despiked = without_spikes(comb);
  ASSERT_TRUE(despiked);
  EXPECT_EQ(despiked->spikes.size(), static_cast<std::size_t>(teeth));
  EXPECT_EQ(despiked->ring.size(), 4U + teeth);
}

TEST(Spikes, OfWhichNothingElseIsLeftStay) {
  EXPECT_FALSE(without_spikes(Ring{a, b, {5, 0.0001, 5}})) << "a sliver of a mesh";
  EXPECT_FALSE(without_spikes(Ring{a, {5, 0, 5}, b, {2, 0, 5}}));
  EXPECT_FALSE(without_spikes(Ring{a, {5, 0, 5}, b, {5, 0, 5}}));
}

/// The six sides of a box, looking out (+1) or in (−1).
std::vector<OrientedArea> box(double side, const Point3d& middle, double direction, std::uint16_t part) {
  std::vector<OrientedArea> sides;
  for (const Point3d& n : {Point3d{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}})
    sides.push_back({direction * side * side * n, middle + 0.5 * side * n, part});
  return sides;
}

TEST(OutwardSigns, AFileThatDrawsInwardsIsTurned) {
  EXPECT_EQ(outward_signs(box(10, {500, 600, 5}, 1.0, 0)), std::vector<double>(6, 1.0));
  EXPECT_EQ(outward_signs(box(10, {500, 600, 5}, -1.0, 0)), std::vector<double>(6, -1.0));
}

TEST(OutwardSigns, AMissingFacetChangesNothing) {
  for (std::size_t missing = 0; missing < 6; ++missing) {
    auto sides = box(10, {500, 600, 5}, -1.0, 0);
    sides.erase(sides.begin() + static_cast<std::ptrdiff_t>(missing));
    EXPECT_EQ(outward_signs(sides), std::vector<double>(5, -1.0)) << missing;
  }
}

TEST(OutwardSigns, EachPartDecidesForItself) {
  auto sides = box(10, {0, 0, 5}, 1.0, 0);
  const auto annex = box(4, {7, 0, 2}, -1.0, 1);
  sides.insert(sides.end(), annex.begin(), annex.end());
  const auto signs = outward_signs(sides);
  for (std::size_t n = 0; n < 12; ++n) EXPECT_EQ(signs[n], n < 6 ? 1.0 : -1.0);
}

}  // namespace
}  // namespace farlod::tiles

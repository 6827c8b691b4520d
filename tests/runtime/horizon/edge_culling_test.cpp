// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/edge_culling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "base/azimuth.hpp"
#include "farlod/angle.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/sky_partition.hpp"
#include "tests/oracles/distance_to_segment.hpp"
#include "tests/runtime/horizon/horizon_oracle.hpp"
#include "tests/runtime/horizon/random_places.hpp"

namespace farlod {
namespace {

/// Intervals and bounds are widened by this; their rounding is a thousandth of it.
constexpr double margin = reach_margin;

struct Scene {
  PacketBounds bounds;
  HorizonEdge edge;
};

/// Boxes of many shapes, down to a point, and edges near and far, across their axes and beside them.
Scene random_scene(RandomPlaces& random) {
  Scene s;
  s.bounds.box.x = random.between(-5.0, 5.0);
  s.bounds.box.y = random.between(-5.0, 5.0);
  s.bounds.box.half_x = std::max(0.0F, random.between(-2.0, 8.0));
  s.bounds.box.half_y = std::max(0.0F, random.between(-2.0, 8.0));
  s.bounds.box.low_z = random.between(-2.0, 2.0);
  s.bounds.depth = -1.0F;
  s.edge = random.edge(random.between(5.0, 100.0), -5.0, 40.0);
  return s;
}

/// What EdgeReach holds, lane by lane; the edge is in the first one.
struct ReachOfLanes {
  std::array<float, lane_count> max_slope, from, to;
};
ReachOfLanes reach(const Scene& s) {
  const EdgeReach r = reach_of(silhouettes_of(std::vector{s.edge}).batches()[0], s.bounds);
  return {to_array(r.max_slope), to_array(r.from), to_array(r.to)};
}

Point3d place(const Point3f& p) { return {p.x, p.y, p.z}; }

/// The corners first, then places within the box.
std::vector<Point3d> eyes_in(const CenteredBox& box, RandomPlaces& random) {
  std::vector<Point3d> eyes;
  const auto add = [&](double x, double y) { eyes.push_back({box.x + x * box.half_x, box.y + y * box.half_y, box.low_z}); };
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) add(x, y);
  for (int n = 0; n < 20; ++n) {
    const float x = random.between(-1.0, 1.0);
    add(x, random.between(-1.0, 1.0));
  }
  return eyes;
}

/// The pseudo-angle of a direction in turns, on the turn that is nearest to `about`.
double turns_about(Point2d direction, double about) {
  const double turns = pseudo_angle(direction);
  return turns + std::round(about - turns);
}

struct Seen {
  double steepest = 0.0, from = 3.0, to = 0.0;
  void add(const Point3d& eye, const Point3d& p, double about) {
    const Point2d way = horizontal(p) - horizontal(eye);
    steepest = std::max(steepest, (p.z - eye.z) / norm(way));
    from = std::min(from, turns_about(way, about));
    to = std::max(to, turns_about(way, about));
  }
};

/// What some receivers see of an edge that is clear of them, at its ends and between.
Seen seen(const Scene& s, double about, RandomPlaces& random) {
  const Point3d a = place(s.edge.a), b = place(s.edge.b);
  Seen result;
  for (const Point3d& eye : eyes_in(s.bounds.box, random)) {
    result.add(eye, a, about);
    result.add(eye, b, about);
    for (int n = 0; n < 20; ++n) result.add(eye, a + double{random.between(0.0, 1.0)} * (b - a), about);
  }
  return result;
}

/// Of the circle around the box, for which alone no edge is steeper.
double slope_from_circle(const Scene& s) {
  const Point2d middle{s.bounds.box.x, s.bounds.box.y};
  const double distance = distance_to_segment(horizontal(place(s.edge.a)) - middle, horizontal(place(s.edge.b)) - middle);
  const double radius = std::hypot(s.bounds.box.half_x, s.bounds.box.half_y);
  const double high = std::max(s.edge.a.z, s.edge.b.z) - double{s.bounds.box.low_z};
  return distance > radius ? high / (distance - radius) : std::numeric_limits<double>::infinity();
}

TEST(EdgeReach, HoldsWhatAnyReceiverSeesAndNoMoreAzimuthsThanThat) {
  RandomPlaces random;
  int told = 0;
  for (int n = 0; n < 5000; ++n) {
    const Scene s = random_scene(random);
    const ReachOfLanes r = reach(s);
    const bool is_above = std::max(s.edge.a.z, s.edge.b.z) > s.bounds.box.low_z;
    EXPECT_EQ(r.max_slope[0] > 0.0F, is_above);
    if (r.max_slope[0] < 0.0F || r.max_slope[0] == EdgeReach::unbounded) continue;
    ++told;
    const double from = r.from[0], to = r.to[0];
    const Seen what = seen(s, 0.5 * (from + to), random);
    EXPECT_LE(what.steepest, r.max_slope[0]);
    EXPECT_LE(r.max_slope[0], slope_from_circle(s) * (1.0 + 2.0 * margin) + 2.0 * margin);
    EXPECT_GE(what.from, from);
    EXPECT_LE(what.to, to);
    EXPECT_NEAR(what.from, from, 2.0 * margin);
    EXPECT_NEAR(what.to, to, 2.0 * margin);
    EXPECT_GE(from, 0.0);
    EXPECT_LT(to, 3.0);
  }
  EXPECT_GT(told, 1000);
}

TEST(EdgeReach, OfAnEdgeThatCrossesTheBoxItCannotTell) {
  Scene s;
  s.bounds.box = {.x = 10.0F, .y = 20.0F, .half_x = 3.0F, .half_y = 1.0F, .low_z = 1.5F};
  const auto steepest = [&s](const Point3f& a, const Point3f& b) {
    s.edge = {a, b};
    return reach(s).max_slope[0];
  };
  EXPECT_EQ(steepest({6.0F, 20.5F, 9.0F}, {14.0F, 20.5F, 9.0F}), EdgeReach::unbounded);
  EXPECT_EQ(steepest({10.0F, 20.0F, 9.0F}, {50.0F, 20.0F, 9.0F}), EdgeReach::unbounded);
  EXPECT_EQ(steepest({6.0F, 21.0F, 9.0F}, {14.0F, 21.0F, 9.0F}), EdgeReach::unbounded);
  // Past the short sides, and beside the long ones, by two metres
  constexpr double slope = 7.5 / 2.0, off = 2.0 * margin * (slope + 1.0);
  EXPECT_NEAR(steepest({15.0F, 0.0F, 9.0F}, {15.0F, 40.0F, 9.0F}), slope, off);
  EXPECT_NEAR(steepest({0.0F, 23.0F, 9.0F}, {40.0F, 23.0F, 9.0F}), slope, off);
}

TEST(EdgeReach, WhatLiesBehindAllIsSeenByNobody) {
  Scene s;
  s.bounds = {.box = {.half_x = 1.0F, .half_y = 1.0F}, .normal_x = 1.0F};
  s.edge = {{-2.0F, -5.0F, 9.0F}, {-2.0F, 5.0F, 9.0F}};
  EXPECT_LT(reach(s).max_slope[0], 0.0F);
  s.edge.b.x = -0.5F;
  EXPECT_GT(reach(s).max_slope[0], 0.0F);
}

TEST(EdgeReach, LanesWithoutAnEdgeAreSeenByNobodyAboveTheirHeight) {
  const Scene s{{.box = {.x = 50.0F, .half_x = 1.0F, .half_y = 1.0F}}, {{1.0F, 2.0F, 3.0F}, {3.0F, 2.0F, 3.0F}}};
  EXPECT_LT(reach(s).max_slope[1], 0.0F);
}

constexpr std::size_t sectors = SectorMinHorizon::sectors;

struct alignas(64) Row : std::array<float, lane_count> {};

/// Random slopes, many of them level.
std::vector<Row> random_rows(std::size_t count, RandomPlaces& random) {
  std::vector<Row> rows(count);
  for (Row& row : rows)
    for (float& slope : row) slope = std::max(0.0F, random.between(-0.3, 5.0));
  return rows;
}

SectorMinHorizon minima_of(const std::vector<Row>& rows, const AzimuthSampling& ring,
                           SectorAzimuths taken = SectorAzimuths::inside) {
  SectorMinHorizon min_horizon;
  const float* const slopes = rows.front().data();
  find_sector_minima({&slopes, 1}, ring.view(), taken, min_horizon);
  return min_horizon;
}

/// The lowest slope at the azimuths of the sectors from first to last, counted on over the end of the turn.
float expected_minimum(const std::vector<Row>& rows, const AzimuthSampling& ring, std::size_t first, std::size_t last) {
  float lowest = std::numeric_limits<float>::max();
  for (std::size_t s = first; s <= last; ++s)
    for (std::size_t k = ring.first_of_sector()[s % sectors]; k < ring.first_of_sector()[s % sectors + 1]; ++k)
      lowest = std::min(lowest, *std::min_element(rows[k].begin(), rows[k].end()));
  return lowest;
}

TEST(SectorMinHorizon, TakesTheAzimuthsBesideASectorToo) {
  RandomPlaces random;
  for (const std::size_t azimuths : {8U, 96U, 256U}) {
    const AzimuthSampling ring = AzimuthSampling::even(azimuths, {});
    const std::vector<Row> rows = random_rows(azimuths, random);
    const SectorMinHorizon minima = minima_of(rows, ring, SectorAzimuths::and_beside);
    for (std::size_t s = 0; s < sectors; ++s) {
      const std::size_t begin = ring.first_of_sector()[s], end = ring.first_of_sector()[s + 1];
      float lowest = expected_minimum(rows, ring, s, s);
      for (const std::size_t k : {(begin + azimuths - 1) % azimuths, end % azimuths})
        lowest = std::min(lowest, *std::min_element(rows[k].begin(), rows[k].end()));
      EXPECT_EQ(minima.minima[s], lowest) << s << " of " << azimuths;
    }
  }
}

std::set<std::size_t> edges_above(const EdgeReach& reach, const SectorMinHorizon& min_horizon) {
  const std::uint32_t bits = raising_edges(reach, min_horizon);
  std::set<std::size_t> edges;
  for (std::size_t l = 0; l < lane_count; ++l)
    if (((bits >> l) & 1U) != 0) edges.insert(l);
  return edges;
}

TEST(SectorMinHorizon, FindWhatRisesOverSomebodysHorizonInAnySectorThatItTouches) {
  RandomPlaces random;
  std::size_t found = 0;
  for (const std::size_t azimuths : {8U, 96U, 256U}) {
    const AzimuthSampling ring = AzimuthSampling::even(azimuths, GridRotation(Angle::degrees(20.0)));
    const std::vector<Row> rows = random_rows(azimuths, random);
    const SectorMinHorizon min_horizon = minima_of(rows, ring);
    for (int n = 0; n < 300; ++n) {
      ReachOfLanes reach;
      std::set<std::size_t> expected;
      for (std::size_t l = 0; l < lane_count; ++l) {
        const float from = random.between(0.0, 1.9), to = from + random.between(0.0, 1.0) * random.between(0.0, 0.99);
        reach.from[l] = from;
        reach.to[l] = to;
        reach.max_slope[l] = random.between(-0.5, 0.5);
        const auto sector_at = [](float turns) { return static_cast<std::size_t>(turns * static_cast<float>(sectors)); };
        if (reach.max_slope[l] > expected_minimum(rows, ring, sector_at(from), sector_at(to))) expected.insert(l);
      }
      const EdgeReach vectors{load(reach.max_slope.data()), load(reach.from.data()), load(reach.to.data())};
      EXPECT_EQ(edges_above(vectors, min_horizon), expected);
      found += expected.size();
    }
  }
  EXPECT_GT(found, 1000U);
}

TEST(SectorMinHorizon, WhatIsTooNearToTellRisesAnywhere) {
  const AzimuthSampling ring = AzimuthSampling::even(1, {});
  const SectorMinHorizon min_horizon = minima_of(std::vector<Row>(1), ring);
  EdgeReach reach{broadcast(EdgeReach::unbounded), broadcast(0.1F), broadcast(2.9F)};
  EXPECT_EQ(edges_above(reach, min_horizon).size(), lane_count);
  reach.max_slope = broadcast(-1.0F);
  EXPECT_TRUE(edges_above(reach, min_horizon).empty());
}

TEST(BitsOf, SayWhichLanesAreSet) {
  std::array<float, lane_count> lanes{};
  EXPECT_EQ(bits_of(load(lanes.data()) > 0.0F), 0U);
  for (std::size_t l = 0; l < lane_count; ++l) {
    lanes[l] = 1.0F;
    EXPECT_EQ(bits_of(load(lanes.data()) > 0.0F), (2U << l) - 1);
  }
}

TEST(MinLanes, AreThoseOfEachVector) {
  RandomPlaces random;
  std::array<float, lane_count> expected;
  Floats vectors[lane_count];
  for (std::size_t n = 0; n < lane_count; ++n) {
    std::array<float, lane_count> lanes;
    for (float& x : lanes) x = random.between(-5.0, 5.0);
    vectors[n] = load(lanes.data());
    expected[n] = *std::min_element(lanes.begin(), lanes.end());
  }
  EXPECT_EQ(to_array(min_lanes(vectors)), expected);
}

/// Azimuths of the city frame in turns, ascending.
std::vector<double> city_turns(const AzimuthSampling& ring, const GridRotation& rotation) {
  std::vector<double> turns;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point2d u = rotation.city_from_grid(Point2d{ring.cosine()[k], ring.sine()[k]});
    const double t = std::atan2(u.y, u.x) / (2.0 * std::numbers::pi);
    turns.push_back(t < 0.0 ? t + 1.0 : t);
  }
  std::sort(turns.begin(), turns.end());
  return turns;
}

TEST(AzimuthSampling, EvenRingsDoNotTurnWithTheGrid) {
  for (const std::size_t count : {1U, 7U, 64U, 256U})
    for (const double bearing_deg : {0.0, 17.0, 45.0, -123.4, 90.0}) {
      const GridRotation rotation(Angle::degrees(bearing_deg));
      const std::vector<double> turns = city_turns(AzimuthSampling::even(count, rotation), rotation);
      ASSERT_EQ(turns.size(), count);
      for (std::size_t k = 0; k < count; ++k)
        EXPECT_NEAR(turns[k], (static_cast<double>(k) + 0.5) / static_cast<double>(count), 2.0 * float_rounding) << bearing_deg;
    }
}

/// In turns, from 0 to less than 1.
double azimuth(const AzimuthSampling& ring, std::size_t k) {
  const double turns = std::atan2(double{ring.sine()[k]}, double{ring.cosine()[k]}) / (2.0 * std::numbers::pi);
  return turns < 0.0 ? turns + 1.0 : turns;
}

void expect_consistent(const AzimuthSampling& ring) {
  for (std::size_t k = 0; k < ring.size(); ++k) {
    EXPECT_NEAR(std::hypot(ring.cosine()[k], ring.sine()[k]), 1.0, 4.0 * float_rounding);
    if (k == 0) continue;
    EXPECT_GE(azimuth(ring, k), azimuth(ring, k - 1) - azimuth_rounding_rad) << k;
  }
}

TEST(AzimuthSampling, AscendsOnceAround) {
  for (const std::size_t count : {1U, 3U, 100U, 256U})
    expect_consistent(AzimuthSampling::even(count, GridRotation(Angle::degrees(3.0))));
  for (const std::size_t count : {1U, 10U, 1000U})
    expect_consistent(AzimuthSampling(SkyPartition(SkyWeight::cosine, count).directions()));
}

TEST(AzimuthSampling, OfDirectionsSaysWhichIsWhere) {
  std::vector<Point3d> directions = SkyPartition(SkyWeight::solid_angle, 500).directions();
  directions.push_back({1.0, 0.0, 0.0});
  directions.push_back({std::cos(1e-12), -std::sin(1e-12), 0.0});  // rounds to a whole turn
  const AzimuthSampling ring = AzimuthSampling(directions);
  ASSERT_EQ(ring.size(), directions.size());
  std::vector<std::uint32_t> places(ring.order().begin(), ring.order().end());
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point3d& d = directions[places[k]];
    const double across = std::hypot(d.x, d.y);
    EXPECT_NEAR(ring.cosine()[k], d.x / across, float_rounding);
    EXPECT_NEAR(ring.sine()[k], d.y / across, float_rounding);
  }
  std::sort(places.begin(), places.end());
  for (std::uint32_t n = 0; n < places.size(); ++n) EXPECT_EQ(places[n], n);
}

/// From one azimuth counter-clockwise to another, in turns.
double turned(double from, double to) { return to - from - std::floor(to - from); }

TEST(AzimuthSampling, DirectionsLieBetweenTheAzimuthsAroundThem) {
  const AzimuthSampling ring = AzimuthSampling::even(320, GridRotation(Angle::degrees(17.0)));
  for (int n = 0; n < 1000; ++n) {
    const double turn = (n + 0.3) / 1000.0, angle = 2.0 * std::numbers::pi * turn;
    const auto [before, after] = ring.around({5.0 * std::cos(angle), 5.0 * std::sin(angle)});
    EXPECT_EQ(after, (before + 1) % ring.size());
    const double apart = turned(azimuth(ring, before), azimuth(ring, after));
    EXPECT_LE(turned(azimuth(ring, before), turn), apart) << turn;
  }
  for (std::uint32_t k = 0; k < ring.size(); ++k) {
    const auto [before, after] = ring.around({ring.cosine()[k], ring.sine()[k]});
    EXPECT_TRUE(before == k || after == k) << k;
  }
}

TEST(AzimuthSampling, StraightUpGetsAnAzimuthToo) {
  const std::vector<Point3d> up{{0.0, 0.0, 1.0}};
  const AzimuthSampling ring = AzimuthSampling(up);
  ASSERT_EQ(ring.size(), 1U);
  expect_consistent(ring);
}

}  // namespace
}  // namespace farlod

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/plane_polygons.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <utility>

#include "base/frame.hpp"
#include "generator/city_layout.hpp"
#include "generator/keyed_random.hpp"

namespace farlod {
namespace {

/// Coordinates are below 10 m and areas are sums of a dozen products: far fewer roundings than this allows.
constexpr double area_error_m2 = 1e-9;

const PlanePolygon square{{0, 0}, {4, 0}, {4, 4}, {0, 4}};

double total_area(const std::vector<PlanePolygon>& pieces) {
  double sum = 0.0;
  for (const PlanePolygon& piece : pieces) sum += area(piece);
  return sum;
}

TEST(PlanePolygons, HalfPlanesKeepTheirSide) {
  const PlanePolygon left = clipped(square, {{1, 0}, -1.0});
  EXPECT_NEAR(area(left), 4.0, area_error_m2);
  for (const Point2d p : left) EXPECT_LE(p.x, 1.0);
  EXPECT_EQ(clipped(square, {{1, 0}, -9.0}), square);
  EXPECT_TRUE(clipped(square, {{1, 0}, 1.0}).empty());
}

TEST(PlanePolygons, WithoutLeavesTheRest) {
  const PlanePolygon gable{{1, 0}, {3, 0}, {3, 2}, {2, 3}, {1, 2}};
  const std::vector<PlanePolygon> rest = without(square, gable);
  EXPECT_NEAR(total_area(rest), 16.0 - area(gable), area_error_m2);
  for (const PlanePolygon& piece : rest) {
    EXPECT_TRUE(is_convex(piece));
    // No piece reaches into what was cut away
    PlanePolygon common = piece;
    for (std::size_t k = 0; k < gable.size(); ++k) {
      const Point2d a = gable[k], b = gable[(k + 1) % gable.size()];
      const Point2d right{b.y - a.y, a.x - b.x};
      common = clipped(common, {right, -dot(right, a)});
    }
    EXPECT_NEAR(area(common), 0.0, area_error_m2);
  }
}

TEST(PlanePolygons, WithoutKnowsNothingAndAll) {
  EXPECT_EQ(without(square, {{5, 0}, {6, 0}, {6, 1}, {5, 1}}), std::vector<PlanePolygon>{square});
  EXPECT_EQ(without(square, {{4, 0}, {6, 0}, {6, 1}, {4, 1}}), std::vector<PlanePolygon>{square}) << "touches from outside";
  EXPECT_TRUE(without(square, {{-1, -1}, {5, -1}, {5, 5}, {-1, 5}}).empty());
  EXPECT_TRUE(without(square, square).empty());
}

/// A ring as the corners of a triangulation, and the triangulation checked for what it promises.
class Triangulated {
 public:
  void add(const std::vector<GridPoint>& ring) {
    std::vector<std::uint32_t>& numbers = rings_.emplace_back();
    for (const GridPoint& p : ring) {
      numbers.push_back(static_cast<std::uint32_t>(points_.size()));
      points_.push_back(p);
    }
  }

  void check() const {
    std::int64_t expected = 0, found = 0;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (const auto& ring : rings_)
      for (std::size_t k = 0; k < ring.size(); ++k) {
        expected += twice_area(ring[k], ring[(k + 1) % ring.size()]);
        --uses[{ring[k], ring[(k + 1) % ring.size()]}];
      }
    for (const GridTriangle& t : triangles(points_, rings_)) {
      std::int64_t own = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        own += twice_area(t[k], t[(k + 1) % 3]);
        ++uses[{t[k], t[(k + 1) % 3]}];
      }
      EXPECT_GT(own, 0) << "a triangle runs clockwise or has no area";
      found += own;
    }
    EXPECT_EQ(found, expected);
    // An edge of the polygon is an edge of one triangle, any other edge is passed in both directions
    for (const auto& [edge, count] : uses)
      if (count != 0) {
        EXPECT_EQ(count, 1);
        EXPECT_EQ((uses[{edge.second, edge.first}]), 1) << edge.first << ' ' << edge.second;
      }
  }

 private:
  [[nodiscard]] std::int64_t twice_area(std::uint32_t a, std::uint32_t b) const {
    return points_[a][0] * points_[b][1] - points_[a][1] * points_[b][0];
  }

  std::vector<GridPoint> points_;
  std::vector<std::vector<std::uint32_t>> rings_;
};

TEST(PlanePolygons, TrianglesOfSimpleRings) {
  Triangulated gable, arcade, notched;
  gable.add({{0, 0}, {8, 0}, {8, 5}, {4, 9}, {0, 5}});
  gable.check();
  arcade.add({{3, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 4}, {3, 4}});
  arcade.check();
  notched.add({{0, 0}, {4, 0}, {8, 0}, {8, 8}, {4, 8}, {4, 4}, {2, 4}, {2, 8}, {0, 8}});
  notched.check();
}

TEST(PlanePolygons, TrianglesOfWallsWithWindows) {
  KeyedRandom random({11});
  for (int round = 0; round < 40; ++round) {
    const int columns = random.whole(1, 9), rows = random.whole(1, 9);
    // Corners are a little off, as those of a turned wall are after rounding
    const auto off = [&random](std::int64_t x) { return x + random.whole(-1, 1); };
    Triangulated wall;
    const std::int64_t wide = 3000 * columns, high = 3000 * rows;
    wall.add(round % 2 == 0 ? std::vector<GridPoint>{{0, 0}, {wide, 0}, {wide, high}, {0, high}}
                            : std::vector<GridPoint>{{0, 0}, {wide, 0}, {wide, high}, {wide / 2, high + 4000}, {0, high}});
    for (std::int64_t i = 0; i < columns; ++i)
      for (std::int64_t j = 0; j < rows; ++j) {
        const std::int64_t west = off(3000 * i + 900), east = off(3000 * i + 2100), low = 3000 * j + 900, top = 3000 * j + 2300;
        wall.add({{west, low}, {west, top}, {east, top}, {east, low}});
      }
    wall.check();
  }
}

/// Sine and cosine here and in the mathematics library are each good to a few units in the last place of 1; a coordinate is
/// the sum of two products with them, and the angle itself is rounded when it is made of degrees (at most 2π here).
constexpr double rotation_error(double length_m) { return 16.0 * std::numeric_limits<double>::epsilon() * length_m; }

TEST(PlanRotation, TurnsAsTheGridOfThePackageDoes) {
  const Point2d p{300.0, -120.0};
  for (double bearing_deg = -360.0; bearing_deg <= 360.0; bearing_deg += 7.25) {
    const Point2d here = PlanRotation(bearing_deg).city_from_plan(p);
    const Point2d there = GridRotation(Angle::degrees(bearing_deg)).city_from_grid(p);
    EXPECT_LE(norm(here - there), rotation_error(norm(p))) << bearing_deg;
  }
}

TEST(PlanRotation, HasItsInverse) {
  const Point2d p{123.45, 678.9};
  for (double bearing_deg = -90.0; bearing_deg <= 90.0; bearing_deg += 3.3) {
    const PlanRotation rotation(bearing_deg);
    EXPECT_LE(norm(rotation.plan_from_city(rotation.city_from_plan(p)) - p), rotation_error(norm(p)));
  }
}

TEST(PlanRotation, QuartersAreExact) {
  const Point2d p{12.34, 56.78};
  EXPECT_EQ(PlanRotation(0.0).city_from_plan(p), p);
  EXPECT_EQ(PlanRotation(90.0).city_from_plan(p), (Point2d{56.78, -12.34}));
  EXPECT_EQ(PlanRotation(180.0).city_from_plan(p), (Point2d{-12.34, -56.78}));
  EXPECT_EQ(PlanRotation(-90.0).city_from_plan(p), PlanRotation(270.0).city_from_plan(p));
}

TEST(LotFrame, RunsCounterClockwiseAroundTheBlock) {
  for (int side = 0; side < 4; ++side) {
    const LotFrame lot{{10.0, 20.0}, side};
    const Point2d corner = lot.plan_from_lot({0, 0});
    const Point2d u = lot.plan_from_lot({1, 0}) - corner, v = lot.plan_from_lot({0, 1}) - corner;
    EXPECT_EQ(corner, lot.corner);
    EXPECT_EQ(u.x * v.y - u.y * v.x, 1.0) << side;
    const Point2d outwards[] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
    EXPECT_EQ(-1.0 * v, outwards[side]) << side;
  }
}

TEST(Millimetres, RoundToTheNearest) {
  EXPECT_EQ(millimetres(1.2344), 1234);
  EXPECT_EQ(millimetres(-1.2346), -1235);
  EXPECT_EQ(on_plan_grid_m(1.236), 1.24);
}

}  // namespace
}  // namespace farlod

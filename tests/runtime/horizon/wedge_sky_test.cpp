// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/wedge_sky.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "tests/runtime/horizon/random_places.hpp"
#include "tests/runtime/horizon/wedge_scenes.hpp"

namespace farlod {
namespace {

constexpr Point3d skyward{0.0, 0.0, 1.0};
constexpr std::size_t numbers_of_wedges[] = {5, 7, 64, 320};

double sky_of_wedge(std::span<const Triangle3d> triangles, const Wedge& wedge, const Point3d& normal, SkyWeight weight) {
  WedgeSky sky;
  sky.begin(wedge, normal, weight);
  for (const Triangle3d& triangle : triangles) sky.add(triangle);
  return sky.sky().sky;
}

/// The share of all of the turn.
double sky_of_turn(std::span<const Triangle3d> triangles, std::size_t wedges, const Point3d& normal = skyward,
                   SkyWeight weight = SkyWeight::cosine) {
  double sum = 0.0;
  for (const Wedge& wedge : wedges_of_turn(wedges)) sum += sky_of_wedge(triangles, wedge, normal, weight);
  return sum / turn_rad;
}

/// Each arc is a sum of a few angles of at most π, each by some ten roundings of as much. A wedge of few triangles has fewer than
/// 64 arcs; what is cut off around the zenith adds 1e-14 of all of the sky.
double turn_rounding(std::size_t wedges) {
  return static_cast<double>(wedges) * 64.0 * 10.0 * 0.5 * std::numeric_limits<double>::epsilon() + 1e-14;
}

void expect_sky(std::span<const Triangle3d> triangles, double expected, const Point3d& normal = skyward,
                SkyWeight weight = SkyWeight::cosine) {
  for (const std::size_t wedges : numbers_of_wedges)
    EXPECT_NEAR(sky_of_turn(triangles, wedges, normal, weight), expected, turn_rounding(wedges)) << wedges << " wedges";
}

std::vector<Triangle3d> level_rectangle(double x0, double y0, double x1, double y1, double z) {
  return quadrilateral({x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z});
}
/// In the plane x = d.
std::vector<Triangle3d> wall(double d, double y0, double y1, double z0, double z1) {
  return quadrilateral({d, y0, z0}, {d, y1, z0}, {d, y1, z1}, {d, y0, z1});
}

TEST(WedgeSky, TheOpenFieldIsAllSeenThatIsInFrontOfTheReceiver) {
  for (const double tilt : {0.0, 0.3, 1.0, 0.5 * std::numbers::pi, 2.0, 3.0}) {
    const Point3d normal{std::sin(tilt) * 0.6, std::sin(tilt) * 0.8, std::cos(tilt)};
    expect_sky({}, 0.5 * (1.0 + std::cos(tilt)), normal);
    // The lune between the level and the receiver's own plane
    expect_sky({}, 1.0 - tilt / std::numbers::pi, normal, SkyWeight::solid_angle);
  }
}

TEST(WedgeSky, AnEndlessWallLeavesWhatItsElevationLeaves) {
  // A place of so long a wall is rounded by so much, some ten times, at the distance of 4 m; its ends are 4e-6 from level
  constexpr double half_length = 1e6, rounding_rad = 10.0 * half_length * std::numeric_limits<double>::epsilon() / 4.0;
  for (const double height : {0.5, 3.0, 40.0})
    for (const std::size_t wedges : numbers_of_wedges)
      EXPECT_NEAR(sky_of_turn(wall(4.0, -half_length, half_length, 0.0, height), wedges),
                  0.5 * (1.0 + std::cos(std::atan(height / 4.0))), rounding_rad + turn_rounding(wedges));
}

TEST(WedgeSky, AWallOfPrismsIsAWall) {
  // Front, back, top and party walls of houses in a row
  std::vector<Triangle3d> row;
  for (int n = -8; n < 8; ++n) {
    const double y = 5.0 * n;
    for (const auto& part :
         {wall(4.0, y, y + 5.0, -1.0, 9.0), wall(14.0, y, y + 5.0, -1.0, 9.0), level_rectangle(4.0, y, 14.0, y + 5.0, 9.0),
          quadrilateral({4.0, y, -1.0}, {14.0, y, -1.0}, {14.0, y, 9.0}, {4.0, y, 9.0})})
      row.insert(row.end(), part.begin(), part.end());
  }
  expect_sky(row, 1.0 - 2.0 * wall_view_factor(4.0, 40.0, 9.0));
}

TEST(WedgeSky, ALevelRectangleOverhead) {
  for (const double h : {0.01, 1.0, 20.0}) {
    const auto roof = level_rectangle(-2.0, -3.0, 5.0, 7.0, h);
    double factor = 0.0, angle = 0.0;
    for (const double a : {2.0, 5.0})
      for (const double b : {3.0, 7.0}) {
        factor += overhead_view_factor(a, b, h);
        angle += overhead_solid_angle(a, b, h);
      }
    expect_sky(roof, 1.0 - factor);
    expect_sky(roof, 1.0 - angle / turn_rad, skyward, SkyWeight::solid_angle);
  }
}

TEST(WedgeSky, ALevelRectangleAside) {
  const auto soffit = level_rectangle(2.0, 1.0, 9.0, 8.0, 4.0);
  const auto part = [](double a, double b) { return overhead_view_factor(a, b, 4.0); };
  expect_sky(soffit, 1.0 - (part(9.0, 8.0) - part(2.0, 8.0) - part(9.0, 1.0) + part(2.0, 1.0)));
}

TEST(WedgeSky, ABridgeBetweenWalls) {
  // Both walls of a street of 8 m, and a bridge of 10 m between their tops: seen from the middle, before and below it
  for (const double y : {-6.0, 3.0}) {
    const std::array parts{wall(4.0, -50.0, 50.0, 0.0, 12.0), wall(-4.0, -50.0, 50.0, 0.0, 12.0),
                           level_rectangle(-4.0, -y, 4.0, 10.0 - y, 12.0)};
    const auto half = [](double b) { return 2.0 * overhead_view_factor(4.0, std::abs(b), 12.0) * (b < 0.0 ? -1.0 : 1.0); };
    expect_sky(joined(parts), 1.0 - 4.0 * wall_view_factor(4.0, 50.0, 12.0) - (half(10.0 - y) - half(-y)));
  }
}

TEST(WedgeSky, AWindowShowsTheSkyBehindTheWall) {
  const std::array parts{wall(3.0, -10.0, 10.0, 0.0, 1.0), wall(3.0, -10.0, 10.0, 2.5, 6.0), wall(3.0, -10.0, -0.5, 1.0, 2.5),
                         wall(3.0, 1.5, 10.0, 1.0, 2.5)};
  const auto up_to = [](double h) { return wall_view_factor(3.0, 0.5, h) + wall_view_factor(3.0, 1.5, h); };
  expect_sky(joined(parts), 1.0 - 2.0 * wall_view_factor(3.0, 10.0, 6.0) + up_to(2.5) - up_to(1.0));
  // A curtain behind the upper half of it
  std::vector<Triangle3d> curtained = joined(parts);
  for (const Triangle3d& t : wall(6.0, -20.0, 20.0, 3.5, 5.5)) curtained.push_back(t);
  const auto shaded = [](double b) { return wall_view_factor(3.0, b, 2.5) - wall_view_factor(3.0, b, 1.75); };
  expect_sky(curtained, 1.0 - 2.0 * wall_view_factor(3.0, 10.0, 6.0) + up_to(2.5) - up_to(1.0) - shaded(0.5) - shaded(1.5));
}

TEST(WedgeSky, ReceiversThatLookAside) {
  // A square in front of each of them and above the level
  const std::array<Point3d, 4> square{{{6.0, -1.0, 2.0}, {6.0, 1.0, 2.0}, {5.5, 1.0, 3.0}, {5.5, -1.0, 3.0}}};
  const auto triangles = quadrilateral(square[0], square[1], square[2], square[3]);
  for (const double tilt : {0.4, 1.2, 0.5 * std::numbers::pi, 1.8, 1.9}) {
    const Point3d normal{std::sin(tilt), 0.0, std::cos(tilt)};
    const double hidden = std::abs(view_factor(square, normal));
    EXPECT_GT(hidden, 1e-4);
    expect_sky(triangles, 0.5 * (1.0 + std::cos(tilt)) - hidden, normal);
  }
}

TEST(WedgeSky, WhatIsBehindTheReceiverHidesNothing) {
  const auto behind = wall(-3.0, -20.0, 20.0, 0.0, 2.0);
  for (const double tilt : {0.7, 0.5 * std::numbers::pi, 2.5})
    expect_sky(behind, 0.5 * (1.0 + std::cos(tilt)), {std::sin(tilt), 0.0, std::cos(tilt)});
}

TEST(WedgeSky, WhatIsRightOverheadHidesTheZenith) {
  // A corner, an edge, and the border of both triangles straight above
  const auto quarter = level_rectangle(0.0, 0.0, 5.0, 7.0, 3.0);
  expect_sky(quarter, 1.0 - overhead_view_factor(5.0, 7.0, 3.0));
  expect_sky(level_rectangle(-5.0, 0.0, 5.0, 7.0, 3.0), 1.0 - 2.0 * overhead_view_factor(5.0, 7.0, 3.0));
  expect_sky(level_rectangle(-5.0, -7.0, 5.0, 7.0, 3.0), 1.0 - 4.0 * overhead_view_factor(5.0, 7.0, 3.0));
}

TEST(WedgeSky, AWallSeenFromItsEdgeHidesNothing) {
  // Its plane passes the receiver at a few roundings of its places, and what is nearer than a nanometre is left out
  constexpr double width_rad = 4.0 * 5.0 * std::numeric_limits<double>::epsilon() / 1e-9;
  for (const std::size_t wedges : numbers_of_wedges)
    EXPECT_NEAR(sky_of_turn(wall(0.0, -5.0, 5.0, -1.0, 3.0), wedges), 1.0, width_rad);
}

std::vector<Triangle3d> random_triangles(RandomPlaces& random, std::size_t count, double size) {
  std::vector<Triangle3d> triangles;
  const auto place = [&](double reach, double low, double high) {
    const Point3f p = random.place(reach, low, high);
    return Point3d{p.x, p.y, p.z};
  };
  for (std::size_t n = 0; n < count; ++n) {
    const Point3d middle = place(20.0, 0.0, 12.0);
    triangles.push_back(
        {middle + place(size, -size, size), middle + place(size, -size, size), middle + place(size, -size, size)});
  }
  return triangles;
}

TEST(WedgeSky, RandomTrianglesAsByQuadrature) {
  RandomPlaces random;
  for (const std::size_t count : {1U, 10U, 60U})
    for (const double z : {1.0, 0.6, 0.0, -0.4}) {
      const Point3f n = random.direction_at(z);
      const Point3d normal = normalized(Point3d{n.x, n.y, n.z});
      const auto triangles = random_triangles(random, count, 4.0);
      for (const SkyWeight weight : {SkyWeight::cosine, SkyWeight::solid_angle})
        for (const Wedge& wedge : wedges_of_turn(12)) {
          const Quadrature expected = sky_by_quadrature(triangles, wedge, normal, weight, 4000);
          EXPECT_NEAR(sky_of_wedge(triangles, wedge, normal, weight), expected.sky, expected.error)
              << count << " triangles, " << z;
        }
    }
}

TEST(WedgeSky, HowTheTurnIsDividedDoesNotMatter) {
  RandomPlaces random;
  for (const double z : {1.0, 0.3, 0.0, -0.4}) {
    const Point3f n = random.direction_at(z);
    const Point3d normal = normalized(Point3d{n.x, n.y, n.z});
    const auto triangles = random_triangles(random, 200, 3.0);
    const double sky = sky_of_turn(triangles, 5, normal);
    // 200 triangles are in the wedges together, with more arcs
    for (const std::size_t wedges : {16U, 320U})
      EXPECT_NEAR(sky_of_turn(triangles, wedges, normal), sky, 100.0 * turn_rounding(wedges)) << z;
  }
}

TEST(WedgeSky, TheOrderOfTrianglesDoesNotMatter) {
  RandomPlaces random;
  auto triangles = random_triangles(random, 100, 5.0);
  const double sky = sky_of_turn(triangles, 64);
  std::reverse(triangles.begin(), triangles.end());
  EXPECT_NEAR(sky_of_turn(triangles, 64), sky, 100.0 * turn_rounding(64));
}

}  // namespace
}  // namespace farlod

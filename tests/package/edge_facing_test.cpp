// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/horizon_edge.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>

#include "farlod/angle.hpp"
#include "package/layout.hpp"

namespace farlod::package {
namespace {

constexpr double step_rad = 0.5 * std::numbers::pi / 127.0;
constexpr std::int8_t wall = AdjacentSlopes::straight_down;

Box2d around(Point2d middle, double half_m) {
  return {{middle.x - half_m, middle.y - half_m}, {middle.x + half_m, middle.y + half_m}};
}

/// An edge with the facets beside it, asked by one eye or by a box of eyes.
struct Edge {
  Point3d a, b;
  AdjacentSlopes adjacent;
  EdgeRole role = EdgeRole::grounded;

  [[nodiscard]] bool may_be_seen_by(const Box2d& plan, double low_m, double high_m) const {
    return may_be_silhouette(a, b, adjacent, role, plan, low_m, high_m);
  }
  [[nodiscard]] bool may_be_seen_by(const Point3d& eye) const {
    return may_be_seen_by(around(horizontal(eye), 0.0), eye.z, eye.z);
  }
  [[nodiscard]] Edge turned_round() const { return {b, a, {adjacent.right, adjacent.left}, role}; }
};

// A flat roof 5 m high over [0, 10]²: it lies to the left of its south edge, and to the right of its north edge
const Edge south_edge{{0, 0, 5}, {10, 0, 5}, {0, wall}}, north_edge{{0, 10, 5}, {10, 10, 5}, {wall, 0}};
// A ridge 9 m high along the x axis, between roofs that fall by 3 on 5
const std::int8_t fall = AdjacentSlopes::rounded_down(-std::atan2(3.0, 5.0));
const Edge ridge{{0, 0, 9}, {20, 0, 9}, {fall, fall}};

TEST(AdjacentSlopes, AreRoundedDownByLessThanAStep) {
  for (double rise_rad = -0.5 * std::numbers::pi; rise_rad < 0.5 * std::numbers::pi; rise_rad += 0.0137) {
    const double kept_rad = std::atan(AdjacentSlopes::slope(AdjacentSlopes::rounded_down(rise_rad)));
    // Each of the two is the product of three roundings of numbers below 2
    const double rounding_rad = 6 * 2 * std::numeric_limits<double>::epsilon();
    EXPECT_LE(kept_rad, rise_rad + rounding_rad);
    EXPECT_GT(kept_rad, rise_rad - step_rad - rounding_rad);
  }
}

TEST(AdjacentSlopes, OfWhatFallsAreRoundedTowardsTheVertical) {
  EXPECT_EQ(AdjacentSlopes::rounded_down(0.9 * step_rad), 0);
  EXPECT_EQ(AdjacentSlopes::rounded_down(-0.1 * step_rad), -1);
  EXPECT_EQ(AdjacentSlopes::rounded_down(-41.5 * step_rad), -42);
}

TEST(AdjacentSlopes, EndAtTheVertical) {
  EXPECT_EQ(AdjacentSlopes::rounded_down(-std::numeric_limits<double>::infinity()), AdjacentSlopes::straight_down);
  EXPECT_EQ(AdjacentSlopes::rounded_down(-2.0), AdjacentSlopes::straight_down);
  EXPECT_EQ(AdjacentSlopes::rounded_down(2.0), 127);
  // A tower 10 km high, a millimetre away, is not as steep
  EXPECT_LT(AdjacentSlopes::slope(AdjacentSlopes::straight_down), -1e7);
  EXPECT_GT(AdjacentSlopes::slope(127), 1e7);
  EXPECT_EQ(AdjacentSlopes::slope(0), 0.0);
}

TEST(EdgeFacing, TellsTheFrontOfAFlatRoofFromItsBack) {
  const Point3d from_south{5, -20, 1.5}, from_north{5, 40, 1.5};
  EXPECT_TRUE(south_edge.may_be_seen_by(from_south));
  EXPECT_FALSE(north_edge.may_be_seen_by(from_south));
  EXPECT_TRUE(north_edge.may_be_seen_by(from_north));
  EXPECT_FALSE(south_edge.may_be_seen_by(from_north));
}

TEST(EdgeFacing, LeavesNoHorizonToWhoLooksDownOnARoof) {
  for (const Point3d& eye : {Point3d{5, -20, 8}, Point3d{5, 5, 6}, Point3d{5, 40, 8}})
    for (const Edge& edge : {south_edge, north_edge}) EXPECT_FALSE(edge.may_be_seen_by(eye));
}

TEST(EdgeFacing, HidesARidgeBehindItsRoofUntilTheEyeIsAboveTheSlope) {
  for (const double side : {-1.0, 1.0}) {
    EXPECT_FALSE(ridge.may_be_seen_by({10, side * 10, 1.5})) << "the roof's plane is 3 m high here";
    EXPECT_TRUE(ridge.may_be_seen_by({10, side * 10, 4}));
    EXPECT_TRUE(ridge.may_be_seen_by({10, side * 30, 1.5})) << "the plane has met the ground";
  }
}

TEST(EdgeFacing, HidesEavesBeforeARoofThatRisesBehindThem) {
  const std::int8_t rise = AdjacentSlopes::rounded_down(std::atan2(3.0, 5.0));
  const Edge eaves{{0, 0, 6}, {20, 0, 6}, {rise, wall}};  // the roof is to the north
  EXPECT_TRUE(eaves.may_be_seen_by({10, -5, 1.5})) << "the plane of the roof passes overhead";
  EXPECT_FALSE(eaves.may_be_seen_by({10, -5, 4})) << "the roof is seen from above, and rises over its eaves";
  EXPECT_FALSE(eaves.may_be_seen_by({10, -30, 1.5}));
}

TEST(EdgeFacing, FollowsTheSlopeOfTheEdgeItself) {
  // A roof that climbs to the east, 1 on 1: beyond its upper end its plane is high above
  const Edge north_rake{{0, 10, 2}, {10, 10, 12}, {wall, 0}};
  EXPECT_FALSE(north_rake.may_be_seen_by({5, -20, 1.5}));
  EXPECT_TRUE(north_rake.may_be_seen_by({-5, -20, 1.5})) << "the plane is at −3 m here, the eye above it";
}

TEST(EdgeFacing, IsUndecidedForEyesOnBothSides) {
  for (const Edge& edge : {south_edge, north_edge, ridge}) {
    const Point2d middle = 0.5 * (horizontal(edge.a) + horizontal(edge.b));
    EXPECT_TRUE(edge.may_be_seen_by(around(middle, 5.0), 0.0, 3.0));
    EXPECT_TRUE(edge.may_be_seen_by(around(middle, 0.5 * facing_slack_m), 0.0, 3.0));
    EXPECT_TRUE(edge.may_be_seen_by({middle.x + 100, middle.y + 0.9 * facing_slack_m, 1.5})) << "too near to tell the sides";
  }
}

TEST(EdgeFacing, IsUndecidedWhereSomeEyesSeeTheEdge) {
  EXPECT_FALSE(ridge.may_be_seen_by(around({10, -10}, 1.0), 0.0, 2.0));
  EXPECT_TRUE(ridge.may_be_seen_by(around({10, -10}, 1.0), 0.0, 6.0)) << "those high up";
  EXPECT_TRUE(ridge.may_be_seen_by(around({10, -10}, 6.0), 0.0, 2.0)) << "those far away";
}

// A soffit 5 m high over [0, 10]²: of its south edge it lies to the left, of its north edge to the right
constexpr std::int8_t none = AdjacentSlopes::straight_up;
const Edge south_border{{0, 0, 5}, {10, 0, 5}, {0, none}, EdgeRole::underside},
    north_border{{0, 10, 5}, {10, 10, 5}, {none, 0}, EdgeRole::underside};

TEST(EdgeFacing, TellsTheFarBorderOfASoffitFromTheNearOne) {
  const Point3d from_south{5, -20, 1.5}, from_north{5, 40, 1.5}, below{5, 5, 1.5};
  EXPECT_TRUE(north_border.may_be_seen_by(from_south)) << "below it the sky begins";
  EXPECT_FALSE(south_border.may_be_seen_by(from_south)) << "the soffit goes on below the line of sight";
  EXPECT_TRUE(south_border.may_be_seen_by(from_north));
  EXPECT_FALSE(north_border.may_be_seen_by(from_north));
  EXPECT_TRUE(south_border.may_be_seen_by(below) && north_border.may_be_seen_by(below));
}

TEST(EdgeFacing, LeavesNoLowerBorderToWhoLooksDownOnIt) {
  for (const Point3d& eye : {Point3d{5, -20, 8}, Point3d{5, 5, 6}, Point3d{5, 40, 8}})
    for (const Edge& border : {south_border, north_border}) EXPECT_FALSE(border.may_be_seen_by(eye));
}

TEST(EdgeFacing, HidesTheRidgeOfAVaultFromWhoSeesItsSideReachLower) {
  // A vault, open below: both sides fall by 3 on 5 from its ridge
  const std::int8_t falls = AdjacentSlopes::rounded_up(-std::atan2(3.0, 5.0));
  const Edge vault{{0, 0, 9}, {20, 0, 9}, {falls, falls}, EdgeRole::underside};
  for (const double side : {-1.0, 1.0}) {
    EXPECT_FALSE(vault.may_be_seen_by({10, side * 10, 1.5}));
    EXPECT_FALSE(vault.may_be_seen_by({10, side * 1, 1.5})) << "within, the far side goes on below the line of sight";
  }
  // A trough: both sides rise from its bottom, which is lowest for those above the plane of its far side
  const std::int8_t climbs = AdjacentSlopes::rounded_up(std::atan2(3.0, 5.0));
  const Edge trough{{0, 0, 9}, {20, 0, 9}, {climbs, climbs}, EdgeRole::underside};
  EXPECT_TRUE(trough.may_be_seen_by({10, -10, 5}));
  EXPECT_FALSE(trough.may_be_seen_by({10, -10, 1.5})) << "1.5 m lies below the plane of the far side, which is 3 m high here";
}

TEST(AdjacentSlopes, OfLowerBordersAreRoundedUpByLessThanAStep) {
  for (double rise_rad = -0.5 * std::numbers::pi; rise_rad < 0.5 * std::numbers::pi; rise_rad += 0.0137) {
    const double kept_rad = std::atan(AdjacentSlopes::slope(AdjacentSlopes::rounded_up(rise_rad)));
    const double rounding_rad = 6 * 2 * std::numeric_limits<double>::epsilon();
    EXPECT_GE(kept_rad, rise_rad - rounding_rad);
    EXPECT_LT(kept_rad, rise_rad + step_rad + rounding_rad);
  }
  EXPECT_EQ(AdjacentSlopes::rounded_up(std::numeric_limits<double>::infinity()), AdjacentSlopes::straight_up);
  EXPECT_EQ(AdjacentSlopes::rounded_up(-2.0), -127);
}

TEST(EdgeFacing, IsUndecidedWhereNothingIsKnownOfTheFacets) {
  std::mt19937_64 random(3);
  const auto coordinate = [&random] { return static_cast<double>(random() % 1000) / 10.0; };
  for (int n = 0; n < 1000; ++n) {
    const Edge bare{{coordinate(), coordinate(), 101}, {coordinate(), coordinate(), 105}, {}};
    EXPECT_TRUE(bare.may_be_seen_by({coordinate(), coordinate(), coordinate()})) << n;
    const Edge bare_border{bare.a, bare.b, {none, none}, EdgeRole::underside};
    EXPECT_TRUE(bare_border.may_be_seen_by({coordinate(), coordinate(), coordinate()})) << n;
  }
  const Edge upright{{3, 3, 1}, {3, 3, 9}, {0, 0}};
  EXPECT_TRUE(upright.may_be_seen_by({20, 3, 1.5})) << "it has no sides";
}

TEST(EdgeFacing, DoesNotDependOnTheOrderOfTheEnds) {
  std::mt19937_64 random(4);
  const auto coordinate = [&random] { return static_cast<double>(random() % 1000) / 10.0; };
  const auto rise = [&random] { return static_cast<std::int8_t>(static_cast<int>(random() % 255) - 127); };
  int away = 0;
  for (int n = 0; n < 5000; ++n) {
    const EdgeRole role = n % 2 == 0 ? EdgeRole::grounded : EdgeRole::underside;
    const Edge edge{
        {coordinate(), coordinate(), coordinate()}, {coordinate(), coordinate(), coordinate()}, {rise(), rise()}, role};
    const Point3d eye{coordinate(), coordinate(), coordinate()};
    EXPECT_EQ(edge.may_be_seen_by(eye), edge.turned_round().may_be_seen_by(eye)) << n;
    away += edge.may_be_seen_by(eye) ? 0 : 1;
  }
  EXPECT_GT(away, 500) << "the test tests nothing";
}

/// Components are rounded to float after length 1 has been made.
constexpr double float_rounding_rad = 2.0 * std::numeric_limits<float>::epsilon();

Point3d place(const Point3f& p) { return {p.x, p.y, p.z}; }

double angle_between_rad(const Point3d& a, const Point3d& b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }

double error_rad(const Point3d& direction) {
  return angle_between_rad(direction, place(OctNormal::nearest_to(direction).direction()));
}

/// Evenly over the sphere, and crowded around the folds of the octahedron, where rounding could step across.
template <class Visitor>
void for_many_directions(Visitor&& visit) {
  std::mt19937 bits(1);
  std::uniform_real_distribution<double> along(-1.0, 1.0);
  for (int n = 0; n < 20'000; ++n) {
    const Point3d p{along(bits), along(bits), along(bits)};
    for (const double crowd : {1.0, 1e-4, 1e-9})
      for (const Point3d& q : {Point3d{crowd * p.x, p.y, p.z}, Point3d{p.x, crowd * p.y, p.z}, Point3d{p.x, p.y, crowd * p.z},
                               Point3d{crowd * p.x, crowd * p.y, p.z}})
        visit(normalized(q));
  }
}

TEST(OctNormal, ComesBackWithinItsError) {
  double largest_rad = 0.0;
  for_many_directions([&](const Point3d& d) { largest_rad = std::max(largest_rad, error_rad(d)); });
  EXPECT_LE(largest_rad, OctNormal::largest_error_rad + float_rounding_rad);
  EXPECT_GT(largest_rad, 0.5 * OctNormal::largest_error_rad) << "the bound says nothing";
}

TEST(OctNormal, HasLengthOne) {
  for_many_directions(
      [](const Point3d& d) { EXPECT_NEAR(norm(place(OctNormal::nearest_to(d).direction())), 1.0, float_rounding_rad); });
}

TEST(OctNormal, KeepsTheAxes) {
  for (const double sign : {-1.0, 1.0})
    for (const Point3d& axis : {Point3d{sign, 0, 0}, Point3d{0, sign, 0}, Point3d{0, 0, sign}})
      EXPECT_EQ(place(OctNormal::nearest_to(3.0 * axis).direction()), axis);
}

TEST(OctNormal, KeepsWallsUpright) {
  for (int n = 0; n < 20'000; ++n) {
    const double t = Angle::degrees(n * 360.0 / 20'000).radians();
    EXPECT_EQ(OctNormal::nearest_to({std::cos(t), std::sin(t), 0.0}).direction().z, 0.0F) << n;
  }
}

TEST(OctNormal, LooksToTheSameSideOfTheHorizon) {
  for_many_directions([](const Point3d& d) {
    const OctNormal stored = OctNormal::nearest_to(d);
    EXPECT_GE(stored.direction().z * d.z, 0.0);
    EXPECT_EQ(stored.looks_up(), stored.direction().z > 0.0F);
  });
}

TEST(OctNormal, IsAnyTwoNumbersOf22Bits) {
  constexpr std::uint32_t last = OctNormal::largest, middle = last / 2;
  for (const std::uint32_t u : {0U, 1U, 12'345U, middle - 1, middle, middle + 1, last - 1, last})
    for (const std::uint32_t v : {0U, 1U, 12'345U, middle - 1, middle, middle + 1, last - 1, last})
      EXPECT_NEAR(norm(place(OctNormal{u, v}.direction())), 1.0, float_rounding_rad) << u << ", " << v;
}

TEST(OctNormal, IsUpwardsForNoDirection) { EXPECT_EQ(OctNormal::nearest_to({}).direction(), (Point3f{0, 0, 1})); }

}  // namespace
}  // namespace farlod::package

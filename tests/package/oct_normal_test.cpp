// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/oct_normal.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "farlod/angle.hpp"

namespace farlod::package {
namespace {

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

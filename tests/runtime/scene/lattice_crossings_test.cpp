// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/lattice_crossings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "farlod/angle.hpp"
#include "scene/plan_index.hpp"

namespace farlod {
namespace {

/// Places of floats, as those of a raster are, in a frame that is turned against the lattice.
PlanLattice lattice_of(std::size_t columns, std::size_t rows, Point2d first_m, double step_m, Angle turned) {
  PlanLattice lattice{columns, rows, first_m, {step_m * std::cos(turned.radians()), step_m * std::sin(turned.radians())},
                      0.0,     {},   {}};
  double farthest_m = 0.0;
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      const Point2d p = first_m + static_cast<double>(column) * lattice.column_m + static_cast<double>(row) * lattice.row_m();
      lattice.x.push_back(static_cast<float>(p.x));
      lattice.y.push_back(static_cast<float>(p.y));
      farthest_m = std::max(farthest_m, norm(p));
    }
  lattice.rounding_m = std::numeric_limits<float>::epsilon() * farthest_m;
  return lattice;
}

/// The judge: each place on its own. Returns how many crossings there are.
std::size_t expect_as_one_by_one(const std::vector<PlanTriangle>& triangles, const PlanLattice& lattice) {
  const PlanIndex index(triangles);
  LatticeCrossings crossings;
  crossings.find(triangles, lattice);
  std::size_t count = 0;
  for (std::size_t n = 0; n < lattice.x.size(); ++n) {
    std::vector<PlanCrossing> expected;
    index.find(lattice.x[n], lattice.y[n], expected);
    const auto found = crossings.at(n);
    EXPECT_EQ(std::vector(found.begin(), found.end()), expected) << lattice.x[n] << ", " << lattice.y[n];
    count += expected.size();
  }
  return count;
}

TEST(LatticeCrossings, OfNothingAreNone) {
  LatticeCrossings crossings;
  crossings.find({}, lattice_of(2, 3, {0.0, 0.0}, 1.0, {}));
  for (std::size_t n = 0; n < 6; ++n) EXPECT_TRUE(crossings.at(n).empty());
}

TEST(LatticeCrossings, ASecondSearchForgetsTheFirst) {
  const PlanTriangle t{Point3f{0, 0, 1}, Point3f{10, 0, 1}, Point3f{0, 10, 1}};
  const std::vector triangles{t};
  LatticeCrossings crossings;
  crossings.find(triangles, lattice_of(4, 4, {1.0, 5.0}, 1.0, {}));
  ASSERT_EQ(crossings.at(0).size(), 1U);
  crossings.find(triangles, lattice_of(1, 1, {20.0, 20.0}, 1.0, {}));
  EXPECT_TRUE(crossings.at(0).empty());
}

/// Corners and sides that run through places: whether they are covered hangs on the last bit.
TEST(LatticeCrossings, OnSidesAndCornersAgreeWithSinglePlaces) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> whole(-2, 18);
  std::vector<PlanTriangle> triangles;
  for (int n = 0; n < 400; ++n) {
    PlanTriangle t;
    for (Point3f& p : t) p = {static_cast<float>(whole(random)), static_cast<float>(whole(random)), static_cast<float>(n % 7)};
    triangles.push_back(t);
  }
  for (const double step_m : {0.5, 1.0})
    for (const Point2d first_m : {Point2d{0.0, 16.0}, Point2d{-8.0, 7.5}})
      for (const double bearing_deg : {0.0, 90.0, 45.0})
        EXPECT_GT(expect_as_one_by_one(triangles, lattice_of(33, 33, first_m, step_m, Angle::degrees(bearing_deg))), 100U);
}

class TurnedLattices : public testing::TestWithParam<double> {
 protected:
  Angle turned_ = Angle::degrees(GetParam());
  std::mt19937 random_{17};
  float uniform(float low, float high) { return std::uniform_real_distribution(low, high)(random_); }
  Point3f point() { return {uniform(-20.0F, 70.0F), uniform(-20.0F, 70.0F), uniform(0.0F, 30.0F)}; }
  PlanLattice lattice(double step_m, std::size_t edge) const { return lattice_of(edge, edge + 3, {7.3, 61.1}, step_m, turned_); }
};

TEST_P(TurnedLattices, AgreeWithSinglePlaces) {
  std::vector<PlanTriangle> triangles;
  for (int n = 0; n < 100; ++n) triangles.push_back({point(), point(), point()});
  for (int n = 0; n < 1000; ++n) {
    const Point3f p = point();
    triangles.push_back({p, p + Point3f{uniform(-1.0F, 1.0F), uniform(-1.0F, 1.0F), 0.0F}, p + Point3f{0.0F, 0.7F, 2.0F}});
  }
  for (const double step_m : {0.07, 0.7, 3.0, 31.0})
    EXPECT_GT(expect_as_one_by_one(triangles, lattice(step_m, 40)), 0U) << step_m;
}

/// Slivers along rows, columns and diagonals of the lattice, down to the rounding of their corners: in the doubles of a plan the
/// side that a place lies on may be wrong.
TEST_P(TurnedLattices, AgreeWithSinglePlacesOnSlivers) {
  const PlanLattice places = lattice(1.0, 40);
  std::uniform_int_distribution<std::size_t> any(0, places.x.size() - 1);
  const auto place = [&] {
    const std::size_t n = any(random_);
    return Point3f{places.x[n], places.y[n], uniform(0.0F, 9.0F)};
  };
  std::vector<PlanTriangle> triangles;
  for (const float width_m : {1e-2F, 1e-4F, 1e-5F, 1e-6F, 1e-30F})
    for (int n = 0; n < 200; ++n) {
      const Point3f a = place(), b = place(), m = a + uniform(-0.2F, 1.2F) * (b - a);
      triangles.push_back({a, b, {m.x + uniform(-width_m, width_m), m.y + uniform(-width_m, width_m), 3.0F}});
    }
  EXPECT_GT(expect_as_one_by_one(triangles, places), 1000U);
}

/// Far corners, whose coordinates take the most bits.
TEST_P(TurnedLattices, AgreeWithSinglePlacesBelowLargeTriangles) {
  std::vector<PlanTriangle> triangles;
  for (int n = 0; n < 300; ++n) {
    PlanTriangle t{point(), point(), point()};
    for (Point3f& p : t) p = (n % 3 == 0 ? 1e5F : 300.0F) * (p - Point3f{25.0F, 25.0F, 0.0F});
    triangles.push_back(t);
  }
  EXPECT_GT(expect_as_one_by_one(triangles, lattice(1.0, 40)), 1000U);
}

INSTANTIATE_TEST_SUITE_P(By, TurnedLattices, testing::Values(0.0, 33.0, 45.0, 90.0, -90.0, 180.0, 137.0));

}  // namespace
}  // namespace farlod

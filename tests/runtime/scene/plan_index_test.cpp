// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/plan_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "farlod/angle.hpp"
#include "occlusion/occluder.hpp"
#include "scene/ray_scenes.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"

namespace farlod {
namespace {

using Crossings = std::vector<PlanCrossing>;

Crossings crossings_at(const PlanIndex& index, float x, float y) {
  Crossings found;
  index.find(x, y, found);
  return found;
}

/// Two triangles of a square, split along its diagonal.
std::vector<PlanTriangle> square(float edge_m, float z_m) {
  const Point3f a{0, 0, z_m}, b{edge_m, 0, z_m}, c{edge_m, edge_m, z_m}, d{0, edge_m, z_m};
  return {{a, b, c}, {a, c, d}};
}

TEST(PlanIndex, OfNothingFindsNothing) { EXPECT_TRUE(crossings_at(PlanIndex({}), 1.0F, 2.0F).empty()); }

TEST(PlanIndex, FindsWhatLiesOverAPlace) {
  const PlanIndex index(square(10.0F, 4.0F));
  const Crossings found = crossings_at(index, 7.0F, 2.0F);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].triangle, 0U);
  EXPECT_EQ(found[0].height_m, 4.0F);
  EXPECT_TRUE(crossings_at(index, 10.1F, 2.0F).empty());
  EXPECT_TRUE(crossings_at(index, -0.1F, 2.0F).empty());
}

TEST(PlanIndex, APlaceOnACommonEdgeIsInBothTriangles) {
  EXPECT_EQ(crossings_at(PlanIndex(square(10.0F, 4.0F)), 3.0F, 3.0F).size(), 2U);
  EXPECT_EQ(crossings_at(PlanIndex(square(10.0F, 4.0F)), 0.0F, 0.0F).size(), 2U);
}

TEST(PlanIndex, UprightTrianglesCoverNothing) {
  const PlanIndex index({{Point3f{0, 0, 0}, Point3f{10, 0, 0}, Point3f{10, 0, 5}}});
  EXPECT_TRUE(crossings_at(index, 5.0F, 0.0F).empty());
}

/// (1): whatever the slope of an edge, a place next to it is on one side of it or on the other.
TEST(PlanIndex, NoPlaceFallsBetweenNeighbors) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> coordinate(0.0F, 50.0F), share(0.0F, 1.0F);
  for (int n = 0; n < 2000; ++n) {
    const Point3f a{coordinate(random), coordinate(random), 1.0F}, b{coordinate(random), coordinate(random), 2.0F};
    // Two triangles on the two sides of a–b
    const Point3f aside{0.5F * (b.y - a.y), 0.5F * (a.x - b.x), 0.0F}, middle = 0.5F * (a + b);
    const PlanIndex index({{a, b, middle + aside}, {b, a, middle - aside}});
    const float s = share(random);
    const Point3f p = a + s * (b - a);
    EXPECT_GE(crossings_at(index, p.x, p.y).size(), 1U) << n;
  }
}

/// In the doubles of `side_of`, a place beyond the end of a sliver may lie on all three of its sides.
TEST(PlanIndex, ASliverEndsAtItsCorners) {
  const float x = std::nextafter(100.0F, 200.0F);
  const PlanTriangle sliver{Point3f{0, 0, 0}, Point3f{100, 100, 0}, Point3f{1e-30F, 0, 0}};
  EXPECT_NE(plan_area(sliver), 0.0);
  EXPECT_TRUE(covers(sliver, 50.0F, 50.0F));
  EXPECT_FALSE(covers(sliver, x, x));
  EXPECT_TRUE(crossings_at(PlanIndex({sliver}), x, x).empty());
}

/// All triangles along a ray, from near to far.
std::vector<Hit> all_hits(const Occluder& occluder, const Ray& ray) {
  std::vector<Hit> hits;
  std::set<std::uint32_t> met;
  while (const auto hit = occluder.nearest(ray, [&met](std::uint32_t t) { return !met.contains(t); })) {
    hits.push_back(*hit);
    met.insert(hit->triangle);
  }
  return hits;
}

/// The oracle: upright rays through all triangles.
TEST(PlanIndex, AgreesWithUprightRays) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> coordinate(-20.0F, 70.0F), height(0.0F, 30.0F);
  std::vector<PlanTriangle> triangles;
  std::vector<Point3f> vertices;
  std::vector<Triangle> numbers;
  for (std::uint32_t n = 0; n < 300; ++n) {
    PlanTriangle corners;
    for (Point3f& p : corners) p = {coordinate(random), coordinate(random), height(random)};
    triangles.push_back(corners);
    vertices.insert(vertices.end(), corners.begin(), corners.end());
    numbers.push_back({3 * n, 3 * n + 1, 3 * n + 2});
  }
  const PlanIndex index(triangles);
  const Occluder occluder(vertices, numbers);
  constexpr float below_all_m = -1.0F, tolerance_m = 1e-3F;  // Embree rounds the distance of hits on steep triangles
  for (int n = 0; n < 500; ++n) {
    const float x = coordinate(random), y = coordinate(random);
    Crossings found = crossings_at(index, x, y);
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.height_m < b.height_m; });
    const std::vector<Hit> hits = all_hits(occluder, {{x, y, below_all_m}, {0.0F, 0.0F, 1.0F}});
    ASSERT_EQ(found.size(), hits.size()) << x << ", " << y;
    for (std::size_t k = 0; k < hits.size(); ++k) EXPECT_NEAR(found[k].height_m, below_all_m + hits[k].distance, tolerance_m);
  }
}

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

/// A pillar in the middle of each of 7 × 5 cells, as high as its number.
class Pillars : public testing::Test {
 protected:
  static constexpr double cell_m = 20.0;

  Pillars() : grid_(scenes::grid_covering(city(), {}, cell_m, 3, 4)), package_(packed()) {}

  static CityModel city() {
    scenes::SceneBuilder builder;
    for (int j = 0; j < 5; ++j)
      for (int i = -3; i < 4; ++i) {
        const Point2d middle{(i + 0.5) * cell_m, (j + 0.5) * cell_m};
        builder.add_box({middle - Point2d{2.0, 2.0}, middle + Point2d{2.0, 2.0}}, 0.0, height_of({i, j}));
      }
    return builder.city();
  }
  static double height_of(Cell c) { return 10.0 + 7.0 * c.j + c.i; }

  /// Looks down onto a pillar: how far below 100 m is what is met first?
  static double height_seen(const Occluder& occluder, Point3f p_scene) {
    p_scene.z = 100.0F;
    const auto hit = occluder.nearest({p_scene, {0.0F, 0.0F, -1.0F}});
    return hit ? 100.0 - static_cast<double>(hit->distance) : -1.0;
  }

  PackageReader packed() const {
    scenes::pack_city(city(), grid_, folder_.path() / "pillars.farlod", scenes::box_maps(1, 1));
    return PackageReader(folder_.path() / "pillars.farlod");
  }

  /// Four steps of a float of 100 m: Embree divides by an approximate reciprocal where the processor has no AVX-512.
  static constexpr double rounding_m = 3.1e-5;

  /// Off the diagonals of the roofs, and exact in float.
  static constexpr Point3f on_the_pillar{10.5F, 9.25F, 0.0F};

  scenes::TemporaryFolder folder_;
  Grid grid_;
  PackageReader package_;
};

TEST_F(Pillars, TheWholeCityHoldsEachTileInItsPlace) {
  const WholeCity whole(package_);
  for (std::size_t n = 0; n < static_cast<std::size_t>(grid_.cells.size()); ++n) {
    const Cell cell = grid_.cells.cell_at(n);
    EXPECT_NEAR(height_seen(whole.occluder(), whole.scene_from_cell(on_the_pillar, cell)), height_of(cell), rounding_m)
        << cell.i << ", " << cell.j;
  }
}

TEST_F(Pillars, TheNearSceneHoldsTheNeighborhoodAndNothingElse) {
  for (const Cell cell : {Cell{0, 2}, {-3, 0}, {3, 4}}) {
    const Occluder near = near_scene(package_, cell);
    for (std::size_t n = 0; n < static_cast<std::size_t>(grid_.cells.size()); ++n) {
      const Cell other = grid_.cells.cell_at(n);
      const Point2d shift = grid_.corner_of(other) - grid_.corner_of(cell);
      const Point3f p_cell = on_the_pillar + Point3f{static_cast<float>(shift.x), static_cast<float>(shift.y), 0.0F};
      const bool is_near = std::abs(other.i - cell.i) <= 1 && std::abs(other.j - cell.j) <= 1;
      EXPECT_NEAR(height_seen(near, p_cell), is_near ? height_of(other) : -1.0, rounding_m) << other.i << ", " << other.j;
    }
  }
}

}  // namespace
}  // namespace farlod

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/ground.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "base/paging/page_file.hpp"
#include "base/paging/paged_heap.hpp"
#include "tests/preprocess/city/temporary_files.hpp"
#include "tests/preprocess/tiles/whole_ground.hpp"

namespace farlod::tiles {
namespace {

const Box2d rectangle{{0, 0}, {100, 100}};

double covered_area(const Ground& ground) {
  double sum = 0.0;
  for (const auto& t : test::triangles_of(ground)) {
    const double area = 0.5 * cross(t[1] - t[0], t[2] - t[0]).z;
    EXPECT_GT(area, 0.0);
    sum += area;
  }
  return sum;
}

TEST(Ground, PassesThroughItsPointsAndCoversItsRectangle) {
  const std::vector<Point3d> points{{20, 30, 5}, {70, 60, 8}, {40, 80, 2}};
  const Ground ground(points, rectangle);
  for (const Point3d& p : points) EXPECT_DOUBLE_EQ(ground.height_at(horizontal(p)), p.z);
  // Six triangles of sums and products of a few digits each
  EXPECT_NEAR(covered_area(ground), 1e4, 1e4 * 16 * std::numeric_limits<double>::epsilon());
}

TEST(Ground, TheLowestOfTwoPointsAtOnePlaceCounts) {
  EXPECT_DOUBLE_EQ(Ground({{50, 50, 9}, {50, 50, 4}}, rectangle).height_at({50, 50}), 4.0);
}

TEST(Ground, ItsCornersHaveTheHeightOfTheNearestPoint) {
  const Ground ground({{10, 10, 1}, {90, 90, 7}}, rectangle);
  EXPECT_DOUBLE_EQ(ground.height_at({0, 0}), 1.0);
  EXPECT_DOUBLE_EQ(ground.height_at({100, 100}), 7.0);
}

TEST(Ground, DoesNotDependOnTheOrderOfItsPoints) {
  std::vector<Point3d> points;
  for (int n = 0; n < 60; ++n)
    points.push_back({static_cast<double>(n * 37 % 100), static_cast<double>(n * 53 % 100), static_cast<double>(n % 9)});
  const Ground there(points, rectangle);
  std::reverse(points.begin(), points.end());
  EXPECT_EQ(test::triangles_of(there), test::triangles_of(Ground(points, rectangle)));
}

TEST(Ground, ItsEdgesDoNotDependOnWhereInMemoryItLies) {
  std::vector<Point3d> points;
  for (int n = 0; n < 900; ++n)
    points.push_back(
        {static_cast<double>(n * 37 % 100) + 1e-3 * n, static_cast<double>(n * 53 % 97), static_cast<double>(n % 9)});
  const Ground first(points, rectangle);
  std::vector<Ground> others;  // all alive at once, in memory that small holes break up
  std::vector<std::vector<char>> holes;
  for (std::size_t n = 1; n < 12; ++n) {
    for (std::size_t k = 0; k < 40; ++k) holes.emplace_back(n * 977 * (k % 7 + 1));
    if (n % 3 == 0) holes.clear();
    others.emplace_back(points, rectangle);
    EXPECT_EQ(test::horizon_edges_of(others.back()), test::horizon_edges_of(first));
  }
  EXPECT_GT(test::horizon_edges_of(first).size(), 500U);
}

TEST(Ground, IsTheSameOnDiskAsInMemory) {
  std::vector<Point3d> points;  // of a lattice: four of a square lie on a circle
  for (int n = 0; n < 600 * 400; ++n)
    points.push_back({static_cast<double>(n % 600), static_cast<double>(n / 600), static_cast<double>(n * 7 % 11)});
  const Ground on_disk(points, rectangle);
  const std::size_t bytes_on_disk = PagedHeap::bytes_on_disk();
  EXPECT_GT(bytes_on_disk, std::size_t{10} << 20);
  const farlod::test::TemporaryFiles files("/nowhere/at/all");
  const Ground in_memory(points, rectangle);
  EXPECT_EQ(PagedHeap::bytes_on_disk(), bytes_on_disk);
  PageFile::let_go_of_all();
  EXPECT_EQ(test::triangles_of(on_disk), test::triangles_of(in_memory));
}

TEST(Ground, MayEndWhereItsPointsEnd) {
  const Ground ground({{20, 20, 5}, {60, 20, 5}, {60, 60, 5}, {20, 60, 5}}, rectangle, GroundExtent::points);
  EXPECT_EQ(covered_area(ground), 1600.0);
  EXPECT_EQ(ground.height_at({95, 95}), 5.0);
}

TEST(Ground, WithoutPointsIsFlatAtZero) { EXPECT_EQ(Ground({}, rectangle).height_at({33, 44}), 0.0); }

}  // namespace
}  // namespace farlod::tiles

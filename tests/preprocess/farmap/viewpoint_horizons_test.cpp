// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farmap/viewpoint_horizons.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "tests/preprocess/farmap/sight.hpp"

namespace farlod {
namespace {

using test::Chance;

constexpr double cell_edge_m = 50.0;
const AzimuthBins bins{128};
const BinBorders borders(bins);

ReceiverPatches patches() { return {cell_edge_m, 2, {0.0F, 3.0F, 10.0F, 40.0F}}; }

std::vector<std::pair<Point3d, Point3d>> random_edges(std::size_t count, Chance& chance) {
  std::vector<std::pair<Point3d, Point3d>> edges;
  while (edges.size() < count) {
    const Point3d a{chance.between(-300, 300), chance.between(-300, 300), chance.between(0, 60)};
    const Point3d b = a + Point3d{chance.between(-40, 40), chance.between(-40, 40), chance.between(-5, 5)};
    const bool outside = std::max(std::abs(a.x - 25), std::abs(a.y - 25)) > 80.0;
    if (outside) edges.emplace_back(a, b);
  }
  return edges;
}

/// The steepest of all edges along the middle of a bin; 0 where nothing rises.
double horizon(const std::vector<std::pair<Point3d, Point3d>>& edges, const Point3d& eye, std::uint32_t bin) {
  double steepest = 0.0;
  for (const auto& [a, b] : edges)
    steepest = std::max(steepest, test::slope_at((bin + 0.5) * bins.width_rad(), a, b, eye).value_or(0.0));
  return steepest;
}

/// A slope is computed in double, as a difference of two numbers of which neither is above 1e6 here, and stored as a float.
double slope_rounding(double slope) { return std::numeric_limits<float>::epsilon() * slope + 1e6 * 1e-15; }

TEST(ViewpointHorizons, AreTheSteepestEdgesAlongTheMiddlesOfTheBins) {
  Chance chance(3);
  const auto edges = random_edges(60, chance);
  ViewpointHorizons views(cell_edge_m, patches(), borders);
  for (const auto& [a, b] : edges) views.add(a, b);
  for (std::uint32_t level = 0; level < 4; ++level)
    for (std::uint32_t corner = 0; corner < 9; ++corner) {
      const Point3d eye{corner % 3 * 25.0, corner / 3 * 25.0, patches().levels_m()[level]};
      for (std::uint32_t bin = 0; bin < bins.count; ++bin) {
        const double expected = horizon(edges, eye, bin);
        ASSERT_NEAR(views.slope(corner % 3, corner / 3, level, bin), expected, slope_rounding(expected))
            << "corner " << corner << ", level " << level << ", bin " << bin;
      }
    }
}

TEST(ViewpointHorizons, LowestIsTheLowestOfALevel) {
  Chance chance(4);
  ViewpointHorizons views(cell_edge_m, patches(), borders);
  for (const auto& [a, b] : random_edges(200, chance)) views.add(a, b);
  for (std::uint32_t level = 0; level < 4; ++level) {
    for (std::uint32_t bin = 0; bin < bins.count; ++bin) {
      float expected = std::numeric_limits<float>::infinity();
      for (std::uint32_t corner = 0; corner < 9; ++corner)
        expected = std::min(expected, views.slope(corner % 3, corner / 3, level, bin));
      ASSERT_EQ(views.lowest(bin)[level], expected);
    }
  }
}

TEST(ViewpointHorizons, AnEdgeInLineWithTheEyeCoversNothing) {
  ViewpointHorizons views(cell_edge_m, ReceiverPatches{cell_edge_m, 1, {0.0F}}, borders);
  views.add({100, 0, 10}, {200, 0, 10});
  float along = 0.0F, beside = 0.0F;
  for (std::uint32_t bin = 0; bin < bins.count; ++bin) {
    along = std::max(along, views.slope(0, 0, 0, bin));
    beside = std::max(beside, views.slope(0, 1, 0, bin));
  }
  EXPECT_EQ(along, 0.0F);
  EXPECT_GT(beside, 0.0F);
}

}  // namespace
}  // namespace farlod

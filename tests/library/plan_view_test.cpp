// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farlod/plan_view.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <string>

#include "farlod/points.hpp"
#include "tests/library/packed_sample.hpp"

namespace farlod::library {
namespace {

constexpr Point2d town_corner{500000.0, 5500000.0};

/// An L of three squares of 20 m, 8 m high, across the borders of cells.
class LShapedHouse {
 public:
  LShapedHouse() {
    std::string ring;
    for (const Point2d d : {Point2d{0, 0}, {40, 0}, {40, 20}, {20, 20}, {20, 40}, {0, 40}, {0, 0}}) {
      const Point2d p = town_corner + d;
      ring.append(ring.empty() ? "[" : ",[").append(std::to_string(p.x)).append(",").append(std::to_string(p.y)).append("]");
    }
    std::ofstream(folder_.file("town.geojson"))
        << R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32632"}},"features":[)"
        << R"({"type":"Feature","properties":{"id":"L","height":8},"geometry":{"type":"Polygon","coordinates":[[)" << ring
        << "]]}}]}";
    PackSettings settings;
    settings.inputs = {folder_.file("town.geojson")};
    settings.output = folder_.file("town.farlod");
    settings.cell_edge_m = 7.0;
    settings.align = AlignMode::none;
    Report report;
    (void)pack(settings, report);
  }
  [[nodiscard]] Package open() const { return Package(folder_.file("town.farlod")); }

 private:
  scenes::TemporaryFolder folder_;
};

double length_of(const BuildingOutlines& outlines) {
  double sum = 0.0;
  for (const PlanSegment& s : outlines.segments) sum += norm(s.b - s.a);
  return sum;
}

/// Coordinates relative to a cell are floats.
constexpr double rounding_m = 0.001;

TEST(Outlines, GoRoundABuildingAndNotThroughIt) {
  const LShapedHouse house;
  const Package package = house.open();
  const auto outlines = building_outlines(package, package.description().outline_projected, 1000);
  ASSERT_TRUE(outlines);
  // Neither the grid nor the triangles of the roof leave a line. A side on a border of the grid does not either
  const PackageDescription& d = package.description();
  double lost_m = 0.0;
  const auto on_border = [&](double offset, double origin) {
    return std::abs(std::remainder(offset - origin, d.cell_edge_m)) < 0.01;
  };
  const Point2d low = d.outline_projected.low - town_corner;
  for (const double x : {0.0, 20.0, 40.0}) lost_m += on_border(x, low.x) ? (x == 0.0 ? 40.0 : 20.0) : 0.0;
  for (const double y : {0.0, 20.0, 40.0}) lost_m += on_border(y, low.y) ? (y == 0.0 ? 40.0 : 20.0) : 0.0;
  EXPECT_NEAR(length_of(*outlines), 160.0 - lost_m, 100 * rounding_m);
  for (const PlanSegment& s : outlines->segments)
    for (const Point2d p : {s.a, s.b}) {
      const Point2d q = p - town_corner;
      const auto is_one_of = [](double c, std::initializer_list<double> lines) {
        return std::ranges::any_of(lines, [&](double line) { return std::abs(c - line) < rounding_m; });
      };
      EXPECT_TRUE(is_one_of(q.x, {0.0, 20.0, 40.0}) || is_one_of(q.y, {0.0, 20.0, 40.0})) << q.x << ' ' << q.y;
    }
  if (lost_m == 0.0) {
    EXPECT_NEAR(outlines->typical_edge_m, 4.0 * 1200.0 / 160.0, 0.1);
  }
}

TEST(Outlines, AreNoneWhereThereAreTooMany) {
  const LShapedHouse house;
  const Package package = house.open();
  const Box2d all = package.description().outline_projected;
  const std::size_t count = building_outlines(package, all, 1000)->segments.size();
  EXPECT_TRUE(building_outlines(package, all, count));
  EXPECT_FALSE(building_outlines(package, all, count - 1));
}

TEST(Outlines, OfAPartAreThoseThatMeetIt) {
  const LShapedHouse house;
  const Package package = house.open();
  const Box2d south{town_corner + Point2d{-5.0, -5.0}, town_corner + Point2d{45.0, 3.0}};
  const auto outlines = building_outlines(package, south, 1000);
  ASSERT_TRUE(outlines);
  EXPECT_FALSE(outlines->segments.empty());
  for (const PlanSegment& s : outlines->segments) EXPECT_LE(std::min(s.a.y, s.b.y), south.high.y);
  const Box2d beside{town_corner + Point2d{1000.0, 1000.0}, town_corner + Point2d{1010.0, 1010.0}};
  EXPECT_TRUE(building_outlines(package, beside, 1000)->segments.empty());
}

TEST(Outlines, AreTheSameForAnyNumberOfThreads) {
  const PackedSample sample;
  const Package package(sample.folder());
  RunSettings one, many;
  one.threads = 1;
  many.threads = 4;
  const Box2d all = package.description().outline_projected;
  const auto a = building_outlines(package, all, 1'000'000, one), b = building_outlines(package, all, 1'000'000, many);
  EXPECT_FALSE(a->segments.empty());
  EXPECT_EQ(a->segments, b->segments);
  EXPECT_EQ(a->typical_edge_m, b->typical_edge_m);
}

/// A receiver 2 m above the ground stands 2 m above the heights.
TEST(GroundHeights, AreThoseOnWhichReceiversStand) {
  const PackedSample sample;
  const Package package(sample.folder());
  const RasterPlan plan = plan_raster(package, 5.0);
  const std::vector<float> heights = ground_heights(package, plan);
  ASSERT_EQ(heights.size(), plan.columns * plan.rows);
  std::vector<double> x, y;
  for (std::size_t row = 0; row < plan.rows; ++row)
    for (std::size_t column = 0; column < plan.columns; ++column) {
      x.push_back(plan.centre_m(column, row).x);
      y.push_back(plan.centre_m(column, row).y);
    }
  const PointAnswers answers = evaluate_points(package, {x, y}, {HeightAbove::ground, 2.0});
  std::size_t compared = 0;
  for (std::size_t n = 0; n < heights.size(); ++n) {
    // Points beyond the grid are answered, too
    if (std::isnan(answers.svf[n]) || std::isnan(heights[n])) continue;
    EXPECT_NEAR(answers.height_m[n], static_cast<double>(heights[n]) + 2.0, 0.001) << n;
    ++compared;
  }
  EXPECT_GT(compared, heights.size() / 4);
}

}  // namespace
}  // namespace farlod::library

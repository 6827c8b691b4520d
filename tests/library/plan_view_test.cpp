// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farlod/plan_view.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <initializer_list>
#include <string>
#include <vector>

#include "farlod/error.hpp"
#include "farlod/points.hpp"
#include "farlod/raster.hpp"
#include "tests/library/packed_sample.hpp"
#include "tests/scenes/footprints_text.hpp"

namespace farlod::library {
namespace {

constexpr Point2d town_corner{500000.0, 5500000.0};

/// An L of three squares of 20 m, 8 m high, across the borders of cells.
class LShapedHouse {
 public:
  LShapedHouse() {
    std::vector<Point2d> ring;
    for (const Point2d d : {Point2d{0, 0}, {40, 0}, {40, 20}, {20, 20}, {20, 40}, {0, 40}}) ring.push_back(town_corner + d);
    std::ofstream(folder_.file("town.geojson")) << scenes::FootprintsText().add(scenes::building("L", 8.0), ring).text();
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

/// The highest surface is a roof over the house, 8 m above the ground, and else the ground.
TEST(PlanHeights, AreThoseOfRoofsAndGround) {
  const LShapedHouse house;
  const Package package = house.open();
  const RasterPlan plan{town_corner + Point2d{-2.0, 42.0}, 4.0, 11, 11};
  const PlanHeights heights = plan_heights(package, plan);
  ASSERT_EQ(heights.highest_m.size(), plan.columns * plan.rows);
  const std::vector<float> ground_m = ground_heights(package, plan);
  std::size_t roofs = 0;
  for (std::size_t n = 0; n < heights.highest_m.size(); ++n) {
    if (std::isnan(ground_m[n])) continue;
    EXPECT_EQ(heights.ground_m[n], ground_m[n]);
    const Point2d q = plan.centre_m(n % plan.columns, n / plan.columns) - town_corner;
    const bool is_on_border = std::min({std::abs(q.x), std::abs(q.x - 20.0), std::abs(q.x - 40.0), std::abs(q.y),
                                        std::abs(q.y - 20.0), std::abs(q.y - 40.0)}) < 0.01;
    if (is_on_border) continue;
    const bool is_house = 0.0 < q.x && q.x < 40.0 && 0.0 < q.y && q.y < 40.0 && !(q.x > 20.0 && q.y > 20.0);
    EXPECT_NEAR(heights.highest_m[n] - heights.ground_m[n], is_house ? 8.0F : 0.0F, rounding_m) << q.x << ' ' << q.y;
    roofs += is_house ? 1 : 0;
  }
  EXPECT_EQ(roofs, 3U * 16) << "pixels that are on no border";
}

class Windows : public testing::Test {
 protected:
  Package package_{PackedSample::shared().folder()};
  /// A step that is no sum of powers of two, so that coordinates are rounded.
  RasterPlan plan_ = plan_raster(package_, 1.7);
};

/// Pixels whose bits are not those of the whole raster.
std::size_t differences(const std::vector<float>& window, const RasterWindow& place, const std::vector<float>& whole,
                        std::size_t whole_columns) {
  std::size_t count = 0;
  for (std::size_t row = 0; row < place.rows; ++row)
    for (std::size_t column = 0; column < place.columns; ++column) {
      const float ours = window[row * place.columns + column];
      const float theirs = whole[(place.row + row) * whole_columns + place.column + column];
      count += std::bit_cast<std::uint32_t>(ours) != std::bit_cast<std::uint32_t>(theirs) ? 1 : 0;
    }
  return count;
}

TEST_F(Windows, HaveThePixelsOfTheWholeToTheBit) {
  EvaluationSettings settings;
  settings.bounds = true;
  settings.further.hidden = true;
  const Raster whole = evaluate_raster(package_, plan_, {}, settings);
  std::size_t receivers = 0, no_data = 0, near_buildings = 0;
  double sum_near_buildings = 0.0;
  constexpr std::size_t columns = 23, rows = 31;
  for (std::size_t row = 0; row < plan_.rows; row += rows)
    for (std::size_t column = 0; column < plan_.columns; column += columns) {
      const RasterWindow place{column, row, std::min(columns, plan_.columns - column), std::min(rows, plan_.rows - row)};
      const Raster window = evaluate_window(package_, plan_, place, {}, settings);
      EXPECT_EQ(differences(window.svf, place, whole.svf, plan_.columns), 0U) << column << ", " << row;
      EXPECT_EQ(differences(window.low, place, whole.low, plan_.columns), 0U);
      EXPECT_EQ(differences(window.high, place, whole.high, plan_.columns), 0U);
      for (std::size_t band = 0; band < whole.further.size(); ++band)
        EXPECT_EQ(differences(window.further[band], place, whole.further[band], plan_.columns), 0U);
      receivers += window.summary.receivers;
      no_data += window.summary.no_data;
      near_buildings += window.summary.near_buildings;
      sum_near_buildings +=
          static_cast<double>(window.summary.near_buildings) * window.summary.svf_mean_near_buildings.value_or(0.0);
    }
  EXPECT_EQ(near_buildings, whole.summary.near_buildings);
  EXPECT_NEAR(sum_near_buildings / static_cast<double>(near_buildings), whole.summary.svf_mean_near_buildings.value(), 1e-12);
  EXPECT_EQ(receivers, whole.summary.receivers);
  EXPECT_EQ(no_data, whole.summary.no_data + whole.summary.beyond_grid);
}

TEST_F(Windows, TellTheirOwnPlanAndFigures) {
  const RasterWindow place{10, 20, 30, 5};
  const Raster window = evaluate_window(package_, plan_, place);
  EXPECT_EQ(window.plan.columns, place.columns);
  EXPECT_EQ(window.plan.rows, place.rows);
  EXPECT_NEAR(window.plan.centre_m(0, 0).x, plan_.centre_m(place.column, place.row).x, 1e-9);
  EXPECT_NEAR(window.plan.centre_m(0, 0).y, plan_.centre_m(place.column, place.row).y, 1e-9);
  ASSERT_TRUE(window.summary.svf_max);
  EXPECT_EQ(*window.summary.svf_max,
            static_cast<double>(*std::ranges::max_element(window.svf, [](float a, float b) { return std::isnan(a) || a < b; })));
}

TEST_F(Windows, BeyondTheRasterAreRefused) {
  const std::size_t columns = plan_.columns, rows = plan_.rows, most = static_cast<std::size_t>(-1);
  for (const RasterWindow& wrong :
       {RasterWindow{0, 0, 0, 1}, RasterWindow{0, 0, 1, 0}, RasterWindow{columns, 0, 1, 1}, RasterWindow{0, rows, 1, 1},
        RasterWindow{1, 0, columns, 1}, RasterWindow{0, 1, 1, rows}, RasterWindow{1, 1, most, 1}, RasterWindow{1, 1, 1, most}})
    EXPECT_THROW((void)evaluate_window(package_, plan_, wrong), InvalidArgument);
}

}  // namespace
}  // namespace farlod::library

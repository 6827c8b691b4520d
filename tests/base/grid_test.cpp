// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "base/grid.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "base/frame.hpp"
#include "base/grid_outline.hpp"

namespace farlod {
namespace {

constexpr double wished_edges_m[] = {50.0, 33.3, 0.1, 1000.0 / 7.0, 100.0, 0.3};
/// Among them the largest index for which borders are exact.
constexpr std::int32_t borders[] = {-(1 << 29), -123456789, -1001, -3, -1, 0, 1, 2, 7, 1000, 99999, 123456789, (1 << 29) - 1};

Grid grid_of(double wish_m) {
  Grid grid;
  grid.cell_edge_m = exact_cell_edge_m(wish_m);
  return grid;
}

TEST(Grid, BordersAreExact) {
  static_assert(std::numeric_limits<long double>::digits >= 24 + 29, "the product must be exact in the oracle's type");
  for (const double wish_m : wished_edges_m) {
    const Grid grid = grid_of(wish_m);
    EXPECT_NEAR(grid.cell_edge_m, wish_m, wish_m * std::numeric_limits<float>::epsilon() / 2);
    for (const std::int32_t k : borders)
      EXPECT_EQ(static_cast<long double>(grid.border_m(k)),
                static_cast<long double>(k) * static_cast<long double>(grid.cell_edge_m));
  }
}

TEST(Grid, NeighboringBordersAreOneEdgeApart) {
  for (const double wish_m : wished_edges_m) {
    const Grid grid = grid_of(wish_m);
    for (const std::int32_t k : borders) EXPECT_EQ(grid.border_m(k + 1) - grid.border_m(k), grid.cell_edge_m);
  }
}

TEST(Grid, APointOnABorderBelongsToTheCellToItsEastOrNorth) {
  for (const double wish_m : wished_edges_m) {
    const Grid grid = grid_of(wish_m);
    for (const std::int32_t k : borders) {
      const double on = grid.border_m(k), before = std::nextafter(on, -1e300);
      EXPECT_EQ(grid.cell_of({on, before}), (Cell{k, k - 1})) << wish_m;
      EXPECT_EQ(grid.cell_of({before, on}), (Cell{k - 1, k})) << wish_m;
    }
  }
}

TEST(Grid, ACellHoldsItsCentreAndItsSouthWestCorner) {
  const Grid grid = grid_of(33.3);
  for (const Cell c : {Cell{0, 0}, {-1, -1}, {-7, 12}, {1000, -1000}}) {
    EXPECT_EQ(grid.cell_of(grid.centre_of(c)), c);
    EXPECT_EQ(grid.cell_of(grid.corner_of(c)), c);
    EXPECT_EQ(grid.square_of(c).high, grid.corner_of({c.i + 1, c.j + 1}));
  }
}

TEST(Grid, TheNeighborhoodIsCentred) {
  Grid grid = grid_of(50.0);
  for (const int n : {1, 3, 5, 9}) {
    grid.neighborhood = n;
    const CellRange near = grid.neighborhood_of({-4, 11});
    EXPECT_EQ(near.width(), n);
    EXPECT_EQ(near.height(), n);
    EXPECT_EQ(near.cell_at(static_cast<std::size_t>(near.size()) / 2), (Cell{-4, 11}));
    EXPECT_EQ(grid.neighborhood_half_edge_m(), grid.centre_of({-4, 0}).x - grid.border_m(near.i_begin));
  }
}

TEST(CellRange, IndexAndCellAreInverse) {
  const CellRange range{-3, 5, 4, 9};
  for (std::size_t n = 0; n < static_cast<std::size_t>(range.size()); ++n) {
    EXPECT_TRUE(range.contains(range.cell_at(n)));
    EXPECT_EQ(range.index_of(range.cell_at(n)), n);
  }
  EXPECT_EQ(range.cell_at(0), (Cell{-3, 5}));
  EXPECT_EQ(range.cell_at(1), (Cell{-2, 5}));
}

TEST(CellRange, RangesThatDoNotMeetHaveNoCells) {
  const CellRange left{-3, 0, 0, 4}, right{0, 0, 3, 4}, above{-3, 7, 3, 9};
  EXPECT_EQ(left.intersection(right).size(), 0);
  EXPECT_EQ(left.intersection(above).size(), 0);
  EXPECT_EQ(left.intersection({-1, 1, 5, 2}), (CellRange{-1, 1, 0, 2}));
}

class Blocks : public testing::TestWithParam<int> {};

TEST_P(Blocks, HoldEachCellOnce) {
  Grid grid;
  grid.block_edge = GetParam();
  for (const CellRange cells : {CellRange{0, 0, 1, 1}, {-9, -5, 7, 3}, {-8, -8, 8, 8}, {3, 30, 70, 33}, {-70, 0, -31, 2}}) {
    grid.cells = cells;
    std::map<Cell, int> times;
    for (const Block block : grid.blocks()) {
      const CellRange inside = grid.cells_of(block);
      EXPECT_GT(inside.size(), 0) << "a block without a cell";
      for (std::size_t n = 0; n < static_cast<std::size_t>(inside.size()); ++n) {
        ++times[inside.cell_at(n)];
        EXPECT_EQ(grid.block_of(inside.cell_at(n)), block);
      }
    }
    EXPECT_EQ(times.size(), static_cast<std::size_t>(cells.size()));
    for (const auto& [cell, count] : times) EXPECT_TRUE(count == 1 && cells.contains(cell)) << cell.i << ", " << cell.j;
  }
}

TEST_P(Blocks, ComeRowByRowFromTheSouthWest) {
  Grid grid;
  grid.block_edge = GetParam();
  grid.cells = {-40, -40, 40, 40};
  const std::vector<Block> blocks = grid.blocks();
  for (std::size_t n = 1; n < blocks.size(); ++n)
    EXPECT_LT(std::pair(blocks[n - 1].j, blocks[n - 1].i), std::pair(blocks[n].j, blocks[n].i));
}

INSTANTIATE_TEST_SUITE_P(OfEdge, Blocks, testing::Values(1, 3, 4, 32));

TEST(Grid, AnEmptyGridHasNoBlocks) {
  Grid grid;
  EXPECT_TRUE(grid.blocks().empty());
}

TEST(Grid, ItsOutlineInTheCityIsTheBoxAroundIt) {
  Grid grid = grid_of(10.0);
  grid.cells = {-1, 0, 3, 2};
  EXPECT_EQ(outline_city(grid), grid.rectangle());
  grid.rotation = GridRotation(Angle::degrees(30.0));
  const Box2d outline = outline_city(grid);
  // Of a rectangle of a × b that is turned by 30°: a cos 30° + b sin 30° by a sin 30° + b cos 30°
  constexpr double rounding_m = 1e-12, cosine = 0.8660254037844386, sine = 0.5;
  EXPECT_NEAR(outline.high.x - outline.low.x, 40.0 * cosine + 20.0 * sine, rounding_m);
  EXPECT_NEAR(outline.high.y - outline.low.y, 40.0 * sine + 20.0 * cosine, rounding_m);
}

constexpr double bearings_deg[] = {0.0, 20.0, 45.0, 61.3, 89.9, 90.0, -20.0, 180.0, 271.0};
/// A turn is two products and a sum, of numbers below `size`; there and back doubles it, and cos² + sin² is 1 up to as much
/// again.
constexpr double turn_error(double size) { return 8 * size * std::numeric_limits<double>::epsilon(); }

TEST(GridRotation, TheGridsYAxisHasTheBearing) {
  for (const double bearing_deg : bearings_deg) {
    const GridRotation rotation(Angle::degrees(bearing_deg));
    const Angle y_axis = azimuth_of(rotation.city_from_grid(Point2d{0.0, 1.0}));
    EXPECT_NEAR(std::remainder(y_axis.degrees() - bearing_deg, 360.0), 0.0, turn_error(360.0)) << bearing_deg;
    EXPECT_EQ(rotation.bearing(), Angle::degrees(bearing_deg));
  }
}

TEST(GridRotation, IsRightHanded) {
  for (const double bearing_deg : bearings_deg) {
    const GridRotation rotation(Angle::degrees(bearing_deg));
    const Point2d x = rotation.city_from_grid(Point2d{1.0, 0.0}), y = rotation.city_from_grid(Point2d{0.0, 1.0});
    EXPECT_NEAR(x.x * y.y - x.y * y.x, 1.0, turn_error(1.0));
  }
}

TEST(GridRotation, ThereAndBackIsWhereOneWas) {
  for (const double bearing_deg : bearings_deg) {
    const GridRotation rotation(Angle::degrees(bearing_deg));
    const Point3d p_city{12345.678, -9876.543, 12.25};
    const Point3d back = rotation.city_from_grid(rotation.grid_from_city(p_city));
    EXPECT_NEAR(back.x, p_city.x, turn_error(norm(horizontal(p_city))));
    EXPECT_NEAR(back.y, p_city.y, turn_error(norm(horizontal(p_city))));
    EXPECT_EQ(back.z, p_city.z);
    EXPECT_EQ(horizontal(back), rotation.city_from_grid(rotation.grid_from_city(horizontal(p_city))));
  }
}

TEST(GridRotation, NoneChangesNothing) {
  const Point2d p{1.25, -7.5};
  EXPECT_EQ(GridRotation().grid_from_city(p), p);
  EXPECT_EQ(GridRotation(Angle::degrees(0)).city_from_grid(p), p);
}

TEST(Azimuth, RunsClockwiseFromNorth) {
  const struct {
    Point2d v;
    double degrees;
  } compass[] = {{{0, 1}, 0}, {{1, 1}, 45}, {{1, 0}, 90}, {{0, -1}, 180}, {{-1, 0}, 270}, {{-1, 1}, 315}};
  for (const auto& [v, degrees] : compass) EXPECT_NEAR(azimuth_of(v).degrees(), degrees, turn_error(360.0));
}

TEST(Azimuth, AHairWestOfNorthIsStillLessThanAWholeTurn) {
  for (const double hair : {1e-3, 1e-15, 1e-17, 1e-300})
    EXPECT_LT(azimuth_of({-hair, 1.0}).radians(), 2.0 * std::numbers::pi) << hair;
}

TEST(Angle, DegreesAndRadiansAreTheSameAngle) {
  EXPECT_NEAR(Angle::degrees(180.0).radians(), std::numbers::pi, std::numeric_limits<double>::epsilon() * 4);
  EXPECT_NEAR(Angle::radians(Angle::degrees(29.3).radians()).degrees(), 29.3, turn_error(29.3));
  EXPECT_LT(Angle::degrees(57.2), Angle::radians(1.0));
  EXPECT_NEAR(tan(2.0 * Angle::degrees(20) + Angle::degrees(5)), 1.0, turn_error(1.0));
}

}  // namespace
}  // namespace farlod

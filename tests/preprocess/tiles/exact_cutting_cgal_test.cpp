// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/exact_cutting_cgal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <random>

#include "tests/preprocess/tiles/twice_area_vector.hpp"
#include "tiles/cutting.hpp"

namespace farlod::tiles {
namespace {

using TriangleOfPoints = std::array<Point3d, 3>;

Grid grid_of(double cell_edge_m) {
  Grid grid;
  grid.cell_edge_m = exact_cell_edge_m(cell_edge_m);
  return grid;
}

/// Random triangles: any, with corners on borders, in border planes, and tiny beside large.
std::vector<TriangleOfPoints> random_triangles(const Grid& grid, int count) {
  std::mt19937_64 random(7);
  const auto uniform = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  std::vector<TriangleOfPoints> triangles;
  for (int n = 0; n < count; ++n) {
    const double reach = n % 3 == 0 ? 5.0 : 300.0;
    const Point3d middle{uniform(-500, 500), uniform(-500, 500), uniform(0, 80)};
    TriangleOfPoints t;
    for (Point3d& p : t) {
      p = middle + Point3d{uniform(-reach, reach), uniform(-reach, reach), uniform(-20, 20)};
      if (random() % 4 == 0) p.x = grid.border_m(grid.interval_of(p.x));
      if (random() % 4 == 0) p.y = grid.border_m(grid.interval_of(p.y));
    }
    if (n % 7 == 0) t[1].x = t[2].x = t[0].x = grid.border_m(grid.interval_of(t[0].x));
    triangles.push_back(t);
  }
  return triangles;
}

ExactPoint twice_area_vector_of(const TriangleOfPoints& t) {
  std::vector<ExactCorner> polygon;
  for (const Point3d& p : t) polygon.push_back({{Rational(p.x), Rational(p.y), Rational(p.z)}, -1});
  return twice_area_vector(polygon);
}

class CutExactly : public testing::TestWithParam<double> {};

TEST_P(CutExactly, PiecesStayInTheirCell) {
  const Grid grid = grid_of(GetParam());
  for (const TriangleOfPoints& t : random_triangles(grid, 300))
    for (const ExactPiece& piece : cut_exactly(t, grid)) {
      const Box2d square = grid.square_of(piece.cell);
      for (const ExactCorner& c : piece.polygon) {
        EXPECT_TRUE(Rational(square.low.x) <= c.p_grid.x && c.p_grid.x <= Rational(square.high.x));
        EXPECT_TRUE(Rational(square.low.y) <= c.p_grid.y && c.p_grid.y <= Rational(square.high.y));
      }
    }
}

TEST_P(CutExactly, AreaVectorsAddUpToTheTrianglesOwn) {
  const Grid grid = grid_of(GetParam());
  std::size_t pieces_in_all = 0;
  for (const TriangleOfPoints& t : random_triangles(grid, 300)) {
    ExactPoint sum{Rational(0), Rational(0), Rational(0)};
    for (const ExactPiece& piece : cut_exactly(t, grid)) {
      sum = sum + twice_area_vector(piece.polygon);
      ++pieces_in_all;
    }
    EXPECT_TRUE(sum == twice_area_vector_of(t));
  }
  EXPECT_GT(pieces_in_all, 300U);
}

bool have_the_same_corners(const ExactPiece& a, const ExactPiece& b) {
  return std::equal(a.polygon.begin(), a.polygon.end(), b.polygon.begin(), b.polygon.end(),
                    [](const ExactCorner& p, const ExactCorner& q) { return p.p_grid == q.p_grid && p.original == q.original; });
}

/// Corner for corner, so that they are rounded alike.
TEST_P(CutExactly, PiecesOfWantedCellsAreThoseOfTheWholeTriangle) {
  const Grid grid = grid_of(GetParam());
  const CellRange wanted{-2, -3, 3, 2};
  std::size_t pieces_in_all = 0;
  for (const TriangleOfPoints& t : random_triangles(grid, 300)) {
    std::vector<ExactPiece> expected = cut_exactly(t, grid);
    std::erase_if(expected, [&](const ExactPiece& piece) { return !wanted.contains(piece.cell); });
    const std::vector<ExactPiece> found = cut_exactly(t, grid, wanted);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t n = 0; n < found.size(); ++n) {
      EXPECT_EQ(found[n].cell, expected[n].cell);
      EXPECT_TRUE(have_the_same_corners(found[n], expected[n]));
    }
    pieces_in_all += found.size();
  }
  EXPECT_GT(pieces_in_all, 100U);
}

TEST_P(CutExactly, EachPieceHasOneOwner) {
  const Grid grid = grid_of(GetParam());
  for (const TriangleOfPoints& t : random_triangles(grid, 300)) {
    std::map<Cell, int> owners;
    for (const ExactPiece& piece : cut_exactly(t, grid)) EXPECT_EQ(++owners[piece.cell], 1);
  }
}

TEST_P(CutExactly, APieceOnABorderBelongsToTheCellEastOrNorth) {
  const Grid grid = grid_of(GetParam());
  const double x = grid.border_m(3), y = grid.border_m(-2), c = grid.cell_edge_m;
  const auto east = cut_exactly({{{x, 0.2 * c, 0}, {x, 0.7 * c, 0}, {x, 0.4 * c, 9}}}, grid);
  ASSERT_EQ(east.size(), 1U);
  EXPECT_EQ(east[0].cell, (Cell{3, 0}));
  const auto north = cut_exactly({{{0.1 * c, y, 0}, {0.6 * c, y, 0}, {0.3 * c, y, 9}}}, grid);
  ASSERT_EQ(north.size(), 1U);
  EXPECT_EQ(north[0].cell, (Cell{0, -2}));
}

TEST_P(CutExactly, NeighborsAreCutAtTheSamePointsOfTheirCommonEdge) {
  const Grid grid = grid_of(GetParam());
  for (const TriangleOfPoints& t : random_triangles(grid, 100)) {
    const auto points_on_edge = [&grid](const Point3d& a, const Point3d& b, const Point3d& other) {
      const ExactPoint u{Rational(b.x) - Rational(a.x), Rational(b.y) - Rational(a.y), Rational(b.z) - Rational(a.z)};
      std::map<std::tuple<Rational, Rational, Rational>, int> points;
      for (const ExactPiece& piece : cut_exactly({a, b, other}, grid))
        for (const ExactCorner& c : piece.polygon) {
          const ExactPoint v = c.p_grid - ExactPoint{Rational(a.x), Rational(a.y), Rational(a.z)};
          if (cross(u, v) == ExactPoint{Rational(0), Rational(0), Rational(0)}) points[{c.p_grid.x, c.p_grid.y, c.p_grid.z}] = 1;
        }
      return points;
    };
    // The neighbor runs along the edge the other way, and lies on its other side
    const Point3d beyond = t[0] + t[1] - t[2];
    EXPECT_TRUE(points_on_edge(t[0], t[1], t[2]) == points_on_edge(t[1], t[0], beyond));
  }
}

// 33.3 is no float: the grid must take the nearest one, whose multiples are exact
INSTANTIATE_TEST_SUITE_P(Cells, CutExactly, testing::Values(50.0, 33.3, 17.9));

/// The pieces of exact cutting, rounded.
std::vector<CellPiece> rounded_pieces(const TriangleOfPoints& t, const Grid& grid, double height_origin_m) {
  std::vector<CellPiece> pieces;
  for (const ExactPiece& exact : cut_exactly(t, grid)) {
    CellPiece& piece = pieces.emplace_back(CellPiece{exact.cell, {}});
    const Point2d corner = grid.corner_of(exact.cell);
    const auto round = [](const Rational& x, double origin) { return static_cast<float>(CGAL::to_double(x - Rational(origin))); };
    for (const ExactCorner& c : exact.polygon)
      piece.polygon.push_back(
          c.original >= 0
              ? cell_from_grid(t[static_cast<std::size_t>(c.original)], exact.cell, grid, height_origin_m)
              : Point3f{round(c.p_grid.x, corner.x), round(c.p_grid.y, corner.y), round(c.p_grid.z, height_origin_m)});
  }
  return pieces;
}

/// Triangles of which bounds cannot tell all: through corners of cells, upright, flat at the origin of heights, or slivers.
std::vector<TriangleOfPoints> awkward_triangles(const Grid& grid) {
  const double c = grid.cell_edge_m;
  std::vector<TriangleOfPoints> triangles;
  for (int n = 1; n < 300; ++n) {
    const double x = 0.125 * (n % 5 + 1), y = 0.375 * (n % 7 + 1), before = 7 * n % 53 + 1, after = 11 * n % 97 + 2;
    triangles.push_back({{{-before * x, -before * y, 1}, {after * x, after * y, 3}, {-5, 40, 5}}});
  }
  const std::vector<TriangleOfPoints> more{{{{-c, -c, 1}, {2 * c, 2 * c, 3}, {c, -2 * c, 5}}},
                                           {{{0.1 * c, 0.1 * c, 0}, {2.9 * c, 2.9 * c, 0}, {0.3 * c, 2 * c, 0}}},
                                           {{{0.3, 0.1, 0}, {2.7 * c, 1.3 * c, 0}, {2.7 * c, 1.3 * c, 12}}},
                                           {{{0.3, 0.1, -1}, {2.7 * c, 1.3 * c, 1}, {0.2 * c, 2.2 * c, 0}}},
                                           {{{-0.5 * c, 0.1, 7}, {1.5 * c, 0.1 + 1e-13, 7}, {0.5 * c, 0.1 - 1e-13, 9}}},
                                           {{{c - 1e-12, 0.2, 7}, {c + 1e-12, 0.3, 8}, {c, 1.4 * c, 1e6}}}};
  triangles.insert(triangles.end(), more.begin(), more.end());
  return triangles;
}

TEST(Cut, RoundsAsExactCuttingDoes) {
  for (const double edge_m : {50.0, 33.3}) {
    const Grid grid = grid_of(edge_m);
    std::vector<TriangleOfPoints> triangles = random_triangles(grid, 1'000);
    for (const TriangleOfPoints& t : awkward_triangles(grid)) triangles.push_back(t);
    for (const TriangleOfPoints& t : triangles) {
      const std::vector<CellPiece> found = cut(t, grid, 0.0), expected = rounded_pieces(t, grid, 0.0);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t n = 0; n < found.size(); ++n) {
        EXPECT_EQ(found[n].cell, expected[n].cell);
        ASSERT_EQ(found[n].polygon.size(), expected[n].polygon.size());
        // Bit for bit: 0 is not −0
        EXPECT_EQ(
            std::memcmp(found[n].polygon.begin(), expected[n].polygon.begin(), expected[n].polygon.size() * sizeof(Point3f)), 0);
      }
    }
  }
}

TEST(Cut, RoundsBothSidesOfABorderAlike) {
  const Grid grid = grid_of(33.3);
  std::map<std::tuple<std::int32_t, float, float>, std::array<bool, 2>>
      on_border;  // border x = k·edge: y of the grid row, z → west, east
  for (const TriangleOfPoints& t : random_triangles(grid, 400)) {
    on_border.clear();
    const bool edge_on_border = t[0].x == t[1].x || t[1].x == t[2].x || t[2].x == t[0].x;
    for (const CellPiece& piece : cut(t, grid, 0.0))
      for (const Point3f& p : piece.polygon) {
        const auto edge = static_cast<float>(grid.cell_edge_m);
        EXPECT_TRUE(0.0F <= p.x && p.x <= edge && 0.0F <= p.y && p.y <= edge);
        if (p.y == 0.0F || p.y == edge) continue;  // where four cells meet, a triangle may touch one of them in that point only
        if (p.x == 0.0F) on_border[{piece.cell.i * 1000 + piece.cell.j, p.y, p.z}][1] = true;
        if (p.x == edge) on_border[{(piece.cell.i + 1) * 1000 + piece.cell.j, p.y, p.z}][0] = true;
      }
    if (edge_on_border) continue;  // it touches the border from one side along a whole edge
    // A corner of the triangle on a border touches one side only; every other point of a border is in both cells
    std::size_t one_sided = 0;
    for (const auto& [place, sides] : on_border) one_sided += sides[0] != sides[1] ? 1 : 0;
    EXPECT_LE(one_sided, 3U);
  }
}

/// A number, and what it stands for.
struct Pair {
  BoundedNumber bounded;
  Rational exact;
};

bool is_within_bounds(const Pair& p) {
  return !std::isfinite(p.bounded.error()) || abs(p.exact - Rational(p.bounded.value())) <= Rational(p.bounded.error());
}

/// Of either sign and of any size, many of them with few digits.
double random_double(std::mt19937_64& random) {
  const auto digits = static_cast<double>(random() % 4 == 0 ? random() % 8 : random() >> 11);
  return std::ldexp(random() % 2 == 0 ? digits : -digits, static_cast<int>(random() % 80) - 60);
}

Pair combined(std::uint64_t operation, const Pair& a, const Pair& b) {
  if (operation == 0) return {a.bounded + b.bounded, a.exact + b.exact};
  if (operation == 1) return {a.bounded - b.bounded, a.exact - b.exact};
  if (operation == 2 || b.exact == 0) return {a.bounded * b.bounded, a.exact * b.exact};
  return {a.bounded / b.bounded, a.exact / b.exact};
}

TEST(BoundedNumber, IsNoFartherFromTheExactOneThanItsError) {
  std::mt19937_64 random(3);
  std::size_t finite = 0;
  for (int turn = 0; turn < 2'000; ++turn) {
    std::vector<Pair> pairs;
    for (int n = 0; n < 4; ++n) {
      const double x = random_double(random);
      pairs.push_back({x, Rational(x)});
    }
    for (int n = 0; n < 8; ++n) {
      const Pair p = combined(random() % 4, pairs[random() % pairs.size()], pairs[random() % pairs.size()]);
      ASSERT_TRUE(is_within_bounds(p)) << p.bounded.value() << " ± " << p.bounded.error() << " for " << p.exact;
      finite += std::isfinite(p.bounded.error()) ? 1 : 0;
      if (std::isfinite(p.bounded.error())) {
        EXPECT_LE(Rational(p.bounded.low()), p.exact);
        EXPECT_GE(Rational(p.bounded.high()), p.exact);
      }
      pairs.push_back(p);
    }
  }
  EXPECT_GT(finite, 10'000U);
}

TEST(BoundedNumber, StaysExactWhereNothingIsRounded) {
  const BoundedNumber a = 0.1, b = 1e-17;
  EXPECT_TRUE((a + a).is_exact());
  EXPECT_TRUE((a - 0.1).is_exact());
  EXPECT_FALSE((a + b).is_exact());
  // A coordinate that does not change along an edge
  const BoundedNumber share = (BoundedNumber(50.0) - 0.3) / (BoundedNumber(71.1) - 0.3),
                      same = a + share * (BoundedNumber(0.1) - a);
  EXPECT_FALSE(share.is_exact());
  EXPECT_TRUE(same.is_exact());
  EXPECT_EQ(same.value(), 0.1);
}

TEST(BoundedNumber, SaysThatItKnowsNothing) {
  const BoundedNumber nearly_zero = BoundedNumber(0.1) * 10.0 - 1.0;
  EXPECT_FALSE(std::isfinite((BoundedNumber(1.0) / nearly_zero).error()));
  EXPECT_FALSE(std::isfinite((BoundedNumber(1e-200) * 1e-200).error())) << "underflow";
}

}  // namespace
}  // namespace farlod::tiles

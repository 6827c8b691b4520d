// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farlod/problem.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <regex>
#include <set>

#include "package/crowns_of_city.hpp"

namespace farlod {
namespace {

TEST(ProblemCodes, AscendAndAreUnique) {
  for (std::size_t n = 1; n < problem_descriptions.size(); ++n)
    EXPECT_LT(problem_descriptions[n - 1].code, problem_descriptions[n].code) << problem_descriptions[n].slug;
}

TEST(ProblemCodes, AreDescribedByThemselves) {
  for (const ProblemDescription& d : problem_descriptions) EXPECT_EQ(describe(d.code).slug, d.slug);
}

TEST(ProblemCodes, BelongToAStage) {
  for (const ProblemDescription& d : problem_descriptions) {
    const int stage = static_cast<int>(d.code) / 100;
    EXPECT_TRUE(1 <= stage && stage <= 4) << d.slug;
  }
}

TEST(ProblemCodes, HaveNamesForFilesAndSentencesForPeople) {
  std::set<std::string_view> slugs;
  for (const ProblemDescription& d : problem_descriptions) {
    EXPECT_TRUE(std::regex_match(std::string(d.slug), std::regex("[a-z]+(_[a-z]+)*"))) << d.slug;
    EXPECT_TRUE(slugs.insert(d.slug).second) << d.slug << " names two problems";
    EXPECT_FALSE(d.summary.empty());
  }
}

TEST(ProblemCodes, ANumberThatIsNoCodeIsRefused) { EXPECT_THROW((void)describe(static_cast<ProblemCode>(999)), InvalidArgument); }

TEST(Report, KeepsProblemsInTheOrderInWhichTheyWereMet) {
  Report report;
  report.add({ProblemCode::zero_area, "town.gml", "house 1", ""});
  report.add({ProblemCode::repeated_id, "town.gml", "house 1", ""});
  report.add({ProblemCode::zero_area, "town.gml", "house 2", ""});
  EXPECT_EQ(report.count(ProblemCode::zero_area), 2U);
  EXPECT_EQ(report.count(ProblemCode::not_planar), 0U);
  EXPECT_EQ(report.problems()[1].code, ProblemCode::repeated_id);
  EXPECT_EQ(report.problems()[2].place, "house 2");
}

Grid grid_of(CellRange cells) {
  Grid grid;
  grid.cell_edge_m = 50.0;
  grid.cells = cells;
  return grid;
}

constexpr CellRange four_cells{-1, -1, 1, 1};
constexpr double right_angle_rad = std::numbers::pi / 2.0;

/// Where a crown was put, in the grid frame.
struct Planted {
  Point2d axis_grid;
  double bottom_m, top_m, half_width_m;
};

std::vector<Planted> random_crowns(std::size_t count) {
  std::mt19937 random(7);
  // Steps of a quarter, so that many crowns share coordinates
  const auto any = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(4 * (high - low))) / 4.0;
  };
  std::vector<Planted> crowns;
  for (std::size_t n = 0; n < count; ++n) {
    const double bottom_m = any(100, 104);
    crowns.push_back({{any(-2, 2), any(-2, 2)}, bottom_m, bottom_m + any(1, 4), any(1, 3)});
  }
  return crowns;
}

CrownsOfCity city_of(const std::vector<Planted>& crowns) {
  CrownsOfCity city(grid_of(four_cells), 100.0);
  for (const Planted& p : crowns)
    city.add(p.axis_grid, p.bottom_m, p.top_m, p.half_width_m, CrownShape::spheroid, Foliage::unknown);
  return city;
}

Crown only_crown(CrownsOfCity city) {
  EXPECT_EQ(city.size(), 1U);
  return city.in_order()[0].crown;
}

std::uint16_t turn_of(double turn_rad, CrownShape shape = CrownShape::prism) {
  CrownsOfCity city(grid_of(four_cells), 0.0);
  city.add({1.0, 1.0}, 2.0, 5.0, 1.0, shape, Foliage::unknown, turn_rad);
  return only_crown(std::move(city)).turn;
}

TEST(CrownsOfCity, ACrownIsKeptInTheFrameOfItsCell) {
  CrownsOfCity city(grid_of(four_cells), 100.0);
  city.add({-12.5, 3.0}, 102.0, 110.5, 2.5, CrownShape::cylinder, Foliage::evergreen);
  ASSERT_EQ(city.size(), 1U);
  const auto& [cell, crown] = city.in_order()[0];
  EXPECT_EQ(four_cells.cell_at(cell), (Cell{-1, 0}));
  EXPECT_EQ(crown, (Crown{37.5F, 3.0F, 2.0F, 10.5F, 2.5F, CrownShape::cylinder, Foliage::evergreen, 0}));
}

TEST(CrownsOfCity, TheOrderIsThatOfTheCrownsAndNotOfTheirComing) {
  std::vector<Planted> crowns = random_crowns(2000);
  CrownsOfCity once = city_of(crowns);
  std::shuffle(crowns.begin(), crowns.end(), std::mt19937(3));
  CrownsOfCity again = city_of(crowns);
  ASSERT_EQ(once.size(), 2000U);
  ASSERT_EQ(again.size(), 2000U);
  std::uint64_t cell = 0;
  for (std::size_t n = 0; n < once.size(); ++n) {
    const auto &a = once.in_order()[n], &b = again.in_order()[n];
    EXPECT_EQ(a.cell, b.cell);
    EXPECT_EQ(std::memcmp(&a.crown, &b.crown, sizeof(Crown)), 0) << n;
    EXPECT_GE(a.cell, cell);
    cell = a.cell;
  }
}

TEST(CrownsOfCity, CrownsOutsideOfTheGridAreCounted) {
  CrownsOfCity city(grid_of(four_cells), 0.0);
  // A border belongs to the cell to its east or north
  const std::vector<Point2d> outside{{50.0, 0.0}, {0.0, 50.0}, {-50.001, 0.0}, {0.0, -50.001}, {1e300, 0.0}, {0.0, -1e300}};
  for (const Point2d p : outside) city.add(p, 0.0, 1.0, 1.0, CrownShape::spheroid, Foliage::unknown);
  EXPECT_TRUE(city.empty());
  EXPECT_EQ(city.outside(), outside.size());
  for (const Point2d p : {Point2d{-50.0, -50.0}, {49.999, 49.999}})
    city.add(p, 0.0, 1.0, 1.0, CrownShape::spheroid, Foliage::unknown);
  EXPECT_EQ(city.size(), 2U);
  EXPECT_EQ(city.outside(), outside.size());
}

TEST(CrownsOfCity, ImpossibleSizesAreCountedWithThem) {
  CrownsOfCity city(grid_of(four_cells), 0.0);
  city.add({1.0, 1.0}, -2e7, 1.0, 1.0, CrownShape::spheroid, Foliage::unknown);
  city.add({1.0, 1.0}, 0.0, 2e7, 1.0, CrownShape::spheroid, Foliage::unknown);
  city.add({1.0, 1.0}, 0.0, 1.0, 1e300, CrownShape::spheroid, Foliage::unknown);
  EXPECT_EQ(city.outside(), 3U);
}

TEST(CrownsOfCity, AThinCrownStaysAbove) {
  CrownsOfCity city(grid_of(four_cells), 0.0);
  city.add({1.0, 1.0}, 1000.0, 1000.0 + 1e-9, 1e-300, CrownShape::spheroid, Foliage::unknown);
  const Crown crown = only_crown(std::move(city));
  EXPECT_LT(crown.bottom_m, crown.top_m);
  EXPECT_GT(crown.half_width_m, 0.0F);
}

TEST(CrownsOfCity, ZeroHasNoSign) {
  CrownsOfCity city(grid_of(four_cells), 0.0);
  city.add({-0.0, -0.0}, -0.0, 1.0, 1.0, CrownShape::spheroid, Foliage::unknown);
  const Crown crown = only_crown(std::move(city));
  for (const float zero : {crown.x_m, crown.y_m, crown.bottom_m}) EXPECT_TRUE(zero == 0.0F && !std::signbit(zero));
}

TEST(CrownsOfCity, APrismIsTurnedWithinARightAngle) {
  EXPECT_EQ(turn_of(0.0), 0);
  EXPECT_EQ(turn_of(right_angle_rad / 2.0), 32768);
  EXPECT_EQ(turn_of(-right_angle_rad / 4.0), 49152);
  EXPECT_EQ(turn_of(3.25 * right_angle_rad), 16384);
  // Nearly a right angle is none
  EXPECT_EQ(turn_of(right_angle_rad * (1.0 - 1e-9)), 0);
  EXPECT_EQ(turn_of(-1e-9), 0);
  EXPECT_EQ(turn_of(right_angle_rad / 2.0, CrownShape::cylinder), 0);
}

}  // namespace
}  // namespace farlod

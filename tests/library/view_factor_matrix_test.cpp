// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farlod/view_factor_matrix.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "farlod/pack.hpp"
#include "farlod/problem.hpp"
#include "package/package_reader.hpp"
#include "tests/scenes/footprints_text.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/planted_crowns.hpp"
#include "tests/scenes/scene_builder.hpp"
#include "tests/scenes/temporary_folder.hpp"

// What surfaces see of each other, against closed forms: walls that face each other near and far, walls of an inner corner, and
// a court. The forms are C-11 and C-14 of Howell's catalogue of configuration factors.

namespace farlod::library {
namespace {

using scenes::building;
using std::numbers::pi;

/// Facing rectangles of a by b, c apart.
double facing_rectangles(double a, double b, double c) {
  const double x = a / c, y = b / c, p = std::sqrt(1.0 + x * x), q = std::sqrt(1.0 + y * y);
  return 2.0 / (pi * x * y) *
         (0.5 * std::log((1.0 + x * x) * (1.0 + y * y) / (1.0 + x * x + y * y)) + x * q * std::atan(x / q) +
          y * p * std::atan(y / p) - x * std::atan(x) - y * std::atan(y));
}

/// From a rectangle to another one at a right angle: they share an edge, and are so wide across it.
double rectangles_at_an_edge(double shared, double from, double to) {
  const double w = from / shared, h = to / shared, w2 = w * w, h2 = h * h, all = 1.0 + w2 + h2, d = std::sqrt(h2 + w2);
  const double logs = std::log((1.0 + w2) * (1.0 + h2) / all) + w2 * std::log(w2 * all / ((1.0 + w2) * (w2 + h2))) +
                      h2 * std::log(h2 * all / ((1.0 + h2) * (w2 + h2)));
  return (w * std::atan(1.0 / w) + h * std::atan(1.0 / h) - d * std::atan(1.0 / d) + 0.25 * logs) / (pi * w);
}

/// 1,000 rays from each square metre of walls of 100 m² and more: 100,000 directions and places, which are spread evenly. Places
/// are a metre apart, which matters most along an edge that two walls share: a strip of 1 m sees half of its wall so.
constexpr double matrix_tolerance = 0.004;
constexpr double matrix_sum_tolerance = 1e-5;
constexpr Point2d matrix_corner{500000.0, 5500000.0};

Box2d matrix_box(double west, double south, double east, double north) {
  return {matrix_corner + Point2d{west, south}, matrix_corner + Point2d{east, north}};
}

/// Footprints, packed and evaluated.
class MatrixTown {
 public:
  explicit MatrixTown(const std::string& footprints, double cell_edge_m = 30.0) {
    std::ofstream(folder_->file("town.geojson")) << footprints;
    PackSettings settings;
    settings.inputs = {folder_->file("town.geojson")};
    settings.output = folder_->file("town");
    settings.cell_edge_m = cell_edge_m;
    settings.align = AlignMode::none;
    Report report;
    (void)pack(settings, report);
  }
  explicit MatrixTown(const CityModel& city) { scenes::pack_city(city, scenes::grid_covering(city, {}, 30.0, 3), folder()); }
  [[nodiscard]] std::filesystem::path folder() const { return folder_->file("town"); }
  void evaluate(const MatrixSettings& settings = {.threshold = 0.0}, std::size_t threads = 0) {
    const Package package(folder());
    const SurfaceSettings surfaces{choice, 1.0};
    EvaluationSettings evaluation;
    evaluation.further.view_factors = true;
    RunSettings run;
    run.threads = threads;
    const SurfaceMeans evaluated = evaluate_surfaces(package, surfaces, evaluation, {}, run);
    means = evaluated.surfaces;
    matrix = view_factor_matrix(package, surfaces, means, settings, evaluation, run);
  }
  /// The wall of a building that faces there, in degrees.
  [[nodiscard]] std::size_t wall(std::string_view id, double azimuth_deg) const {
    const auto found = std::ranges::find_if(means, [&](const SurfaceMean& m) {
      const double apart = std::remainder(m.azimuth.degrees() - azimuth_deg, 360.0);
      return m.building == id && m.kind == SurfaceKind::wall && std::abs(apart) < 5.0;
    });
    EXPECT_NE(found, means.end()) << id << ' ' << azimuth_deg;
    return static_cast<std::size_t>(found - means.begin());
  }
  [[nodiscard]] double view(std::size_t row, std::size_t column) const {
    const auto begin = matrix.columns.begin() + static_cast<std::ptrdiff_t>(row == 0 ? 0 : matrix.row_end[row - 1]);
    const auto end = matrix.columns.begin() + static_cast<std::ptrdiff_t>(matrix.row_end[row]);
    const auto found = std::lower_bound(begin, end, column);
    const auto place = static_cast<std::size_t>(found - matrix.columns.begin());
    return found != end && *found == column ? static_cast<double>(matrix.values[place]) : 0.0;
  }
  [[nodiscard]] double view(std::size_t row, MatrixRest rest) const { return view(row, matrix.column_of(rest)); }
  [[nodiscard]] double ground(std::size_t row) const {
    double sum = view(row, MatrixRest::ground_beyond);
    for (std::size_t n = 0; n < matrix.ground.size(); ++n) sum += view(row, matrix.surfaces + n);
    return sum;
  }
  [[nodiscard]] double sum(std::size_t row) const {
    double sum = 0.0;
    for (std::size_t n = row == 0 ? 0 : matrix.row_end[row - 1]; n < matrix.row_end[row]; ++n)
      sum += static_cast<double>(matrix.values[n]);
    return sum;
  }
  /// Sums are 1, and without a threshold each pair is reciprocal.
  void expect_closed_and_reciprocal() const {
    for (std::size_t i = 0; i < matrix.surfaces; ++i) {
      EXPECT_NEAR(sum(i), 1.0, matrix_sum_tolerance);
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_NEAR(matrix.area_m2[i] * view(i, j), matrix.area_m2[j] * view(j, i), 1e-6 * matrix.area_m2[i]) << i << ' ' << j;
    }
  }

  SurfaceChoice choice = SurfaceChoice::all;
  std::vector<SurfaceMean> means;
  ViewFactorMatrix matrix;

 private:
  std::shared_ptr<const scenes::TemporaryFolder> folder_ = std::make_shared<scenes::TemporaryFolder>();
};

/// Two houses of the same size, whose walls face each other across a street to the north.
std::string houses_across(double street_m, double length_m, double height_m) {
  return scenes::FootprintsText()
      .add(building("a", height_m), matrix_box(0, 0, 10, length_m))
      .add(building("b", height_m), matrix_box(10 + street_m, 0, 20 + street_m, length_m))
      .text();
}

TEST(ViewFactorMatrix, WallsThatFaceEachOtherSeeWhatTheClosedFormSays) {
  for (const double street_m : {5.0, 12.0}) {
    MatrixTown town(houses_across(street_m, 20.0, 12.0));
    town.evaluate();
    const std::size_t of_a = town.wall("a", 90.0), of_b = town.wall("b", 270.0);
    EXPECT_NEAR(town.view(of_a, of_b), facing_rectangles(20.0, 12.0, street_m), matrix_tolerance);
    EXPECT_NEAR(town.view(of_b, of_a), facing_rectangles(20.0, 12.0, street_m), matrix_tolerance);
    EXPECT_NEAR(town.view(of_a, MatrixRest::sky), *town.means[of_a].svf_mean, matrix_tolerance);
    EXPECT_EQ(town.view(of_a, of_a), 0.0);
    EXPECT_EQ(town.view(town.wall("a", 270.0), of_b), 0.0);
    town.expect_closed_and_reciprocal();
  }
}

/// The house across is some ten cells away, far beyond the neighborhood of three.
TEST(ViewFactorMatrix, AHouseFarAwayIsSeenAsItself) {
  MatrixTown town(houses_across(300.0, 80.0, 60.0));
  town.evaluate();
  const double expected = facing_rectangles(80.0, 60.0, 300.0);
  EXPECT_NEAR(town.view(town.wall("a", 90.0), town.wall("b", 270.0)), expected, 0.02 * expected);
  EXPECT_EQ(town.view(town.wall("a", 90.0), MatrixRest::other), 0.0);
  // Of all cells, the wall sees most of the ground of that before it
  std::size_t nearest = 0;
  const auto from_wall_m = [&](std::size_t n) {
    return norm(town.matrix.ground[n].centre_projected - matrix_corner - Point2d{20.0, 40.0});
  };
  for (std::size_t n = 0; n < town.matrix.ground.size(); ++n)
    if (from_wall_m(n) < from_wall_m(nearest)) nearest = n;
  const std::size_t row = town.wall("a", 90.0);
  for (std::size_t n = 0; n < town.matrix.ground.size(); ++n)
    EXPECT_LE(town.view(row, town.matrix.surfaces + n), town.view(row, town.matrix.surfaces + nearest)) << n;
  town.expect_closed_and_reciprocal();
}

TEST(ViewFactorMatrix, WallsOfAnInnerCornerSeeWhatTheClosedFormSays) {
  const std::vector<Point2d> ring{{0, 0}, {22, 0}, {22, 10}, {10, 10}, {10, 18}, {0, 18}};
  std::vector<Point2d> placed;
  for (const Point2d& p : ring) placed.push_back(matrix_corner + p);
  MatrixTown town(scenes::FootprintsText().add(building("l", 10.0), placed).text());
  town.evaluate();
  // The other walls to the north and east are 10 m and 8 m long, and see none of these two
  std::optional<std::size_t> north, east;
  for (std::size_t n = 0; n < town.matrix.surfaces; ++n) {
    const double area_m2 = town.matrix.area_m2[n], azimuth_deg = town.means[n].azimuth.degrees();
    if (town.means[n].kind != SurfaceKind::wall) continue;
    if (std::abs(area_m2 - 120.0) < 1.0 && std::abs(std::remainder(azimuth_deg, 360.0)) < 5.0) north = n;
    if (std::abs(area_m2 - 80.0) < 1.0 && std::abs(azimuth_deg - 90.0) < 5.0) east = n;
  }
  ASSERT_TRUE(north && east);
  EXPECT_NEAR(town.view(*north, *east), rectangles_at_an_edge(10.0, 12.0, 8.0), matrix_tolerance);
  EXPECT_NEAR(town.view(*east, *north), rectangles_at_an_edge(10.0, 8.0, 12.0), matrix_tolerance);
  town.expect_closed_and_reciprocal();
}

/// Four houses around a court, which meet at its corners.
TEST(ViewFactorMatrix, WallsOfACourtSeeWallsGroundAndSky) {
  constexpr double edge_m = 16.0, height_m = 10.0;
  // Cells cut walls, and a surface has one row nonetheless
  for (const double cell_edge_m : {7.0, 60.0}) {
    MatrixTown town(scenes::FootprintsText()
                        .add(building("n", height_m), matrix_box(0, edge_m, edge_m, edge_m + 8))
                        .add(building("s", height_m), matrix_box(0, -8, edge_m, 0))
                        .add(building("e", height_m), matrix_box(edge_m, 0, edge_m + 8, edge_m))
                        .add(building("w", height_m), matrix_box(-8, 0, 0, edge_m))
                        .text(),
                    cell_edge_m);
    town.evaluate();
    EXPECT_EQ(town.matrix.surfaces, 20U);
    const std::size_t north = town.wall("n", 180.0), south = town.wall("s", 0.0), east = town.wall("e", 270.0),
                      west = town.wall("w", 90.0);
    const double beside = rectangles_at_an_edge(height_m, edge_m, edge_m),
                 level = rectangles_at_an_edge(edge_m, height_m, edge_m);
    EXPECT_NEAR(town.view(north, south), facing_rectangles(edge_m, height_m, edge_m), matrix_tolerance);
    EXPECT_NEAR(town.view(north, east), beside, matrix_tolerance);
    EXPECT_NEAR(town.view(north, west), beside, matrix_tolerance);
    EXPECT_NEAR(town.ground(north), level, matrix_tolerance);
    EXPECT_NEAR(town.view(north, MatrixRest::sky), level, matrix_tolerance);
    EXPECT_NEAR(town.view(west, east), facing_rectangles(edge_m, height_m, edge_m), matrix_tolerance);
    town.expect_closed_and_reciprocal();
  }
}

TEST(ViewFactorMatrix, WhatIsBelowTheThresholdIsDroppedByName) {
  MatrixTown town(houses_across(12.0, 20.0, 12.0));
  town.evaluate();
  const MatrixTown whole = town;
  town.evaluate({.threshold = 0.1});
  double dropped_max = 0.0;
  for (std::size_t i = 0; i < town.matrix.surfaces; ++i) {
    double dropped = 0.0;
    for (std::size_t j = 0; j < town.matrix.surfaces + town.matrix.ground.size(); ++j) {
      const double view = whole.view(i, j);
      EXPECT_EQ(town.view(i, j), view < 0.1 ? 0.0 : view);
      dropped += view < 0.1 ? view : 0.0;
    }
    EXPECT_EQ(town.view(i, MatrixRest::sky), whole.view(i, MatrixRest::sky));
    EXPECT_NEAR(town.view(i, MatrixRest::dropped), dropped, 1e-6);
    EXPECT_NEAR(town.sum(i), 1.0, matrix_sum_tolerance);
    dropped_max = std::max(dropped_max, dropped);
  }
  EXPECT_GT(dropped_max, 0.01);
  EXPECT_NEAR(town.matrix.figures.dropped_max, dropped_max, 1e-6);
}

/// Wall to wall: neither of the two has a receiver with an answer.
TEST(ViewFactorMatrix, ACoveredWallSeesSomethingElse) {
  MatrixTown town(scenes::FootprintsText()
                      .add(building("a", 10.0), matrix_box(0, 0, 10, 20))
                      .add(building("b", 10.0), matrix_box(10, 0, 20, 20))
                      .text());
  town.evaluate();
  EXPECT_EQ(town.matrix.area_m2[town.wall("a", 90.0)], 0.0);
  EXPECT_EQ(town.view(town.wall("a", 90.0), MatrixRest::other), 1.0);
  town.expect_closed_and_reciprocal();
}

TEST(ViewFactorMatrix, ASurfaceWithoutARowIsSomethingElse) {
  MatrixTown town(houses_across(12.0, 20.0, 12.0));
  town.choice = SurfaceChoice::roofs;
  town.evaluate();
  EXPECT_EQ(town.matrix.surfaces, 2U);
  town = MatrixTown(scenes::FootprintsText()
                        .add(building("low", 3.0), matrix_box(0, 0, 10, 20))
                        .add(building("high", 30.0), matrix_box(10, 0, 20, 20))
                        .text());
  town.choice = SurfaceChoice::roofs;
  town.evaluate();
  const std::size_t low = town.means.front().building == "low" ? 0 : 1;
  EXPECT_NEAR(town.view(low, MatrixRest::other), rectangles_at_an_edge(20.0, 10.0, 27.0), matrix_tolerance);
}

/// A wall, and at the height of its top a slab that looks up, a metre before it.
TEST(ViewFactorMatrix, TheBackOfASurfaceIsSomethingElse) {
  scenes::SceneBuilder builder;
  builder.add_box({{0, 0}, {10, 20}}, 0.0, 9.0);
  builder.add_polygon({{11, 0, 9}, {20, 0, 9}, {20, 20, 9}, {11, 20, 9}});
  MatrixTown town(builder.city());
  town.evaluate();
  EXPECT_EQ(town.matrix.surfaces, 6U);
  const double expected = rectangles_at_an_edge(20.0, 9.0, 10.0) - rectangles_at_an_edge(20.0, 9.0, 1.0);
  EXPECT_NEAR(town.view(town.wall("box 0", 90.0), MatrixRest::other), expected, matrix_tolerance);
  town.expect_closed_and_reciprocal();
}

/// The columns by class, against Quantities::view_factors, which the same receivers have.
TEST(ViewFactorMatrix, ClassesAreThoseOfViewFactorsWithTrees) {
  MatrixTown town(houses_across(12.0, 20.0, 12.0));
  CrownsOfCity crowns = scenes::random_crowns(PackageReader(town.folder()), 40);
  scenes::plant(crowns, town.folder());
  town.evaluate();
  constexpr std::size_t sky = 0, ground = 1, crown = 7;
  double most_crown = 0.0;
  for (std::size_t n = 0; n < town.matrix.surfaces; ++n) {
    const std::vector<double>& views = town.means[n].further_mean;
    EXPECT_NEAR(town.view(n, MatrixRest::sky), views[sky], matrix_tolerance);
    EXPECT_NEAR(town.ground(n), views[ground], matrix_tolerance);
    EXPECT_NEAR(town.view(n, MatrixRest::crown), views[crown], matrix_tolerance);
    most_crown = std::max(most_crown, views[crown]);
  }
  EXPECT_GT(most_crown, 0.1);
  town.expect_closed_and_reciprocal();
}

TEST(ViewFactorMatrix, IsTheSameForAnyNumberOfThreads) {
  scenes::FootprintsText houses;
  for (int n = 0; n < 16; ++n)
    houses.add(building("h" + std::to_string(n), 9.0 + n), matrix_box(n % 4 * 20, n / 4 * 20, n % 4 * 20 + 12, n / 4 * 20 + 14));
  MatrixTown town(houses.text(), 25.0);
  town.evaluate({}, 1);
  const ViewFactorMatrix alone = town.matrix;
  town.evaluate({}, 5);
  EXPECT_EQ(town.matrix.row_end, alone.row_end);
  EXPECT_EQ(town.matrix.columns, alone.columns);
  EXPECT_EQ(town.matrix.values, alone.values);
}

}  // namespace
}  // namespace farlod::library

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <functional>
#include <sstream>

#include "tests/acceptance/packed_town.hpp"
#include "tests/analytic/oracles.hpp"
#include "tests/analytic/tolerance.hpp"

namespace farlod::acceptance {
namespace {

constexpr double floor_m = 5.0, roof_m = 25.0, receiver_m = 0.05;
/// From a receiver to the roofs around it.
constexpr double rise_m = roof_m - floor_m - receiver_m;
constexpr double pixel_m = 0.25;
constexpr std::size_t rays = 20000;

/// A surface model around the town's middle, a square of 80 m with pixel centres at whole pixels from the middle.
constexpr double half_edge_m = 40.0;
constexpr int pixels = static_cast<int>(2.0 * half_edge_m / pixel_m) + 1;
std::string surface_model(const std::function<bool(Point2d)>& is_roof) {
  std::ostringstream text;
  text.precision(12);
  const Point2d corner = town_middle - (half_edge_m + 0.5 * pixel_m) * Point2d{1.0, 1.0};
  text << "ncols " << pixels << "\nnrows " << pixels << "\nxllcorner " << corner.x << "\nyllcorner " << corner.y << "\ncellsize "
       << pixel_m << "\nNODATA_value -9999\n";
  for (int row = 0; row < pixels; ++row) {
    for (int column = 0; column < pixels; ++column)
      text << (is_roof({-half_edge_m + column * pixel_m, half_edge_m - row * pixel_m}) ? roof_m : floor_m) << ' ';
    text << '\n';
  }
  return text.str();
}

/// A city that is known only as a raster of its surface: its walls stand between two pixels, with their tops at the roof's.
class SurfaceModel : public testing::Test {
 protected:
  void pack(const std::function<bool(Point2d)>& is_roof) const {
    folder.write("dsm.asc", surface_model(is_roof));
    folder.must("farlod-pack --terrain dsm.asc --crs EPSG:32632 --quiet -o a.farlod");
  }
  [[nodiscard]] double svf_at(Point2d p, const std::string& engine) const {
    std::ostringstream command;
    command << "farlod-svf a.farlod -o at.csv --at " << text_of(town_middle + p) << " --on-surface --height " << receiver_m
            << " --rays " << rays << " --engine " << engine;
    folder.must(command.str());
    return CsvTable(folder.text_of("at.csv")).number(0, "svf");
  }

  WorkFolder folder;
};

TEST_F(SurfaceModel, RectangularCourt) {
  constexpr double a = 10.0, b = 25.0;  // half its edges
  pack([](Point2d p) { return std::abs(p.x) >= a || std::abs(p.y) >= b; });
  // The opening is convex, and so is its picture on the unit disk: no longer than the circle
  const double sampling = sampling_error(rays, 2.0 * oracles::pi);
  // A corner may be cut off by half a pixel, which is seen from right below at best
  const double corners = 4.0 * 0.5 * pixel_m * pixel_m / (oracles::pi * rise_m * rise_m);
  for (const Point2d p : {Point2d{}, {4.0, 0.0}, {-7.0, 12.5}, {6.25, -20.0}}) {
    double expected = 0.0;
    for (const double to_x : {a - p.x, a + p.x})
      for (const double to_y : {b - p.y, b + p.y}) expected += oracles::court_quadrant_cos(to_x, to_y, rise_m);
    for (const char* engine : {"auto", "exact"})
      EXPECT_NEAR(svf_at(p, engine), expected, sampling + corners) << p.x << ' ' << p.y;
  }
}

TEST_F(SurfaceModel, RoundCourt) {
  constexpr double radius_m = 25.0;
  pack([](Point2d p) { return norm(p) >= radius_m; });
  // Roof pixels lie outside of the circle; what joins two neighbors reaches into it by a chord's sagitta at most. A point that
  // is farther than a pixel's diagonal outside has roof pixels all around.
  const double diagonal_m = std::sqrt(2.0) * pixel_m;
  const double least_radius_m = radius_m - diagonal_m * diagonal_m / (8.0 * radius_m), largest_radius_m = radius_m + diagonal_m;
  // Stairs around a circle are no longer than the square around it, and the unit disk shows them smaller by the rise at least
  const double sampling = sampling_error(rays, 8.0 * largest_radius_m / rise_m);
  for (const Point2d p : {Point2d{}, {10.0, 0.0}, {-6.0, 8.0}, {0.0, -20.0}})
    for (const char* engine : {"auto", "exact"}) {
      const double svf = svf_at(p, engine);
      EXPECT_GE(svf, oracles::round_court_cos(least_radius_m, rise_m, norm(p)) - sampling) << p.x << ' ' << p.y;
      EXPECT_LE(svf, oracles::round_court_cos(largest_radius_m, rise_m, norm(p)) + sampling) << p.x << ' ' << p.y;
    }
}

TEST_F(SurfaceModel, OnARoofThereIsNothingAbove) {
  pack([](Point2d p) { return norm(p) >= 25.0; });
  for (const Point2d p : {Point2d{30.0, 0.0}, {-32.5, 31.0}}) EXPECT_EQ(svf_at(p, "exact"), 1.0);
}

}  // namespace
}  // namespace farlod::acceptance

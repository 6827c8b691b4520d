// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>

#include "base/frame.hpp"
#include "tests/acceptance/packed_town.hpp"

// A town in a valley, judged by brute force: marches over all pixels of the relief, and planes of sight over the blocks.

namespace farlod::acceptance {
namespace {

/// The town's level ground, and how far it reaches.
constexpr double valley_floor_m = 600.0, level_to_m = 600.0;

/// A number from 0 to 1 for each place of a lattice, the same on every machine.
double random_at(std::int64_t column, std::int64_t row, std::uint64_t octave) {
  std::uint64_t h = static_cast<std::uint64_t>(column) * 0x9E3779B97F4A7C15U +
                    static_cast<std::uint64_t>(row) * 0xC2B2AE3D27D4EB4FU + octave * 0x165667B19E3779F9U;
  for (int n = 0; n < 3; ++n) h = (h ^ (h >> 29U)) * 0xBF58476D1CE4E5B9U;
  return static_cast<double>(h >> 11U) * 0x1p-53;
}

double smooth(double t) { return t * t * (3.0 - 2.0 * t); }

/// From 0 to 1: lattices of random numbers, each twice as fine as the one before and half as high.
double fractal(Point2d p) {
  double sum = 0.0, all = 0.0, cell_m = 6400.0, height = 1.0;
  for (std::uint64_t octave = 0; octave < 7; ++octave, cell_m *= 0.5, height *= 0.5, all += height * 2.0) {
    const double x = std::floor(p.x / cell_m), y = std::floor(p.y / cell_m);
    const double s = smooth(p.x / cell_m - x), t = smooth(p.y / cell_m - y);
    const auto at = [&](int i, int j) {
      return random_at(static_cast<std::int64_t>(x) + i, static_cast<std::int64_t>(y) + j, octave);
    };
    sum += height * ((1.0 - t) * ((1.0 - s) * at(0, 0) + s * at(1, 0)) + t * ((1.0 - s) * at(0, 1) + s * at(1, 1)));
  }
  return sum / all;
}

/// A valley that opens to the east, with mountains of 1,500 m on both sides, at its end in the west, and 30 km away in the east.
double valley_m(Point2d p) {
  const auto rise = [](double d, double from, double to) { return smooth(std::clamp((d - from) / (to - from), 0.0, 1.0)); };
  const double side = rise(std::abs(p.y) - 0.25 * std::max(p.x, 0.0), 1500.0, 5000.0), west = rise(-p.x, 1500.0, 5000.0),
               east = rise(p.x, 26e3, 32e3), level = rise(norm(p), level_to_m, 3000.0);
  return valley_floor_m + (1500.0 * std::max({side, west, east}) + 60.0 * level) * (0.35 + 0.65 * fractal(p));
}

/// The relief as its file has it: pixel centres at whole steps from the town's middle, heights in centimetres.
class MountainRelief {
 public:
  MountainRelief() {
    for (int row = rows - 1; row >= 0; --row)
      for (int column = 0; column < columns; ++column)
        height_m_.push_back(std::round(100.0 * valley_m({step_m * (column + west), step_m * (row + south)})) / 100.0);
  }
  [[nodiscard]] std::string ascii_grid() const {
    const double half = 0.5 * step_m;
    std::string text = "ncols " + std::to_string(columns) + "\nnrows " + std::to_string(rows) + "\nxllcorner " +
                       std::to_string(town_middle.x + step_m * west - half) + "\nyllcorner " +
                       std::to_string(town_middle.y + step_m * south - half) + "\ncellsize " + std::to_string(step_m) + "\n";
    std::array<char, 32> number{};
    for (const double height_m : height_m_) {
      std::snprintf(number.data(), number.size(), "%.2f\n", height_m);
      text += number.data();
    }
    return text;
  }
  /// Bilinear; nothing beyond the last pixels.
  [[nodiscard]] std::optional<double> at(Point2d p) const {
    const double x = p.x / step_m - west, y = p.y / step_m - south;
    if (!(x >= 0.0 && y >= 0.0 && x < columns - 1 && y < rows - 1)) return std::nullopt;
    const auto column = static_cast<std::size_t>(x), row = static_cast<std::size_t>(y);
    const double s = x - static_cast<double>(column), t = y - static_cast<double>(row);
    const double* const below = &height_m_[(rows - 1 - row) * columns + column];
    const double* const above = below - columns;
    return (1.0 - t) * ((1.0 - s) * below[0] + s * below[1]) + t * ((1.0 - s) * above[0] + s * above[1]);
  }

 private:
  static constexpr double step_m = 30.0;
  static constexpr int west = -250, south = -350, columns = 1451, rows = 701;  // 43.5 km by 21 km
  std::vector<double> height_m_;                                               ///< row by row from the north, as the file
};

/// A place that sees, in metres from the town's middle.
struct Eye {
  Point2d p;
  double z_m;
};

/// What hides the sky in a direction, as a slope.
struct Sight {
  double slope = 0.0, distance_m = 0.0;
  void see(double slope_seen, double seen_from_m) {
    if (slope_seen > slope) *this = {slope_seen, seen_from_m};
  }
};

/// Marches over the relief, which sinks by the curvature of the Earth less refraction, k = 0.13, counted from the eye.
Sight over_relief(const MountainRelief& relief, const Eye& eye, Point2d direction) {
  constexpr double stride_m = 5.0;  // a sixth of a pixel
  Sight sight;
  for (double d = stride_m;; d += d < 6000.0 ? stride_m : 2.0 * stride_m) {
    const auto height_m = relief.at(eye.p + d * direction);
    if (!height_m) return sight;
    sight.see((*height_m - 0.87 * d * d / (2.0 * 6371008.8) - eye.z_m) / d, d);
  }
}

/// A block hides most at the nearest place where a plane of sight meets its walls.
Sight over_block(const Block& block, const Eye& eye, Point2d direction) {
  const GridRotation town(town_bearing);
  const Point2d from = town.grid_from_city(eye.p) - block.centre, way = town.grid_from_city(direction);
  const double half_m = 0.5 * block.edge_m;
  double near_m = 0.0, far_m = 1e9;
  for (const auto& [p, d] : {std::pair(from.x, way.x), std::pair(from.y, way.y)}) {
    near_m = std::max(near_m, std::min((-half_m - p) / d, (half_m - p) / d));
    far_m = std::min(far_m, std::max((-half_m - p) / d, (half_m - p) / d));
  }
  Sight sight;
  if (near_m < far_m && near_m > 0.0) sight.see((valley_floor_m + block.height_m - eye.z_m) / near_m, near_m);
  return sight;
}

/// How far the horizons of a table are from the truth, in degrees.
struct Errors {
  double sum_deg = 0.0, sum_of_sizes_deg = 0.0;
  int count = 0;
  void add(double error_deg) {
    sum_deg += error_deg;
    sum_of_sizes_deg += std::abs(error_deg);
    ++count;
  }
  [[nodiscard]] double mean_deg() const { return sum_deg / count; }
  [[nodiscard]] double mean_size_deg() const { return sum_of_sizes_deg / count; }
};

constexpr int azimuths = 720;

class FarValley : public testing::TestWithParam<double> {
 protected:
  FarValley() {
    folder.write("town.geojson", footprints_geojson(small_town()));
    folder.write("valley.asc", relief.ascii_grid());
    folder.must("farlod-pack town.geojson --terrain valley.asc --cell 50 -o a.farlod");
    std::string points = "x,y\n";
    for (const Point2d p : places) points += text_of(p_projected(p)) + "\n";
    folder.write("points.csv", points);
  }

  [[nodiscard]] CsvTable answers(const std::string& arguments) const {
    folder.must("farlod-svf a.farlod --points points.csv --height " + std::to_string(GetParam()) +
                " -o at.csv --quantity horizon --horizons " + std::to_string(azimuths) + " " + arguments);
    return CsvTable(folder.text_of("at.csv"));
  }
  [[nodiscard]] std::vector<Sight> truth_at(std::size_t place) const {
    const Eye eye{p_projected(places[place]) - town_middle, valley_floor_m + GetParam()};
    std::vector<Sight> horizon;
    for (int n = 0; n < azimuths; ++n) {
      const double azimuth = 2.0 * std::numbers::pi * n / azimuths;
      const Point2d direction{std::sin(azimuth), std::cos(azimuth)};
      Sight sight = over_relief(relief, eye, direction);
      for (const Block& block : small_town())
        if (const Sight other = over_block(block, eye, direction); other.slope > sight.slope) sight = other;
      horizon.push_back(sight);
    }
    return horizon;
  }

  /// Crossings of streets, in the frame of the town.
  const std::vector<Point2d> places{{0.0, 0.0},    {60.0, -60.0}, {120.0, 0.0},     {-120.0, 60.0},
                                    {60.0, 120.0}, {0.0, -120.0}, {-120.0, -120.0}, {120.0, -120.0}};
  const MountainRelief relief;
  WorkFolder folder;
};

/// In the street, and above all roofs but that of the tower.
INSTANTIATE_TEST_SUITE_P(Heights, FarValley, testing::Values(1.5, 25.0));

/// 20,000 rays leave .0007 on average and three times as much at the most; horizons less.
constexpr double svf_error = 0.003;

/// The relief is kept to within two thousandths of its distance, .115°. An error of either sign and any size up to that is half
/// as large on average.
constexpr double mean_size_deg = 0.06;
/// The mean of such errors over hundreds of azimuths is nearly 0, but for peaks, which triangles cut off. Without the curvature,
/// what is 15 to 38 km away would rise by another .06° to .15°.
constexpr double mean_deg = 0.05;
/// Far maps have 256 bins of 1.4°, and estimate what rises by less than .002 in them.
constexpr double mean_size_of_bins_deg = 0.2;

TEST_P(FarValley, IsWhatBruteForceSees) {
  for (const bool is_exact : {true, false}) {
    const CsvTable table = answers(is_exact ? "--engine exact --rays 20000" : "--azimuths 720");
    const auto is_horizon = [](const std::string& name) { return name.starts_with("horizon_"); };
    const std::size_t first = static_cast<std::size_t>(std::ranges::find_if(table.header(), is_horizon) - table.header().begin());
    ASSERT_EQ(table.header().size() - first, static_cast<std::size_t>(azimuths));
    Errors mountains, farthest;
    for (std::size_t n = 0; n < places.size(); ++n) {
      const std::vector<Sight> truth = truth_at(n);
      double svf = 0.0;
      for (std::size_t k = 0; k < truth.size(); ++k) {
        const Angle angle = Angle::radians(std::atan(truth[k].slope));
        svf += cos(angle) * cos(angle) / azimuths;
        const double error_deg = table.number(n, table.header()[first + k]) - angle.degrees();
        if (truth[k].distance_m > 1000.0) mountains.add(error_deg);
        if (truth[k].distance_m > 15e3) farthest.add(error_deg);
      }
      EXPECT_NEAR(table.number(n, "svf"), svf, svf_error) << "place " << n << (is_exact ? ", exact" : "");
    }
    ASSERT_GT(farthest.count, 100);
    EXPECT_LT(mountains.mean_size_deg(), is_exact ? mean_size_deg : mean_size_of_bins_deg);
    if (is_exact) {
      EXPECT_NEAR(farthest.mean_deg(), 0.0, mean_deg);
    }
  }
}

}  // namespace
}  // namespace farlod::acceptance

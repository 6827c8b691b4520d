// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/city_layout.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "generator/keyed_random.hpp"

namespace farlod {
namespace {

/// Taylor series about 0, summed from the smallest term; for |x| ≤ π/4 the first left-out term is below 1e-18.
[[nodiscard]] double sine_of_eighth(double x) {
  double sum = 1.0;
  for (int n = 17; n >= 3; n -= 2) sum = 1.0 - x * x / static_cast<double>(n * (n - 1)) * sum;
  return x * sum;
}

[[nodiscard]] double cosine_of_eighth(double x) {
  double sum = 1.0;
  for (int n = 18; n >= 2; n -= 2) sum = 1.0 - x * x / static_cast<double>(n * (n - 1)) * sum;
  return sum;
}

}  // namespace

std::int64_t millimetres(double value_m) { return std::llround(value_m * 1000.0); }

double on_plan_grid_m(double value_m) { return std::round(value_m * 100.0) / 100.0; }

PlanRotation::PlanRotation(double bearing_deg) {
  // Subtract whole quarter turns, so that 90° is exact
  const double quarters = std::round(bearing_deg / 90.0);
  const double rest_rad = (bearing_deg - 90.0 * quarters) * (std::numbers::pi / 180.0);
  cos_ = cosine_of_eighth(rest_rad);
  sin_ = sine_of_eighth(rest_rad);
  const int turns = ((static_cast<int>(quarters) % 4) + 4) % 4;
  for (int k = 0; k < turns; ++k) cos_ = std::exchange(sin_, cos_) * -1.0;
}

namespace {

/// The largest distance of a street from its place at even spacing, as a share of that spacing.
constexpr double largest_shift = 0.18;
/// Every fourth avenue and every fifth street is a main one, which is 1.5 times as wide.
constexpr int avenues_per_boulevard = 4, streets_per_main_street = 5;

[[nodiscard]] std::int32_t intervals(double size_m, double spacing_m) {
  return std::max(1, static_cast<std::int32_t>(std::lround(size_m / spacing_m)));
}

}  // namespace

CityLayout::CityLayout(const CitySettings& settings)
    : settings_(settings),
      columns_(intervals(settings.size_m, settings.avenue_spacing_m)),
      rows_(intervals(settings.size_m, settings.street_spacing_m)) {}

double CityLayout::axis_m(Line line, std::int32_t number) const {
  const std::int32_t last = line == Line::avenue ? columns_ : rows_;
  const RandomStream stream = line == Line::avenue ? RandomStream::avenue_line : RandomStream::street_line;
  const double spacing_m = settings_.size_m / last;
  // The outermost streets stay on the border of the city
  double shift = 0.0;
  if (number > 0 && number < last)
    shift = KeyedRandom({settings_.seed, key_of(stream), key_of(number)}).between(-largest_shift, largest_shift);
  return on_plan_grid_m(spacing_m * (static_cast<double>(number) + shift) - 0.5 * settings_.size_m);
}

double CityLayout::half_width_m(Line line, std::int32_t number) const {
  const bool avenue = line == Line::avenue;
  const double width_m = avenue ? settings_.avenue_width_m : settings_.street_width_m;
  const int period = avenue ? avenues_per_boulevard : streets_per_main_street;
  // Main streets meet near the middle of the city, not at its corner
  const std::int32_t middle = (avenue ? columns_ : rows_) / 2;
  const bool main_street = (number - middle) % period == 0;
  return on_plan_grid_m(0.5 * width_m * (main_street ? 1.5 : 1.0));
}

Box2d CityLayout::rectangle(CityBlock block) const {
  FARLOD_EXPECTS(contains(block));
  const auto low = [&](Line line, std::int32_t k) { return on_plan_grid_m(axis_m(line, k) + half_width_m(line, k)); };
  const auto high = [&](Line line, std::int32_t k) { return on_plan_grid_m(axis_m(line, k + 1) - half_width_m(line, k + 1)); };
  return {{low(Line::avenue, block.i), low(Line::street, block.j)}, {high(Line::avenue, block.i), high(Line::street, block.j)}};
}

LotFrame side_frame(const Box2d& rectangle, int side) {
  switch (side) {
    case 0:
      return {rectangle.low, 0};
    case 1:
      return {{rectangle.high.x, rectangle.low.y}, 1};
    case 2:
      return {rectangle.high, 2};
    default:
      return {{rectangle.low.x, rectangle.high.y}, 3};
  }
}

double side_length_m(const Box2d& rectangle, int side) {
  return side % 2 == 0 ? rectangle.high.x - rectangle.low.x : rectangle.high.y - rectangle.low.y;
}

namespace {

/// There is one smaller centre in each square of this edge.
constexpr double sub_centre_spacing_m = 4000.0;
/// Slopes of a hillside along its direction, and how high its ridges are above its valleys.
constexpr double gentlest_slope = 0.10, steepest_slope = 0.25, hillside_rise_m = 24.0;
constexpr Point2d uphill{0.96, 0.28};

/// Value noise in [0, 1): random numbers at the nodes of a square net, smoothly interpolated.
[[nodiscard]] double smooth_noise(std::uint64_t seed, RandomStream stream, double net_m, Point2d p) {
  const double column = std::floor(p.x / net_m), row = std::floor(p.y / net_m);
  const auto node = [&](int right, int up) {
    const auto i = static_cast<std::int64_t>(column) + right, j = static_cast<std::int64_t>(row) + up;
    return KeyedRandom({seed, key_of(stream), static_cast<std::uint64_t>(net_m), key_of(i), key_of(j)}).unit();
  };
  const double across = smooth_step(0.0, 1.0, p.x / net_m - column);
  const double up = smooth_step(0.0, 1.0, p.y / net_m - row);
  const double south = node(0, 0) + across * (node(1, 0) - node(0, 0));
  const double north = node(0, 1) + across * (node(1, 1) - node(0, 1));
  return south + up * (north - south);
}

/// Half of it is left at `radius_m`.
[[nodiscard]] double decay(Point2d from_centre, double radius_m) {
  return 1.0 / (1.0 + dot(from_centre, from_centre) / (radius_m * radius_m));
}

}  // namespace

double smooth_step(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

UrbanField::UrbanField(const CitySettings& settings)
    : seed_(settings.seed),
      relief_m_(settings.terrain_relief_m),
      hillside_(settings.hillside),
      peak_(0.25 + 0.75 * smooth_step(120.0, 480.0, settings.size_m)),
      core_radius_m_(std::clamp(0.17 * settings.size_m, 120.0, 1500.0)) {}

double UrbanField::urbanity(Point2d p_plan) const {
  const double centre = decay(p_plan, core_radius_m_);
  const double noise = smooth_noise(seed_, RandomStream::urbanity_noise, 450.0, p_plan);
  // At the centre, low noise does not reduce the urbanity
  const double modulation = 0.7 + 0.6 * noise;
  const double modulated = std::max(centre, sub_centre_urbanity(p_plan)) * modulation;
  return std::min(1.0, peak_ * std::max(modulated, centre * smooth_step(0.6, 0.9, centre)));
}

double UrbanField::sub_centre_urbanity(Point2d p_plan) const {
  const auto column = static_cast<std::int64_t>(std::floor(p_plan.x / sub_centre_spacing_m));
  const auto row = static_cast<std::int64_t>(std::floor(p_plan.y / sub_centre_spacing_m));
  double densest = 0.0;
  for (std::int64_t i = column - 1; i <= column + 1; ++i) {
    for (std::int64_t j = row - 1; j <= row + 1; ++j) {
      KeyedRandom random({seed_, key_of(RandomStream::sub_centre), key_of(i), key_of(j)});
      const double x = sub_centre_spacing_m * (static_cast<double>(i) + random.unit());
      const double y = sub_centre_spacing_m * (static_cast<double>(j) + random.unit());
      const double peak = random.between(0.3, 0.8);
      const double radius_m = random.between(200.0, 450.0);
      densest = std::max(densest, peak * decay(p_plan - Point2d{x, y}, radius_m));
    }
  }
  return densest;
}

/// Valleys (even numbers) and ridges (odd numbers), so far apart that every slope between them is in the range.
double UrbanField::hillside_line_m(std::int64_t number) const {
  constexpr double widest_m = hillside_rise_m / gentlest_slope, narrowest_m = hillside_rise_m / steepest_slope;
  constexpr double shift_m = 0.25 * (widest_m - narrowest_m);
  KeyedRandom random({seed_, key_of(RandomStream::hillside_line), key_of(number)});
  return static_cast<double>(number) * 0.5 * (widest_m + narrowest_m) + random.between(-shift_m, shift_m);
}

double UrbanField::hillside_m(Point2d p_plan) const {
  constexpr double mean_spacing_m = 0.5 * (hillside_rise_m / gentlest_slope + hillside_rise_m / steepest_slope);
  const double along_m = dot(uphill, p_plan);
  // Lines are less than half their spacing away from even places: the place lies between two of the next ones
  auto line = static_cast<std::int64_t>(std::floor(along_m / mean_spacing_m)) - 1;
  while (hillside_line_m(line + 1) <= along_m) ++line;
  const double low_m = hillside_line_m(line), high_m = hillside_line_m(line + 1);
  const double share = (along_m - low_m) / (high_m - low_m);
  return hillside_rise_m * (line % 2 == 0 ? share : 1.0 - share);
}

double UrbanField::ground_m(Point2d p_plan) const {
  if (hillside_) return hillside_m(p_plan);
  if (relief_m_ == 0.0) return 0.0;
  const double hills = smooth_noise(seed_, RandomStream::ground_noise, 1100.0, p_plan);
  const double knolls = smooth_noise(seed_, RandomStream::ground_noise, 400.0, p_plan);
  return relief_m_ * (0.75 * hills + 0.25 * knolls);
}

}  // namespace farlod

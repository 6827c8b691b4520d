// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/city_layout.hpp"

#include <algorithm>
#include <cmath>

#include "generator/keyed_random.hpp"

namespace farlod {
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

}  // namespace farlod

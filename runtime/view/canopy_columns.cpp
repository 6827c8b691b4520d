// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/canopy_columns.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "farlod/inspection.hpp"
#include "farlod/plan_view.hpp"
#include "farlod/raster.hpp"

namespace farlod {
namespace {

static_assert(std::endian::native == std::endian::little, "the page reads little-endian numbers");

constexpr std::uint16_t most_side = std::numeric_limits<std::uint16_t>::max();  // a column and a row have 16 bits
constexpr std::size_t most_squares = std::size_t{1} << 26U;                     // are looked up within some seconds
constexpr std::size_t squares_at_a_time = std::size_t{1} << 22U;                // take 32 MiB
/// A crown has its axis in a cell, and may reach beyond the last one.
constexpr double margin_of_canopy_m = 10.0;
constexpr double unit_of_height_m = 0.1;

Box2d place_of_canopy(const Package& package) {
  Box2d part = package.description().outline_projected;
  part.add(part.low - Point2d{margin_of_canopy_m, margin_of_canopy_m});
  part.add(part.high + Point2d{margin_of_canopy_m, margin_of_canopy_m});
  return part;
}

/// Whether a place has no more squares of this step than can be looked up and told.
bool has_few_squares(const Box2d& place, double step_m) {
  const double columns = (place.high.x - place.low.x) / step_m + 2.0, rows = (place.high.y - place.low.y) / step_m + 2.0;
  return std::max(columns, rows) < double{most_side} && columns * rows < static_cast<double>(most_squares);
}

/// Some rows of a plan.
RasterPlan some_rows(const RasterPlan& plan, std::size_t first, std::size_t count) {
  RasterPlan rows = plan;
  rows.north_west_m.y -= static_cast<double>(first) * plan.step_m;
  rows.rows = count;
  return rows;
}

void add_columns(const PlanCanopy& canopy, std::size_t width, std::size_t first_row, double origin_m, CanopyColumns& found) {
  for (std::size_t n = 0; n < canopy.top_m.size(); ++n) {
    if (std::isnan(canopy.top_m[n])) continue;
    found.columns.push_back({.column = static_cast<std::uint16_t>(n % width),
                             .row = static_cast<std::uint16_t>(first_row + n / width),
                             .bottom_local_m = static_cast<double>(canopy.bottom_m[n]) - origin_m,
                             .top_local_m = static_cast<double>(canopy.top_m[n]) - origin_m});
  }
}

/// The columns of a plan, or nothing where there are too many.
std::optional<CanopyColumns> columns_on(const Package& package, const ViewFrame& frame, const RasterPlan& plan,
                                        std::size_t most) {
  CanopyColumns found{plan.north_west_m - horizontal(frame.origin_projected), plan.step_m, {}};
  const std::size_t rows_at_a_time = std::max<std::size_t>(1, squares_at_a_time / plan.columns);
  for (std::size_t row = 0; row < plan.rows; row += rows_at_a_time) {
    const PlanCanopy canopy = plan_canopy(package, some_rows(plan, row, std::min(rows_at_a_time, plan.rows - row)));
    add_columns(canopy, plan.columns, row, frame.origin_projected.z, found);
    if (found.columns.size() > most) return std::nullopt;
  }
  return found;
}

double height_of_all_m(const CanopyColumns& canopy) {
  double sum_m = 0.0;
  for (const CanopyColumn& c : canopy.columns) sum_m += c.top_local_m - c.bottom_local_m;
  return sum_m;
}

/// Whether a canopy is the same in squares of twice the edge, as of a raster of large pixels.
bool are_quarters(const CanopyColumns& fine, const CanopyColumns& coarse) {
  constexpr double rounding = 1e-9;
  const double of_fine_m = height_of_all_m(fine), of_coarse_m = 4.0 * height_of_all_m(coarse);
  return fine.columns.size() == 4 * coarse.columns.size() && std::abs(of_fine_m - of_coarse_m) <= rounding * of_fine_m;
}

template <class Number>
void append_numbers(std::string& bytes, std::span<const Number> numbers) {
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
}

std::uint16_t units_above(double height_m, double low_m) {
  return static_cast<std::uint16_t>(std::clamp(std::round((height_m - low_m) / unit_of_height_m), 0.0, double{most_side}));
}

}  // namespace

std::string CanopyColumns::bytes() const {
  double low_m = columns.empty() ? 0.0 : std::numeric_limits<double>::infinity();
  for (const CanopyColumn& c : columns) low_m = std::min(low_m, c.bottom_local_m);
  const std::array<float, 5> head{static_cast<float>(north_west_local.x), static_cast<float>(north_west_local.y),
                                  static_cast<float>(step_m), static_cast<float>(low_m), static_cast<float>(unit_of_height_m)};
  std::string bytes;
  bytes.reserve(sizeof head + columns.size() * 4 * sizeof(std::uint16_t));
  append_numbers(bytes, std::span<const float>(head));
  for (const CanopyColumn& c : columns) {
    const std::array<std::uint16_t, 4> row{c.column, c.row, units_above(c.bottom_local_m, low_m),
                                           units_above(c.top_local_m, low_m)};
    append_numbers(bytes, std::span<const std::uint16_t>(row));
  }
  return bytes;
}

CanopyColumns canopy_columns_of(const Package& package, const ViewFrame& frame, std::size_t most) {
  if (inventory_of(package).crowns.all() == 0) return {};
  const Box2d place = place_of_canopy(package);
  for (double step_m = finest_canopy_step_m; step_m < place.high.x - place.low.x; step_m *= 2.0) {
    if (!has_few_squares(place, step_m)) continue;
    std::optional<CanopyColumns> columns = columns_on(package, frame, plan_raster(package, step_m, place), most);
    if (!columns) continue;
    for (;;) {
      auto coarse = columns_on(package, frame, plan_raster(package, 2.0 * columns->step_m, place), most);
      if (!coarse || !are_quarters(*columns, *coarse)) return *std::move(columns);
      columns = std::move(coarse);
    }
  }
  return {};
}

}  // namespace farlod

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "receivers/raster_receivers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/cancellation.hpp"
#include "farlod/points.hpp"
#include "receivers/point_receivers.hpp"

namespace farlod {
namespace {

/// What two boxes have in common; empty where they do not meet.
Box2d common_part(const Box2d& a, const Box2d& b) {
  return {{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y)}, {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y)}};
}

/// Pixels are listed patch by patch, so that 16 in a row see almost the same.
constexpr std::size_t patch_edge = 4;

PixelRange pixels_over(const RasterPlan& plan, const Box2d& o) {
  const auto clamp = [](double x, std::size_t n) { return static_cast<std::size_t>(std::clamp(x, 0.0, static_cast<double>(n))); };
  return {clamp(std::floor((o.low.x - plan.north_west_m.x) / plan.step_m), plan.columns),
          clamp(std::ceil((o.high.x - plan.north_west_m.x) / plan.step_m), plan.columns),
          clamp(std::floor((plan.north_west_m.y - o.high.y) / plan.step_m), plan.rows),
          clamp(std::ceil((plan.north_west_m.y - o.low.y) / plan.step_m), plan.rows)};
}

template <class Visit>
void for_each_pixel_by_patches(const PixelRange& r, const Visit& visit) {
  for (std::size_t row_0 = r.row_begin; row_0 < r.row_end; row_0 += patch_edge)
    for (std::size_t column_0 = r.column_begin; column_0 < r.column_end; column_0 += patch_edge)
      for (std::size_t row = row_0; row < std::min(row_0 + patch_edge, r.row_end); ++row)
        for (std::size_t column = column_0; column < std::min(column_0 + patch_edge, r.column_end); ++column) visit(column, row);
}

/// Divides a range into strips of some rows, so that what is known of a strip's pixels stays in the processor's cache, and does
/// not grow with the cell. Patches are not divided.
template <class Visit>
void for_each_strip(const PixelRange& r, const Visit& visit) {
  constexpr std::size_t pixels_of_strip = 16'384;
  if (r.empty()) return;
  const std::size_t patches = pixels_of_strip / (patch_edge * (r.column_end - r.column_begin));
  const std::size_t rows = patch_edge * std::max<std::size_t>(patches, 1);
  for (std::size_t row = r.row_begin; row < r.row_end; row += rows)
    visit(PixelRange{r.column_begin, r.column_end, row, std::min(row + rows, r.row_end)});
}

bool meet(const Box2d& a, const Box2d& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

}  // namespace

RasterPlan plan_raster(const package::Manifest& m, double step_m, const std::optional<Box2d>& wanted_projected) {
  const Box2d area = wanted_projected ? *wanted_projected : m.city_projected();
  const double west = std::floor(area.low.x / step_m), south = std::floor(area.low.y / step_m);
  const double east = std::ceil(area.high.x / step_m), north = std::ceil(area.high.y / step_m);
  return {
      {west * step_m, north * step_m}, step_m, static_cast<std::size_t>(east - west), static_cast<std::size_t>(north - south)};
}

RasterPlan plan_within(const RasterPlan& whole, const Box2d& box) {
  // The pixels along one axis between two distances from its begin
  const auto pixels_between = [&](double from_m, double to_m, std::size_t count) {
    const double last = static_cast<double>(count) - 1.0;
    const double begin = std::clamp(std::floor(from_m / whole.step_m), 0.0, last);
    return std::pair(static_cast<std::size_t>(begin),
                     static_cast<std::size_t>(std::clamp(std::ceil(to_m / whole.step_m), begin + 1.0, last + 1.0)));
  };
  const auto [west, east] = pixels_between(box.low.x - whole.north_west_m.x, box.high.x - whole.north_west_m.x, whole.columns);
  const auto [north, south] = pixels_between(whole.north_west_m.y - box.high.y, whole.north_west_m.y - box.low.y, whole.rows);
  const Point2d corner{whole.north_west_m.x + static_cast<double>(west) * whole.step_m,
                       whole.north_west_m.y - static_cast<double>(north) * whole.step_m};
  return {corner, whole.step_m, east - west, south - north};
}

std::vector<Cell> RasterReceivers::cells() const {
  std::vector<Cell> result;
  const CellRange& range = manifest_.grid.cells;
  for (std::size_t n = 0; n < static_cast<std::size_t>(range.size()); ++n)
    if (!range_of(range.cell_at(n)).empty()) result.push_back(range.cell_at(n));
  if (beyond_grid_ == BeyondGrid::is_answered) add_cells_beyond_grid(result);
  return result;
}

void RasterReceivers::add_cells_beyond_grid(std::vector<Cell>& cells) const {
  const Grid& grid = manifest_.grid;
  const Point2d corner = plan_.north_west_m;
  const Box2d all{{corner.x, corner.y - static_cast<double>(plan_.rows) * plan_.step_m},
                  {corner.x + static_cast<double>(plan_.columns) * plan_.step_m, corner.y}};
  // A raster of another place has nothing to do with the city
  const Box2d outline = manifest_.projected_outline(grid.rectangle());
  if (!meet(all, outline)) return;
  Box2d asked = common_part(all, grown(outline, answered_beyond_grid_m));
  if (region_ != nullptr) asked = common_part(asked, region_->outline());
  if (asked.empty()) return;
  Box2d asked_grid;
  for (const Point2d p : {asked.low, Point2d{asked.high.x, asked.low.y}, asked.high, Point2d{asked.low.x, asked.high.y}})
    asked_grid.add(manifest_.grid_from_projected(p));
  const Cell first = grid.cell_of(asked_grid.low), last = grid.cell_of(asked_grid.high);
  for (Cell cell = first; cell.j <= last.j; ++cell.j)
    for (cell.i = first.i; cell.i <= last.i; ++cell.i) {
      if (grid.cells.contains(cell) || !meet(manifest_.projected_outline(grid.square_of(cell)), asked)) continue;
      if (!range_of(cell).empty()) cells.push_back(cell);
    }
}

PixelRange RasterReceivers::range_of(Cell cell) const {
  return pixels_over(plan_, manifest_.projected_outline(manifest_.grid.square_of(cell)));
}

double RasterReceivers::rounding_m(const PixelRange& pixels, Cell cell) const {
  const Point2d projected = plan_.centre_m(pixels.column_end, pixels.row_begin);
  const double in_double_m = norm(projected) + norm(manifest_.origin_m) + norm(manifest_.grid.corner_of(cell));
  // No pixel of a cell's range is farther from the cell's corner than four edges of the cell, or of pixels
  const double in_cell_m = 4.0 * (manifest_.grid.cell_edge_m + plan_.step_m);
  return std::numeric_limits<float>::epsilon() * in_cell_m + 16.0 * std::numeric_limits<double>::epsilon() * in_double_m;
}

RasterReceivers::Centres RasterReceivers::centres_of(const PixelRange& pixels, Cell cell) const {
  const Box2d square = manifest_.grid.square_of(cell);
  const auto centre_grid = [&](std::size_t column, std::size_t row) {
    return manifest_.grid_from_projected(plan_.centre_m(column, row));
  };
  const std::size_t columns = pixels.column_end - pixels.column_begin, rows = pixels.row_end - pixels.row_begin;
  Centres centres{{columns, rows, centre_grid(pixels.column_begin, pixels.row_begin) - square.low,
                   manifest_.grid.rotation.grid_from_city(Point2d{plan_.step_m, 0.0}), rounding_m(pixels, cell),
                   std::vector<float>(columns * rows), std::vector<float>(columns * rows)},
                  std::vector<bool>(columns * rows)};
  for (std::size_t row = 0, n = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column, ++n) {
      const Point2d p_grid = centre_grid(pixels.column_begin + column, pixels.row_begin + row), p = p_grid - square.low;
      centres.places.x[n] = static_cast<float>(p.x);
      centres.places.y[n] = static_cast<float>(p.y);
      // A point on a border belongs to the cell to its east or north
      centres.are_in_cell[n] =
          square.low.x <= p_grid.x && p_grid.x < square.high.x && square.low.y <= p_grid.y && p_grid.y < square.high.y;
    }
  return centres;
}

template <class OnStrip, class Visit>
std::size_t RasterReceivers::for_each_wanted(Cell cell, const std::stop_token& stop, const OnStrip& on_strip,
                                             const Visit& visit) const {
  std::size_t unwanted = 0;
  for_each_strip(range_of(cell), [&](const PixelRange& strip) {
    throw_if_cancelled(stop);
    const Centres centres = centres_of(strip, cell);
    on_strip(centres.places);
    for_each_pixel_by_patches(strip, [&](std::size_t column, std::size_t row) {
      const std::size_t n = (row - strip.row_begin) * centres.places.columns + column - strip.column_begin;
      if (!centres.are_in_cell[n]) return;
      if (region_ != nullptr && !region_->contains(plan_.centre_m(column, row)))
        ++unwanted;
      else
        visit(centres.places, n, column, row);
    });
  });
  return unwanted;
}

CellReceivers RasterReceivers::in_cell(const PackageReader& package, Cell cell, HeightAbove above, float height_m,
                                       const std::stop_token& stop) const {
  if (!manifest_.grid.cells.contains(cell)) return beyond_grid(package, cell, above, height_m, stop);
  LatticeLocator locator(package, cell);
  CellReceivers result{cell, {}};
  // Where all pixels are outside of the region, nobody asks for their heights
  const bool is_met = region_ == nullptr || meet(manifest_.projected_outline(manifest_.grid.square_of(cell)), region_->outline());
  const auto look_at = [&](const PlanLattice& places) {
    if (is_met) locator.look_at(places);
  };
  const auto add = [&](const PlanLattice& places, std::size_t n, std::size_t column, std::size_t row) {
    if (const auto p_cell = stand(locator.at(n), places.x[n], places.y[n], above, height_m))
      result.receivers.push_back({row * plan_.columns + column, *p_cell});
    else
      ++result.left_out;
  };
  result.outside_of_region = for_each_wanted(cell, stop, look_at, add);
  return result;
}

CellReceivers RasterReceivers::beyond_grid(const PackageReader& package, Cell cell, HeightAbove above, float height_m,
                                           const std::stop_token& stop) const {
  std::vector<PlaceOfReceiver> places;
  std::vector<std::size_t> pixels;
  const auto add = [&](const PlanLattice&, std::size_t, std::size_t column, std::size_t row) {
    places.push_back({plan_.centre_m(column, row), {}});
    pixels.push_back(row * plan_.columns + column);
  };
  const std::size_t unwanted = for_each_wanted(
      cell, stop, [](const PlanLattice&) {}, add);
  std::vector<std::size_t> all(places.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  CellReceivers result = receivers_at(package, cell, places, all, above, height_m, stop);
  for (Receiver& receiver : result.receivers) receiver.index = pixels[receiver.index];
  result.left_out = places.size() - result.receivers.size();
  result.outside_of_region = unwanted;
  return result;
}

void RasterReceivers::for_each_profile(
    const PackageReader& package, Cell cell, const std::stop_token& stop,
    const std::function<void(std::size_t pixel, const VerticalProfile& profile)>& visit) const {
  LatticeLocator locator(package, cell);
  for_each_strip(range_of(cell), [&](const PixelRange& strip) {
    throw_if_cancelled(stop);
    const Centres centres = centres_of(strip, cell);
    locator.look_at(centres.places);
    for (std::size_t n = 0; n < centres.are_in_cell.size(); ++n)
      if (centres.are_in_cell[n])
        visit((strip.row_begin + n / centres.places.columns) * plan_.columns + strip.column_begin + n % centres.places.columns,
              locator.at(n));
  });
}

}  // namespace farlod

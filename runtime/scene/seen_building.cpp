// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/seen_building.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "base/cancellation.hpp"
#include "base/nearest_word.hpp"
#include "farlod/angle.hpp"
#include "farlod/error.hpp"
#include "occlusion/placed_mesh.hpp"

namespace farlod {
namespace {

/// Calls `visit` with the id and the number of each building of a block, block by block.
template <class Visit>
void for_each_building(const PackageReader& package, const Visit& visit) {
  const Grid& grid = package.grid();
  for (const Block& block : grid.blocks()) {
    const BlockTiles& tiles = package.block_tiles(grid.cells_of(block).cell_at(0));
    for (const package::BuildingRecord& building : tiles.buildings()) visit(tiles.id_of(building), building.number);
  }
}

std::string message_of_unknown(const PackageReader& package, const std::string& id) {
  constexpr std::size_t most_examples = 3;
  std::set<std::string> known;
  for_each_building(package, [&](std::string_view of, std::uint32_t) { known.emplace(of); });
  const std::vector<std::string> ids(known.begin(), known.end());
  const std::string message = "the package has no building \"" + id + "\"", meant = did_you_mean(id, ids);
  if (!meant.empty()) return message + meant;
  std::string examples;
  for (std::size_t n = 0; n < std::min(most_examples, ids.size()); ++n) examples += (n == 0 ? " " : ", ") + ids[n];
  return message + (ids.empty() ? ", and no other either" : ": it has such as" + examples);
}

/// The numbers, within the city, of all buildings that have this id, ascending.
std::vector<std::uint32_t> numbers_of(const PackageReader& package, const std::string& id) {
  std::set<std::uint32_t> numbers;
  for_each_building(package, [&](std::string_view of, std::uint32_t number) {
    if (of == id) numbers.insert(number);
  });
  if (numbers.empty()) throw InvalidArgument(message_of_unknown(package, id));
  return {numbers.begin(), numbers.end()};
}

/// The sine of the elevation of what is so much higher, at a level distance.
double sine_of(double rise_m, double level_m) {
  const double distance_m = std::hypot(rise_m, level_m);
  return distance_m > 0.0 ? rise_m / distance_m : 0.0;
}

/// The nearest and the farthest level distance of a box.
struct DistancesOfBox {
  double least_m, most_m;
};

DistancesOfBox distances_of(const Box2d& box, Point2d from) {
  const auto least = [](double low, double high, double at) { return std::max({0.0, low - at, at - high}); };
  const auto most = [](double low, double high, double at) { return std::max(std::abs(low - at), std::abs(high - at)); };
  return {std::hypot(least(box.low.x, box.high.x, from.x), least(box.low.y, box.high.y, from.y)),
          std::hypot(most(box.low.x, box.high.x, from.x), most(box.low.y, box.high.y, from.y))};
}

/// The azimuths of a box, seen from outside of it: less than half a turn.
void set_azimuths(const Box2d& box, Point2d from, DirectionWindow& window) {
  const Point2d towards = 0.5 * (box.low + box.high) - from;
  double left = 0.0, right = 0.0;
  for (const Point2d corner : {box.low, Point2d{box.high.x, box.low.y}, box.high, Point2d{box.low.x, box.high.y}}) {
    const Point2d to = corner - from;
    const double turn = std::atan2(towards.y * to.x - towards.x * to.y, towards.x * to.x + towards.y * to.y);
    left = std::min(left, turn);
    right = std::max(right, turn);
  }
  window.from_rad = std::atan2(towards.x, towards.y) + left;
  window.width_rad = right - left;
}

}  // namespace

Point3d DirectionWindow::direction(Point2d p_square) const {
  const double z = low_z + (high_z - low_z) * p_square.y, level = std::sqrt(std::max(0.0, 1.0 - z * z));
  const Angle azimuth = Angle::radians(from_rad + width_rad * p_square.x);
  return {level * sin(azimuth), level * cos(azimuth), z};
}

SeenBuilding::SeenBuilding(const PackageReader& package, const std::string& id, const std::stop_token& stop) {
  const std::vector<std::uint32_t> numbers = numbers_of(package, id);
  const Grid& grid = package.grid();
  for (std::size_t n = 0; n < static_cast<std::size_t>(grid.cells.size()); ++n) {
    throw_if_cancelled(stop);
    const Cell cell = grid.cells.cell_at(n);
    add(package.tile(cell), grid.corner_of(cell) - grid.middle_corner(), numbers);
  }
}

void SeenBuilding::add(const TileView& tile, Point2d corner_m, std::span<const std::uint32_t> numbers) {
  std::uint32_t begin = 0;
  for (const package::SurfaceRun& run : tile.surface_runs) {
    const bool is_own = std::ranges::binary_search(numbers, tile.building_number(tile.surfaces[run.surface]));
    is_own_.insert(is_own_.end(), run.end - begin, is_own);
    for (std::uint32_t n = begin; n < run.end && is_own; ++n)
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const Point3f p = placed(tile.mesh.vertices[tile.mesh.triangles[n].corner(corner)], corner_m);
        outline_.add({p.x, p.y});
        low_m_ = std::min(low_m_, p.z);
        high_m_ = std::max(high_m_, p.z);
      }
    begin = run.end;
  }
}

DirectionWindow SeenBuilding::window_from(const Point3f& place) const {
  const Point2d from{place.x, place.y};
  DirectionWindow window;
  window.width_rad = 2.0 * std::numbers::pi;
  if (!outline_.contains(from)) set_azimuths(outline_, from, window);
  const DistancesOfBox level = distances_of(outline_, from);
  const double rise_m = high_m_ - place.z, fall_m = low_m_ - place.z;
  window.high_z = sine_of(rise_m, rise_m > 0.0 ? level.least_m : level.most_m);
  window.low_z = sine_of(fall_m, fall_m > 0.0 ? level.most_m : level.least_m);
  return window;
}

void require_building(const PackageReader& package, const std::string& id) { (void)numbers_of(package, id); }

}  // namespace farlod

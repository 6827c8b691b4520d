// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/scenes/planted_crowns.hpp"

#include <array>
#include <random>

#include "package/crowns_of_city.hpp"
#include "package/manifest.hpp"
#include "package/package_writer.hpp"
#include "scene/vertical_profile.hpp"

namespace farlod::scenes {

CrownsOfCity crowns_for(const std::filesystem::path& package) {
  const package::Manifest manifest = read_manifest(package);
  return {manifest.grid, manifest.height_origin_m};
}

void plant(CrownsOfCity& crowns, const std::filesystem::path& package) {
  package::Manifest manifest = read_manifest(package);
  manifest.canopy = write_canopy(package, crowns);
  PackageWriter(package).write_manifest(manifest);
}

CrownsOfCity random_crowns(const PackageReader& package, std::size_t count, std::uint64_t seed) {
  constexpr std::array shapes{CrownShape::spheroid, CrownShape::cylinder, CrownShape::prism};
  const Grid& grid = package.grid();
  const double height_origin_m = package.manifest().height_origin_m;
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11U) * 0x1p-53;
  };
  CrownsOfCity crowns(grid, height_origin_m);
  while (crowns.size() < count) {
    const Cell cell = grid.cells.cell_at(static_cast<std::size_t>(uniform(0.0, static_cast<double>(grid.cells.size()))));
    const Point2d place{uniform(0.0, grid.cell_edge_m), uniform(0.0, grid.cell_edge_m)};
    const auto ground_m = PointLocator(package, cell).at(static_cast<float>(place.x), static_cast<float>(place.y)).ground_m();
    if (!ground_m) continue;
    const double foot_m = height_origin_m + static_cast<double>(*ground_m), height_m = uniform(5.0, 18.0);
    crowns.add(grid.corner_of(cell) + place, foot_m + uniform(0.1, 0.5) * height_m, foot_m + height_m, uniform(1.0, 4.0),
               shapes[random() % shapes.size()], random() % 4 == 0 ? Foliage::evergreen : Foliage::deciduous, uniform(0.0, 1.5));
  }
  return crowns;
}

}  // namespace farlod::scenes

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "city/located_city.hpp"
#include "contract/grid.hpp"
#include "contract/package/manifest.hpp"
#include "farlod/pack.hpp"
#include "farmap/far_map_settings.hpp"
#include "georeference/area_reader.hpp"
#include "package/existing_package.hpp"
#include "pipeline/pack.hpp"
#include "tiles/tile_set.hpp"

namespace farlod::pipeline {

/// What a run that makes far maps for an area does with a block.
struct PlannedBlock {
  Block block;
  std::optional<package::CellRuns> mapped;       ///< the cells that have far maps afterwards; all when absent
  std::optional<package::BlockFiles> kept = {};  ///< its files, where the package has all of these far maps
};

/// What a run does that makes far maps for an area.
struct AreaPlan {
  std::vector<PlannedBlock> blocks;        ///< in the order of Grid::blocks()
  std::uint64_t far_maps = 0;              ///< to bake: those of a block that gets more are baked again, since they share edges
  std::size_t shapes_outside_of_grid = 0;  ///< points, lines and polygons that meet no cell
};

/// The area's cells, and those that have far maps in the package that is there. Throws InputError when the area has no place in
/// the CRS of the package, and InvalidArgument when it meets no cell.
[[nodiscard]] AreaPlan plan_area(const georeference::RequestedArea& area, const Georeference& georeference, const Grid& grid,
                                 const ExistingPackage* existing);

/// A run that makes far maps for an area (StageSettings::area), in a new package or in one that is there. Its functions are
/// called in this order, as soon as the manifest of the run says what they need.
class AreaPackage {
 public:
  /// Reads the area and the manifest of the package that is there. The settings must outlive it. Throws InputError, OutputError.
  explicit AreaPackage(const StageSettings& settings);

  /// Once CRS, grid, settings and inputs are known. Adds notes on what of the area has no effect. Throws what plan_area() throws,
  /// and OutputError when the package that is there is of another city, grid or settings.
  void plan(const Georeference& georeference, PackedCity& result);
  [[nodiscard]] std::uint64_t far_maps() const { return plan_.far_maps; }
  /// Once the tiles are described. Throws OutputError.
  void require_same_city(const package::Manifest& manifest) const;
  /// Bakes and writes what is planned, several blocks at once, and then the manifest, whose blocks it fills in. Where it ends
  /// early, a package that was there stays as it was. Throws OutputError, Cancelled.
  void write(const TileSet& tiles, const FarMapSettings& far_map, PackedCity& result, const RunSettings& run,
             std::size_t blocks_at_once) const;

 private:
  const StageSettings* settings_;
  georeference::RequestedArea area_;
  std::optional<ExistingPackage> existing_;
  AreaPlan plan_;
};

/// Refuses an output folder that cannot be one, before the long stages: it must be new, or may be replaced, or far maps are added
/// to the package in it. Nothing where far maps are made for all cells. Throws InputError, OutputError.
[[nodiscard]] std::optional<AreaPackage> prepare_output(const StageSettings& settings);

}  // namespace farlod::pipeline

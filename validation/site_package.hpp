// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "base/grid.hpp"
#include "farmap/far_map_settings.hpp"
#include "package/package_reader.hpp"
#include "package/tile_set.hpp"
#include "tests/scenes/packed_city.hpp"
#include "validation/studied_city.hpp"

namespace farlod::validation {

/// A city cut into cells. The cut does not depend on the neighborhood, which a package decides.
struct CutCity {
  Grid grid;
  TileSet tiles;
};
[[nodiscard]] CutCity cut(const StudiedCity& city, Angle bearing, double cell_edge_m, int block_edge = 32);

/// The default settings of a kind.
[[nodiscard]] FarMapSettings of_kind(FarMapKind kind);

/// A package in a temporary folder, whose far maps are baked where they are wanted.
class SitePackage {
 public:
  SitePackage(const CutCity& cut, int neighborhood, const FarMapSettings& far_map, const scenes::ChosenCells& only);
  [[nodiscard]] const PackageReader& package() const { return package_; }
  [[nodiscard]] const scenes::FarMapCost& cost() const { return cost_; }
  /// Over blocks that were baked whole.
  [[nodiscard]] double bytes_a_cell() const;
  [[nodiscard]] double bake_ms_a_cell() const { return 1e3 * cost_.seconds / static_cast<double>(cost_.cells); }

 private:
  scenes::TemporaryFolder folder_;
  scenes::FarMapCost cost_;
  PackageReader package_;
};

/// For the engine `exact`, which needs no far maps.
[[nodiscard]] SitePackage without_far_maps(const CutCity& cut);

}  // namespace farlod::validation

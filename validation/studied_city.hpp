// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "base/grid.hpp"
#include "city/city_model.hpp"
#include "farlod/angle.hpp"
#include "farmap/horizon_map_baker.hpp"
#include "package/package_reader.hpp"
#include "package/tile_set.hpp"
#include "tests/scenes/packed_city.hpp"

namespace farlod::validation {

/// A city whose sky view factors are studied, in a city frame around its middle.
struct StudiedCity {
  std::string name;
  CityModel city;
  Angle streets;  ///< bearing of its streets
};

/// farlod-city --size `size_m` --seed 1 --towers 0.3 --rotation 20 --lod 1
[[nodiscard]] StudiedCity generated_city(double size_m);
/// Of each kind of model that farlod-city makes, a town of `size_m`.
[[nodiscard]] std::vector<StudiedCity> generated_models(double size_m);
/// Buildings of any file, read by the stages of farlod-pack.
[[nodiscard]] StudiedCity building_city(const std::string& name, const std::filesystem::path& file);
/// Footprints with heights, read by the stages of farlod-pack.
[[nodiscard]] StudiedCity footprint_city(const std::string& name, const std::filesystem::path& file,
                                         const std::string& height_field);

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

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>

#include "base/grid.hpp"
#include "farmap/city_horizon.hpp"
#include "package/tile_set.hpp"

namespace farlod {

/// A city in tiles and the tree of its occluders, as they lie on disk for several processes: each maps them, and reads of them
/// what its blocks need. They are arrays as memory holds them, for the same build of the program alone.
struct SavedCity {
  TileSet tiles;
  std::optional<CityHorizon> horizon;  ///< none for far maps of the kind `box`
  std::string record;                  ///< what else was noted down, for people and programs

  /// Nothing where the folder holds none that is whole, or one of another build. The grid must outlive it. Throws InputError.
  [[nodiscard]] static std::optional<SavedCity> open(const std::filesystem::path& folder, const Grid& grid);
  /// The record alone.
  [[nodiscard]] static std::optional<std::string> find_record(const std::filesystem::path& folder);
};

/// Writes a city into a folder. It is whole when its record is there. Throws OutputError, Cancelled.
void save_city(const std::filesystem::path& folder, const TileSet& tiles, const CityHorizon* horizon, const Grid& grid,
               const std::string& record, const std::stop_token& stop = {});

}  // namespace farlod

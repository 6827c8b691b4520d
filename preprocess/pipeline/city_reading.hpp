// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "align/align.hpp"
#include "base/grid.hpp"
#include "city/city_model.hpp"
#include "farlod/pack.hpp"
#include "farlod/problem.hpp"
#include "georeference/raster_reader.hpp"
#include "ingest/files/input_search.hpp"
#include "pipeline/pack.hpp"
#include "tiles/crowns_on_ground.hpp"

namespace farlod::pipeline {

/// Runs a stage of that name, and measures how long it takes.
using RunStage = std::function<void(const std::string& stage, const std::function<void()>& work)>;

/// Rasters of heights.
struct TerrainTiles {
  std::vector<georeference::TerrainFile> files;  ///< as GDAL opens them
  std::vector<std::filesystem::path> on_disk;    ///< the files, or the archives that hold them
};

/// The files that the inputs of the user lead to, not read yet.
struct CityFiles {
  std::vector<ingest::InputFile> files;
  std::vector<std::filesystem::path> on_disk;  ///< an archive is one input, however many of its files are read
  TerrainTiles terrain, far_terrain;
  SkippedFeatures skipped;
};

/// Searches the inputs for files. A raster among them becomes the terrain. Throws InputError.
[[nodiscard]] CityFiles find_city_files(const StageSettings& settings, Report& report);

/// A grid, the ground below it where a raster is read, and how the streets lie.
struct GridOnGround {
  Grid grid;
  std::optional<TerrainRaster> terrain;
  align::Alignment streets = {};
};

/// A city where it stands, a grid over it, and the far maps that its cells will have.
struct ReadCity {
  LocatedCity located;
  GridOnGround ground;
  std::vector<georeference::TerrainFile> terrain_files;      ///< of which the ground is a part, and not all
  std::vector<georeference::TerrainFile> far_terrain_files;  ///< beyond what these cover
  FarMapSettings far_map;
  bool is_chosen = false;          ///< cells, neighborhood and tolerance were to be chosen
  std::optional<GridChoice> best;  ///< and this is the choice; none where nothing keeps the error
  SkippedFeatures skipped;
  std::vector<std::string> notes;
};

/// Reads the files, places the city, and lays a grid over it. Throws InputError, Cancelled.
[[nodiscard]] ReadCity read_city(CityFiles files, const StageSettings& settings, Report& report, const std::stop_token& stop,
                                 const RunStage& run_stage);

/// The trees that the settings name, in the city frame.
struct ReadTrees {
  tiles::TreesOfCity trees;
  SkippedFeatures skipped;
  std::vector<std::string> notes;  ///< for the user
};

/// Reads inventories, and opens rasters of canopies: before the city is read, so that a wrong file is told first. If there are
/// several inventories, one that is empty or cannot be used as a whole is reported and left out. Throws InputError for a file
/// that does not exist, when no inventory is left, or when a raster cannot be opened; Cancelled.
[[nodiscard]] std::vector<SourceTrees> read_inventories(const StageSettings& stages, Report& report, const std::stop_token& stop);

/// Brings them to the city, and reads the raster of canopies where the grid is. Inventories without a usable CRS are left out as
/// before. Throws InputError when none is left, or a raster cannot be used; Cancelled.
[[nodiscard]] ReadTrees bring_to_city(std::vector<SourceTrees> inventories, const StageSettings& settings,
                                      const Georeference& georeference, const Grid& grid, Report& report,
                                      const std::stop_token& stop);

}  // namespace farlod::pipeline

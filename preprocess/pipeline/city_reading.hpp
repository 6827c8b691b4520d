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

}  // namespace farlod::pipeline

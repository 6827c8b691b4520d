// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "align/align.hpp"
#include "city/city_model.hpp"
#include "farlod/pack.hpp"
#include "farmap/horizon_map_baker.hpp"
#include "georeference/georeference.hpp"
#include "ingest/ingest.hpp"
#include "package/manifest.hpp"
#include "tiles/tiles.hpp"
#include "trial/far_map_trial.hpp"

namespace farlod::pipeline {

/// The error to keep, and the choices that may keep it.
struct ChoiceSettings {
  double max_far_error = 0.01;  ///< of the far maps alone
  std::vector<double> cell_edges_m{25.0, 50.0, 100.0, 200.0};
  std::vector<int> neighborhoods{1, 3, 5};
  std::vector<double> tolerances{0.1, 0.05, 0.02, 0.01};  ///< descending
  FarErrorSettings error_sampling;                        ///< which receivers the errors are estimated with
};

/// Lays a grid with cells of this edge over the city. Returns it with the ground below it.
using LayGrid = std::function<std::pair<Grid, std::optional<TerrainRaster>>(double cell_edge_m)>;

/// The cheapest choice whose far maps keep the error. No sampled receiver may be farther from the engine `exact` than
/// `max_far_error`, and the bounds of 99 % of them must guarantee it; farlod-svf --max-error retraces the rest. Empty when no
/// choice keeps the error. Deterministic.
[[nodiscard]] std::optional<GridChoice> choose_grid(const LocatedCity& city, const LayGrid& lay, Assign assign,
                                                    const HorizonMapSettings& far_map, const ChoiceSettings& settings,
                                                    const std::stop_token& stop = {});

/// What of a package a run makes.
enum class PackPart { whole, shard, merge };

/// From which files a package is made, and what each stage is told.
struct StageSettings {
  std::vector<std::filesystem::path> inputs;   ///< files, folders and archives; may be empty when there is a terrain
  std::vector<std::filesystem::path> terrain;  ///< rasters, and folders of them
  double terrain_offset_m = 0.0;
  SurfaceReading surface = SurfaceReading::automatic;
  std::vector<std::filesystem::path> far_terrains;  ///< beyond what `terrain` covers
  TreeSettings trees = {};
  std::filesystem::path output;
  Overwrite overwrite = Overwrite::refuse;
  ingest::IngestSettings ingest;
  georeference::GeoreferenceSettings georeference;
  align::GridSettings grid;
  Assign assign = Assign::clip;
  FarMapSettings far_map;
  ProblemPolicy problems = ProblemPolicy::pack;
  /// If set, the cells, the neighborhood and the tolerance of the far maps are chosen to keep an error, and those of `grid` and
  /// `far_map` are not used.
  std::optional<ChoiceSettings> choice;
  std::optional<FarMapArea> area = {};
  PackPart part = PackPart::whole;
  bool resume = false;
  Shard shard = {};  ///< with PackPart::shard
};

/// Throws InvalidArgument where a setting is not what its declaration promises.
[[nodiscard]] StageSettings resolved(const PackSettings& settings);

/// The counts and measurements of a run, and what the package says of itself.
struct PackedCity : PackResult {
  package::Manifest manifest;
};

/// Runs the stages from city files to a package: ingest, georeference, align, tiles, far maps, package. What an earlier run of
/// the same origin has finished is taken over. Problems of single buildings are reported. Throws what farlod::pack throws, and
/// OcclusionError. If problems are refused, throws ProblemsRefused when the report is complete, after the tiles and before the
/// far maps; nothing is written then.
PackedCity pack(const StageSettings& settings, Report& report, const RunSettings& run = {}, const OnEstimate& on_estimate = {});

}  // namespace farlod::pipeline

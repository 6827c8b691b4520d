// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "align/align.hpp"
#include "city/problem.hpp"
#include "farmap/far_map_baker.hpp"
#include "georeference/georeference.hpp"
#include "ingest/ingest.hpp"
#include "package/package_writer.hpp"
#include "pipeline/grid_choice.hpp"
#include "pipeline/pack_estimate.hpp"
#include "tiles/tiles.hpp"

namespace farlod::pipeline {

/// Whether a city with problems is packed.
enum class ProblemPolicy { pack, refuse };

/// The city has problems, and ProblemPolicy refuses them.
class ProblemsRefused : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The settings of a run of `farlod-pack`.
struct PackSettings {
  std::vector<std::filesystem::path> inputs;  ///< files, folders and archives; may be empty when there is a terrain
  std::optional<std::filesystem::path> terrain;
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
  /// If set, a run that is expected to need more memory ends before the long stages.
  std::optional<std::uint64_t> memory_limit_mib;
};

/// The grid that was chosen to keep an error, and its error at receivers that were not used for the choice.
struct ChosenGrid {
  std::optional<GridChoice> best;  ///< none: nothing keeps the error, and the settings were taken as they are
  FarErrorEstimate measured;
};

/// The counts and measurements of a run.
struct PackResult {
  package::Manifest manifest;
  align::Alignment alignment;
  std::optional<ChosenGrid> chosen;
  std::uint64_t facets = 0;        ///< polygons as the files have them: a surface of a mesh is made of several triangles
  std::uint64_t foundations = 0;   ///< buildings whose lowest floor was closed down to the ground
  SkippedFeatures skipped;         ///< features of the files that are not used
  std::vector<std::string> notes;  ///< for the user: what was read from files beside the inputs, or assumed
  std::uint64_t package_bytes = 0, far_map_bytes = 0;
  PackEstimate estimate;  ///< made when the grid was laid
  /// In the order in which the stages ran. The package is written while far maps are baked, so that these two overlap.
  std::vector<std::pair<std::string, double>> stage_seconds;
};

/// Called with the progress of a run: the stage, and how much of it is done.
using PackProgress = std::function<void(const std::string& stage, std::size_t done, std::size_t all)>;
/// Called before the long stages with what they are expected to need.
using OnEstimate = std::function<void(const PackEstimate&)>;

/// Runs the stages from city files to a package: ingest, georeference, align, tiles, far maps, package. Problems of single
/// buildings are reported. Throws InputError, PackageWriteError, MemoryLimitError or OcclusionError. If problems are refused,
/// throws ProblemsRefused when the report is complete, after the tiles and before the far maps; nothing is written then.
PackResult pack(const PackSettings& settings, Report& report, const PackProgress& progress, const OnEstimate& on_estimate = {});

}  // namespace farlod::pipeline

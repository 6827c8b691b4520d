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

/// What to do with a city that has problems.
enum class ProblemPolicy { pack, refuse };

/// The city has problems, and was to have none.
class ProblemsRefused : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Everything that `farlod-pack` can be told.
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
  /// Choose the cells, the neighborhood and the far maps' tolerance such that an error is kept, instead of taking them from
  /// `grid` and `far_map`.
  std::optional<ChoiceSettings> choice;
  /// End the run before the long work when it is expected to need more.
  std::optional<std::uint64_t> memory_limit_mib;
};

/// What was chosen to keep an error, and what it was then measured to do with receivers that did not take part in the choice.
struct ChosenGrid {
  std::optional<GridChoice> best;  ///< none: nothing keeps the error, and the settings were taken as they are
  FarErrorEstimate measured;
};

/// What came of it.
struct PackResult {
  package::Manifest manifest;
  align::Alignment alignment;
  std::optional<ChosenGrid> chosen;
  std::uint64_t facets = 0;        ///< polygons as the files have them: a surface of a mesh is made of several triangles
  std::uint64_t foundations = 0;   ///< buildings whose lowest floor was closed down to the ground
  SkippedFeatures skipped;         ///< what the files hold that is not used
  std::vector<std::string> notes;  ///< for the user: what was taken from beside the inputs, or guessed
  std::uint64_t package_bytes = 0, far_map_bytes = 0;
  PackEstimate estimate;  ///< made when the grid was laid
  /// In the order in which the stages ran. The package is written while far maps are baked: together they take less than the sum.
  std::vector<std::pair<std::string, double>> stage_seconds;
};

/// Is told how far the work is: the stage, and how much of it is done.
using PackProgress = std::function<void(const std::string& stage, std::size_t done, std::size_t all)>;
/// Is told, before the long work, what it will need.
using TellEstimate = std::function<void(const PackEstimate&)>;

/// From city files to a package: ingest, georeference, align, tiles, far maps, package.
/// Throws InputError, PackageWriteError, MemoryLimitError or OcclusionError; what is wrong with single buildings goes to the
/// report. Where problems are refused, throws ProblemsRefused as soon as the report is complete: after the tiles, before far
/// maps, and with nothing written.
PackResult pack(const PackSettings& settings, Report& report, const PackProgress& progress, const TellEstimate& tell = {});

}  // namespace farlod::pipeline

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "align/align.hpp"
#include "farlod/pack.hpp"
#include "farmap/far_map_settings.hpp"
#include "georeference/georeference.hpp"
#include "ingest/ingest.hpp"
#include "package/manifest.hpp"
#include "pipeline/grid_choice.hpp"

namespace farlod::pipeline {

/// What of a package a run makes.
enum class PackPart { whole, shard, merge };

/// From which files a package is made, and what each stage is told.
struct StageSettings {
  std::vector<std::filesystem::path> inputs;  ///< files, folders and archives; may be empty when there is a terrain
  std::optional<std::filesystem::path> terrain;
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

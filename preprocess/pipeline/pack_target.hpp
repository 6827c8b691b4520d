// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "farmap/city_horizon.hpp"
#include "georeference/area_reader.hpp"
#include "package/existing_package.hpp"
#include "package/package_origin.hpp"
#include "package/unfinished_package.hpp"
#include "pipeline/block_plan.hpp"
#include "pipeline/city_record.hpp"
#include "pipeline/pack.hpp"

namespace farlod::pipeline {

/// Refuses an output below a file. Throws OutputError.
void require_folders_above(const std::filesystem::path& output);

/// Where a run puts its package: what is there already, what an earlier run has left, and what other processes make beside it.
class PackTarget {
 public:
  /// Refuses, before the long stages, an output that cannot be one. A shard waits here while another one reads the city. Throws
  /// InputError, OutputError, Busy, Cancelled.
  PackTarget(const StageSettings& settings, const PackageOrigin& origin, const std::stop_token& stop);
  /// What shards have made, and what is known of their city. Throws OutputError, which names what is missing; Busy.
  [[nodiscard]] static std::pair<PackTarget, CityRecord> to_merge(const StageSettings& settings,
                                                                  const std::optional<PackageOrigin>& origin);

  /// For the user.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
  [[nodiscard]] const UnfinishedPackage& unfinished() const { return unfinished_; }
  [[nodiscard]] std::filesystem::path city_folder() const { return unfinished_.city_folder(); }
  /// The package that is there, to which far maps are added or which is made whole.
  [[nodiscard]] const ExistingPackage* existing() const { return existing_ ? &*existing_ : nullptr; }
  /// What another process has saved of the city.
  [[nodiscard]] const std::optional<CityRecord>& saved_city() const { return saved_city_; }

  /// The blocks to make, once CRS, grid, settings and inputs are known. Adds notes. Throws what plan_area() throws, and
  /// OutputError when the package that is there is of another city, grid or settings.
  [[nodiscard]] BlockPlan plan(const Georeference& georeference, PackedCity& result) const;
  /// Once the tiles are described. Throws OutputError.
  void require_same_city(const TileSet& tiles, const package::Manifest& manifest) const;
  /// For the other shards, which wait for it. `horizon` is null for far maps of the kind `box`.
  void save_city(const TileSet& tiles, const CityHorizon* horizon, const CityRecord& record, const std::stop_token& stop);
  /// Gives the package its name, when all blocks are made. Completes the manifest and the counts of the result. Throws
  /// OutputError.
  void publish(CityRecord& record);

 private:
  PackTarget(const StageSettings& settings, UnfinishedPackage unfinished);
  void find_saved_city();

  const StageSettings* settings_;
  std::filesystem::path package_;
  std::optional<georeference::RequestedArea> area_;
  std::optional<ExistingPackage> existing_;
  UnfinishedPackage unfinished_;
  std::optional<FileLock> shard_lock_, city_lock_;
  std::optional<CityRecord> saved_city_;
  std::vector<std::string> notes_;
};

}  // namespace farlod::pipeline

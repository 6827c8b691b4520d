// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "base/grid.hpp"
#include "city/city_model.hpp"
#include "farlod/problem.hpp"
#include "farmap/city_horizon.hpp"
#include "georeference/area_reader.hpp"
#include "package/existing_package.hpp"
#include "package/sources_file.hpp"
#include "package/tile_set.hpp"
#include "package/unfinished_package.hpp"
#include "pipeline/blocks.hpp"
#include "pipeline/city_reading.hpp"
#include "pipeline/pack.hpp"
#include "pipeline/pack_estimate.hpp"

namespace farlod::pipeline {

/// What is known of a city once it is cut: all that its package and its report say, but for the blocks. With SavedCity, another
/// process goes on from there as the one that cut it.
struct CityRecord {
  PackedCity result;  ///< without seconds; its manifest has no blocks yet
  PackMemory memory;
  BlockPlan plan;
  std::vector<double> costs;  ///< of the blocks of the plan
  std::vector<Problem> problems;
};

[[nodiscard]] std::string record_text(const CityRecord& record);
/// Nothing where the text is none.
[[nodiscard]] std::optional<CityRecord> city_record_from(const std::string& text);

}  // namespace farlod::pipeline

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
  /// Natural relief, once it is cut, gets no far maps but those that are asked for. Nothing for other cities.
  [[nodiscard]] std::optional<BlockPlan> plan_of_relief(PackedCity& result) const;
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

/// From what a run makes its package. The contents of all files count, with those that lie beside them and are read with them. A
/// file that `earlier` knows, and that was not written since, is not read for that. Throws InputError.
[[nodiscard]] PackageOrigin origin_of(const StageSettings& settings, const CityFiles& files,
                                      const std::optional<PackageOrigin>& earlier);

/// What the manifest says of the inputs: those that the user named or that were found, in their order.
[[nodiscard]] std::vector<package::InputFile> inputs_of(const PackageOrigin& origin);

/// The files into which attributes can be inserted, in the order of `placed` (LocatedCity), with their inputs.
[[nodiscard]] std::vector<std::optional<SourceOfPackage>> sources_of(const PackageOrigin& origin,
                                                                     std::vector<std::optional<PlacedFile>> placed);

/// Throws InputError where a file has changed or vanished since its origin was told.
void require_unchanged(const PackageOrigin& origin);

}  // namespace farlod::pipeline

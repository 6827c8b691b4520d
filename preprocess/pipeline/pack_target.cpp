// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/pack_target.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include "base/shard_parts.hpp"
#include "farlod/error.hpp"
#include "package/layout.hpp"
#include "package/package_place.hpp"
#include "package/written_stamp.hpp"
#include "pipeline/saved_city.hpp"

namespace farlod::pipeline {
namespace {

namespace fs = std::filesystem;

georeference::RequestedArea requested(const FarMapArea& area) {
  if (const auto* file = std::get_if<fs::path>(&area)) return georeference::read_area(*file);
  return {"The area", {{area_of(std::get<Box2d>(area)), {}}}};
}

/// The folder that a name leads to: it is replaced, and a link to it stays. Without a slash behind it.
fs::path folder_of_output(const fs::path& output) {
  std::error_code unread;
  const fs::path named = output.has_filename() ? output : output.parent_path();
  return fs::is_symlink(named, unread) ? fs::weakly_canonical(named, unread) : named;
}

/// The package that is there and is not replaced.
std::optional<ExistingPackage> existing_package(const StageSettings& settings, const fs::path& package,
                                                const PackageOrigin& origin) {
  remove_replaced_packages(package);
  const bool may_be_there =
      settings.overwrite == Overwrite::refuse && (settings.area || settings.resume || was_just_published(package, origin));
  std::optional<ExistingPackage> existing = may_be_there ? ExistingPackage::find(package) : std::nullopt;
  std::error_code unread;
  // It is refused: nobody comes to go on with what a killed run has left beside it
  if (!existing && settings.overwrite == Overwrite::refuse && fs::exists(package / package::manifest_file, unread))
    UnfinishedPackage::remove_useless(package);
  existing ? require_replaceable(package) : require_room(package, settings.overwrite);
  return existing;
}

UnfinishedPackage opened(const StageSettings& settings, const fs::path& package, const PackageOrigin& origin) {
  using OfAnotherOrigin = UnfinishedPackage::OfAnotherOrigin;
  const bool is_shard = settings.part == PackPart::shard;
  return UnfinishedPackage::open(package, origin, is_shard ? LockKind::shared : LockKind::exclusive,
                                 is_shard || settings.resume ? OfAnotherOrigin::refuse : OfAnotherOrigin::replace);
}

/// Bytes of the package's files.
std::uint64_t bytes_of(const fs::path& package, const package::Manifest& manifest) {
  std::error_code unread;
  const std::uintmax_t of_manifest = fs::file_size(package / package::manifest_file, unread);
  std::uint64_t bytes = unread ? 0 : of_manifest;
  for (const package::BlockFiles& b : manifest.blocks) bytes += b.tiles.bytes + b.far_map.bytes;
  if (manifest.canopy) bytes += manifest.canopy->stamp.bytes;
  if (manifest.sources) bytes += manifest.sources->bytes;
  return bytes;
}

/// "shard 3/8: blocks 0_1 0_2; shard 5/8: blocks 1_1"
std::string missing_text(const CityRecord& record, const std::set<std::size_t>& missing, std::size_t shards) {
  std::string text;
  for (std::size_t index = 0; index < shards; ++index) {
    std::string blocks;
    for (const std::size_t n : parts_of_shard(record.costs, {index, shards}))
      if (missing.contains(n)) {
        const Block b = record.plan.blocks[n].block;
        blocks += " " + std::to_string(b.i) + "_" + std::to_string(b.j);
      }
    if (!blocks.empty())
      text += (text.empty() ? "" : "; ") + ("shard " + std::to_string(index) + "/" + std::to_string(shards)) + " (blocks" +
              blocks + ")";
  }
  return text;
}

}  // namespace

void require_folders_above(const fs::path& output) {
  // What cannot be looked at is refused when it is written
  std::error_code unread;
  for (fs::path above = fs::absolute(output, unread).parent_path(); above.has_relative_path(); above = above.parent_path())
    if (fs::exists(above, unread) && !fs::is_directory(above, unread))
      throw OutputError(output.string() + " cannot be written: " + above.string() + ": Not a directory");
}

PackTarget::PackTarget(const StageSettings& settings, const PackageOrigin& origin, const std::stop_token& stop)
    : settings_(&settings),
      package_(folder_of_output(settings.output)),
      existing_(existing_package(settings, package_, origin)),
      unfinished_(opened(settings, package_, origin)) {
  if (settings.area) area_ = requested(*settings.area);
  if (!unfinished_.finding().empty()) notes_.push_back(unfinished_.finding());
  find_saved_city();
  if (settings.part != PackPart::shard) return;
  shard_lock_ = unfinished_.lock_shard(settings.shard.index, settings.shard.count);
  if (saved_city_) return;
  city_lock_ = unfinished_.lock_city(stop);
  find_saved_city();
  if (saved_city_) city_lock_.reset();
}

PackTarget::PackTarget(const StageSettings& settings, UnfinishedPackage unfinished)
    : settings_(&settings), package_(folder_of_output(settings.output)), unfinished_(std::move(unfinished)) {}

void PackTarget::find_saved_city() {
  if (const auto text = SavedCity::find_record(unfinished_.city_folder())) saved_city_ = city_record_from(*text);
}

std::pair<PackTarget, CityRecord> PackTarget::to_merge(const StageSettings& settings,
                                                       const std::optional<PackageOrigin>& origin) {
  const fs::path package = folder_of_output(settings.output);
  auto unfinished = UnfinishedPackage::open_existing(package, LockKind::exclusive);
  if (!unfinished)
    throw OutputError("there is nothing to merge into " + package.string() + ": no shard has made a part of it (--shard).");
  const std::string what = origin ? difference(unfinished->origin(), *origin) : std::string();
  if (!what.empty())
    throw OutputError("the shards of " + package.string() + " are of another package: " + what + ". Give what they were given.");
  PackTarget target(settings, std::move(*unfinished));
  target.existing_ = existing_package(settings, package, target.unfinished_.origin());
  target.find_saved_city();
  if (!target.saved_city_)
    throw OutputError("the shards of " + package.string() + " have not read their city to the end: run them again.");
  CityRecord record = *target.saved_city_;
  std::set<std::size_t> missing;
  for (std::size_t n = 0; n < record.plan.blocks.size(); ++n) {
    const PlannedBlock& b = record.plan.blocks[n];
    if (!b.kept && !target.unfinished_.finished(b.block, b.mapped)) missing.insert(n);
  }
  if (!missing.empty())
    throw OutputError(package.string() + " is not complete: " +
                      missing_text(record, missing, target.unfinished_.shard_count().value_or(1)) + ". Run what is missing.");
  return {std::move(target), std::move(record)};
}

BlockPlan PackTarget::plan(const Georeference& georeference, PackedCity& result) const {
  const package::Manifest& manifest = result.manifest;
  if (existing_) existing_->require_same(manifest, Known::before_tiles);
  if (!area_) {
    BlockPlan plan = plan_all(manifest.grid, existing());
    if (plan.far_maps == 0) result.notes.emplace_back("The package is whole already");
    return plan;
  }
  BlockPlan plan = plan_area(*area_, georeference, manifest.grid, existing());
  if (plan.shapes_outside_of_grid > 0)
    result.notes.push_back("Shapes of the area that meet no cell of the grid: " + std::to_string(plan.shapes_outside_of_grid));
  if (plan.far_maps == 0) result.notes.emplace_back("All cells of the area have far maps already");
  return plan;
}

void PackTarget::require_same_city(const TileSet& tiles, const package::Manifest& manifest) const {
  existing_->require_same(manifest, Known::all);
  existing_->require_same_tiles(tiles, manifest.grid);
}

void PackTarget::save_city(const TileSet& tiles, const CityHorizon* horizon, const CityRecord& record,
                           const std::stop_token& stop) {
  farlod::save_city(unfinished_.city_folder(), tiles, horizon, record.result.manifest.grid, record_text(record), stop);
  city_lock_.reset();
}

void PackTarget::publish(CityRecord& record) {
  const auto require = [this](bool is_as_it_was) {
    if (!is_as_it_was) throw OutputError(unfinished_.package_folder().string() + " was changed while it was made: pack again.");
  };
  package::Manifest& manifest = record.result.manifest;
  const auto is_kept = [](const PlannedBlock& b) { return b.kept.has_value(); };
  const bool is_there = existing_ && std::ranges::all_of(record.plan.blocks, is_kept) && are_others_whole(package_, manifest);
  require(is_there || are_others_whole(unfinished_.package_folder(), manifest));
  manifest.blocks.clear();
  for (const PlannedBlock& b : record.plan.blocks) {
    if (b.kept && !is_there) unfinished_.adopt(package_, *b.kept);
    const auto files = b.kept ? b.kept : unfinished_.finished(b.block, b.mapped);
    require(files.has_value());
    manifest.blocks.push_back(*files);
  }
  if (existing_) existing_->require_unchanged();
  if (!is_there) {
    const std::string note = unfinished_.publish(manifest);
    if (!note.empty()) record.result.notes.push_back(note);
  }
  manifest.file_xxh3 = stamp_of(package_ / package::manifest_file).xxh3;
  record.result.package_bytes = bytes_of(package_, manifest);
}

}  // namespace farlod::pipeline

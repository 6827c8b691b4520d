// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/unfinished_package.hpp"

#include <chrono>
#include <fstream>
#include <map>
#include <set>
#include <system_error>
#include <thread>

#include "base/cancellation.hpp"
#include "base/durable_file.hpp"
#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "package/file_stamp.hpp"
#include "package/layout.hpp"
#include "package/package_folder.hpp"
#include "package/package_writer.hpp"

namespace farlod {
namespace {

std::string difference_of_inputs(const std::vector<PackageOrigin::Input>& was, const std::vector<PackageOrigin::Input>& is) {
  for (const PackageOrigin::Input& input : is)
    if (!input.is_known) return input.name + " is a pipe, and what came through it before is not known";
  if (was.size() != is.size())
    return "it was made of " + std::to_string(was.size()) + " input files, and there are " + std::to_string(is.size());
  for (std::size_t n = 0; n < is.size(); ++n) {
    if (was[n].name != is[n].name) return "its input was " + was[n].name + ", and is " + is[n].name;
    if (!was[n].is_known || was[n].stamp != is[n].stamp) return "the input " + is[n].name + " has changed";
  }
  return {};
}

std::string difference_of_settings(const std::vector<std::pair<std::string, std::string>>& was,
                                   const std::vector<std::pair<std::string, std::string>>& is) {
  const std::map<std::string, std::string> before(was.begin(), was.end()), now(is.begin(), is.end());
  std::set<std::string> names;
  for (const auto* settings : {&before, &now})
    for (const auto& [name, value] : *settings) names.insert(name);
  for (const std::string& name : names) {
    const auto old_value = before.find(name), value = now.find(name);
    if (old_value == before.end()) return "--" + name + " was not given, and is " + value->second;
    if (value == now.end()) return "--" + name + " was " + old_value->second + ", and is not given";
    if (old_value->second != value->second) return "--" + name + " was " + old_value->second + ", and is " + value->second;
  }
  return {};
}

}  // namespace

std::string difference(const PackageOrigin& was, const PackageOrigin& is) {
  if (was.software != is.software) return "the program was " + was.software + ", and is " + is.software;
  std::string of_settings = difference_of_settings(was.settings, is.settings);
  return of_settings.empty() ? difference_of_inputs(was.inputs, is.inputs) : of_settings;
}

namespace fs = std::filesystem;
namespace {

constexpr const char *lock_file = "lock", *origin_file = "origin.json", *finished_folder = "finished", *shards_folder = "shards",
                     *publishing_file = "publishing", *city_lock_file = "city.lock", *records_lock_file = "records.lock",
                     *shard_count_file = "count";

std::string stamp_text(const package::FileStamp& stamp) { return std::to_string(stamp.bytes) + " " + std::to_string(stamp.xxh3); }

[[noreturn]] void refuse_as_busy(const fs::path& lock, const fs::path& package) {
  const std::string holder = holder_of(lock);
  throw Busy("another farlod-pack is at work on " + package.string() + (holder.empty() ? "" : " (" + holder + ")") +
             ": wait for it, or choose another folder for -o.");
}

FileLock locked(const fs::path& package, LockKind kind) {
  const fs::path folder = unfinished_folder_of(package), lock = folder / lock_file;
  while (true) {
    make_folder(folder);
    try {
      if (auto held = FileLock::try_lock(lock, kind)) {
        if (kind == LockKind::exclusive) held->sign("packing");
        return std::move(*held);
      }
    } catch (const OutputError&) {
      // Another process may have removed the folder just now
      if (fs::exists(folder)) throw;
      continue;
    }
    refuse_as_busy(lock, package);
  }
}

FileLock wait_for(const fs::path& lock_path, const std::stop_token& stop) {
  constexpr std::chrono::milliseconds between_looks{50};
  while (true) {
    if (auto lock = FileLock::try_lock(lock_path, LockKind::exclusive)) return std::move(*lock);
    throw_if_cancelled(stop);
    std::this_thread::sleep_for(between_looks);
  }
}

}  // namespace

fs::path unfinished_folder_of(const fs::path& package) {
  // A name that ends in a slash has no file name of its own
  const fs::path named = package.has_filename() ? package : package.parent_path();
  return named.string() + ".unfinished";
}

std::optional<PackageOrigin> origin_of_unfinished(const fs::path& package) {
  return origin_from(text_of(unfinished_folder_of(package) / origin_file));
}

bool was_just_published(const fs::path& package, const PackageOrigin& origin) {
  const fs::path folder = unfinished_folder_of(package), named = package / package::manifest_file;
  const std::string published = text_of(folder / publishing_file);
  std::error_code unread;
  if (published.empty() || !fs::is_regular_file(named, unread) || stamp_text(stamp_of(named)) != published) return false;
  const auto before = origin_from(text_of(folder / origin_file));
  return before && difference(*before, origin).empty();
}

UnfinishedPackage::UnfinishedPackage(fs::path package, FileLock lock, LockKind kind)
    : package_(std::move(package)), folder_(unfinished_folder_of(package_)), lock_(std::move(lock)), kind_(kind) {}

UnfinishedPackage::UnfinishedPackage(UnfinishedPackage&& other) noexcept
    : package_(std::move(other.package_)),
      folder_(std::move(other.folder_)),
      lock_(std::exchange(other.lock_, std::nullopt)),
      kind_(other.kind_),
      origin_(std::move(other.origin_)),
      finding_(std::move(other.finding_)) {}

UnfinishedPackage& UnfinishedPackage::operator=(UnfinishedPackage&& other) noexcept {
  std::swap(package_, other.package_);
  std::swap(folder_, other.folder_);
  std::swap(lock_, other.lock_);
  std::swap(kind_, other.kind_);
  std::swap(origin_, other.origin_);
  std::swap(finding_, other.finding_);
  return *this;
}

UnfinishedPackage::~UnfinishedPackage() {
  if (!lock_) return;
  std::error_code ignored;
  if (kind_ == LockKind::shared) {
    // Only who has the folder for itself may remove it
    lock_.reset();
    if (fs::exists(folder_, ignored)) {
      auto alone = FileLock::try_lock_existing(folder_ / lock_file, LockKind::exclusive);
      if (!alone) return;
      lock_ = std::move(alone);
    }
  }
  if (!holds_work()) fs::remove_all(folder_, ignored);
}

UnfinishedPackage UnfinishedPackage::open(const fs::path& package, const PackageOrigin& origin, LockKind kind,
                                          OfAnotherOrigin of_another) {
  UnfinishedPackage unfinished(package, locked(package, kind), kind);
  unfinished.begin(origin, of_another);
  return unfinished;
}

std::optional<UnfinishedPackage> UnfinishedPackage::open_existing(const fs::path& package, LockKind kind) {
  std::error_code unread;
  if (!fs::exists(unfinished_folder_of(package) / origin_file, unread)) return std::nullopt;
  UnfinishedPackage unfinished(package, locked(package, kind), kind);
  unfinished.finish_publishing();
  const auto origin = origin_from(text_of(unfinished.folder_ / origin_file));
  if (!origin) return std::nullopt;
  unfinished.origin_ = *origin;
  return unfinished;
}

void UnfinishedPackage::remove_useless(const fs::path& package) {
  auto lock = FileLock::try_lock_existing(unfinished_folder_of(package) / lock_file, LockKind::exclusive);
  if (!lock) return;
  UnfinishedPackage leftover(package, std::move(*lock), LockKind::exclusive);
  leftover.finish_publishing();
  // Its destructor removes a folder without work
}

void UnfinishedPackage::begin(const PackageOrigin& origin, OfAnotherOrigin of_another) {
  if (kind_ == LockKind::exclusive) finish_publishing();
  // Several shards may begin at once: the first one notes down what all are part of
  const FileLock alone = lock_records();
  const auto before = origin_from(text_of(folder_ / origin_file));
  origin_ = origin;
  if (before) {
    const std::string what = difference(*before, origin);
    if (what.empty()) {
      finding_ = "Going on with what an earlier run has left: " + std::to_string(finished_blocks()) + " finished blocks.";
      return;
    }
    if (of_another == OfAnotherOrigin::refuse || kind_ == LockKind::shared)
      throw OutputError(folder_.string() + " holds what an earlier run has left of another package: " + what +
                        ". Give the same inputs and options, or remove that folder.");
    finding_ = "Removed what an earlier run had left of another package (" + what + ").";
  }
  remove_all_but_lock();
  make_folder(package_folder() / "blocks");
  make_folder(folder_ / finished_folder);
  write_durably(folder_ / origin_file, record_text(origin));
}

void UnfinishedPackage::remove_all_but_lock() const {
  std::error_code ignored;
  std::vector<fs::path> others;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, ignored))
    if (entry.path().extension() != ".lock" && entry.path().filename() != lock_file) others.push_back(entry.path());
  // First what says that the rest is worth anything
  fs::remove(folder_ / origin_file, ignored);
  for (const fs::path& other : others) fs::remove_all(other, ignored);
}

FileLock UnfinishedPackage::lock_city(const std::stop_token& stop) const {
  FileLock lock = wait_for(folder_ / city_lock_file, stop);
  lock.sign("reading the city");
  return lock;
}

/// Held for some lines of code only.
FileLock UnfinishedPackage::lock_records() const { return wait_for(folder_ / records_lock_file, {}); }

FileLock UnfinishedPackage::lock_shard(std::size_t index, std::size_t count) const {
  const fs::path shards = folder_ / shards_folder;
  make_folder(shards);
  const fs::path lock_path = shards / (std::to_string(index) + ".lock");
  auto lock = FileLock::try_lock(lock_path, LockKind::exclusive);
  const std::string name = "shard " + std::to_string(index) + "/" + std::to_string(count);
  if (!lock)
    throw Busy("another process has " + name + " of " + package_.string() + " (" + holder_of(lock_path) +
               "): each shard is for one process.");
  lock->sign(name);
  const FileLock alone = lock_records();
  const std::optional<std::size_t> counted = shard_count();
  if (counted && *counted != count)
    throw OutputError(package_.string() + " is being made in " + std::to_string(*counted) + " shards, and --shard says " +
                      std::to_string(count) + ": give the same number to all.");
  if (!counted) write_durably(shards / shard_count_file, std::to_string(count));
  return std::move(*lock);
}

std::optional<std::size_t> UnfinishedPackage::shard_count() const {
  std::ifstream file(folder_ / shards_folder / shard_count_file);
  std::size_t count = 0;
  return file >> count ? std::optional(count) : std::nullopt;
}

fs::path UnfinishedPackage::record_of(const package::BlockFiles& files) const {
  return folder_ / finished_folder / (fs::path(package::folder_of(files)).filename().string() + ".json");
}

std::optional<package::BlockFiles> UnfinishedPackage::finished(Block block,
                                                               const std::optional<package::CellRuns>& mapped) const {
  const auto files = block_files_from(text_of(record_of({block, {}, {}, mapped})));
  if (!files || files->block != block || files->mapped != mapped) return std::nullopt;
  return are_whole(package_folder(), *files) ? files : std::nullopt;
}

void UnfinishedPackage::record(const package::BlockFiles& files) const { write_durably(record_of(files), record_text(files)); }

void UnfinishedPackage::adopt(const fs::path& package, const package::BlockFiles& files) const {
  const fs::path from = package / package::folder_of(files), to = package_folder() / package::folder_of(files);
  make_folder(to);
  for (const char* const name : {package::tiles_file, package::far_map_file}) {
    if (name == package::far_map_file && !files.has_far_maps()) continue;
    std::error_code error;
    fs::remove(to / name, error);
    fs::create_hard_link(from / name, to / name, error);
    // Not every file system has links
    if (error) error.clear(), fs::copy_file(from / name, to / name, error);
    if (error) throw OutputError((to / name).string() + " cannot be written: " + error.message());
  }
}

std::size_t UnfinishedPackage::finished_blocks() const {
  std::error_code unread;
  std::size_t count = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / finished_folder, unread))
    count += is_unfinished_file(entry.path()) ? 0U : 1U;
  return count;
}

bool UnfinishedPackage::holds_work() const {
  std::error_code unread;
  return finished_blocks() > 0 || fs::exists(city_folder() / city_record_file, unread) ||
         fs::exists(folder_ / publishing_file, unread);
}

std::string UnfinishedPackage::publish(const package::Manifest& manifest) {
  FARLOD_EXPECTS(kind_ == LockKind::exclusive && lock_.has_value());
  const std::string text = manifest_text(manifest);
  write_durably(package_folder() / package::manifest_file, text);
  // From here on, whoever comes knows which of the two packages is the new one
  write_durably(folder_ / publishing_file, stamp_text(stamp_of(std::as_bytes(std::span(text)))));
  put_in_place(package_folder(), package_, folder_ / "aside");
  std::string note = dispose_of_package(package_folder(), package_);
  std::error_code ignored;
  remove_all_but_lock();
  fs::remove_all(folder_, ignored);
  return note;
}

void UnfinishedPackage::finish_publishing() {
  std::error_code ignored;
  const fs::path aside = folder_ / "aside", named = package_ / package::manifest_file;
  // Killed where the file system needs several steps
  if (!fs::exists(package_, ignored) && fs::exists(aside, ignored)) move_package(aside, package_);
  const std::string published = text_of(folder_ / publishing_file);
  if (published.empty()) return;
  if (fs::is_regular_file(named, ignored) && stamp_text(stamp_of(named)) == published) {
    finding_ = dispose_of_package(fs::exists(aside, ignored) ? aside : package_folder(), package_);
    remove_all_but_lock();
  } else {
    fs::remove(folder_ / publishing_file, ignored);
    fs::remove(package_folder() / package::manifest_file, ignored);
  }
}

}  // namespace farlod

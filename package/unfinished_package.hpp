// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "base/file_lock.hpp"
#include "package/manifest.hpp"

namespace farlod {

/// From what a package is made: whatever decides its bytes. Two runs of the same origin make the same package.
struct PackageOrigin {
  struct Input {
    std::string name;
    package::FileStamp stamp;
    /// What comes through a pipe has no stamp before it was read: it is another one each time.
    bool is_known = true;
    bool is_beside = false;  ///< read together with an input, and not one itself
    // Where the file was, and when it was last written: who finds it the same need not read it. Not compared.
    std::string path = {};
    std::int64_t written_ns = 0;
  };

  std::string software;
  std::vector<Input> inputs;
  /// Options that were given, and their values, in a fixed order.
  std::vector<std::pair<std::string, std::string>> settings;
};

/// The first difference, for people: "the input town.gml has changed", "--cell was 150, and is 100"; empty if there is none.
[[nodiscard]] std::string difference(const PackageOrigin& was, const PackageOrigin& is);

// What an unfinished package notes down for the process that goes on with it. A text that is none of these gives nothing: what it
// says is made anew.

[[nodiscard]] std::string record_text(const PackageOrigin& origin);
[[nodiscard]] std::optional<PackageOrigin> origin_from(const std::string& text);

[[nodiscard]] std::string record_text(const package::BlockFiles& files);
[[nodiscard]] std::optional<package::BlockFiles> block_files_from(const std::string& text);

/// The folder in which a package is made, NAME.farlod.unfinished beside NAME.farlod. A package has its name when it is whole, and
/// never changes from then on. What is finished of it outlives the process that made it, however that ends, so that another one
/// of the same origin goes on with it.
///   lock          who is at work
///   origin.json   from what the package is made
///   finished/     a record of each finished block
///   package/      what will be the package: blocks, and in the end the manifest
///   city/         the city in tiles (SavedCity), where several processes bake its far maps
///   shards/       their locks
class UnfinishedPackage {
 public:
  /// What becomes of a folder in which a package of another origin was made.
  enum class OfAnotherOrigin { refuse, replace };

  /// Makes the folder where there is none, and locks it. Brings to an end what an earlier run had begun when it put its package
  /// in its place. Throws OutputError: another process is at work, the origin is another one, or the disk refuses.
  [[nodiscard]] static UnfinishedPackage open(const std::filesystem::path& package, const PackageOrigin& origin, LockKind kind,
                                              OfAnotherOrigin of_another);
  /// The one that is there, of whatever origin. Nothing where there is none.
  [[nodiscard]] static std::optional<UnfinishedPackage> open_existing(const std::filesystem::path& package, LockKind kind);
  UnfinishedPackage(UnfinishedPackage&&) noexcept;
  UnfinishedPackage& operator=(UnfinishedPackage&&) noexcept;
  /// Removes the folder where nothing in it is finished.
  ~UnfinishedPackage();

  [[nodiscard]] const PackageOrigin& origin() const { return origin_; }
  /// What was found when it was opened, for the user; empty if nothing.
  [[nodiscard]] const std::string& finding() const { return finding_; }
  [[nodiscard]] std::filesystem::path package_folder() const { return folder_ / "package"; }
  [[nodiscard]] std::filesystem::path city_folder() const { return folder_ / "city"; }

  /// Waits until no other process makes the city that all share. Throws Cancelled when `stop` is asked for meanwhile.
  [[nodiscard]] FileLock lock_city(const std::stop_token& stop) const;
  /// Locks one of several shards. Throws OutputError where another process has it, or where the shards were counted otherwise.
  [[nodiscard]] FileLock lock_shard(std::size_t index, std::size_t count) const;
  /// The number of shards, once there is one.
  [[nodiscard]] std::optional<std::size_t> shard_count() const;

  /// The files of a block which has far maps for these cells, if they are finished, and as they were written.
  [[nodiscard]] std::optional<package::BlockFiles> finished(Block block, const std::optional<package::CellRuns>& mapped) const;
  /// The files are in package_folder().
  void record(const package::BlockFiles& files) const;
  /// Removes what a killed run has left beside a package, where it is of no use and nobody is at work there.
  static void remove_useless(const std::filesystem::path& package);

  /// Takes a block from a package, whose files stay: they have two names then, or are copied.
  void adopt(const std::filesystem::path& package, const package::BlockFiles& files) const;

  /// Writes the manifest, and gives the package its name. One that has the name already is removed, or kept under another name
  /// while a process reads it. Removes all that is left. Returns what the user should know; empty if nothing. The lock must be
  /// exclusive.
  [[nodiscard]] std::string publish(const package::Manifest& manifest);

 private:
  UnfinishedPackage(std::filesystem::path package, FileLock lock, LockKind kind);
  void begin(const PackageOrigin& origin, OfAnotherOrigin of_another);
  [[nodiscard]] FileLock lock_records() const;
  void finish_publishing();
  [[nodiscard]] std::filesystem::path record_of(const package::BlockFiles& files) const;
  [[nodiscard]] std::size_t finished_blocks() const;
  [[nodiscard]] bool holds_work() const;
  void remove_all_but_lock() const;
  [[nodiscard]] std::string dispose_of(const std::filesystem::path& old_package) const;

  std::filesystem::path package_, folder_;
  std::optional<FileLock> lock_;  ///< nothing in an object that was moved from
  LockKind kind_;
  PackageOrigin origin_;
  std::string finding_;
};

/// The record of a city that is saved in UnfinishedPackage::city_folder(). It is there when the city is whole.
inline constexpr const char* city_record_file = "city.json";

/// Whether a run of this origin was killed after the package had got its name: what is there is what it was to make.
[[nodiscard]] bool was_just_published(const std::filesystem::path& package, const PackageOrigin& origin);

/// The origin of the unfinished package that is there; nothing where there is none. Takes no lock.
[[nodiscard]] std::optional<PackageOrigin> origin_of_unfinished(const std::filesystem::path& package);

/// Beside a package, where it is made.
[[nodiscard]] std::filesystem::path unfinished_folder_of(const std::filesystem::path& package);

}  // namespace farlod

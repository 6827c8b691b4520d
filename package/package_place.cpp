// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/package_place.hpp"

#include <sys/stat.h>

#include <optional>
#include <regex>
#include <system_error>
#include <utility>
#include <vector>

#include "base/file_lock.hpp"
#include "base/folder_swap.hpp"
#include "farlod/error.hpp"
#include "package/layout.hpp"

namespace farlod {
namespace fs = std::filesystem;
namespace {

constexpr const char* replaced_ending = ".replaced-";

/// Whether a path within a package's folder is that of something that packages consist of, in any version.
bool is_of_packages(const fs::path& within) {
  static const std::regex known(
      R"((manifest\.json|crowns\.bin|sources\.bin|blocks|blocks/-?[0-9]+_-?[0-9]+(_[0-9]+)?(/(tiles\.bin|far\.exr))?)(\.part)?)");
  return std::regex_match(within.generic_string(), known);
}

/// Only what a package consists of may be swept away: a mistyped -o must not cost anybody their files.
void require_package_or_empty(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path within = entry.path().lexically_relative(folder);
    if (!is_of_packages(within))
      throw OutputError(folder.string() + " holds " + within.string() +
                        ", which is not part of a package: choose another folder for -o.");
  }
}

/// A disk that is mounted there keeps its name.
bool is_mount_point(const fs::path& folder) {
  struct stat own {
  }, above{};
  return stat(folder.c_str(), &own) == 0 && stat((folder / "..").c_str(), &above) == 0 && own.st_dev != above.st_dev;
}

/// Nobody reads it, or nobody can.
std::optional<FileLock> locked_for_removal(const fs::path& package) {
  return FileLock::try_lock_existing(package / package::manifest_file, LockKind::exclusive);
}

/// With the manifest first, so that a half-swept package is none.
void sweep(const fs::path& package) {
  std::error_code ignored;
  fs::remove(package / package::manifest_file, ignored);
  fs::remove_all(package, ignored);
}

fs::path free_name_beside(const fs::path& package) {
  for (int n = 1;; ++n)
    if (fs::path name = package.string() + replaced_ending + std::to_string(n); !fs::exists(name)) return name;
}

}  // namespace

void require_replaceable(const fs::path& folder) {
  try {
    if (!fs::exists(folder)) return;
    if (!fs::is_directory(folder)) throw OutputError(folder.string() + " is a file: choose another name for -o.");
    require_package_or_empty(folder);
    if (is_mount_point(folder))
      throw OutputError(folder.string() + " is the root of a disk, which cannot be replaced: name a folder in it for -o.");
  } catch (const fs::filesystem_error& reason) {
    throw OutputError(folder.string() + " cannot be written: " + reason.code().message());
  }
}

void require_room(const fs::path& folder, Overwrite overwrite) {
  require_replaceable(folder);
  // What has blocks and no manifest was never finished
  std::error_code unread;
  if (overwrite == Overwrite::refuse && fs::exists(folder / package::manifest_file, unread))
    throw OutputError(folder.string() + " exists already: let it be replaced (--force), or choose another folder.");
}

void put_in_place(const fs::path& finished, const fs::path& package, const fs::path& aside) {
  std::error_code unread;
  fs::exists(package, unread) ? swap_folders(finished, package, aside) : move_folder(finished, package);
}

void move_package(const fs::path& from, const fs::path& to) { move_folder(from, to); }

std::string dispose_of_package(const fs::path& old, const fs::path& package) {
  std::error_code unread;
  if (!fs::exists(old, unread)) return {};
  if (!fs::exists(old / package::manifest_file, unread) || locked_for_removal(old)) {
    sweep(old);
    return {};
  }
  const fs::path kept = free_name_beside(package);
  move_folder(old, kept);
  return "The package that was replaced is still being read: it is kept as " + kept.string() +
         " until a later run of farlod-pack finds that nobody reads it.";
}

void remove_replaced_packages(const fs::path& package) {
  const std::string prefix = package.filename().string() + replaced_ending;
  const fs::path folder = package.has_parent_path() ? package.parent_path() : ".";
  std::error_code unread;
  std::vector<fs::path> kept;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, unread)) {
    const std::string name = entry.path().filename().string();
    const bool ends_in_digits = name.size() > prefix.size() && name.find_first_not_of("0123456789", prefix.size()) == name.npos;
    if (name.starts_with(prefix) && ends_in_digits && entry.is_directory(unread)) kept.push_back(entry.path());
  }
  for (const fs::path& old : kept)
    if (!fs::exists(old / package::manifest_file, unread) || locked_for_removal(old)) sweep(old);
}

}  // namespace farlod

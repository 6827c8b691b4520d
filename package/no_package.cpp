// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/no_package.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "base/nearest_word.hpp"
#include "base/unread_file.hpp"
#include "package/layout.hpp"

namespace farlod {
namespace {

namespace fs = std::filesystem;

bool is_package(const fs::path& folder) {
  std::error_code unread;
  return fs::is_regular_file(folder / package::manifest_file, unread);
}

/// The package that a path leads into.
std::optional<fs::path> package_around(const fs::path& name) {
  constexpr int most_levels = 3;  // blocks/0_0/tiles.bin
  fs::path folder = name;
  for (int level = 0; level < most_levels; ++level) {
    folder = folder.has_filename() ? folder.parent_path() : folder.parent_path().parent_path();
    if (folder.empty()) return std::nullopt;
    if (is_package(folder)) return folder;
  }
  return std::nullopt;
}

PackageUnusable missing(const fs::path& name) {
  const fs::path folder = name.parent_path();
  std::vector<fs::path> packages;
  for (const std::string& entry : names_in_folder(folder))
    if (is_package(folder / entry)) packages.push_back(folder / entry);
  // Without the ending, which all have and which makes any two names alike
  std::vector<std::string> stems;
  for (const fs::path& package : packages) stems.push_back(package.stem().string());
  const std::string what = name.string() + " is not a package: there is no such folder";
  const std::optional<std::string> nearest = nearest_word(name.stem().string(), stems);
  if (!nearest) return PackageUnusable(what + ". farlod-pack makes one.");
  const auto place = std::ranges::find(stems, *nearest) - stems.begin();
  return PackageUnusable(what + "; did you mean " + packages[static_cast<std::size_t>(place)].string() + "?");
}

/// A folder that is there, and no package.
PackageUnusable of_folder(const fs::path& name) {
  const std::vector<std::string> entries = names_in_folder(name);
  if (entries.empty()) return PackageUnusable(name.string() + " is an empty folder, and not a package: farlod-pack makes one.");
  std::error_code unread;
  if (fs::exists(name / "blocks", unread))
    return PackageUnusable(name.string() + " is not a finished package: it has no " + package::manifest_file +
                           ". Was farlod-pack interrupted? Pack the city again.");
  if (const auto inner = std::ranges::find_if(entries, [&](const std::string& entry) { return is_package(name / entry); });
      inner != entries.end())
    return PackageUnusable(name.string() + " is not a package, but a folder with some: give one of them, such as " +
                           (name / *inner).string() + ".");
  return PackageUnusable(name.string() + " is not a package: it has no " + package::manifest_file + ", but " + entries.front() +
                         ". farlod-pack makes a package of a city: farlod-pack " + name.string() + " -o NAME.farlod");
}

}  // namespace

PackageUnusable no_package(const fs::path& name) {
  std::error_code unread;
  if (!fs::exists(name, unread)) return missing(name);
  if (const auto package = package_around(name))
    return PackageUnusable(name.string() + " is a part of the package " + package->string() + ": give that folder.");
  if (fs::is_directory(name, unread)) return of_folder(name);
  return PackageUnusable(name.string() + " is a file, and a package is a folder: farlod-pack " + name.string() +
                         " -o NAME.farlod makes one of a city file.");
}

}  // namespace farlod

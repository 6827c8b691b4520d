// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include "farlod/error.hpp"
#include "package/layout.hpp"

namespace farlod {

/// A file of a package whose version this program does not read is unusable; one of version 0, which never was, is damaged.
/// Versions from `oldest` to `newest` are read.
inline void require_readable_version(const std::string& file, std::uint32_t version, std::uint32_t oldest, std::uint32_t newest) {
  if (oldest <= version && version <= newest) return;
  if (version == 0) throw PackageDamaged(file + " is damaged: its format version does not exist. Pack the city again.");
  const std::string readable = oldest == newest ? "version " + std::to_string(newest)
                                                : "versions " + std::to_string(oldest) + " to " + std::to_string(newest);
  throw PackageUnusable(
      file + " has format version " + std::to_string(version) + ", this program reads " + readable + ". " +
      (version > newest ? "Use a newer release, or pack the city again." : "Pack the city again with this release."));
}

/// A file of a package: where it is opened, and what messages call it.
struct PackageFile {
  PackageFile(const std::filesystem::path& file) : path(file), name(file.string()) {}  // NOLINT: a path is a file's name, too
  PackageFile(std::filesystem::path opened, std::string shown) : path(std::move(opened)), name(std::move(shown)) {}

  std::filesystem::path path;
  std::string name;
};

/// The folder of an open package. It leads to the same files as long as it lives: farlod-pack may give its name to another
/// package meanwhile, and removes the old one when nobody has it open.
class PackageFolder {
 public:
  /// Throws PackageUnusable where there is no such folder.
  explicit PackageFolder(const std::filesystem::path& name);
  PackageFolder(PackageFolder&&) noexcept;
  PackageFolder& operator=(PackageFolder&&) noexcept;
  ~PackageFolder();

  /// As the user has named it.
  [[nodiscard]] const std::filesystem::path& name() const;
  /// A file in it. Throws PackageDamaged where one of that name is anything but a plain file in plain folders.
  [[nodiscard]] PackageFile plain_file(const std::filesystem::path& within) const;
  /// The same without a look at it.
  [[nodiscard]] PackageFile file(const std::filesystem::path& within) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A whole file, readable as memory. Throws PackageDamaged when it cannot be mapped: a package lists its files, so one that
/// is missing or unreadable is damage.
class MappedFile {
 public:
  explicit MappedFile(const PackageFile& file);
  MappedFile(MappedFile&&) noexcept;
  MappedFile& operator=(MappedFile&&) noexcept;
  ~MappedFile();

  /// Begins at a page, and stays where it is when the object is moved.
  [[nodiscard]] std::span<const std::byte> bytes() const;
  /// Gives the memory back that holds the bytes. They stay readable, and are read from the disk anew when somebody does.
  void let_go() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Throws PackageDamaged where a file of a package breaks a rule.
inline void require_whole(bool rule, const std::string& name, const char* what) {
  if (!rule) throw PackageDamaged(name + " is damaged: " + what + ". Pack the city again.");
}

/// What a file holds; nothing where it cannot be read.
[[nodiscard]] inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Makes a folder and those above it. Throws OutputError.
inline void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw OutputError(folder.string() + " cannot be made: " + error.message() +
                      "; choose another folder for -o, or see who may write there");
}

}  // namespace farlod

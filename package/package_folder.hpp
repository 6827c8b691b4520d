// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

namespace farlod {

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

}  // namespace farlod

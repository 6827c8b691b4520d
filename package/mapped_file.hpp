// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "package/package_folder.hpp"

namespace farlod {

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

}  // namespace farlod

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>

#include "farlod/package.hpp"
#include "package/package_reader.hpp"

namespace farlod {

/// What is behind a Package.
struct PackageContents {
  explicit PackageContents(const std::filesystem::path& place);

  std::filesystem::path folder;
  PackageReader reader;
  PackageDescription description;
  std::mutex runs_mutex;
  std::size_t runs = 0;  ///< that use the package now
};

/// A package while a run uses it: its contents stay, even when the caller closes it meanwhile, and its blocks have the memory
/// that the cells in flight of all runs need, and no more. Throws InvalidArgument when the package is closed, PackageDamaged when
/// a file of it is not what it was when it was opened.
class PackageInUse {
 public:
  explicit PackageInUse(const Package& package);
  ~PackageInUse();
  PackageInUse(const PackageInUse&) = delete;
  PackageInUse& operator=(const PackageInUse&) = delete;

  [[nodiscard]] const PackageReader& reader() const { return contents_->reader; }
  [[nodiscard]] const std::filesystem::path& folder() const { return contents_->folder; }

 private:
  void share_memory() const;

  std::shared_ptr<PackageContents> contents_;
};

}  // namespace farlod

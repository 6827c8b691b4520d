// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "package/crown.hpp"
#include "package/manifest.hpp"
#include "package/package_folder.hpp"

namespace farlod {

/// The `crowns.bin` of a package, mapped: what is read of it is in memory until it is let go. Everything is checked once, of
/// which no more than some MiB are in memory at a time:
///   (1) each crown is that of a cell of the grid, and lies in its square; its numbers are finite, its bottom is below its top,
///       its half width is above 0, its shape and its foliage exist
///   (2) the bounds of the cells, and of all crowns, are those of the crowns, so that nobody misses one who relies on them
///   (3) there are as many crowns of each shape as the manifest says
class CrownsFile {
 public:
  /// Opens that of a package whose manifest names crowns. Throws PackageDamaged or PackageUnusable.
  CrownsFile(const PackageFolder& folder, const package::Manifest& manifest);

  /// Those that have crowns, row by row from the south, each row from the west.
  [[nodiscard]] std::span<const package::CrownCellRecord> cells() const { return cells_; }
  [[nodiscard]] std::span<const Crown> crowns() const { return crowns_; }
  /// In the frame of the cell itself.
  [[nodiscard]] std::span<const Crown> crowns_of(const package::CrownCellRecord& cell) const {
    return crowns_.subspan(cell.first_crown, cell.crown_count);
  }
  [[nodiscard]] std::span<const Crown> crowns_of(Cell cell) const;
  /// The cells from the first that is not before `first`, in the order of cells().
  [[nodiscard]] std::span<const package::CrownCellRecord> cells_from(Cell first) const;
  /// Gives the memory of all crowns back. They stay readable, and come back from the file when somebody reads them.
  void let_go() const { file_.let_go(); }
  [[nodiscard]] float largest_half_width_m() const { return header().largest_half_width_m; }

 private:
  [[nodiscard]] const package::CrownsHeader& header() const {
    return *reinterpret_cast<const package::CrownsHeader*>(file_.bytes().data());
  }
  void check_header();
  void check_cells(const Grid& grid) const;
  void check_crowns(const package::Manifest& manifest) const;
  void require(bool rule, const char* what) const { require_whole(rule, name_, what); }

  std::string name_;
  MappedFile file_;
  std::span<const package::CrownCellRecord> cells_;
  std::span<const Crown> crowns_;
};

}  // namespace farlod

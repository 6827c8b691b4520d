// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "base/grid.hpp"
#include "package/far_map.hpp"
#include "package/manifest.hpp"
#include "package/package_folder.hpp"

namespace farlod {

/// The far map of one cell, of the kind `box`: which directions the city beyond the neighborhood hides, seen from the capture
/// point.
class BoxFarMap {
 public:
  /// A far field that hides nothing.
  BoxFarMap() = default;
  /// `distance_m` holds a row of texels after the other, from the horizontal upwards; infinite where the sky is seen.
  BoxFarMap(BoxMap shape, std::vector<float> distance_m) : shape_(shape), distance_m_(std::move(distance_m)) {}

  [[nodiscard]] const BoxMap& shape() const { return shape_; }
  /// Distance from the capture point to what hides this direction (of the grid frame); infinite where the sky is seen.
  [[nodiscard]] float distance_m(const Point3d& direction) const {
    if (distance_m_.empty()) return std::numeric_limits<float>::infinity();
    const auto texel = shape_.texel_of(direction);
    if (!texel) return std::numeric_limits<float>::infinity();
    return distance_m_[static_cast<std::size_t>(texel->row) * shape_.columns() + texel->column];
  }
  [[nodiscard]] bool blocks(const Point3d& direction) const {
    return distance_m(direction) < std::numeric_limits<float>::infinity();
  }

 private:
  BoxMap shape_;
  std::vector<float> distance_m_;
};

/// The `far.exr` of a block: one tile of the picture for each cell that has a far map. Cells may be read from many threads.
class FarMapReader {
 public:
  /// `mapped` are those of the cells that have a far map, where not all have one; not none. Throws PackageDamaged when the file
  /// does not hold the far maps of these cells.
  FarMapReader(const PackageFile& file, const CellRange& cells, const package::FarMapShape& shape,
               const std::optional<package::CellRuns>& mapped = {});
  FarMapReader(FarMapReader&&) noexcept;
  FarMapReader& operator=(FarMapReader&&) noexcept;
  ~FarMapReader();

  /// Reads a far map of the kind `box`; `top` is BoxMap::top. Throws PackageDamaged.
  [[nodiscard]] BoxFarMap read_box(Cell cell, float top) const;
  /// Reads the slopes of a far map of the kind `horizon`: fills low, estimate, high and overhang. Throws PackageDamaged.
  void read_slopes(Cell cell, FarHorizon& map) const;
  /// Bytes that the picture of a cell takes in the file, compressed. Throws PackageDamaged.
  [[nodiscard]] std::uint64_t stored_bytes(Cell cell) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farlod

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "farlod/angle.hpp"
#include "farlod/box.hpp"
#include "farlod/export.hpp"

namespace farlod {

/// What a package says of itself.
struct PackageDescription {
  std::string software;           ///< that wrote it, with its version
  std::string crs_wkt, crs_name;  ///< projected, in metres: the CRS of all coordinates here and in the results
  std::optional<int> epsg;        ///< of the CRS, where it has a code
  Box2d outline_projected;        ///< around all cells of the grid
  /// Where the city is: the pixels of its raster; else its buildings, and around them 50 m, or a thirtieth of the box's side
  /// where that is less, but no less than 5 m; else, of a bare terrain and of packages that do not tell where their buildings
  /// are, all cells.
  Box2d city_projected;
  std::optional<Box2d> buildings_projected;  ///< around the buildings, as far as the package tells
  Angle grid_bearing;                        ///< of the grid's y axis, clockwise from grid north
  Angle convergence;                         ///< true azimuth = grid azimuth + convergence
  double cell_edge_m = 0.0;
  int neighborhood = 0;  ///< cells along the edge of the near field
  std::int64_t columns = 0, rows = 0;
  std::string far_map_kind;              ///< "horizon" or "box"
  std::uint64_t cells_with_far_map = 0;  ///< columns × rows, or fewer (PackSettings::area)
  std::uint64_t buildings = 0, polygons = 0, triangles = 0;
  /// XXH3-64 of the manifest, which has the checksums of all other files: the same for the same package. 0 of one that a shard
  /// makes.
  std::uint64_t manifest_xxh3 = 0;
  /// It is a raster, and nothing else, most of whose pixels differ from their neighbors: rays march over its pixels, so that
  /// cells without far maps lack none.
  bool has_rough_surface = false;
};

struct PackageContents;

/// An open package. Any number of runs may use it at the same time, from any threads; opening, moving, closing and destroying it
/// are not for two threads at a time, as with any value. Files are mapped when a run needs them, and checked against their
/// checksums then. Where farlod-pack replaces the package meanwhile, this one stays as it was. Where anything else has written,
/// replaced or removed a file since, the next run ends with PackageDamaged: open the package again.
class FARLOD_EXPORT Package {
 public:
  /// Reads the manifest only. Throws PackageUnusable or PackageDamaged.
  explicit Package(const std::filesystem::path& folder);
  Package(Package&&) noexcept;
  Package& operator=(Package&&) noexcept;
  Package(const Package&) = delete;
  Package& operator=(const Package&) = delete;
  ~Package();

  /// False after close(), and of a package that was moved from: all other functions then throw InvalidArgument.
  [[nodiscard]] bool is_open() const noexcept { return contents_ != nullptr; }
  /// Forgets the files. Runs that are under way end as if nothing had happened.
  void close() noexcept;

  /// Valid until the package is closed.
  [[nodiscard]] const PackageDescription& description() const;
  /// For the runs of the library.
  [[nodiscard]] const std::shared_ptr<PackageContents>& contents() const;

 private:
  std::shared_ptr<PackageContents> contents_;
};

}  // namespace farlod

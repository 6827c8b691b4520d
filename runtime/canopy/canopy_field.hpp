// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/grid.hpp"
#include "canopy/canopy_march.hpp"
#include "farlod/point.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/pixel_field.hpp"
#include "package/crown.hpp"
#include "package/manifest.hpp"

namespace farlod {

/// The crowns of a cell, in its frame.
struct CellCrowns {
  Cell cell;
  std::span<const Crown> crowns;
};

/// What PixelHeightsFile has of the pixels of a city that is a raster, or nothing.
struct SolidPixels {
  std::span<const float> height_m = {};
  std::span<const std::uint8_t> joined = {};
};

/// Where the pixels of a canopy raster lie: squares along the axes of the city frame.
class CanopyLattice {
 public:
  struct Place {
    std::int32_t column, row;
  };

  /// That of a crown, if it is a prism and lies along the axes.
  [[nodiscard]] static std::optional<CanopyLattice> of(const Grid& grid, Cell cell, const Crown& crown);

  [[nodiscard]] double pixel_m() const { return pixel_m_; }
  [[nodiscard]] Foliage foliage() const { return any_.foliage; }
  /// Counted from the centre of a pixel, in pixels.
  [[nodiscard]] Point2d pixels_at(Point2d p_city) const { return (1.0 / pixel_m_) * (p_city - centre_city_); }
  /// The pixel with its centre here, if there is one: within a thousandth of a pixel.
  [[nodiscard]] std::optional<Place> centre_at(Point2d p_city) const;
  [[nodiscard]] std::optional<Place> centre_at(const Grid& grid, Cell cell, const Point3f& p_cell) const {
    return centre_at(city_from_cell(grid, cell, p_cell.x, p_cell.y));
  }
  /// The pixel that a crown is.
  [[nodiscard]] std::optional<Place> place_of(const Grid& grid, Cell cell, const Crown& crown) const;

 private:
  CanopyLattice(double pixel_m, const Crown& any) : pixel_m_(pixel_m), any_(any) {}
  [[nodiscard]] static Point2d city_from_cell(const Grid& grid, Cell cell, float x, float y) {
    return grid.rotation.city_from_grid(grid.corner_of(cell) + Point2d{static_cast<double>(x), static_cast<double>(y)});
  }

  double pixel_m_;
  Crown any_;  ///< all have its size, turn and foliage
  Point2d centre_city_;
};

/// The ways of rays over the pixels of a canopy, from the centre of one.
class CanopyPaths {
 public:
  /// Crowns farther away are not seen.
  static constexpr double farthest_m = 3000.0;

  /// Directions are counted from the east; pixels lie in planes of this stride, and no way is longer than `end` pixels.
  CanopyPaths(std::span<const Point2d> directions, double pixel_m, std::ptrdiff_t stride, double end);
  [[nodiscard]] std::span<const CanopyPath> paths() const { return paths_; }
  [[nodiscard]] std::size_t most_crossings() const { return most_crossings_; }

 private:
  void add_segments(Point2d direction, double pixel_m, std::ptrdiff_t stride, std::size_t count);

  std::vector<CanopyPath> paths_;
  std::vector<CanopyCrossing> crossings_;
  std::vector<CanopySegment> segments_, long_segments_;
  std::size_t most_crossings_ = 0;
};

/// A canopy that is a raster, as marches read it: eight bytes a pixel, and four more where solid things are known. All threads
/// share it.
class CanopyField {
 public:
  /// More take too much memory: of all, and for each crown.
  static constexpr double most_pixels = 1 << 26, most_pixels_per_crown = 32.0;

  /// Nothing, unless all crowns are pixels of the lattice, each once, and not too far from each other. What is solid is known if
  /// the city is a raster with the same pixels, which are these.
  [[nodiscard]] static std::optional<CanopyField> of(const CanopyLattice& lattice, const package::Manifest& manifest,
                                                     std::span<const CellCrowns> crowns, const SolidPixels& solids);

  [[nodiscard]] CanopyFieldView view() const;
  [[nodiscard]] bool knows_solids() const { return !solid_m_.empty(); }
  [[nodiscard]] std::ptrdiff_t stride() const { return stride_; }
  /// From a corner to the opposite one, in pixels.
  [[nodiscard]] double diagonal() const { return std::hypot(columns_, rows_); }
  /// A pixel of the lattice as one of the field, if it is one.
  [[nodiscard]] std::optional<CanopyLattice::Place> in_field(const CanopyLattice::Place& place) const;

 private:
  CanopyField(const CanopyLattice& lattice, const Grid& grid);
  [[nodiscard]] bool fill(const CanopyLattice& lattice, const Grid& grid, std::span<const CellCrowns> crowns);
  void fill_solids(const CanopyLattice& lattice, const package::Manifest& manifest, const SolidPixels& solids);
  [[nodiscard]] std::size_t index_of(const CanopyLattice::Place& in_field) const {
    return static_cast<std::size_t>((in_field.row + aside) * stride_ + in_field.column + aside);
  }
  /// Room around the pixels, for the end of a row and of a segment.
  static constexpr std::int32_t aside = 128;

  std::int32_t first_column_ = 0, first_row_ = 0, columns_ = 0, rows_ = 0;
  std::ptrdiff_t stride_ = 0;
  std::vector<float> top_m_, bottom_m_, solid_m_;
  float highest_m_ = no_height_m;
  std::optional<HighestPixels> around_, long_around_;
};

/// A canopy and the ways over it at the azimuths of a sampling.
struct CanopyCity {
  CanopyCity(const package::Manifest& m, const CanopyLattice& l, CanopyField f, const AzimuthSampling& azimuths);
  const package::Manifest& manifest;
  CanopyLattice lattice;
  CanopyField field;
  CanopyPaths paths;
};

}  // namespace farlod

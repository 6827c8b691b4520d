// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "farlod/box.hpp"
#include "farlod/point.hpp"
#include "georeference/crs.hpp"

// Private to the wrappers of GDAL: it names one of its classes.
class GDALDataset;

namespace farlod {
struct WarpWay;
}

namespace farlod::georeference {

/// Half-open ranges of columns and rows.
struct RasterWindow {
  int column = 0, row = 0, column_end = 0, row_end = 0;

  [[nodiscard]] bool is_empty() const { return column >= column_end || row >= row_end; }
  [[nodiscard]] std::size_t columns() const { return static_cast<std::size_t>(column_end - column); }
  [[nodiscard]] std::size_t rows() const { return static_cast<std::size_t>(row_end - row); }
};

/// Converts the numbers of a band to heights in metres.
struct HeightScale {
  double scale = 1.0, offset = 0.0;

  [[nodiscard]] float metres(double value) const { return static_cast<float>(scale * value + offset); }
  [[nodiscard]] double number(float height_m) const { return (static_cast<double>(height_m) - offset) / scale; }
};

/// Where the pixels of a raster are. Places within it are counted in pixels from the corner of the first one.
struct PixelFrame {
  Point2d corner, column_step, row_step;

  [[nodiscard]] Point2d place(double column, double row) const { return corner + column * column_step + row * row_step; }
  [[nodiscard]] Point2d pixels_at(Point2d p) const;
  [[nodiscard]] bool is_north_up() const {
    return column_step.x > 0.0 && row_step.x == 0.0 && column_step.y == 0.0 && row_step.y < 0.0;
  }
  [[nodiscard]] bool is_made_of_squares() const;
};

/// A raster that is open.
struct PlacedRaster {
  std::filesystem::path path;
  std::shared_ptr<GDALDataset> file, cleared = {};  ///< `cleared` has no data where the file does not declare it
  std::shared_ptr<GDALDataset> warped = {};         ///< empty when the pixels stay where they are
  HeightScale scale = {};
  std::string note = {};                         ///< what was done to it, for the user
  std::optional<std::string> crs_in_place = {};  ///< of that of the file
  std::optional<Crs> own = {};                   ///< the CRS of the file, once it is taken
  std::string whose_crs = {};                    ///< from where it has that, for messages
  bool is_in_crs_of_city = false;                ///< for want of one of its own, and of --crs

  [[nodiscard]] GDALDataset& dataset() const { return warped ? *warped : unwarped(); }
  [[nodiscard]] GDALDataset& unwarped() const { return cleared ? *cleared : *file; }
  [[nodiscard]] int columns() const;
  [[nodiscard]] int rows() const;
  [[nodiscard]] std::optional<float> height_m(double number) const {
    const float height = scale.metres(number);
    return std::isfinite(height) ? std::optional(height) : std::nullopt;
  }
  [[nodiscard]] PixelFrame frame() const;
  /// The rectangle of the file, before anything is done to it.
  [[nodiscard]] Box2d extent() const;

  /// Finds the CRS of the file, and the scale of its heights.
  [[nodiscard]] Crs take_crs(const std::string& fallback_crs, const Crs& output);
  /// Pixels are computed when they are read. Throws InputError where GDAL cannot.
  void warp(const WarpWay& way, const Crs& output);
};

/// For a raster that does not meet the city: where both lie, and why it is taken to lie there. `name` is how the message calls
/// it; `wanted` is in the output CRS. Throws InputError.
[[noreturn]] void refuse_elsewhere(const std::string& name, const PlacedRaster& raster, const Crs& output, const Box2d& wanted);

/// For the user, of a raster whose CRS is taken: note_of_height_unit. Empty where the band names its unit.
[[nodiscard]] std::optional<std::string> note_of_unit(const PlacedRaster& raster);

/// A length as messages show it: five digits.
[[nodiscard]] std::string length_text(double length_m);

}  // namespace farlod::georeference

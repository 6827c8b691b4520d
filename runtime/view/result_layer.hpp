// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "farlod/package.hpp"
#include "view/view_frame.hpp"

namespace farlod {

/// How a result file is drawn.
enum class ResultForm : std::uint8_t {
  raster,    ///< on the ground, in place of the values of the tiles
  surfaces,  ///< on the surfaces of buildings, in place of the values of the tiles
  points,    ///< a dot each, in the colours of its values
  problems   ///< a mark each: what a report of farlod-pack says
};
[[nodiscard]] std::string_view name_of(ResultForm form);

/// A result file as the page draws it.
struct ResultLayer {
  ResultForm form = ResultForm::points;
  std::string name = {};      ///< of the file
  std::string quantity = {};  ///< of the band or the field; empty for problems
  std::uint64_t count = 0;    ///< of pixels, points or surfaces in the file; there are fewer here where they were thinned

  // Rasters
  std::uint32_t width = 0, height = 0;
  std::array<double, 6> local_from_pixel{};  ///< as RasterBand::projected_from_pixel, and from the origin of the view

  // Points and problems
  std::vector<std::array<float, 3>> places_local = {};  ///< z is NaN where no height is known

  // Surfaces: the building of each as a number of `labels`, and the surface's own number within it
  std::vector<std::array<std::uint32_t, 2>> surfaces = {};

  std::vector<std::string> labels = {};  ///< ids of points, or what the problems are, or ids of buildings

  std::vector<float> values = {};  ///< of pixels, points or surfaces, NaN where there is none; empty for problems

  /// The unit of a quantity of farlod-svf that is no share, for people, by its name: "kWh/m²" of `irradiation_mean`; else empty.
  [[nodiscard]] std::string_view unit() const;
  /// From 0 to 1 where all values lie there, else the least and the greatest of them. That of light begins at 0, and ends at five
  /// steps of 1, 2, 2.5 or 5 and a power of ten, but not at 1.
  [[nodiscard]] std::array<float, 2> range() const;
  /// The values of a raster, or the three coordinates and the value of each point, or the two numbers and the value of each
  /// surface, as little-endian floats, which hold whole numbers up to 16,777,216.
  [[nodiscard]] std::string bytes() const;
};

/// A layer of more points keeps each n-th of them, so that a browser draws it at once.
inline constexpr std::size_t most_points_of_layer = 1'000'000;

/// Reads a result file. `request` is its name, perhaps with a colon and the name of a band or a field behind it; without one, it
/// is `svf`, and of a raster without that the first band. Rasters are all that GDAL knows; points are those of `farlod-svf
/// --points` or of any vector file; surfaces are the table FILE.surfaces.csv of `farlod-svf --surfaces`, or the layer `surfaces`
/// of its GeoPackage, of which `svf_mean` is taken without a name, and `irradiation_mean` by the name `irradiation`; a report of
/// `farlod-pack --report FILE.geojson` is known by its fields. What is in another CRS is brought into that of the package. Points
/// without a height stand as high as receivers of a map. Throws InputError, PackageDamaged.
[[nodiscard]] ResultLayer read_result_layer(const std::string& request, const Package& package, const ViewFrame& frame);

}  // namespace farlod

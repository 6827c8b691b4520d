// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <utility>

#include "city/city_model.hpp"
#include "farlod/point.hpp"
#include "farlod/problem.hpp"
#include "georeference/crs.hpp"
#include "georeference/input_crs.hpp"
#include "plausibility/doubtful_surface.hpp"

namespace farlod::georeference {

enum class AxisOrder { easting_first, northing_first };

/// How the coordinates of a file differ from those on the map of its CRS, where x is the easting or longitude, y the northing or
/// latitude, and z is in metres.
struct FileAxes {
  AxisOrder order = AxisOrder::easting_first;
  double before_easting = 0.0;  ///< added to each easting by the file: 32,000,000 if it begins with the zone 32
  double height_unit_m = 1.0;

  bool operator==(const FileAxes&) const = default;

  [[nodiscard]] Point3d p_map(const Point3d& p_file) const {
    const bool swap = order == AxisOrder::northing_first;
    return {(swap ? p_file.y : p_file.x) - before_easting, swap ? p_file.x : p_file.y, p_file.z * height_unit_m};
  }
  [[nodiscard]] Point3d p_file(const Point3d& p_map) const {
    const Point2d p{p_map.x + before_easting, p_map.y};
    const bool swap = order == AxisOrder::northing_first;
    return {swap ? p.y : p.x, swap ? p.x : p.y, p_map.z / height_unit_m};
  }
};

/// Brings points from the CRS of a file to that of the package, in place.
using Projection = std::function<void(std::span<Point3d>)>;

/// By the most exact of the ways that there are. `typical`: a place of the file.
[[nodiscard]] Projection make_projection(const Crs& from, const Crs& to, Point2d typical);

/// Whether a point has a place on some map of the Earth.
[[nodiscard]] bool is_on_a_map(const Point3d& p_projected);

/// Computes the longitude and latitude of problems whose positions are in the CRS and with the axes of a file. `typical`: a place
/// in that CRS, the easting or longitude first.
class ProblemLocator {
 public:
  ProblemLocator(Crs crs, FileAxes axes, Point2d typical) : crs_(std::move(crs)), axes_(axes), typical_(typical) {}
  /// Sets lon_lat_deg, if the problem has a position and the CRS has that position on the Earth.
  void locate(Problem& problem);

 private:
  Crs crs_;
  FileAxes axes_;
  Point2d typical_;
  std::optional<CrsTransformation> lon_lat_from_crs_;  ///< made for the first problem: most cities have none
};

/// A place as messages show it.
[[nodiscard]] inline std::string place_text(Point2d p) {
  std::ostringstream text;
  text.precision(10);
  text << p.x << ", " << p.y;
  return text.str();
}

/// A file with x as the easting or longitude and heights in metres.
struct ResolvedSource {
  SourceCity source;
  Crs crs;
  Point2d typical;  ///< a typical place of the file
  FileAxes axes;    ///< the axes of the file before
};

/// Resolves CRS, axes and units of a source that has buildings or a relief. Reports problems of its CRS (two_crs, crs_unknown)
/// and of its coordinates (axes_swapped, zone_in_easting, unlikely_place), each once for the whole file. Throws InputError when
/// the coordinates are in degrees and the CRS is projected, or the other way round.
[[nodiscard]] ResolvedSource resolve(SourceCity source, const InputCrs& given, Report& report);

/// The same for a raster, by its middle pixel and the one beside it: unlikely_place, and implausible_size where pixels are
/// smaller than a centimetre or wider than 10 km. Throws InputError as `resolve` does.
void report_place(const std::string& raster, const Crs& crs, Point2d middle, Point2d beside, Report& report);

/// Whether --crs holds in place of the CRS of a raster that is the city. Reports as `resolve` does: two_crs, crs_unknown, and
/// unlikely_place where --crs was given for another purpose.
[[nodiscard]] bool is_overruled(const std::string& raster, const InputCrs& given, Point2d middle, double pixel, Report& report);

/// Reports what concerns a whole file, with a place of the city frame.
void report_whole_file(ProblemCode code, const std::string& file, std::string detail, const Point3d& p_city,
                       const Georeference& georeference, Report& report);

/// Reports the heights of a city without buildings of its own where they are hardly those of a city (implausible_size), at the
/// highest of them.
void report_surface(const std::string& file, const plausibility::SurfaceShape& shape_city, const Georeference& georeference,
                    Report& report);

/// Reports an output CRS that is not meant to be used where the city lies (unlikely_place), unless its input's is not either.
/// `typical` is a place of the city in that.
void report_output(const Crs& input, const Crs& output, Point2d typical, Report& report);

}  // namespace farlod::georeference

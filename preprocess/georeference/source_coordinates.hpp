// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "city/source.hpp"
#include "georeference/crs.hpp"
#include "georeference/file_axes.hpp"

namespace farlod::georeference {

/// What holds for most of a file, whatever a few stray buildings say.
struct TypicalPlace {
  /// As the file has it: the median, by axis, of the buildings' first vertices; without buildings, of the relief's points.
  Point3d place;
  std::optional<double> building_extent;  ///< median of the larger side of the buildings' upright rectangles
  /// What tells metres from degrees: the median of the larger side of facets, as one stray facet makes a building as large as
  /// the Earth; without any, how far a point of the relief is from the next one.
  std::optional<double> grain;
};

/// Of a source with at least one point.
[[nodiscard]] TypicalPlace typical_place(const SourceCity& source);

/// The order that the definition states. `longitude_first`: the name or the reader says so, whatever the authority does.
[[nodiscard]] AxisOrder stated_order(const Crs& crs, bool longitude_first);

/// How the file counts (heights aside).
///   (1) degrees come in the stated order, projected coordinates easting first, which is what CityGML and CityJSON files do
///       whatever the authority's order is
///   (2) unless only without the number of a UTM zone before the easting, or only in the other order, they lie in the CRS's area
///       of use; a place that is possible is never second-guessed
[[nodiscard]] FileAxes find_axes(Point2d typical_place, const Crs& crs, bool longitude_first);

/// Whether the coordinates can be of that CRS: degrees of a geographic one, and nothing like degrees of a projected one.
[[nodiscard]] bool may_count_in(const TypicalPlace& typical, const Crs& crs);

/// Throws InputError when they cannot: when the coordinates look like degrees in a file that claims a projected CRS, or the other
/// way round. `advice` ends the message.
void check_units(const SourceCity& source, const TypicalPlace& typical, const Crs& crs, const std::string& advice);

}  // namespace farlod::georeference

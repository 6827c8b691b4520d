// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "city/city_model.hpp"
#include "farlod/point.hpp"
#include "georeference/crs.hpp"

namespace farlod::georeference {

/// Whether a place lies in the area of use of a CRS. If the area of a CRS in degrees is not known: whether it lies on the Earth.
[[nodiscard]] bool lies_in_area_of_use(const Crs& crs, Point2d p);

/// Whether the CRS may be used at a place: the area of use is not known, or ends near it.
///   (1) the area of a projection of a country may be 0.25° away, that of a zone or of a CRS in degrees 1°
///   (2) if the CRS has zones, it may be one zone away, since some surveys use one zone for a whole country
[[nodiscard]] bool may_be_used_at(const Crs& crs, Point2d p);

/// A text that the file does not lie in the area of use of its CRS, or that its buildings are too large, with a possible reason:
/// another unit, or a model of a site without a place on the map. Empty when the place is plausible. `p_map`: the typical place,
/// easting or longitude first.
[[nodiscard]] std::optional<std::string> doubt_about_place(const Crs& crs, Point2d p_map, std::optional<double> building_extent);

/// The same where --crs overrules the CRS that a file names: it may have been given for the one that a package is to have. Empty
/// unless the file lies elsewhere by the two, within the area of its own and, be it a little, outside of the area of --crs.
[[nodiscard]] std::optional<std::string> doubt_beside_own(const Crs& given, Point2d p_given, const Crs& own, Point2d p_own);

/// The same where the corners of outlines are right angles only with longitude and latitude exchanged
/// (plausibility::RightAngles). `source` has longitude, latitude; `latitude_first`: its file has them in the other order.
[[nodiscard]] std::optional<std::string> doubt_about_order(const SourceCity& source, Point2d lon_lat_deg, bool latitude_first);

}  // namespace farlod::georeference

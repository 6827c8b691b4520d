// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "farlod/point.hpp"
#include "farlod/problem.hpp"
#include "georeference/crs.hpp"
#include "georeference/placed_raster_gdal.hpp"
#include "plausibility/stand_ins.hpp"

namespace farlod::georeference {

/// A number that stands for no data, and the first of its pixels in the CRS of the file.
struct StandInOfFile {
  double number = 0.0;
  Point2d place;
};

/// Reports undeclared_no_data. `how_many`: "4 of 400 pixels here, ", or empty where a sample was searched.
void report_stand_in(const std::string& file, const Crs& own, const StandInOfFile& found, const std::string& how_many,
                     Report& report);

/// Throws InputError where they are heights in another unit (plausibility::sign_of_another_unit).
void require_metres(const std::string& file, std::span<const plausibility::StandIn> stand_ins,
                    std::span<const std::optional<float>> left_m);

/// What stands for no data though the raster does not declare it, by a sample that is spread over all of it. Throws as
/// require_metres does.
[[nodiscard]] std::vector<StandInOfFile> sampled_stand_ins(const PlacedRaster& raster, plausibility::HeightsOf of);

/// Reports them, and has the raster read as if it had no data there: before it is resampled, which would mix them into their
/// neighbours.
void clear_stand_ins(PlacedRaster& raster, plausibility::HeightsOf of, const Crs& own, Report& report);

}  // namespace farlod::georeference

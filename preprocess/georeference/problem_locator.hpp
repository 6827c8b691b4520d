// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <utility>

#include "city/problem.hpp"
#include "georeference/crs.hpp"
#include "georeference/file_axes.hpp"

namespace farlod::georeference {

/// Finds the longitudes and latitudes of problems whose positions are in one CRS, as a file counts. `typical`: a place in it,
/// the easting or longitude first.
class ProblemLocator {
 public:
  ProblemLocator(Crs crs, FileAxes axes, Point2d typical) : crs_(std::move(crs)), axes_(axes), typical_(typical) {}
  /// Fills in lon_lat_deg, unless there is no position, or none that the CRS has on the Earth.
  void locate(Problem& problem);

 private:
  Crs crs_;
  FileAxes axes_;
  Point2d typical_;
  std::optional<CrsTransformation> lon_lat_from_crs_;  ///< made for the first problem: most cities need it not
};

}  // namespace farlod::georeference

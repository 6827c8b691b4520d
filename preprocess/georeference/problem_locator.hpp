// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <utility>

#include "farlod/problem.hpp"
#include "georeference/crs.hpp"

namespace farlod {

/// How the positions of some problems are to be read.
enum class AxisOrder { as_usual, northing_first };

/// Finds the longitudes and latitudes of problems whose positions are in one CRS. `typical`: a place in it, the easting or
/// longitude first.
class ProblemLocator {
 public:
  ProblemLocator(Crs crs, AxisOrder order, Point2d typical) : crs_(std::move(crs)), order_(order), typical_(typical) {}
  /// Fills in lon_lat_deg, unless there is no position, or none that the CRS has on the Earth.
  void locate(Problem& problem);

 private:
  Crs crs_;
  AxisOrder order_;
  Point2d typical_;
  std::optional<CrsTransformation> lon_lat_from_crs_;  ///< made for the first problem: most cities need it not
};

}  // namespace farlod

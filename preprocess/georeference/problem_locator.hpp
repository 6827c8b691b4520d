// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <utility>

#include "farlod/problem.hpp"
#include "georeference/crs.hpp"
#include "georeference/file_axes.hpp"

namespace farlod::georeference {

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

}  // namespace farlod::georeference

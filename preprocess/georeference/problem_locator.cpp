// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/problem_locator.hpp"

#include <cmath>

#include "base/expects.hpp"

namespace farlod::georeference {
namespace {

bool is_on_earth(Point2d lon_lat_deg) { return std::abs(lon_lat_deg.x) <= 180.0 && std::abs(lon_lat_deg.y) <= 90.0; }

CrsTransformation make_transformation(const Crs& crs, Point2d typical) {
  const auto wgs84 = Crs::find("EPSG:4326");
  FARLOD_EXPECTS(wgs84.has_value());
  return {crs, *wgs84, typical};
}

}  // namespace

void ProblemLocator::locate(Problem& problem) {
  if (!problem.position) return;
  if (!lon_lat_from_crs_) lon_lat_from_crs_ = make_transformation(crs_, typical_);
  const auto lon_lat_deg = lon_lat_from_crs_->apply(horizontal(axes_.p_map(*problem.position)));
  if (lon_lat_deg && is_on_earth(*lon_lat_deg)) problem.lon_lat_deg = lon_lat_deg;
}

}  // namespace farlod::georeference

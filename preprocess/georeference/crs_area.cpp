// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/crs_area.hpp"

#include <algorithm>

namespace farlod::georeference {
namespace {

/// Areas of use are bounding boxes of countries and zones. Towns at a border extend beyond them.
constexpr double least_margin_deg = 1.0;

}  // namespace

bool lies_in_area_of_use(const Crs& crs, Point2d p) {
  const auto place = crs.lon_lat_deg(p);
  const auto area = crs.area_of_use();
  return place && (area ? area->contains(*place) : !crs.is_projected());
}

bool may_be_used_at(const Crs& crs, Point2d p) {
  const auto area = crs.area_of_use();
  if (!area && crs.is_projected()) return true;
  const auto place = crs.lon_lat_deg(p);
  const double lon_margin_deg = std::max(least_margin_deg, crs.zone_width_deg());
  return place && (!area || area->contains(*place, lon_margin_deg, least_margin_deg));
}

}  // namespace farlod::georeference

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
// Bearings and convergences belong together: a street has one true azimuth, whatever map it is drawn on.
#include <gtest/gtest.h>

#include <cmath>

#include "align/align.hpp"
#include "georeference/georeference.hpp"
#include "tests/preprocess/align/extruded_town.hpp"

namespace farlod::align {
namespace {

/// A town of 450 m by 150 m in Queens, in the metric CRS of Long Island.
SourceCity town_in_queens() {
  SourceCity source;
  source.source = "queens.obj";
  source.crs.definition = "EPSG:32118";
  add_quarter(source.city, 40, Angle::degrees(17.0), {315000.0, 54500.0});
  return source;
}

double true_bearing_deg(const std::string& out_crs) {
  std::vector<SourceCity> sources;
  sources.push_back(town_in_queens());
  Report report;
  const LocatedCity located = georeference::georeference(std::move(sources), {"", out_crs}, report);
  return (street_alignment(located.city).bearing + located.georeference.convergence).degrees();
}

TEST(TrueBearing, IsTheSameOnEveryMap) {
  // The convergence is that of the origin; it changes by sin φ < 1 per degree of longitude, of which the town's half spans this
  // many
  constexpr double half_a_town_deg = 225.0 / 84000.0;
  const double in_its_own_crs = true_bearing_deg("");
  for (const char* out_crs : {"EPSG:32618", "EPSG:26918", "EPSG:32619"})
    EXPECT_NEAR(true_bearing_deg(out_crs), in_its_own_crs, half_a_town_deg) << out_crs;
}

}  // namespace
}  // namespace farlod::align

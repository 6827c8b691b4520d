// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "georeference/crs_name.hpp"

#include <gtest/gtest.h>

#include <map>

namespace farlod::georeference {
namespace {

TEST(CrsName, IsThatOfTheRegister) {
  const std::map<std::string, std::string> names{{"ETRS89 / UTM zone 32N", "EPSG:25832"},
                                                 {"WGS 84", "EPSG:4326"},
                                                 {"ETRS89", "EPSG:4258"},
                                                 {"Amersfoort / RD New", "EPSG:28992"},
                                                 {"Amersfoort / RD New + NAP height", "EPSG:7415"},
                                                 {"NAD83 / New York Long Island (ftUS)", "EPSG:2263"},
                                                 {"JGD2011 / Japan Plane Rectangular CS IX", "EPSG:6677"}};
  for (const auto& [name, code] : names) EXPECT_EQ(code_of_crs_name(name), code) << name;
}

TEST(CrsName, MayBeSpeltOtherwise) {
  const std::map<std::string, std::string> names{{"etrs89 / utm zone 32n", "EPSG:25832"},
                                                 {"ETRS89_UTM_zone_32N", "EPSG:25832"},
                                                 {"ETRS89 / UTM 32N", "EPSG:25832"},
                                                 {"ETRS_1989_UTM_Zone_32N", "EPSG:25832"},
                                                 {"WGS84 UTM 32N", "EPSG:32632"},
                                                 {"WGS84 UTM 56S", "EPSG:32756"},
                                                 {"WGS84", "EPSG:4326"},
                                                 {"Amersfoort RD New", "EPSG:28992"},
                                                 {"RD New", "EPSG:28992"},
                                                 {"British National Grid", "EPSG:27700"},
                                                 {"JGD2011/Japan Plane Rectangular CS IX", "EPSG:6677"}};
  for (const auto& [name, code] : names) EXPECT_EQ(code_of_crs_name(name), code) << name;
}

TEST(CrsName, MayNameItsHeights) {
  EXPECT_EQ(code_of_crs_name("ETRS89 / UTM zone 32N + DHHN2016 height"), "EPSG:25832+EPSG:7837");
  EXPECT_EQ(code_of_crs_name("ETRS89 / UTM zone 32N + heights of nobody"), std::nullopt);
}

TEST(CrsName, MeansNothingWhenSeveralWouldDo) {
  for (const char* name : {"UTM", "Germany", "UTM zone 32N", "zone 32N", "Lambert-93", "New", "local", "unknown", "nonsense",
                           "EPSG", "Unknown engineering CRS", "height", "DHHN2016 height"})
    EXPECT_EQ(code_of_crs_name(name), std::nullopt) << name;
}

}  // namespace
}  // namespace farlod::georeference

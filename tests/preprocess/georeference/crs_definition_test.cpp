// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "georeference/crs_definition.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace farlod {
namespace {

struct Naming {
  const char* text;
  CrsDefinition meaning;
};

/// What GoogleTest shows of a case.
void PrintTo(const Naming& naming, std::ostream* out) { *out << naming.text; }

class CrsDefinitionOf : public testing::TestWithParam<Naming> {};

TEST_P(CrsDefinitionOf, IsInWordsThatProjKnows) {
  const auto found = parse_crs_definition(GetParam().text);
  ASSERT_TRUE(found.has_value()) << GetParam().text;
  EXPECT_EQ(found->for_proj, GetParam().meaning.for_proj) << GetParam().text;
  EXPECT_EQ(found->longitude_first, GetParam().meaning.longitude_first) << GetParam().text;
}

INSTANTIATE_TEST_SUITE_P(Codes, CrsDefinitionOf,
                         testing::Values(Naming{"EPSG:28992", {"EPSG:28992"}}, Naming{"epsg:28992", {"EPSG:28992"}},
                                         Naming{" EPSG:28992\n", {"EPSG:28992"}}, Naming{"EPSG::28992", {"EPSG:28992"}},
                                         Naming{"EPSG:25832+5783", {"EPSG:25832+5783"}}));

INSTANTIATE_TEST_SUITE_P(Urns, CrsDefinitionOf,
                         testing::Values(Naming{"urn:ogc:def:crs:EPSG::6697", {"EPSG:6697"}},
                                         Naming{"urn:ogc:def:crs:EPSG:6.12:3068", {"EPSG:3068"}},
                                         Naming{"urn:x-ogc:def:crs:EPSG:6697", {"EPSG:6697"}},
                                         Naming{"urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783", {"EPSG:25832+5783"}},
                                         Naming{"urn:ogc:def:crs,crs:EPSG:6.12:3068,crs:EPSG:6.12:5783", {"EPSG:3068+5783"}}));

INSTANTIATE_TEST_SUITE_P(
    Urls, CrsDefinitionOf,
    testing::Values(Naming{"http://www.opengis.net/def/crs/EPSG/0/6697", {"EPSG:6697"}},
                    Naming{"https://www.opengis.net/def/crs/EPSG/0/7415", {"EPSG:7415"}},
                    Naming{"http://www.opengis.net/def/crs/EPSG/6.12/3068", {"EPSG:3068"}},
                    Naming{"http://www.opengis.net/gml/srs/epsg.xml#25832", {"EPSG:25832"}},
                    Naming{"http://www.opengis.net/def/crs-compound?1=http://www.opengis.net/def/crs/EPSG/0/25832"
                           "&2=http://www.opengis.net/def/crs/EPSG/0/7837",
                           {"EPSG:25832+7837"}}));

INSTANTIATE_TEST_SUITE_P(LongitudeFirst, CrsDefinitionOf,
                         testing::Values(Naming{"urn:ogc:def:crs:OGC:1.3:CRS84", {"EPSG:4326", true}},
                                         Naming{"urn:ogc:def:crs:OGC::CRS84", {"EPSG:4326", true}},
                                         Naming{"http://www.opengis.net/def/crs/OGC/1.3/CRS84", {"EPSG:4326", true}},
                                         Naming{"OGC:CRS84", {"EPSG:4326", true}}, Naming{"CRS84h", {"EPSG:4326", true}},
                                         Naming{"urn:ogc:def:crs:OGC:1.3:CRS83", {"EPSG:4269", true}}));

INSTANTIATE_TEST_SUITE_P(GermanSurveys, CrsDefinitionOf,
                         testing::Values(Naming{"urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH*GCG2016", {"EPSG:25832"}},
                                         Naming{"urn:adv:crs:ETRS89_UTM33*DE_DHHN92_NH", {"EPSG:25833"}},
                                         Naming{"urn:adv:crs:ETRS89_UTM31", {"EPSG:25831"}},
                                         Naming{"urn:adv:crs:ETRS89_Lat-Lon", {"EPSG:4258"}},
                                         Naming{"urn:adv:crs:DE_DHDN_3GK2_NW101", {"EPSG:31466"}},
                                         Naming{"urn:adv:crs:DE_DHDN_3GK3*DE_DHN92_NH", {"EPSG:31467"}},
                                         Naming{"urn:adv:crs:DE_DHDN_3GK4", {"EPSG:31468"}},
                                         Naming{"urn:adv:crs:DE_DHDN_3GK5", {"EPSG:31469"}}));

INSTANTIATE_TEST_SUITE_P(WktAndProj, CrsDefinitionOf,
                         testing::Values(Naming{"+proj=utm +zone=32 +datum=WGS84", {"+proj=utm +zone=32 +datum=WGS84 +type=crs"}},
                                         Naming{"+proj=longlat +type=crs", {"+proj=longlat +type=crs"}},
                                         Naming{"PROJCS[\"ETRS_1989_UTM_Zone_32N\",GEOGCS[]]",
                                                {"PROJCS[\"ETRS_1989_UTM_Zone_32N\",GEOGCS[]]"}},
                                         Naming{"PROJCRS (\"x\")", {"PROJCRS (\"x\")"}}));

TEST(CrsDefinition, KnowsNothingElse) {
  for (const char* text : {"", "   ", "EPSG", "EPSG:", "EPSG:28992x", "28992", "Amersfoort / RD New",
                           "urn:ogc:def:crs:EPSG::", "urn:adv:crs:ETRS89_UTM34", "urn:adv:crs:DE_DHHN2016_NH",
                           "http://www.opengis.net/def/crs/EPSG/0/", "urn:ogc:def:crs:IAU::49900", "PROJCS[\"cut off", "[]"})
    EXPECT_FALSE(parse_crs_definition(text).has_value()) << text;
}

TEST(CrsDefinition, SurvivesALongText) { EXPECT_FALSE(parse_crs_definition(std::string(1'000'000, 'E')).has_value()); }

}  // namespace
}  // namespace farlod

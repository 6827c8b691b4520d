// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "georeference/crs_definition.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace farlod::georeference {
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
  EXPECT_EQ(found->is_bare_name, GetParam().meaning.is_bare_name) << GetParam().text;
}

INSTANTIATE_TEST_SUITE_P(Codes, CrsDefinitionOf,
                         testing::Values(Naming{"EPSG:28992", {"EPSG:28992"}}, Naming{"epsg:28992", {"EPSG:28992"}},
                                         Naming{" EPSG:28992\n", {"EPSG:28992"}}, Naming{"EPSG::28992", {"EPSG:28992"}},
                                         Naming{"EPSG:25832+5783", {"EPSG:25832+5783"}}, Naming{"25832", {"EPSG:25832"}},
                                         Naming{"epsg 25832", {"EPSG:25832"}}, Naming{"EPSG: 25832", {"EPSG:25832"}},
                                         Naming{"EPSG_25832", {"EPSG:25832"}}, Naming{"25832+7837", {"EPSG:25832+7837"}},
                                         Naming{"EPSG:25832, EPSG:7837", {"EPSG:25832+7837"}},
                                         Naming{"EPSG:25832+EPSG:7837", {"EPSG:25832+7837"}}));

INSTANTIATE_TEST_SUITE_P(OtherAuthorities, CrsDefinitionOf,
                         testing::Values(Naming{"ESRI:102100", {"ESRI:102100"}}, Naming{"esri:102100", {"ESRI:102100"}},
                                         Naming{"EPSG:102100", {"ESRI:102100"}}, Naming{"EPSG:900913", {"EPSG:900913"}},
                                         Naming{"IGNF:LAMB93", {"IGNF:LAMB93"}},
                                         Naming{"ESRI:102100+EPSG:5703", {"ESRI:102100+EPSG:5703"}},
                                         Naming{"urn:ogc:def:crs:ESRI::102100", {"ESRI:102100"}},
                                         Naming{"urn:ogc:def:crs:IGNF::LAMB93", {"IGNF:LAMB93"}},
                                         Naming{"http://www.opengis.net/def/crs/ESRI/0/102100", {"ESRI:102100"}}));

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
                           {"EPSG:25832+7837"}},
                    Naming{
                        "https://www.opengis.net/def/crs-compound?1=https%3A%2F%2Fwww.opengis.net%2Fdef%2Fcrs%2FEPSG%2F0%2F25832"
                        "&amp;2=https%3a%2f%2fwww.opengis.net%2fdef%2fcrs%2fEPSG%2f0%2f7837",
                        {"EPSG:25832+7837"}},
                    Naming{"https://www.opengis.net/gml/srs/epsg.xml#25832", {"EPSG:25832"}},
                    Naming{"https://epsg.io/25832", {"EPSG:25832"}},
                    Naming{"http://spatialreference.org/ref/epsg/25832/", {"EPSG:25832"}}));

INSTANTIATE_TEST_SUITE_P(LongitudeFirst, CrsDefinitionOf,
                         testing::Values(Naming{"urn:ogc:def:crs:OGC:1.3:CRS84", {"EPSG:4326", true}},
                                         Naming{"urn:ogc:def:crs:OGC::CRS84", {"EPSG:4326", true}},
                                         Naming{"http://www.opengis.net/def/crs/OGC/1.3/CRS84", {"EPSG:4326", true}},
                                         Naming{"OGC:CRS84", {"EPSG:4326", true}}, Naming{"CRS84h", {"EPSG:4326", true}},
                                         Naming{"urn:ogc:def:crs:OGC:1.3:CRS83", {"EPSG:4269", true}}));

INSTANTIATE_TEST_SUITE_P(
    GermanSurveys, CrsDefinitionOf,
    testing::Values(
        Naming{"urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH*GCG2016", {"EPSG:25832"}},
        Naming{"urn:adv:crs:ETRS89_UTM33*DE_DHHN92_NH", {"EPSG:25833"}}, Naming{"urn:adv:crs:ETRS89_UTM31", {"EPSG:25831"}},
        Naming{"urn:adv:crs:ETRS89_Lat-Lon", {"EPSG:4258"}}, Naming{"urn:adv:crs:DE_DHDN_3GK2_NW101", {"EPSG:31466"}},
        Naming{"urn:adv:crs:DE_DHDN_3GK3*DE_DHN92_NH", {"EPSG:31467"}}, Naming{"urn:adv:crs:DE_DHDN_3GK4", {"EPSG:31468"}},
        Naming{"urn:adv:crs:DE_DHDN_3GK5", {"EPSG:31469"}}, Naming{"urn:adv:crs:ETRS89_UTM28", {"EPSG:25828"}},
        Naming{"urn:adv:crs:ETRS89_UTM38*DE_DHHN2016_NH", {"EPSG:25838"}}, Naming{"urn:adv:crs:ETRS89_Lat-Lon-h", {"EPSG:4937"}},
        Naming{"urn:adv:crs:DE_DHDN_Lat-Lon*DE_DHHN92_NH", {"EPSG:4314"}},
        Naming{"urn:adv:crs:DE_RD-83_3GK5*DE_DHHN92_NH", {"EPSG:3399"}}, Naming{"urn:adv:crs:DE_PD-83_3GK4", {"EPSG:3397"}},
        Naming{"urn:adv:crs:DE_42-83_3GK4", {"EPSG:2398"}}));

INSTANTIATE_TEST_SUITE_P(BareNames, CrsDefinitionOf,
                         testing::Values(Naming{"Amersfoort / RD New", {"Amersfoort / RD New", false, true}},
                                         Naming{"WGS84 UTM 32N", {"WGS84 UTM 32N", false, true}},
                                         Naming{"NAD83 / New York Long Island (ftUS)",
                                                {"NAD83 / New York Long Island (ftUS)", false, true}}));

INSTANTIATE_TEST_SUITE_P(
    WktAndProj, CrsDefinitionOf,
    testing::Values(Naming{"+proj=utm +zone=32 +datum=WGS84", {"+proj=utm +zone=32 +datum=WGS84 +type=crs"}},
                    Naming{"+proj=longlat +type=crs", {"+proj=longlat +type=crs"}},
                    Naming{"PROJCS[\"ETRS_1989_UTM_Zone_32N\",GEOGCS[]]", {"PROJCS[\"ETRS_1989_UTM_Zone_32N\",GEOGCS[]]"}},
                    Naming{"PROJCRS (\"x\")", {"PROJCRS (\"x\")"}},
                    Naming{"{\"type\": \"ProjectedCRS\", \"name\": \"x\"}", {"{\"type\": \"ProjectedCRS\", \"name\": \"x\"}"}}));

TEST(CrsDefinition, KnowsNothingElse) {
  for (const char* text : {"",
                           "   ",
                           "EPSG:",
                           "28",
                           "12345678",
                           "EPSG:28992x",
                           "EPSG:1+2+3",
                           "EPSG:25832+",
                           "25832,",
                           "urn:ogc:def:crs:EPSG::",
                           "urn:adv:crs:ETRS89_UTM39",
                           "urn:adv:crs:DE_DHHN2016_NH",
                           "urn:ogc:def:crs:",
                           "http://www.opengis.net/def/crs/EPSG/0/",
                           "http://www.opengis.net/def/crs-compound?1=x&2=y",
                           "https://example.org/25832",
                           "PROJCS[\"cut off",
                           "[]",
                           "{}",
                           "{\"type\": \"Feature\"}",
                           "a\nb"})
    EXPECT_FALSE(parse_crs_definition(text).has_value()) << text;
}

TEST(CrsDefinition, ShowsNoEndlessNestingToProj) {
  std::string nested;
  for (int n = 0; n < 1000; ++n) nested += "{\"type\": \"BoundCRS\", \"source_crs\": ";
  EXPECT_FALSE(parse_crs_definition(nested + "0" + std::string(1000, '}')).has_value());
}

TEST(CrsDefinition, SurvivesALongText) { EXPECT_FALSE(parse_crs_definition(std::string(1'000'000, 'E')).has_value()); }

}  // namespace
}  // namespace farlod::georeference

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "georeference/input_crs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <ostream>
#include <string>

#include "georeference/crs.hpp"
#include "georeference/resolved_source.hpp"
#include "tests/preprocess/georeference/small_source.hpp"

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
    testing::Values(Naming{"urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH*GCG2016", {"EPSG:25832+7837"}},
                    Naming{"urn:adv:crs:ETRS89_UTM33*DE_DHHN92_NH", {"EPSG:25833+5783"}},
                    Naming{"urn:adv:crs:ETRS89_UTM31", {"EPSG:25831"}}, Naming{"urn:adv:crs:ETRS89_Lat-Lon", {"EPSG:4258"}},
                    Naming{"urn:adv:crs:DE_DHDN_3GK2_NW101", {"EPSG:31466"}},
                    Naming{"urn:adv:crs:DE_DHDN_3GK3*DE_DHN92_NH", {"EPSG:31467"}},
                    Naming{"urn:adv:crs:DE_DHDN_3GK4", {"EPSG:31468"}}, Naming{"urn:adv:crs:DE_DHDN_3GK5", {"EPSG:31469"}},
                    Naming{"urn:adv:crs:ETRS89_UTM28", {"EPSG:25828"}},
                    Naming{"urn:adv:crs:ETRS89_UTM38*DE_DHHN2016_NH", {"EPSG:25838+7837"}},
                    Naming{"urn:adv:crs:ETRS89_Lat-Lon-h", {"EPSG:4937"}},
                    Naming{"urn:adv:crs:DE_DHDN_Lat-Lon*DE_DHHN92_NH", {"EPSG:4314+5783"}},
                    Naming{"urn:adv:crs:DE_RD-83_3GK5*DE_DHHN92_NH", {"EPSG:3399+5783"}},
                    Naming{"urn:adv:crs:DE_PD-83_3GK4", {"EPSG:3397"}}, Naming{"urn:adv:crs:DE_42-83_3GK4", {"EPSG:2398"}}));

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

TEST(FileAxes, LeadToTheMapAndBack) {
  const Point3d p{32'365'000.25, 5'621'000.5, 200.0};
  const FileAxes zone{AxisOrder::easting_first, 32e6, 1.0}, swapped{AxisOrder::northing_first, 0.0, 0.5};
  EXPECT_EQ(zone.p_map(p), (Point3d{365'000.25, 5'621'000.5, 200.0}));
  EXPECT_EQ(swapped.p_map(p), (Point3d{p.y, p.x, 100.0}));
  for (const FileAxes& axes : {FileAxes{}, zone, swapped, FileAxes{AxisOrder::northing_first, 32e6, 0.5}}) {
    EXPECT_EQ(axes.p_file(axes.p_map(p)), p);
    EXPECT_EQ(axes.p_map(axes.p_file(p)), p);
  }
}

constexpr Ellipsoid wgs84{6378137.0, 298.257223563};
/// The figures are stated to a thousandth of a degree.
constexpr double last_digit_deg = 0.0005;

TEST(UtmZone, FollowsTheExceptionsOfTheNorth) {
  EXPECT_EQ(utm_zone_of({-73.97, 40.78}), (UtmZone{18, true}));
  EXPECT_EQ(utm_zone_of({5.32, 60.39}), (UtmZone{32, true})) << "Bergen";
  EXPECT_EQ(utm_zone_of({15.6, 78.2}), (UtmZone{33, true})) << "Longyearbyen";
  EXPECT_EQ(utm_zone_of({151.2, -33.9}), (UtmZone{56, false}));
  EXPECT_EQ(utm_zone_of({179.9, 0.0}), (UtmZone{60, true}));
  EXPECT_EQ(utm_zone_of({-100.0, 86.0}), (UtmZone{14, true})) << "beyond UTM proper";
}

TEST(UtmProjection, PutsTheMeridianAtHalfAMillion) {
  EXPECT_EQ(UtmProjection({31, true}, wgs84).projected({3.0, 0.0}), (Point2d{500000.0, 0.0}));
  EXPECT_EQ(UtmProjection({31, false}, wgs84).projected({3.0, 0.0}), (Point2d{500000.0, 1e7}));
}

TEST(UtmProjection, AgreesWithProj) {
  const auto wgs84_crs = Crs::find("EPSG:4326"), utm = Crs::find("EPSG:32618");
  ASSERT_TRUE(wgs84_crs && utm);
  for (const Point2d place : {Point2d{-73.97, 40.78}, Point2d{-77.9, 5.0}, Point2d{-72.1, 79.0}}) {
    const auto ours = UtmProjection({18, true}, wgs84).projected(place);
    const auto theirs = CrsTransformation(*wgs84_crs, *utm, place).apply(place);
    ASSERT_TRUE(ours && theirs);
    EXPECT_NEAR(ours->x, theirs->x, two_series_m);
    EXPECT_NEAR(ours->y, theirs->y, two_series_m);
  }
}

TEST(UtmProjection, HasAnInverse) {
  const UtmProjection utm({33, false}, wgs84);
  const Point2d place{17.25, -22.5};
  const Point2d back = utm.lon_lat_deg(*utm.projected(place));
  constexpr double two_series_deg = two_series_m / 1e5;  // a degree is longer than 100 km here
  EXPECT_NEAR(back.x, place.x, two_series_deg);
  EXPECT_NEAR(back.y, place.y, two_series_deg);
}

TEST(UtmProjection, HasNoPlaceForWhatIsFarOff) {
  const UtmProjection utm({32, true}, wgs84);
  EXPECT_FALSE(utm.projected({0.0, 0.0})) << "9 degrees from the meridian, at the equator";
  EXPECT_FALSE(utm.projected({189.0, 50.0})) << "on the other side of the Earth";
  EXPECT_FALSE(utm.projected({9.0, 95.0}));
  EXPECT_FALSE(utm.projected({std::numeric_limits<double>::quiet_NaN(), 50.0}));
  EXPECT_FALSE(utm.projected({std::numeric_limits<double>::infinity(), 50.0}));
}

TEST(Convergence, IsWhatIsKnownOfManhattanAndBarcelona) {
  const UtmProjection zone_18({18, true}, wgs84), zone_31({31, true}, wgs84);
  EXPECT_NEAR(zone_18.convergence_at(*zone_18.projected({-73.97, 40.78})).degrees(), 0.673, last_digit_deg);
  EXPECT_NEAR(zone_31.convergence_at(*zone_31.projected({2.16, 41.39})).degrees(), -0.555, last_digit_deg);
}

// The promise itself: true azimuth = grid azimuth + γ, measured on two points one above the other
TEST(Convergence, TurnsGridAzimuthsIntoTrueOnes) {
  for (const Point2d place : {Point2d{-73.97, 40.78}, Point2d{-76.5, -33.0}}) {
    const UtmProjection utm(utm_zone_of(place), wgs84);
    const Point2d p = *utm.projected(place);
    constexpr double step_deg = 1e-4;
    const Point2d to_true_north = *utm.projected(place + Point2d{0.0, step_deg}) - p;
    const double grid_azimuth = std::atan2(to_true_north.x, to_true_north.y);
    // Rounding of two coordinates over 11 m, and the bend of the meridian, less than a step's worth of latitude
    const double measured_rad = 4.0 * two_series_m / 11.0 + step_deg * (3.14159265358979 / 180.0);
    EXPECT_NEAR(grid_azimuth + utm.convergence_at(p).radians(), 0.0, measured_rad);
  }
}

}  // namespace
}  // namespace farlod::georeference

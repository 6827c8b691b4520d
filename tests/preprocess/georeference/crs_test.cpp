// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "georeference/crs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>

#include "georeference/georeference.hpp"
#include "tests/preprocess/georeference/small_source.hpp"
#include "tests/preprocess/ingest/reading.hpp"

namespace farlod::georeference::test {
namespace {

using ingest::test::shared_data;
using ingest::test::write_file;

constexpr double us_survey_foot_m = 1200.0 / 3937.0;
/// EPSG writes units with 17 digits: an ulp of a foot.
constexpr double ulp_of_a_foot = 1.2e-16;

const char* const esri_wgs84 =
    "GEOGCS[\"GCS_WGS_1984\",DATUM[\"D_WGS_1984\",SPHEROID[\"WGS_1984\",6378137.0,298.257223563]],"
    "PRIMEM[\"Greenwich\",0.0],UNIT[\"Degree\",0.0174532925199433]]";
const char* const esri_utm_32 =
    "PROJCS[\"ETRS_1989_UTM_Zone_32N\",GEOGCS[\"GCS_ETRS_1989\",DATUM[\"D_ETRS_1989\",SPHEROID[\"GRS_1980\",6378137.0,"
    "298.257222101]],PRIMEM[\"Greenwich\",0.0],UNIT[\"Degree\",0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],"
    "PARAMETER[\"False_Easting\",500000.0],PARAMETER[\"False_Northing\",0.0],PARAMETER[\"Central_Meridian\",9.0],"
    "PARAMETER[\"Scale_Factor\",0.9996],PARAMETER[\"Latitude_Of_Origin\",0.0],UNIT[\"Meter\",1.0]]";

Crs crs(const std::string& definition) {
  const auto found = Crs::find(definition);
  EXPECT_TRUE(found.has_value()) << definition;
  return found.value();
}

TEST(Crs, KnowsOnlyHorizontalOnes) {
  EXPECT_FALSE(Crs::find("EPSG:669")) << "no such code";
  EXPECT_FALSE(Crs::find("EPSG:4978")) << "geocentric";
  EXPECT_FALSE(Crs::find("EPSG:5783")) << "heights alone";
  EXPECT_FALSE(Crs::find("PROJCS[broken]"));
  EXPECT_FALSE(Crs::find("+proj=nonsense +type=crs"));
}

TEST(Crs, KnowsTheAuthoritysAxisOrder) {
  for (const char* northing_first : {"EPSG:4326", "EPSG:6697", "EPSG:31467", "EPSG:2180", "EPSG:3007"})
    EXPECT_TRUE(crs(northing_first).northing_first()) << northing_first;
  for (const std::string easting_first : {"EPSG:25832", "EPSG:28992", "EPSG:2263", esri_wgs84, esri_utm_32})
    EXPECT_FALSE(crs(easting_first).northing_first()) << easting_first;
}

TEST(Crs, KnowsWhereAxesRun) {
  EXPECT_TRUE(crs("EPSG:31467").runs_east_and_north());
  EXPECT_FALSE(crs("EPSG:2048").runs_east_and_north()) << "Lo19 of South Africa counts to the west and south";
}

TEST(Crs, KnowsTheUnitOfHeights) {
  EXPECT_EQ(crs("EPSG:25832+7837").height_unit_m(), 1.0);
  EXPECT_EQ(crs("EPSG:4979").height_unit_m(), 1.0);
  EXPECT_EQ(crs("EPSG:4326").height_unit_m(), 1.0);
  EXPECT_NEAR(crs("EPSG:2263").height_unit_m(), us_survey_foot_m, ulp_of_a_foot) << "no vertical axis: as the horizontal ones";
  EXPECT_EQ(crs("EPSG:2263+5703").height_unit_m(), 1.0) << "NAVD88 in metres";
  EXPECT_NEAR(crs("EPSG:2263+6360").height_unit_m(), us_survey_foot_m, ulp_of_a_foot) << "NAVD88 in US survey feet";
  EXPECT_EQ(crs("EPSG:2263+8228").height_unit_m(), 0.3048) << "NAVD88 in international feet";
  for (const char* three_dimensions : {"EPSG:6697", "EPSG:4979", "EPSG:7912"}) {
    EXPECT_EQ(crs(three_dimensions).height_unit_m(), 1.0) << three_dimensions;
    EXPECT_TRUE(crs(three_dimensions).says_height_unit()) << three_dimensions;
  }
  EXPECT_FALSE(crs("EPSG:2263").says_height_unit());
  EXPECT_NEAR(crs("EPSG:32118+6360").height_unit_m(), us_survey_foot_m, ulp_of_a_foot) << "NAVD88 in feet";
}

TEST(Crs, FindsItsCodeInTheRegister) {
  EXPECT_EQ(crs("EPSG:28992").epsg(), 28992);
  EXPECT_EQ(crs("EPSG:7415").epsg(), 28992) << "without its heights";
  EXPECT_EQ(crs(esri_utm_32).epsg(), 25832);
  EXPECT_EQ(crs("+proj=tmerc +lat_0=1 +lon_0=2 +type=crs").epsg(), std::nullopt);
}

TEST(Crs, WktLeadsBackToIt) {
  for (const char* code : {"EPSG:28992", "EPSG:31467", "EPSG:32118", "+proj=tmerc +lat_0=1 +lon_0=2 +type=crs"}) {
    const Crs first = crs(code);
    EXPECT_TRUE(crs(first.wkt()).equals(first)) << code;
    EXPECT_EQ(crs(first.wkt()).northing_first(), first.northing_first()) << code;
  }
}

TEST(Crs, HasAMetricTwin) {
  const Crs long_island = crs("EPSG:2263").counted_in(metre);
  EXPECT_EQ(long_island.epsg(), 32118);
  EXPECT_EQ(long_island.unit(), 1.0);
  const Crs maryland = crs("EPSG:2248").counted_in(metre);  // the register's own differs by parts of a millimetre
  EXPECT_EQ(maryland.unit(), 1.0);
  EXPECT_EQ(maryland.name(), "NAD83 / Maryland");
}

TEST(Crs, HasTwinsInOtherUnits) {
  EXPECT_EQ(crs("EPSG:32118").counted_in(us_survey_foot).epsg(), 2263);
  EXPECT_EQ(crs("EPSG:28992").counted_in(foot).epsg(), std::nullopt);
  EXPECT_EQ(crs("EPSG:28992").counted_in(foot).unit(), 0.3048);
}

TEST(Crs, KnowsHowWideZonesAre) {
  for (const char* utm : {"EPSG:25832", "EPSG:4647", "EPSG:5652", "EPSG:3834"}) EXPECT_EQ(crs(utm).zone_width_deg(), 6.0) << utm;
  for (const char* gauss_krueger : {"EPSG:31466", "EPSG:5677"}) EXPECT_EQ(crs(gauss_krueger).zone_width_deg(), 3.0);
  for (const char* other : {"EPSG:28992", "EPSG:4258", "EPSG:2225"}) EXPECT_EQ(crs(other).zone_width_deg(), 0.0) << other;
}

TEST(Crs, HasUtmOnItsOwnDatum) {
  EXPECT_EQ(crs("EPSG:4326").utm({18, true}).epsg(), 32618);
  EXPECT_EQ(crs("EPSG:4979").utm({56, false}).epsg(), 32756);
  EXPECT_EQ(crs(esri_wgs84).utm({18, true}).epsg(), 32618);
  EXPECT_EQ(crs("EPSG:4258").utm({32, true}).epsg(), 25832);
  EXPECT_EQ(crs("EPSG:4269").utm({18, true}).epsg(), 26918);
  EXPECT_EQ(crs("EPSG:6697").utm({54, true}).epsg(), 6691);
  EXPECT_EQ(crs("EPSG:4301").utm({54, true}).epsg(), 3095);
}

TEST(Crs, KnowsUtmWhenItSeesIt) {
  EXPECT_EQ(crs("EPSG:25832").utm_zone(), (UtmZone{32, true}));
  EXPECT_EQ(crs("EPSG:32756").utm_zone(), (UtmZone{56, false}));
  EXPECT_EQ(crs("EPSG:4647").utm_zone(), std::nullopt) << "the zone stands before the easting: not the formula's own";
  EXPECT_EQ(crs("EPSG:28992").utm_zone(), std::nullopt);
  EXPECT_EQ(crs("EPSG:4326").utm_zone(), std::nullopt);
}

TEST(Crs, CountsInDegreesFromGreenwich) {
  EXPECT_TRUE(crs("EPSG:4326").is_in_degrees_from_greenwich());
  EXPECT_TRUE(crs(esri_wgs84).is_in_degrees_from_greenwich());
  EXPECT_FALSE(crs("EPSG:4807").is_in_degrees_from_greenwich()) << "grads from Paris";
  EXPECT_FALSE(crs("EPSG:25832").is_in_degrees_from_greenwich());
}

TEST(Crs, KnowsPlacesInDegreesFromGreenwich) {
  const auto observatory = crs("EPSG:4807").lon_lat_deg({0.0, 54.262});  // grads from Paris
  ASSERT_TRUE(observatory.has_value());
  // By definition of the meridian of Paris: 2 deg 20' 14.025"
  constexpr double written_to_deg = 0.5e-3 / 3600.0;
  EXPECT_NEAR(observatory->x, 2.0 + 20.0 / 60.0 + 14.025 / 3600.0, written_to_deg);
  EXPECT_NEAR(observatory->y, 54.262 * 0.9, written_to_deg);
  const auto meridian = crs("EPSG:25832").lon_lat_deg({500000.0, 5400000.0});
  ASSERT_TRUE(meridian.has_value());
  EXPECT_NEAR(meridian->x, 9.0, written_to_deg);
  EXPECT_FALSE(crs("EPSG:4326").lon_lat_deg({8.0, 95.0}).has_value());
  EXPECT_FALSE(crs("EPSG:25832").lon_lat_deg({1e12, 1e12}).has_value());
}

/// Textbook: tan γ = tan Δλ sin φ on the sphere; the ellipsoid changes it by e'² Δλ² of itself at most.
double convergence_of_transverse_mercator(double lon_from_meridian_deg, double lat_deg) {
  constexpr double degree = 3.14159265358979 / 180.0;
  return std::atan(std::tan(lon_from_meridian_deg * degree) * std::sin(lat_deg * degree));
}

TEST(Crs, ConvergesWhateverItsAxisOrder) {
  for (const char* code : {"EPSG:31467", "EPSG:5677"}) {  // the same projection, northing first and easting first
    const Crs gauss_krueger = crs(code);
    const auto p = CrsTransformation(gauss_krueger.geographic(), gauss_krueger, {10.0, 50.0}).apply(Point2d{10.0, 50.0});
    ASSERT_TRUE(p.has_value());
    const double expected = convergence_of_transverse_mercator(1.0, 50.0);
    constexpr double ellipsoid_share = 0.0067 * 0.0175 * 0.0175;
    EXPECT_NEAR(gauss_krueger.distortion_at(*p)->convergence.radians(), expected, ellipsoid_share) << code;
  }
}

TEST(Crs, KnowsThatWebMercatorStretches) {
  const Crs web = crs("EPSG:3857");
  const auto p = CrsTransformation(web.geographic(), web, {8.0, 60.0}).apply(Point2d{8.0, 60.0});
  const auto distortion = web.distortion_at(*p);
  ASSERT_TRUE(distortion.has_value());
  // Sphere for ellipsoid: off by the flattening
  EXPECT_NEAR(distortion->greatest_scale, 1.0 / std::cos(3.14159265358979 / 3.0), 2.0 * 2.0 / 298.0);
}

TEST(Crs, StatesItsScaleInMetres) {
  const auto distortion = crs("EPSG:2263").distortion_at({1025000.0, 172918.0});  // feet
  ASSERT_TRUE(distortion.has_value());
  constexpr double state_plane_scale_error = 1e-4;  // by the design of the system: one part in 10,000
  EXPECT_NEAR(distortion->greatest_scale, 1.0, state_plane_scale_error);
}

TEST(AreaOfUse, MayCrossTheAntimeridian) {
  constexpr AreaOfUse fiji{176.0, -20.0, -178.0, -12.0};
  EXPECT_TRUE(fiji.contains({179.0, -17.0}));
  EXPECT_TRUE(fiji.contains({-179.0, -17.0}));
  EXPECT_FALSE(fiji.contains({0.0, -17.0}));
  EXPECT_TRUE(fiji.contains({-177.5, -17.0}, 1.0, 0.0)) << "half a degree beyond, with a margin of one";
  EXPECT_TRUE(fiji.contains({175.5, -17.0}, 1.0, 0.0));
  EXPECT_FALSE(fiji.contains({-176.5, -17.0}, 1.0, 0.0));
  EXPECT_FALSE(fiji.contains({-177.5, -17.0}));
}

TEST(AreaOfUse, MayBeTheWorld) {
  constexpr AreaOfUse world{-180.0, -90.0, 180.0, 90.0};
  for (const double lon_deg : {-180.0, -90.0, 0.0, 179.9, 180.0}) EXPECT_TRUE(world.contains({lon_deg, 45.0})) << lon_deg;
  EXPECT_FALSE(world.contains({0.0, 90.5}));
}

TEST(CrsTransformation, MakesWhatItCannotTransformInfinite) {
  const CrsTransformation way(crs("EPSG:4326"), crs("EPSG:28992"), {4.4, 51.9});
  std::vector<Point3d> points{{4.4, 51.9, 7.0}, {4.4, 100.0, 7.0}};
  way.apply(points);
  EXPECT_TRUE(std::isfinite(points[0].x));
  EXPECT_EQ(points[0].z, 7.0) << "heights are left alone";
  EXPECT_TRUE(std::isinf(points[1].x));
}

TEST(CrsTransformation, KeepsTheShiftThatOldDefinitionsCarry) {
  const Crs shifted = crs("+proj=longlat +ellps=bessel +towgs84=598.1,73.7,418.2,0.202,0.045,-2.455,6.7 +type=crs");
  const auto there = CrsTransformation(shifted, crs("EPSG:4326"), {9.0, 50.0}).apply(Point2d{9.0, 50.0});
  ASSERT_TRUE(there.has_value());
  EXPECT_GT(std::abs(there->x - 9.0), 1e-4) << "DHDN lies some 100 m from WGS 84";
}

// Corners of real buildings, against values that were not computed by this project nor by PROJ, but from published formulas in
// Python: transverse Mercator by Krüger's series to the sixth order (Karney 2011, J. Geod. 85, 475; the same as the Geospatial
// Information Authority of Japan publishes), Lambert's conformal conic by Snyder (1987, USGS Prof. Paper 1395, p. 107), both on
// GRS 80; RD to WGS 84 by the polynomials of Schreutelkamp & Strang van Hees (2001). Each was checked against gdaltransform: the
// series and the cone agree to 1e-7 m.

/// The values below are written to a tenth of a millimetre.
constexpr double written_to_m = 0.5e-4;
/// One rounding of a coordinate below 8,000 km, moved to the origin and back: two ulps.
constexpr double rounding_m = 2.0 * 9.4e-10;

LocatedCity locate(const std::filesystem::path& file, const ingest::IngestSettings& ingest_settings,
                   const GeoreferenceSettings& settings, Report& report) {
  std::vector<SourceCity> sources;
  sources.push_back(ingest::ingest(file, ingest_settings, report));
  return georeference(std::move(sources), settings, report);
}

LocatedCity locate(const std::filesystem::path& file, const std::string& out_crs = "") {
  Report report;
  LocatedCity located = locate(file, {}, {"", out_crs}, report);
  for (const Problem& problem : report.problems()) EXPECT_NE(static_cast<int>(problem.code) / 100, 2) << problem.detail;
  return located;
}

Point3d projected(const LocatedCity& located, const Point3d& p_city) {
  return p_city + Point3d{located.georeference.origin_m.x, located.georeference.origin_m.y, 0.0};
}

/// How far the nearest vertex of a building is from a place on the map.
double distance_to(const LocatedCity& located, const std::string& building, Point2d corner) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const Building& b : located.city.buildings()) {
    if (b.id != building) continue;
    for (const Point3d& p : located.city.points_of(b)) {
      const Point3d there = projected(located, p);
      least_m = std::min(least_m, std::hypot(there.x - corner.x, there.y - corner.y));
    }
  }
  return least_m;
}

TEST(KnownCorners, Tokyo) {
  FARLOD_NEEDS_DATA("tokyo");
  const LocatedCity tokyo = locate(shared_data("tokyo/53392633_bldg_6697_2_op.gml"), "EPSG:6677");
  EXPECT_EQ(tokyo.georeference.epsg, 6677);
  std::set<std::string> ids;
  for (const Building& b : tokyo.city.buildings()) ids.insert(b.id);
  EXPECT_EQ(tokyo.city.buildings().size(), 9u);
  EXPECT_EQ(ids.size(), 9u) << "each building once";
  // 35.533096948566886 N, 139.7963519674318 E, from the origin of system IX, 36 N, 139 deg 50' E, scale 0.9999
  EXPECT_LT(distance_to(tokyo, "bldg_1290f570-9df8-4956-bef3-6d0976c835be", {-3353.5846, -51799.2696}), 2.0 * written_to_m);
}

TEST(KnownCorners, NorthRhineWestphalia) {
  FARLOD_NEEDS_DATA("nrw");
  const std::filesystem::path file = shared_data("nrw/LoD2_32_280_5657_1_NW.gml");
  const LocatedCity own = locate(file);
  EXPECT_EQ(own.georeference.epsg, 25832);
  EXPECT_LT(distance_to(own, "DENW43AL00001j2W", {280928.215, 5657501.743}), 2.0 * rounding_m);
  // Zone 32 to 51.02725923847479 N, 5.875814027008618 E, and from there to zone 31
  const LocatedCity next_zone = locate(file, "EPSG:25831");
  EXPECT_LT(distance_to(next_zone, "DENW43AL00001j2W", {701658.8208, 5656792.2631}), 2.0 * written_to_m);
}

TEST(KnownCorners, Rotterdam) {
  FARLOD_NEEDS_DATA("rotterdam");
  const std::filesystem::path file = shared_data("rotterdam/delfshaven.city.json");
  const LocatedCity own = locate(file);
  EXPECT_EQ(own.georeference.epsg, 28992);
  EXPECT_LT(distance_to(own, "{10A31B7E-8FC2-45EE-836A-1DB9FEF06E04}", {90437.680, 436076.886}), 2.0 * rounding_m);
  // The polynomials' stated accuracy, and that of PROJ's seven parameters by EPSG's register (15934)
  constexpr double polynomials_m = 0.25, seven_parameters_m = 1.0;
  const LocatedCity utm = locate(file, "EPSG:32631");  // at 51.90944204 N, 4.44892703 E
  EXPECT_LT(distance_to(utm, "{10A31B7E-8FC2-45EE-836A-1DB9FEF06E04}", {599667.690, 5751958.114}),
            polynomials_m + seven_parameters_m);
}

const Point3d queens_origin_m{312420.625, 52705.512, 0.0};
const Point3d queens_origin_ft{1025000.0, 172918.0, 0.0};

/// The first buildings of the file, with coordinates multiplied.
std::filesystem::path some_of_queens(std::size_t buildings, double factor) {
  std::ifstream file(shared_data("nyc_queens/queens_da4.obj"));
  std::ostringstream text;
  text.precision(17);
  std::size_t met = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("g ") && ++met > buildings) break;
    double x = 0.0, y = 0.0, z = 0.0;
    if (std::sscanf(line.c_str(), "v %lf %lf %lf", &x, &y, &z) == 3)
      text << "v " << factor * x << ' ' << factor * y << ' ' << factor * z << '\n';
    else
      text << line << '\n';
  }
  return write_file(factor == 1.0 ? "metres.obj" : "feet.obj", text.str());
}

LocatedCity locate_queens(const std::filesystem::path& file, const std::string& crs, const Point3d& origin,
                          const std::string& out_crs = "") {
  ingest::IngestSettings settings;
  settings.obj_origin = origin;
  Report report;
  LocatedCity located = locate(file, settings, {crs, out_crs}, report);
  for (const Problem& problem : report.problems()) EXPECT_NE(static_cast<int>(problem.code) / 100, 2) << problem.detail;
  return located;
}

TEST(KnownCorners, Queens) {
  FARLOD_NEEDS_DATA("nyc_queens");
  const std::filesystem::path file = some_of_queens(300, 1.0);
  const LocatedCity own = locate_queens(file, "EPSG:32118", queens_origin_m);
  EXPECT_EQ(own.georeference.epsg, 32118);
  EXPECT_LT(distance_to(own, "BIN_4245437", {312498.959, 56219.153}), 2.0 * rounding_m);
  // Long Island's cone to 40.67284249553845 N, 73.85217036652884 W, and from there to UTM 18 on NAD83
  const LocatedCity utm = locate_queens(file, "EPSG:32118", queens_origin_m, "EPSG:26918");
  EXPECT_LT(distance_to(utm, "BIN_4245437", {597010.9619, 4503073.8689}), 2.0 * written_to_m);
}

TEST(KnownCorners, QueensIsTheSameInFeet) {
  FARLOD_NEEDS_DATA("nyc_queens");
  const LocatedCity metres = locate_queens(some_of_queens(300, 1.0), "EPSG:32118", queens_origin_m);
  const LocatedCity feet = locate_queens(some_of_queens(300, 1.0 / us_survey_foot_m), "EPSG:2263", queens_origin_ft);
  EXPECT_EQ(feet.georeference.epsg, 32118) << "the metric twin";
  ASSERT_EQ(metres.city.buildings().size(), 300u);
  ASSERT_EQ(feet.city.points().size(), metres.city.points().size());
  // The origin in metres is that in feet, written to a millimetre
  constexpr double half_a_millimetre = 0.5e-3;
  for (std::size_t n = 0; n < metres.city.points().size(); ++n) {
    const Point3d in_m = projected(metres, metres.city.points()[n]), in_ft = projected(feet, feet.city.points()[n]);
    ASSERT_NEAR(in_ft.x, in_m.x, half_a_millimetre + rounding_m);
    ASSERT_NEAR(in_ft.y, in_m.y, half_a_millimetre + rounding_m);
    ASSERT_NEAR(in_ft.z, in_m.z, rounding_m);
  }
}

TEST(KnownCorners, AreTheSameInMetresFeetAndDegrees) {
  // The corner of Queens above, as four files say it: its cone in metres, in feet, latitude and longitude, and UTM
  const Point2d in_m{312498.959, 56219.153};
  std::vector<SourceCity> sources{source_with("EPSG:32118", {in_m.x, in_m.y, 6.0}, 10.0),
                                  source_with("EPSG:2263", {in_m.x / us_survey_foot_m, in_m.y / us_survey_foot_m, 20.0}, 30.0),
                                  source_with("EPSG:4269", {40.672842495538454, -73.85217036652884, 6.0}, ten_metres_deg),
                                  source_with("EPSG:26918", {597010.9619, 4503073.8689, 6.0}, 10.0)};
  Report report;
  const LocatedCity located = georeference(std::move(sources), {}, report);
  EXPECT_TRUE(report.problems().empty());
  ASSERT_EQ(located.city.buildings().size(), 4u);
  EXPECT_EQ(located.georeference.epsg, 32118) << "the first file's";
  for (const Building& b : located.city.buildings()) {
    const Point3d corner = projected(located, located.city.points_of(b)[0]);
    EXPECT_NEAR(corner.x, in_m.x, 2.0 * written_to_m) << "file " << b.source;
    EXPECT_NEAR(corner.y, in_m.y, 2.0 * written_to_m) << "file " << b.source;
  }
}

TEST(KnownCorners, StayWhereTheyAreWhenFilesOfSeveralSystemsComeTogether) {
  FARLOD_NEEDS_DATA("nrw");
  FARLOD_NEEDS_DATA("rotterdam");
  Report report;
  std::vector<SourceCity> sources;
  // German metres first; Dutch metres on another ellipsoid into the same zone, 170 km away
  sources.push_back(ingest::ingest(shared_data("nrw/LoD2_32_280_5657_1_NW.gml"), {}, report));
  sources.push_back(ingest::ingest(shared_data("rotterdam/delfshaven.city.json"), {}, report));
  const LocatedCity both = georeference(std::move(sources), {}, report);
  EXPECT_EQ(both.georeference.epsg, 25832) << "the first file's";
  EXPECT_LT(distance_to(both, "DENW43AL00001j2W", {280928.215, 5657501.743}), 2.0 * rounding_m);
  constexpr double polynomials_m = 0.25, seven_parameters_m = 1.0;
  EXPECT_LT(distance_to(both, "{10A31B7E-8FC2-45EE-836A-1DB9FEF06E04}", {187014.955, 5760758.452}),
            polynomials_m + seven_parameters_m);
}

}  // namespace
}  // namespace farlod::georeference::test

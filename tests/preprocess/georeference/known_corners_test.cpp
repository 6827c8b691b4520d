// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
// Corners of real buildings, against values that were not computed by this project nor by PROJ, but from published formulas in
// Python: transverse Mercator by Krüger's series to the sixth order (Karney 2011, J. Geod. 85, 475; the same as the Geospatial
// Information Authority of Japan publishes), Lambert's conformal conic by Snyder (1987, USGS Prof. Paper 1395, p. 107), both on
// GRS 80; RD to WGS 84 by the polynomials of Schreutelkamp & Strang van Hees (2001). Each was checked against gdaltransform: the
// series and the cone agree to 1e-7 m.
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
constexpr double us_survey_foot_m = 1200.0 / 3937.0;

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

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "georeference/georeference.hpp"

#include <gmock/gmock.h>

#include <functional>

#include "farlod/error.hpp"
#include "georeference/crs.hpp"
#include "georeference/place_on_earth.hpp"
#include "georeference/resolved_source.hpp"
#include "tests/preprocess/georeference/small_source.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod::georeference {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double survey_foot_m = 1200.0 / 3937.0;
/// One rounding of a coordinate below 8,000 km, moved to the origin and back: two ulps.
constexpr double double_rounding_m = 2.0 * 9.4e-10;

LocatedCity locate(SourceCity source, const GeoreferenceSettings& settings = {}) {
  std::vector<SourceCity> sources;
  sources.push_back(std::move(source));
  Report report;
  LocatedCity located = georeference(std::move(sources), settings, report);
  EXPECT_TRUE(report.problems().empty());
  return located;
}

std::string message_of(const std::function<void()>& action) {
  return scenes::refusal_of<InputError>([&] { action(); });
}

Point3d in_crs(const std::string& from, const std::string& to, const Point3d& p) {
  const CrsTransformation way(*Crs::find(from), *Crs::find(to), horizontal(p));
  std::vector<Point3d> points{p};
  way.apply(points);
  return points[0];
}

TEST(Georeference, KeepsMetricCoordinatesToTheBit) {
  const Point3d first{92461.37, 436007.11, 3.25};
  const LocatedCity located = locate(source_with("EPSG:28992", first, 10.0));
  EXPECT_EQ(located.georeference.epsg, 28992);
  EXPECT_EQ(located.georeference.origin_m, (Point2d{92466.0, 436012.0})) << "the centre, in whole metres";
  EXPECT_EQ(located.city.points()[0], (Point3d{first.x - 92466.0, first.y - 436012.0, first.z}));
  EXPECT_EQ(located.georeference.crs_name, "Amersfoort / RD New");
  EXPECT_TRUE(Crs::find(located.georeference.crs_wkt)->equals(*Crs::find("EPSG:28992")));
}

TEST(Georeference, ReadsLatitudeFirstAsSuch) {
  const LocatedCity tokyo =
      locate(source_with("http://www.opengis.net/def/crs/EPSG/0/6697", {35.5327, 139.7937, 3.0}, ten_metres_deg));
  EXPECT_EQ(tokyo.georeference.epsg, 6691) << "UTM 54N on the datum of the input, JGD2011";
  expect_place(first_projected(tokyo), in_crs("EPSG:6668", "EPSG:6691", {139.7937, 35.5327, 3.0}),
               two_series_m + double_rounding_m);
}

TEST(Georeference, ReadsLongitudeFirstWhereTheNameSaysSo) {
  const LocatedCity located = locate(source_with("urn:ogc:def:crs:OGC:1.3:CRS84", {-73.97, 40.78, 3.0}, ten_metres_deg));
  EXPECT_EQ(located.georeference.epsg, 32618);
  expect_place(first_projected(located), in_crs("EPSG:4326", "EPSG:32618", {-73.97, 40.78, 3.0}),
               two_series_m + double_rounding_m);
}

TEST(Georeference, ReadsLongitudeFirstWhereTheReaderSaysSo) {
  SourceCity source = source_with("EPSG:4326", {-73.97, 40.78, 3.0}, ten_metres_deg);
  source.crs.longitude_first = true;
  EXPECT_EQ(locate(std::move(source)).georeference.epsg, 32618);
}

TEST(Georeference, NeverSecondGuessesAPlaceThatIsPossible) {
  const LocatedCity off_arabia = locate(source_with("EPSG:4326", {13.4, 52.5, 3.0}, ten_metres_deg));
  EXPECT_EQ(off_arabia.georeference.epsg, 32639) << "13.4 N 52.5 E is a place: the authority's order holds";
}

TEST(Georeference, TakesEastingFirstFromFilesOfNorthingFirstCrss) {
  const Point3d easting_first{3512000.0, 5403000.0, 250.0};  // Stuttgart
  const LocatedCity as_files_do = locate(source_with("urn:ogc:def:crs:EPSG::31467", easting_first, 10.0));
  expect_place(first_projected(as_files_do), easting_first, double_rounding_m);
  const LocatedCity as_the_authority = locate(source_with("EPSG:31467", {5403000.0, 3512000.0, 250.0}, 10.0));
  expect_place(first_projected(as_the_authority), easting_first, double_rounding_m);
}

TEST(Georeference, TakesEastingFirstWhereBothOrdersArePlaces) {
  // Soldner Berlin, Alexanderplatz: swapped, it would be in Berlin too
  const Point3d place{25400.0, 21600.0, 36.0};
  expect_place(first_projected(locate(source_with("urn:ogc:def:crs,crs:EPSG:6.12:3068,crs:EPSG:6.12:5783", place, 10.0))), place,
               double_rounding_m);
}

TEST(Georeference, CountsFeetAsFeet) {
  const Point3d first_ft{1025000.0, 172918.0, 100.0};
  const LocatedCity located = locate(source_with("EPSG:2263", first_ft, 30.0));
  EXPECT_EQ(located.georeference.epsg, 32118);
  expect_place(first_projected(located), survey_foot_m * first_ft, double_rounding_m);
  EXPECT_NEAR(located.city.points()[2].z, 130.0 * survey_foot_m, double_rounding_m);
}

TEST(Georeference, KeepsHeightsOfAttributesInMetres) {
  SourceCity source = source_with("EPSG:2263", {1025000.0, 172918.0, 100.0}, 30.0);
  source.crs.heights_in_metres = true;
  EXPECT_EQ(locate(std::move(source)).city.points()[0].z, 100.0);
}

TEST(Georeference, AsksTheVerticalAxisForTheUnitOfHeights) {
  EXPECT_EQ(locate(source_with("EPSG:2263+5703", {1025000.0, 172918.0, 100.0}, 30.0)).city.points()[0].z, 100.0);
}

TEST(HeightsOfAMapInFeet, AreToldWhereNothingNamesTheirUnit) {
  const Point3d first_ft{1025000.0, 172918.0, 100.0};
  EXPECT_THAT(locate(source_with("EPSG:2263", first_ft, 30.0)).notes,
              ElementsAre(AllOf(HasSubstr("town.gml: its heights are taken for US survey feet"), HasSubstr("EPSG:2263+5703"))));
  for (const char* named : {"EPSG:2263+5703", "EPSG:2263+6360"})
    EXPECT_THAT(locate(source_with(named, first_ft, 30.0)).notes, IsEmpty()) << named;
  SourceCity footprints = source_with("EPSG:2263", first_ft, 30.0);
  footprints.crs.heights_in_metres = true;
  EXPECT_THAT(locate(std::move(footprints)).notes, IsEmpty());
  Report report;
  const std::vector<SourceCity> tiles(2, source_with("EPSG:2263", first_ft, 30.0));
  EXPECT_THAT(georeference(tiles, {}, report).notes, testing::SizeIs(1)) << "once for all";
}

TEST(Georeference, LeavesWebMercator) {
  const Point3d place = in_crs("EPSG:4326", "EPSG:3857", {8.0, 60.0, 5.0});
  const LocatedCity located = locate(source_with("EPSG:3857", place, 10.0));
  EXPECT_EQ(located.georeference.epsg, 32632) << "its metres are half metres there";
  expect_place(first_projected(located), in_crs("EPSG:4326", "EPSG:32632", {8.0, 60.0, 5.0}), two_series_m + double_rounding_m);
}

TEST(Georeference, LeavesAxesThatRunWestAndSouth) {
  const LocatedCity located = locate(source_with("EPSG:2048", {52000.0, 3756000.0, 5.0}, 10.0));  // Cape Town
  EXPECT_THAT(located.georeference.crs_name, HasSubstr("UTM zone 34S"));
}

TEST(Georeference, PutsCitiesInGradsFromParisIntoUtm) {
  const LocatedCity paris = locate(source_with("EPSG:4807", {54.27, 0.012, 35.0}, ten_metres_deg));
  EXPECT_EQ(paris.georeference.epsg, 32631);
  const Point3d p = first_projected(paris);
  EXPECT_NEAR(p.x, 452000.0, 5000.0) << "in Paris, and not at 54 degrees of latitude";
  EXPECT_NEAR(p.y, 5410000.0, 10000.0);
}

TEST(Georeference, ObeysOutCrs) {
  const LocatedCity located = locate(source_with("EPSG:28992", {92461.0, 436007.0, 3.0}, 10.0), {"", "EPSG:32631"});
  EXPECT_EQ(located.georeference.epsg, 32631);
  expect_place(first_projected(located), in_crs("EPSG:28992", "EPSG:32631", {92461.0, 436007.0, 3.0}), double_rounding_m);
}

TEST(Georeference, RefusesAnOutCrsThatIsNotInMetres) {
  for (const char* bad : {"EPSG:4326", "EPSG:2263", "EPSG:3857", "EPSG:2048", "EPSG:99999", "nonsense"}) {
    const auto action = [&] { (void)locate(source_with("EPSG:4326", {60.0, 8.0, 3.0}, ten_metres_deg), {"", bad}); };
    EXPECT_THAT(message_of(action), HasSubstr(std::string("--out-crs ") + bad));
  }
}

TEST(Georeference, UsesTheGivenCrsWhereTheFileSaysNone) {
  EXPECT_EQ(locate(source_with("", {92461.0, 436007.0, 3.0}, 10.0), {"EPSG:28992", ""}).georeference.epsg, 28992);
}

TEST(Georeference, AsksForACrsWhereThereIsNone) {
  EXPECT_EQ(message_of([] {
              (void)locate(source_with("", {1, 2, 3}, 10.0));
            }),
            "town.gml does not say its CRS: give --crs EPSG:n");
  EXPECT_THAT(message_of([] {
                (void)locate(source_with("http://www.opengis.net/def/crs/EPSG/0/669", {1, 2, 3}, 10.0));
              }),
              AllOf(HasSubstr("town.gml"), HasSubstr("/669"), HasSubstr("--crs")));
  EXPECT_THAT(message_of([] { (void)locate(source_with("", {1, 2, 3}, 10.0), {"EPSG:669", ""}); }), HasSubstr("--crs EPSG:669"));
}

TEST(Georeference, TellsDegreesFromMetres) {
  EXPECT_THAT(message_of([] {
                (void)locate(source_with("EPSG:25832", {8.5, 50.1, 3}, ten_metres_deg));
              }),
              AllOf(HasSubstr("town.gml"), HasSubstr("degrees"), HasSubstr("8.5, 50.1")));
  EXPECT_THAT(message_of([] {
                (void)locate(source_with("EPSG:4326", {500000, 5600000, 3}, 10.0));
              }),
              HasSubstr("cannot be degrees"));
  EXPECT_THAT(message_of([] { (void)locate(source_with("EPSG:4326", {12, 20, 3}, 10.0)); }), HasSubstr("cannot be degrees"));
}

SourceCity town_with_stray_building() {
  SourceCity source = source_with("EPSG:4326", {60.0, 8.0, 3.0}, ten_metres_deg);
  add_building(source.city, "stray", {{95.0, 8.0, 3.0}, {95.0, 8.1, 3.0}, {95.1, 8.0, 3.0}});
  add_building(source.city, "last", {{60.0, 8.001, 3.0}, {60.0, 8.0012, 3.0}, {60.001, 8.0, 3.0}});
  return source;
}

TEST(Georeference, ReportsABuildingThatLiesNowhere) {
  std::vector<SourceCity> sources{town_with_stray_building()};
  Report report;
  const LocatedCity located = georeference(std::move(sources), {}, report);
  ASSERT_EQ(located.city.buildings().size(), 2u);
  EXPECT_EQ(located.city.buildings()[0].id, "first");
  EXPECT_EQ(located.city.buildings()[1].id, "last");
  EXPECT_EQ(located.city.points().size(), 6u);
  ASSERT_EQ(report.problems().size(), 1u);
  const Problem& problem = report.problems()[0];
  EXPECT_EQ(problem.code, ProblemCode::outside_of_projection);
  EXPECT_EQ(problem.source, "town.gml");
  EXPECT_EQ(problem.place, "stray");
  EXPECT_THAT(problem.detail, AllOf(HasSubstr("8, 95"), HasSubstr("UTM zone 32N")));
}

TEST(Georeference, ReportsCoordinatesThatNoMapHas) {
  SourceCity source = source_with("EPSG:28992", {92461.0, 436007.0, 3.0}, 10.0);
  add_building(source.city, "stray", {{1e30, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  std::vector<SourceCity> sources{std::move(source)};
  Report report;
  EXPECT_EQ(georeference(std::move(sources), {}, report).city.buildings().size(), 1u);
  EXPECT_EQ(report.count(ProblemCode::outside_of_projection), 1u);
}

TEST(Georeference, RefusesACityOfWhichNothingIsLeft) {
  Report report;
  EXPECT_THROW((void)georeference({}, {}, report), InputError);
  const auto bad = source_with("EPSG:28992", {1e30, 0, 0}, 10.0);
  EXPECT_THROW((void)georeference({bad}, {}, report), InputError);
  EXPECT_EQ(report.count(ProblemCode::outside_of_projection), 1u);
}

TEST(Georeference, BringsFilesOfDifferentCrssTogether) {
  const Point3d rd{92461.0, 436007.0, 3.0};
  const Point3d lon_lat = in_crs("EPSG:28992", "EPSG:4326", rd);
  std::vector<SourceCity> sources{source_with("EPSG:28992", rd, 10.0),
                                  source_with("EPSG:4326", {lon_lat.y, lon_lat.x, 3.0}, ten_metres_deg)};
  Report report;
  const LocatedCity located = georeference(std::move(sources), {}, report);
  EXPECT_EQ(located.georeference.epsg, 28992) << "the first file's";
  ASSERT_EQ(located.city.buildings().size(), 2u);
  // Heights are not shifted, so each way starts on its own ellipsoid: 50 m apart, along normals that differ by 100 m / 6,400 km
  constexpr double shift_and_back_m = 50.0 * 100.0 / 6.4e6;
  expect_place(located.city.points_of(located.city.buildings()[1])[0], located.city.points()[0], shift_and_back_m);
}

TEST(Georeference, KeepsAllOfABuilding) {
  SourceCity source;
  source.crs.definition = "EPSG:28992";
  source.city.begin_building("with a hole", HeightReference::on_ground);
  source.city.begin_facet(SurfaceKind::roof, 7, 2);
  source.city.add_ring(std::vector<Point3d>{{92461, 436007, 3}, {92471, 436007, 3}, {92471, 436017, 3}});
  source.city.add_ring(std::vector<Point3d>{{92469, 436009, 3}, {92470, 436009, 3}, {92470, 436010, 3}});
  add_building(source.city, "stray", {{1e30, 0, 0}, {1, 0, 0}, {0, 1, 0}});  // so that the others are copied
  std::vector<SourceCity> sources{std::move(source)};
  Report report;
  const CityModel city = georeference(std::move(sources), {}, report).city;
  ASSERT_EQ(city.buildings().size(), 1u);
  EXPECT_EQ(city.buildings()[0].height_reference, HeightReference::on_ground);
  ASSERT_EQ(city.facets().size(), 1u);
  EXPECT_EQ(city.facets()[0].kind, SurfaceKind::roof);
  EXPECT_EQ(city.facets()[0].surface, 7u);
  EXPECT_EQ(city.facets()[0].part, 2u);
  EXPECT_EQ(city.facets()[0].ring_count, 2u);
  EXPECT_EQ(city.ring(city.facets()[0], 1)[1] - city.ring(city.facets()[0], 0)[0], (Point3d{9, 2, 0}));
}

TEST(Georeference, StatesTheConvergence) {
  const LocatedCity manhattan = locate(source_with("OGC:CRS84", {-73.97, 40.78, 3.0}, ten_metres_deg));
  // The origin is the rounded centre, up to 10 m away: γ changes by sin φ for each degree of longitude
  constexpr double last_digit_deg = 0.0005 + 1e-4;
  EXPECT_NEAR(manhattan.georeference.convergence.degrees(), 0.673, last_digit_deg);
  const LocatedCity barcelona = locate(source_with("EPSG:25831", in_crs("EPSG:4258", "EPSG:25831", {2.16, 41.39, 3.0}), 10.0));
  EXPECT_NEAR(barcelona.georeference.convergence.degrees(), -0.555, last_digit_deg);
}

// Terrain that files bring along.

const Point3d rotterdam{92461.0, 436007.0, 3.0};

SourceCity relief_with(const std::string& crs, std::vector<Point3d> points) {
  SourceCity source;
  source.source = "relief.gml";
  source.crs.definition = crs;
  source.relief_points = std::move(points);
  return source;
}

/// One triangle of a relief, with a step of that size.
std::vector<Point3d> triangle(const Point3d& first, double step) {
  return {first, first + Point3d{step, 0, 0}, first + Point3d{0, step, 1}};
}

TEST(Relief, GoesWithItsBuildings) {
  SourceCity source = source_with("EPSG:28992", rotterdam, 10.0);
  source.relief_points = triangle(rotterdam, 500.0);
  Report report;
  const LocatedCity located = georeference({source}, {}, report);
  EXPECT_THAT(report.problems(), IsEmpty());
  EXPECT_EQ(located.georeference.origin_m, (Point2d{92466.0, 436012.0})) << "the buildings' centre, whatever the relief";
  EXPECT_THAT(located.relief_points, ElementsAre(Point3d{-5, -5, 3}, Point3d{495, -5, 3}, Point3d{-5, 495, 4}));
}

TEST(Relief, IsCountedAsItsFileCounts) {
  SourceCity source = source_with("EPSG:2263", {1025000.0, 172918.0, 100.0}, 30.0);
  source.relief_points = {{1025000.0, 172918.0, 100.0}};
  Report report;
  const LocatedCity located = georeference({source}, {}, report);
  EXPECT_THAT(located.relief_points, ElementsAre(located.city.points()[0])) << "in metres, like a building's vertex there";
}

TEST(Relief, MayComeInAFileOfItsOwnAndInAnotherCrs) {
  const Point3d lat_lon{51.90876, 4.44, 3.0};
  Report report;
  const LocatedCity located =
      georeference({source_with("EPSG:28992", rotterdam, 10.0), relief_with("EPSG:4326", triangle(lat_lon, 1e-3)),
                    relief_with("EPSG:28992", triangle(rotterdam, 20.0))},
                   {}, report);
  EXPECT_THAT(report.problems(), IsEmpty());
  ASSERT_EQ(located.relief_points.size(), 6u) << "file by file";
  EXPECT_EQ(located.relief_points[3], (Point3d{-5, -5, 3}));
  const double degree_of_latitude_m = located.relief_points[1].y - located.relief_points[0].y;
  constexpr double flattening = 1.0 / 298.0;
  EXPECT_NEAR(degree_of_latitude_m, 111.2, 2.0 * 111.2 * flattening) << "latitude first, a thousandth of a degree";
}

TEST(Relief, IsACityOnItsOwn) {
  Report report;
  const LocatedCity located = georeference({relief_with("EPSG:28992", triangle(rotterdam, 100.0))}, {}, report);
  EXPECT_THAT(report.problems(), IsEmpty());
  EXPECT_TRUE(located.city.buildings().empty());
  EXPECT_EQ(located.georeference.origin_m, (Point2d{92511.0, 436057.0})) << "its own centre";
  EXPECT_EQ(located.relief_points[0], (Point3d{-50, -50, 3}));
}

TEST(Relief, LosesPointsThatLieNowhereAndSaysSoOnce) {
  std::vector<Point3d> points = triangle(rotterdam, 100.0);
  points.insert(points.begin() + 1, 2, {1e30, 0.0, 0.0});
  Report report;
  const LocatedCity located = georeference({relief_with("EPSG:28992", points)}, {}, report);
  EXPECT_EQ(located.relief_points.size(), 3u);
  ASSERT_EQ(report.problems().size(), 1u);
  EXPECT_EQ(report.problems()[0].code, ProblemCode::outside_of_projection);
  EXPECT_EQ(report.problems()[0].source, "relief.gml");
  EXPECT_THAT(report.problems()[0].detail, AllOf(HasSubstr("2 of 5 points"), HasSubstr("1e+30")));
}

TEST(Relief, IsNotTakenForDegreesNorDegreesForMetres) {
  Report report;
  EXPECT_THROW((void)georeference({relief_with("EPSG:25832", triangle({8.5, 50.1, 3.0}, 1e-3))}, {}, report), InputError);
  EXPECT_THROW((void)georeference({relief_with("EPSG:4326", triangle({500000, 5600000, 3.0}, 10.0))}, {}, report), InputError);
}

TEST(Relief, MayBeOnePoint) {
  Report report;
  EXPECT_EQ(georeference({relief_with("EPSG:28992", {rotterdam, rotterdam})}, {}, report).relief_points.size(), 2u);
}

TEST(OutputCrs, OfAZoneThatIsNotMeantForTheCityIsDoubtful) {
  Report report;
  const std::vector<SourceCity> town{source_with("EPSG:32632", {500000.0, 5500000.0, 3.0}, 10.0)};
  (void)georeference(town, {"", "EPSG:32633"}, report);
  EXPECT_THAT(report.problems(), IsEmpty()) << "many surveys use one zone for a country";
  (void)georeference(town, {"", "EPSG:32634"}, report);
  ASSERT_EQ(report.count(ProblemCode::unlikely_place), 1u);
  EXPECT_THAT(report.problems()[0].detail, AllOf(HasSubstr("--out-crs"), HasSubstr("UTM zone 34N")));
}

TEST(OutputCrs, OfAFarZoneIsRefused) {
  Report report;
  EXPECT_THROW((void)georeference({source_with("EPSG:28992", rotterdam, 10.0)}, {"", "EPSG:32618"}, report), InputError);
}

TEST(Place, IsInWgs84) {
  const PlaceOnEarth place = place_of(georeference_around({155000.0, 463000.0}, *Crs::find("EPSG:28992")));
  // RD New begins at the Onze Lieve Vrouwetoren of Amersfoort: 52.1551729 N, 5.3872035 E in ETRS89
  ASSERT_TRUE(place.lon_lat_deg);
  constexpr double some_metres_deg = 1e-4;
  EXPECT_NEAR(place.lon_lat_deg->x, 5.3872035, some_metres_deg);
  EXPECT_NEAR(place.lon_lat_deg->y, 52.1551729, some_metres_deg);
  EXPECT_EQ(place.country, "Netherlands");
}

TEST(Place, HasNoCountryBesideTheAreaOfItsCrs) {
  EXPECT_EQ(place_of(georeference_around({500000.0, 5000000.0}, *Crs::find("EPSG:28992"))).country, "");
}

TEST(Place, IsInACountryWhereTheAreaIsThatOfOne) {
  EXPECT_EQ(country_in("Netherlands - onshore, including Waddenzee, and 12-mile offshore coastal zone."), "Netherlands");
  EXPECT_EQ(country_in("Liechtenstein; Switzerland."), "Liechtenstein; Switzerland");
  EXPECT_EQ(country_in("Austria."), "Austria");
  for (const char* none :
       {"World.", "Europe - west.", "Between 6°E and 12°E, northern hemisphere, onshore and offshore.",
        "Japan - onshore; North Korea - onshore; South Korea - onshore.", "Burundi, Kenya, Rwanda, Tanzania and Uganda.", ""})
    EXPECT_EQ(country_in(none), "") << none;
}

}  // namespace
}  // namespace farlod::georeference

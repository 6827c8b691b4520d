// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "farlod/error.hpp"
#include "georeference/crs.hpp"
#include "georeference/georeference.hpp"
#include "georeference/resolved_source.hpp"
#include "tests/preprocess/georeference/small_source.hpp"

// What is said of a whole file: how it counts, where it lies, and which CRS holds.

namespace farlod::georeference {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double foot_m = 1200.0 / 3937.0;
/// One rounding of a coordinate below 40,000 km, moved to the origin and back: two ulps.
constexpr double rounding_m = 2.0 * 7.5e-9;

struct Georeferencing {
  LocatedCity located;
  Report report;

  [[nodiscard]] std::vector<int> codes() const {
    std::vector<int> codes;
    for (const Problem& problem : report.problems()) codes.push_back(static_cast<int>(problem.code));
    return codes;
  }
  [[nodiscard]] std::string detail() const { return report.problems().empty() ? "" : report.problems()[0].detail; }
  [[nodiscard]] Point3d projected(std::size_t building = 0) const { return first_projected(located, building); }
};

Georeferencing run(std::vector<SourceCity> sources, const GeoreferenceSettings& settings = {}) {
  Georeferencing result;
  result.located = georeference(std::move(sources), settings, result.report);
  return result;
}

Georeferencing run(const std::string& crs, const Point3d& first, double extent, const GeoreferenceSettings& settings = {}) {
  return run({source_with(crs, first, extent)}, settings);
}

const Point3d bonn{365000.0, 5621000.0, 60.0};

TEST(AxesSwapped, IsSaidOfLatitudesBeyondThePoles) {
  const Georeferencing tokyo = run("EPSG:6668", {139.7937, 35.5327, 3.0}, ten_metres_deg);
  EXPECT_THAT(tokyo.codes(), ElementsAre(202));
  EXPECT_EQ(tokyo.located.georeference.epsg, 6691);
  const Problem& problem = tokyo.report.problems()[0];
  EXPECT_EQ(problem.source, "town.gml");
  EXPECT_EQ(problem.place, "the whole file");
  EXPECT_EQ(problem.position, (Point3d{139.7937, 35.5327, 3.0})) << "as the file has it";
  ASSERT_TRUE(problem.lon_lat_deg);
  EXPECT_NEAR(problem.lon_lat_deg->x, 139.7937, ten_metres_deg);
}

TEST(AxesSwapped, IsSaidWhereOnlyTheOtherOrderLiesInTheAreaOfUse) {
  const Georeferencing berlin = run("EPSG:4258", {13.4, 52.5, 3.0}, ten_metres_deg);
  EXPECT_THAT(berlin.codes(), ElementsAre(202));
  EXPECT_EQ(berlin.located.georeference.epsg, 25833);
  EXPECT_THAT(berlin.detail(), HasSubstr("longitude first"));
}

TEST(AxesSwapped, IsSaidEvenOfReadersThatKnowTheOrder) {
  SourceCity source = source_with("EPSG:4326", {35.5327, 139.7937, 3.0}, ten_metres_deg);
  source.crs.longitude_first = true;
  const Georeferencing tokyo = run({std::move(source)});
  EXPECT_THAT(tokyo.codes(), ElementsAre(202));
  EXPECT_EQ(tokyo.located.georeference.epsg, 32654);
}

TEST(AxesSwapped, IsSaidOfNorthingsFirstWhereEastingsAreDue) {
  const Georeferencing swapped = run("EPSG:25832", {bonn.y, bonn.x, bonn.z}, 10.0);
  EXPECT_THAT(swapped.codes(), ElementsAre(202));
  EXPECT_THAT(swapped.detail(), HasSubstr("northing first"));
  expect_place(swapped.projected(), bonn, rounding_m);
}

TEST(AxesSwapped, IsNotSaidOfUsualOrders) {
  const Point3d stuttgart{3512000.0, 5403000.0, 250.0};
  EXPECT_THAT(run("EPSG:31467", stuttgart, 10.0).codes(), IsEmpty()) << "easting first, as nearly all files have it";
  EXPECT_THAT(run("EPSG:31467", {stuttgart.y, stuttgart.x, 250.0}, 10.0).codes(), IsEmpty()) << "as the authority says";
  EXPECT_THAT(run("EPSG:6697", {35.5327, 139.7937, 3.0}, ten_metres_deg).codes(), IsEmpty());
  EXPECT_THAT(run("OGC:CRS84", {139.7937, 35.5327, 3.0}, ten_metres_deg).codes(), IsEmpty());
}

TEST(AxesSwapped, IsNotSaidOfAPlaceJustBeyondTheArea) {
  // Where the area ends depends on the version of PROJ's database
  const AreaOfUse area = Crs::find("EPSG:4258").value().area_of_use().value();
  const double lat_deg = 36.0, lon_deg = area.east_deg + 0.7;
  ASSERT_FALSE(area.contains({lon_deg, lat_deg}));
  ASSERT_TRUE(area.contains({lat_deg, lon_deg})) << "in the other order";
  const Georeferencing anatolia = run("EPSG:4258", {lat_deg, lon_deg, 900.0}, ten_metres_deg);
  EXPECT_THAT(anatolia.codes(), IsEmpty());
  EXPECT_EQ(anatolia.located.georeference.epsg, 25837);
}

/// Houses of 10 m in a row at 51.92° N, 4.47° E, turned by 30°, with the first number as x.
SourceCity rotterdam_with(const std::string& crs, bool latitude_first) {
  SourceCity source;
  source.source = "town.gml";
  source.crs.definition = crs;
  const auto place = [&](double along_m, double across_m) {
    constexpr double lon_per_m = 1.0 / (metres_in_a_degree * 0.6168), lat_per_m = 1.0 / metres_in_a_degree;
    const double lon = 4.47 + (0.866 * along_m - 0.5 * across_m) * lon_per_m,
                 lat = 51.92 + (0.5 * along_m + 0.866 * across_m) * lat_per_m;
    return latitude_first ? Point3d{lat, lon, 3.0} : Point3d{lon, lat, 3.0};
  };
  for (int n = 0; n < 20; ++n) {
    const double x = 15.0 * n;
    add_building(source.city, "house " + std::to_string(n),
                 {place(x, 0.0), place(x + 10.0, 0.0), place(x + 10.0, 10.0), place(x, 10.0)});
  }
  return source;
}

TEST(LatitudesAndLongitudes, AreToldWhereOnlyTheOthersMakeRightAngles) {
  SourceCity geojson = rotterdam_with("OGC:CRS84", true);
  geojson.crs.longitude_first = true;
  const Georeferencing in_the_sea = run({std::move(geojson)});
  EXPECT_THAT(in_the_sea.codes(), ElementsAre(205));
  EXPECT_THAT(in_the_sea.detail(),
              AllOf(HasSubstr("at 4.47° N, 51.92° E, where 0 of 80 corners"), HasSubstr("at 51.92° N, 4.47° E 80 are"),
                    HasSubstr("ogr2ogr -ct \"+proj=axisswap +order=2,1\"")));
  const Georeferencing as_authority = run({rotterdam_with("EPSG:4326", false)});
  EXPECT_THAT(as_authority.codes(), ElementsAre(205));
  EXPECT_THAT(as_authority.detail(), HasSubstr("--crs OGC:CRS84 reads the longitude first"));
  const Georeferencing as_crs84 = run({rotterdam_with("OGC:CRS84", true)});
  EXPECT_THAT(as_crs84.codes(), ElementsAre(205));
  EXPECT_THAT(as_crs84.detail(), HasSubstr("--crs EPSG:4326 reads the latitude first"));
}

TEST(LatitudesAndLongitudes, AreNotToldWhereTheyAreRight) {
  EXPECT_THAT(run({rotterdam_with("OGC:CRS84", false)}).codes(), IsEmpty());
  EXPECT_THAT(run({rotterdam_with("EPSG:4326", true)}).codes(), IsEmpty());
}

TEST(LatitudesAndLongitudes, CanBeExchangedAsTheAdviceSays) {
  const auto codes_with = [](SourceCity source, const std::string& crs) { return run({std::move(source)}, {crs}).codes(); };
  EXPECT_THAT(codes_with(rotterdam_with("EPSG:4326", false), "OGC:CRS84"), ElementsAre(203));
  EXPECT_THAT(codes_with(rotterdam_with("OGC:CRS84", true), "EPSG:4326"), ElementsAre(203));
}

TEST(ZoneInEasting, IsTakenOff) {
  const Georeferencing prefixed = run("EPSG:25832", {32e6 + bonn.x, bonn.y, bonn.z}, 10.0);
  EXPECT_THAT(prefixed.codes(), ElementsAre(206));
  EXPECT_THAT(prefixed.detail(), AllOf(HasSubstr("32365000"), HasSubstr("365000 is taken")));
  EXPECT_EQ(prefixed.located.georeference.epsg, 25832);
  expect_place(prefixed.projected(), bonn, rounding_m);
  EXPECT_EQ(prefixed.report.problems()[0].position, (Point3d{32e6 + bonn.x, bonn.y, bonn.z})) << "as the file has it";
  ASSERT_TRUE(prefixed.report.problems()[0].lon_lat_deg);
  EXPECT_NEAR(prefixed.report.problems()[0].lon_lat_deg->x, 7.1, 0.1) << "Bonn";
}

TEST(ZoneInEasting, IsTakenOffBehindANorthing) {
  const Georeferencing both = run("EPSG:25832", {bonn.y, 32e6 + bonn.x, bonn.z}, 10.0);
  EXPECT_THAT(both.codes(), ElementsAre(202, 206));
  expect_place(both.projected(), bonn, rounding_m);
}

TEST(ZoneInEasting, IsNoProblemWhereTheCrsHasIt) {
  const Georeferencing honest = run("EPSG:4647", {32e6 + bonn.x, bonn.y, bonn.z}, 10.0);
  EXPECT_THAT(honest.codes(), IsEmpty());
  expect_place(honest.projected(), {32e6 + bonn.x, bonn.y, bonn.z}, rounding_m);
  const Georeferencing plain = run("EPSG:25832", bonn, 10.0);
  // PROJ's is a central difference over 1e-5 radians
  constexpr double two_ways_rad = 1e-5 * 1e-5;
  EXPECT_NEAR(honest.located.georeference.convergence.radians(), plain.located.georeference.convergence.radians(), two_ways_rad);
}

TEST(ZoneInEasting, IsNotThatOfAnotherZone) {
  EXPECT_THAT(run("EPSG:25833", {32e6 + bonn.x, bonn.y, 0.0}, 10.0).codes(), ElementsAre(205));
}

TEST(UnlikelyPlace, IsSaidOfASiteThatStaysWhereItIs) {
  const Point3d first{12.0, 20.0, 3.0};
  for (const char* crs : {"EPSG:32632", "EPSG:2154", "EPSG:31467", "EPSG:2193", "EPSG:5514"}) {
    const Georeferencing site = run("", first, 10.0, {crs, ""});
    EXPECT_THAT(site.codes(), ElementsAre(205)) << crs;
    EXPECT_THAT(site.detail(), AllOf(HasSubstr("12, 20"), HasSubstr("--origin"))) << crs;
    expect_place(site.projected(), first, rounding_m);
  }
  const Georeferencing in_feet = run("", first, 10.0, {"EPSG:2225", ""});
  EXPECT_THAT(in_feet.codes(), ElementsAre(205));
  expect_place(in_feet.projected(), foot_m * first, rounding_m);
}

TEST(UnlikelyPlace, IsNotSaidWhereZeroIsWithinTheCountry) {
  EXPECT_THAT(run("EPSG:6677", {-35000.0, -7000.0, 3.0}, 10.0).codes(), IsEmpty());
  EXPECT_THAT(run("EPSG:28991", {1000.0, 500.0, 3.0}, 10.0).codes(), IsEmpty()) << "RD Old counts from Amersfoort";
}

/// What is said first of a file that lies beyond all maps, and ends the run.
std::string detail_in_ended_run(const std::string& crs, const Point3d& first, double extent) {
  Report report;
  EXPECT_THROW((void)georeference({source_with(crs, first, extent)}, {}, report), InputError);
  return report.problems().empty() ? "" : report.problems()[0].detail;
}

TEST(UnlikelyPlace, NamesTheUnitThatExplainsIt) {
  const Point3d queens_m{312420.625, 52705.512, 3.0}, queens_ft{1025000.0, 172918.0, 10.0};
  EXPECT_THAT(run("EPSG:32118", queens_ft, 30.0).detail(), AllOf(HasSubstr("US survey feet"), HasSubstr("--crs EPSG:2263")));
  EXPECT_THAT(run("EPSG:2263", queens_m, 10.0).detail(), AllOf(HasSubstr("in metres"), HasSubstr("--crs EPSG:32118")));
  EXPECT_THAT(detail_in_ended_run("EPSG:25832", 1e3 * bonn, 10e3), HasSubstr("in millimetres it would lie within"));
  EXPECT_THAT(detail_in_ended_run("EPSG:25832", 1e2 * bonn, 1e3), HasSubstr("in centimetres it would lie within"));
  EXPECT_THAT(run("EPSG:25832", {365.0, 5621.0, 0.06}, 0.01).detail(), HasSubstr("in kilometres it would lie within"));
  EXPECT_THAT(run("EPSG:25832", {900000.0, 100000.0, 0.0}, 10.0).detail(), HasSubstr("is it the right CRS?"));
}

TEST(UnlikelyPlace, LeavesPlacesJustBeyondAnAreaAlone) {
  EXPECT_THAT(run("EPSG:25832", {930000.0, 5700000.0, 100.0}, 10.0).codes(), IsEmpty()) << "Saxony in the zone of the west";
  EXPECT_THAT(run("EPSG:31466", {2735000.0, 5750000.0, 100.0}, 10.0).codes(), IsEmpty())
      << "the east of a Land that keeps one zone";
  EXPECT_THAT(run("EPSG:28992", {92461.0, 560000.0, 3.0}, 10.0).codes(), IsEmpty());
}

TEST(UnlikelyPlace, IsSaidNearACountryThatACrsIsMeantFor) {
  // Gothenburg in EPSG:3007, taken for the CRS of all of Sweden
  const Georeferencing at_sea = run("", {150000.0, 6400000.0, 20.0}, 10.0, {"EPSG:3006", ""});
  EXPECT_THAT(at_sea.codes(), ElementsAre(205));
  EXPECT_THAT(at_sea.detail(), AllOf(HasSubstr("° N, 9.1"), HasSubstr("SWEREF99 TM (Sweden) is not meant to be used"),
                                     HasSubstr("--crs EPSG:n names another")));
  EXPECT_THAT(run("", {150000.0, 6400000.0, 20.0}, 10.0, {"EPSG:3007", ""}).codes(), IsEmpty());
}

TEST(UnlikelyPlace, IsSaidWhereTheFilesOwnCrsFitsBetterThanTheGivenOne) {
  const Point3d rotterdam{90000.0, 436000.0, 3.0};
  const Georeferencing gulf = run("EPSG:28992", rotterdam, 10.0, {"EPSG:32631", ""});
  EXPECT_THAT(gulf.codes(), ElementsAre(203, 205));
  EXPECT_THAT(
      gulf.report.problems().back().detail,
      AllOf(HasSubstr("° W), where WGS 84 / UTM zone 31N is not meant to be used"),
            HasSubstr("Amersfoort / RD New (Netherlands), is meant for its place (51.91° N, 4.4"), HasSubstr("--out-crs")));
  EXPECT_THAT(run("EPSG:28992", rotterdam, 10.0).codes(), IsEmpty());
  EXPECT_THAT(run("EPSG:25832", {280000.0, 5657000.0, 60.0}, 10.0, {"EPSG:32632", ""}).codes(), ElementsAre(203))
      << "a little to the west of both areas";
}

TEST(UnlikelyPlace, IsSaidOfBuildingsThatAreTooLarge) {
  EXPECT_THAT(detail_in_ended_run("EPSG:25832", bonn, 10e3), HasSubstr("10000 m wide"));
  EXPECT_THAT(run("EPSG:25832", bonn, 1.9e3).codes(), ElementsAre(208));
}

TEST(UnlikelyPlace, IsSaidOfDegreesToo) {
  EXPECT_THAT(run("EPSG:4258", {40.7, -74.0, 3.0}, ten_metres_deg).codes(), ElementsAre(205)) << "New York in Europe's degrees";
}

TEST(GivenCrs, OverrulesWhatEveryFileSays) {
  const Georeferencing overruled = run("EPSG:25832", bonn, 10.0, {"EPSG:32632", ""});
  EXPECT_THAT(overruled.codes(), ElementsAre(203));
  EXPECT_THAT(overruled.detail(), AllOf(HasSubstr("EPSG:25832"), HasSubstr("EPSG:32632")));
  EXPECT_EQ(overruled.located.georeference.epsg, 32632);
}

TEST(GivenCrs, IsNotSaidWhereItIsTheFilesOwn) {
  for (const char* same : {"EPSG:25832", "EPSG:25832+7837", "ETRS89 / UTM zone 32N", "urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH"})
    EXPECT_THAT(run("urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783", bonn, 10.0, {same, ""}).codes(), IsEmpty()) << same;
}

TEST(GivenCrs, LeavesTheUnitOfHeightsToTheFileUnlessItSaysOne) {
  const Point3d first_ft{1025000.0, 172918.0, 100.0};
  const Georeferencing own = run("EPSG:2263+5703", first_ft, 30.0, {"EPSG:2263", ""});
  EXPECT_THAT(own.codes(), IsEmpty());
  EXPECT_EQ(own.projected().z, 100.0) << "the file says metres";
  const Georeferencing given = run("EPSG:2263", first_ft, 30.0, {"EPSG:2263+5703", ""});
  EXPECT_THAT(given.codes(), ElementsAre(203));
  EXPECT_EQ(given.projected().z, 100.0) << "--crs says metres";
}

TEST(GivenCrs, MayTurnTheAxes) {
  const Georeferencing turned = run("EPSG:4326", {13.4, 52.5, 3.0}, ten_metres_deg, {"OGC:CRS84", ""});
  EXPECT_THAT(turned.codes(), ElementsAre(203));
  EXPECT_THAT(turned.detail(), HasSubstr("longitude first"));
  EXPECT_EQ(turned.located.georeference.epsg, 32633) << "Berlin";
}

TEST(GivenCrs, StandsInForOneThatNobodyKnows) {
  const Georeferencing unknown = run("EPSG:669", bonn, 10.0, {"EPSG:25832", ""});
  EXPECT_THAT(unknown.codes(), ElementsAre(204));
  EXPECT_THAT(unknown.detail(), AllOf(HasSubstr("\"EPSG:669\""), HasSubstr("EPSG:25832")));
  EXPECT_EQ(unknown.located.georeference.epsg, 25832);
}

TEST(GivenCrs, LeavesFilesAloneWhenItIsForOthers) {
  const Georeferencing mixed =
      run({source_with("EPSG:32632", bonn, 10.0), source_with("", bonn, 10.0)}, {"EPSG:25832", "EPSG:32632"});
  EXPECT_THAT(mixed.codes(), IsEmpty());
  expect_place(mixed.projected(), bonn, rounding_m);
  EXPECT_THAT(run("EPSG:32632", bonn, 10.0, {"EPSG:25832", "", true}).codes(), IsEmpty()) << "of a raster that says none";
}

TEST(GivenCrs, MustBeKnownWhereItOverrules) {
  Report report;
  EXPECT_THROW((void)georeference({source_with("EPSG:25832", bonn, 10.0)}, {"Germany", ""}, report), InputError);
}

TEST(GivenCrs, YieldsToTheFileWhoseCoordinatesItCannotHave) {
  const Georeferencing degrees = run("EPSG:4326", {50.7, 7.1, 60.0}, ten_metres_deg, {"EPSG:25832", ""});
  EXPECT_THAT(degrees.codes(), ElementsAre(203));
  EXPECT_THAT(degrees.detail(), HasSubstr("EPSG:4326 (WGS 84), which is used"));
  EXPECT_EQ(degrees.located.georeference.epsg, 32632);
  const Georeferencing metres = run("EPSG:25832", bonn, 10.0, {"EPSG:4326", ""});
  EXPECT_THAT(metres.codes(), ElementsAre(203));
  EXPECT_EQ(metres.located.georeference.epsg, 25832);
}

TEST(GivenCrs, IsInTheReportOfARunThatEnds) {
  Report report;
  std::string message;
  try {
    (void)georeference({source_with("EPSG:32632", {50.7, 7.1, 60.0}, ten_metres_deg)}, {"EPSG:25832", ""}, report);
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_THAT(message, HasSubstr("look like degrees"));
  EXPECT_EQ(report.count(ProblemCode::two_crs), 1u);
}

Problem problem_at(const std::string& source, std::optional<Point3d> position) {
  return {ProblemCode::repeated_id, source, "house", "", position};
}

std::optional<Point2d> lon_lat_of(const char* crs, AxisOrder order, const Point3d& position) {
  const bool swap = order == AxisOrder::northing_first;
  ProblemLocator locator(Crs::find(crs).value(), FileAxes{order}, swap ? Point2d{position.y, position.x} : horizontal(position));
  Problem problem = problem_at("town.gml", position);
  locator.locate(problem);
  return problem.lon_lat_deg;
}

TEST(ProblemLocator, LeavesDegreesOfWgs84AsTheyAre) {
  EXPECT_EQ(lon_lat_of("EPSG:4326", AxisOrder::easting_first, {8.5, 49.25, 3.0}), (Point2d{8.5, 49.25}));
}

TEST(ProblemLocator, ReadsTheFilesAxisOrder) {
  EXPECT_EQ(lon_lat_of("EPSG:4326", AxisOrder::northing_first, {49.25, 8.5, 3.0}), (Point2d{8.5, 49.25}));
}

TEST(ProblemLocator, KnowsNoPlaceBeyondTheEarth) {
  EXPECT_FALSE(lon_lat_of("EPSG:4326", AxisOrder::easting_first, {8.5, 95.0, 3.0}));
  EXPECT_FALSE(lon_lat_of("EPSG:4326", AxisOrder::easting_first, {190.0, 49.25, 3.0}));
  EXPECT_FALSE(lon_lat_of("EPSG:25832", AxisOrder::easting_first, {1e12, 1e12, 3.0}));
}

TEST(ProblemLocator, LeavesAProblemWithoutPositionAlone) {
  ProblemLocator locator(Crs::find("EPSG:4326").value(), FileAxes{}, {8.5, 49.25});
  Problem problem = problem_at("town.gml", std::nullopt);
  locator.locate(problem);
  EXPECT_FALSE(problem.lon_lat_deg);
}

TEST(Georeference, LocatesTheProblemsOfEachFileInItsOwnCrs) {
  SourceCity degrees = source_with("EPSG:4326", {60.0, 8.0, 3.0}, ten_metres_deg);
  SourceCity metres = source_with("EPSG:32632", {500000.0, 6651411.0, 3.0}, 10.0);
  metres.source = "other.gml";
  Report report;
  report.add(problem_at("town.gml", Point3d{60.0, 8.0, 3.0}));
  report.add(problem_at("other.gml", Point3d{500000.0, 6651411.0, 3.0}));
  report.add(problem_at("unread.gml", Point3d{60.0, 8.0, 3.0}));
  (void)georeference({degrees, metres}, {}, report);
  EXPECT_EQ(report.problems()[0].lon_lat_deg, (Point2d{8.0, 60.0})) << "the file has latitude first";
  ASSERT_TRUE(report.problems()[1].lon_lat_deg);
  constexpr double metre_deg = 1.0 / 111.2e3;
  EXPECT_NEAR(report.problems()[1].lon_lat_deg->x, 9.0, metre_deg) << "the central meridian";
  EXPECT_FALSE(report.problems()[2].lon_lat_deg) << "its CRS is not known";
}

TEST(Georeference, TellsWhereAStrayBuildingLiesInTheFilesOwnAxes) {
  SourceCity source = source_with("EPSG:4326", {60.0, 8.0, 3.0}, ten_metres_deg);
  add_building(source.city, "stray", {{95.0, 8.0, 3.0}, {95.0, 8.1, 3.0}, {95.1, 8.0, 3.0}});
  add_building(source.city, "last", {{60.0, 8.001, 3.0}, {60.0, 8.0012, 3.0}, {60.001, 8.0, 3.0}});
  Report report;
  (void)georeference({source}, {}, report);
  ASSERT_EQ(report.problems().size(), 1U);
  EXPECT_EQ(report.problems()[0].position, (Point3d{95.0, 8.0, 3.0}));
  EXPECT_FALSE(report.problems()[0].lon_lat_deg) << "there is no latitude of 95 degrees";
}

}  // namespace
}  // namespace farlod::georeference

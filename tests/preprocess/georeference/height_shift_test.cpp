// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "georeference/height_shift.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "georeference/georeference.hpp"

namespace farlod::georeference {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Optional;
using testing::SizeIs;

Crs crs(const std::string& code) { return *Crs::find(code); }

/// West of Frankfurt, in degrees and in UTM zone 32.
constexpr Point2d lon_lat_deg{8.5, 50.0};
constexpr Point2d p_utm{464166.5, 5538750.5};
/// The grid of EGM96 that comes with PROJ says so there, by cs2cs. It has a node every quarter of a degree, and is bilinear.
constexpr double geoid_m = 48.1387;
constexpr double digits_m = 0.02;  // between houses and nodes some metres apart, the geoid rises by less

TEST(HeightShift, NamesTheVerticalSystem) {
  EXPECT_EQ(crs("EPSG:25832").heights_name(), std::nullopt);
  EXPECT_THAT(crs("EPSG:25832+7837").heights_name(), Optional(std::string("DHHN2016 height")));
  EXPECT_THAT(crs("EPSG:4979").heights_name(), Optional(std::string("ellipsoidal heights of WGS 84")));
}

TEST(HeightShift, ANameThatSaysNothingNamesNone) {
  const std::string before = R"(COMPD_CS["a",)" + crs("EPSG:25832").wkt() + R"(,VERT_CS[")",
                    behind = R"(",VERT_DATUM["unknown",2005],UNIT["metre",1],AXIS["Up",UP]]])";
  for (const char* name : {"unknown", "Unknown", "unnamed", "Unknown VCS"})
    EXPECT_EQ(crs(before + name + behind).heights_name(), std::nullopt) << name;
  EXPECT_THAT(crs(before + "of my town" + behind).heights_name(), Optional(std::string("of my town")));
}

TEST(HeightShift, IsThatOfTheGrid) {
  const HeightShift shift(crs("EPSG:4979"), crs("EPSG:32632+5773"), lon_lat_deg);
  ASSERT_TRUE(shift.is_needed() && shift.is_known());
  EXPECT_THAT(shift.at(lon_lat_deg), Optional(testing::DoubleNear(-geoid_m, digits_m)));
  const HeightShift back(crs("EPSG:32632+5773"), crs("EPSG:4979"), p_utm);
  ASSERT_TRUE(back.is_known());
  EXPECT_THAT(back.at(p_utm), Optional(testing::DoubleNear(geoid_m, digits_m)));
}

TEST(HeightShift, NothingIsDoneWhereBothAreTheSame) {
  EXPECT_FALSE(HeightShift(crs("EPSG:25832+7837"), crs("EPSG:4258+7837"), p_utm).is_needed());
}

// Debian's PROJ has no grid of Germany, and PROJ's ballpark would leave the heights as they are
TEST(HeightShift, WithoutItsGridItIsNotKnown) {
  const HeightShift shift(crs("EPSG:4937"), crs("EPSG:25832+7837"), lon_lat_deg);
  ASSERT_TRUE(shift.is_needed());
  if (shift.is_known()) GTEST_SKIP() << "a grid of DHHN2016 is installed";
  EXPECT_THAT(shift.reason(), AllOf(HasSubstr("ellipsoidal heights of ETRS89"), HasSubstr("DHHN2016 height"), HasSubstr("grid")));
}

/// A house with its base at 100 m.
SourceCity house(const std::string& name, const std::string& definition, HeightReference reference = HeightReference::elevation) {
  SourceCity source{.source = name, .crs = {definition, true, false}, .city = {}};
  source.city.begin_building(name, reference);
  for (const double z : {100.0, 110.0}) {
    source.city.begin_facet(SurfaceKind::roof, 0);
    const Point3d corner{p_utm.x, p_utm.y, z};
    source.city.add_ring(std::vector{corner, corner + Point3d{10.0, 0.0, 0.0}, corner + Point3d{0.0, 10.0, 0.0}});
  }
  return source;
}

double base_of(const LocatedCity& located, std::size_t building) {
  return located.city.points_of(located.city.buildings()[building]).front().z;
}

TEST(HeightsOfCities, FollowTheFirstThatSaysWhereTheyCountFrom) {
  Report report;
  std::vector<SourceCity> sources;
  sources.push_back(house("unsaid", "EPSG:32632"));
  sources.push_back(house("egm96", "EPSG:32632+5773"));
  const std::string in_3d =
      R"(PROJCRS["UTM 32N, ellipsoidal",BASEGEOGCRS["WGS 84",DATUM["World Geodetic System 1984",ELLIPSOID["WGS 84",6378137,)"
      R"(298.257223563]],ID["EPSG",4979]],CONVERSION["UTM zone 32N",METHOD["Transverse Mercator"],)"
      R"(PARAMETER["Latitude of natural origin",0],PARAMETER["Longitude of natural origin",9],)"
      R"(PARAMETER["Scale factor at natural origin",0.9996],PARAMETER["False easting",500000],PARAMETER["False northing",0]],)"
      R"(CS[Cartesian,3],AXIS["easting",east],AXIS["northing",north],AXIS["ellipsoidal height",up],LENGTHUNIT["metre",1]])";
  sources.push_back(house("ellipsoidal", in_3d));
  sources.push_back(house("above ground", in_3d, HeightReference::on_ground));
  const LocatedCity located = georeference(std::move(sources), {}, report);
  EXPECT_THAT(report.problems(), IsEmpty());
  EXPECT_EQ(base_of(located, 0), 100.0);
  EXPECT_EQ(base_of(located, 1), 100.0);
  EXPECT_NEAR(base_of(located, 2), 100.0 - geoid_m, digits_m);
  EXPECT_EQ(base_of(located, 3), 100.0) << "it counts from the ground";
  EXPECT_THAT(located.notes, testing::Contains(AllOf(HasSubstr("ellipsoidal heights of WGS 84"), HasSubstr("EGM96 height"))));
  EXPECT_EQ(Crs::find(located.georeference.heights_wkt)->heights_name(), "EGM96 height");
}

TEST(HeightsOfCities, AreLeftAndToldWhereNothingIsKnown) {
  Report report;
  std::vector<SourceCity> sources;
  sources.push_back(house("old", "EPSG:32632+5773"));
  sources.push_back(house("unknown", "EPSG:32632+5717"));  // N60 of Finland
  const LocatedCity located = georeference(std::move(sources), {}, report);
  ASSERT_THAT(report.problems(), SizeIs(1));
  EXPECT_EQ(report.problems()[0].code, ProblemCode::another_datum);
  EXPECT_EQ(report.problems()[0].source, "unknown");
  EXPECT_THAT(report.problems()[0].detail, AllOf(HasSubstr("N60 height"), HasSubstr("EGM96 height")));
  EXPECT_EQ(base_of(located, 1), 100.0);
}

TEST(HeightsOfTerrains, AreBroughtToThoseOfTheCity) {
  Report report;
  const Georeference frame = [] {
    Georeference g = georeference_around(p_utm, *Crs::find("EPSG:32632"));
    g.heights_wkt = Crs::find("EPSG:32632+5773")->whole_wkt();
    return g;
  }();
  TerrainRaster terrain;
  terrain.first = {-20.0, -20.0};
  terrain.step_m = {10.0, 40.0};
  terrain.columns = 5;
  terrain.rows = 2;
  terrain.height_m.assign(10, 200.0F);
  terrain.height_m[3].reset();
  shift_heights(terrain, "dtm.tif", crs("EPSG:4979"), frame, report);
  EXPECT_THAT(report.problems(), IsEmpty());
  EXPECT_THAT(terrain.notes, SizeIs(1));
  EXPECT_FALSE(terrain.height_m[3].has_value());
  for (const std::size_t n : {0U, 4U, 9U}) EXPECT_NEAR(*terrain.height_m[n], 200.0 - geoid_m, digits_m);
}

}  // namespace
}  // namespace farlod::georeference

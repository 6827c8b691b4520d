// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <filesystem>

#include "base/frame.hpp"
#include "tests/acceptance/packed_town.hpp"
#include "tests/analytic/oracles.hpp"
#include "tests/analytic/tolerance.hpp"

namespace farlod::acceptance {
namespace {

double plane_m(Point2d p) { return 100.0 + 0.1 * p.x + 0.05 * p.y; }

/// Sides as steep as 20° all around, from a single lowest point.
constexpr Angle bowl_side = Angle::degrees(20.0);
double bowl_m(Point2d p) { return 50.0 + norm(p) * tan(bowl_side); }

/// Tables print millimetres, packages keep floats of the height above their lowest whole metre.
constexpr double plane_error_m = 0.0005 + 0.0001;

class Terrain : public testing::Test {
 protected:
  /// Packs a terrain, and what else there is.
  void pack(double (*height_m)(Point2d), const std::string& inputs = "--crs EPSG:32632") const {
    folder.write("terrain.asc", ascii_grid(height_m));
    folder.must("farlod-pack --terrain terrain.asc -o a.farlod --summary p.json " + inputs);
  }
  [[nodiscard]] CsvTable answer_at(Point2d p, const std::string& arguments) const {
    folder.must("farlod-svf a.farlod -o at.csv --at " + text_of(p) + " " + arguments);
    return CsvTable(folder.text_of("at.csv"));
  }
  WorkFolder folder;
};

TEST_F(Terrain, ReceiversStandOnIt) {
  pack(plane_m);
  for (const Point2d p : {Point2d{}, {100.0, 0.0}, {-123.0, 77.0}, {401.5, -398.25}}) {
    EXPECT_NEAR(answer_at(town_middle + p, "").number(0, "z_m"), plane_m(p) + 1.5, plane_error_m);
    EXPECT_NEAR(answer_at(town_middle + p, "--on-surface").number(0, "z_m"), plane_m(p) + 1.5, plane_error_m);
  }
}

TEST_F(Terrain, MayComeInTilesAndInAFolder) {
  std::filesystem::create_directory(folder.path("tiles"));
  folder.write("tiles/a.asc", ascii_grid(plane_m));
  folder.write("tiles/b.asc", ascii_grid([](Point2d p) { return p.x > 50.0 ? plane_m(p) + 30.0 : -9999.0; }));
  const Point2d west{-100.0, 20.0}, east{100.0, 20.0};
  for (const char* terrain : {"--terrain tiles", "--terrain tiles/a.asc --terrain tiles/b.asc"}) {
    folder.must(std::string("farlod-pack --crs EPSG:32632 --force -o a.farlod ") + terrain);
    EXPECT_NEAR(answer_at(town_middle + west, "").number(0, "z_m"), plane_m(west) + 1.5, plane_error_m) << terrain;
    EXPECT_NEAR(answer_at(town_middle + east, "").number(0, "z_m"), plane_m(east) + 31.5, plane_error_m) << terrain;
  }
}

TEST_F(Terrain, AloneItIsACityToo) {
  pack(plane_m);
  EXPECT_EQ(folder.json_of("p.json").at("buildings"), 0);
  folder.must("farlod-svf a.farlod -o o.asc --grid 20 --on-surface --summary s.json");
  EXPECT_GT(folder.json_of("s.json").at("receivers"), 2000);
  // A plane hides from a horizontal receiver what lies between it and the horizontal: at most the slope's steepness all around
  const double steepness = std::hypot(0.1, 0.05), hidden = steepness * steepness / (1.0 + steepness * steepness);
  EXPECT_GE(folder.json_of("s.json").at("svf").at("min"), 1.0 - hidden - sampling_error(default_rays, 2.0 * std::numbers::pi));
}

TEST_F(Terrain, AHillHidesTheSky) {
  pack(bowl_m);
  // From the lowest point the rim stands at the sides' own angle, in all directions
  const double expected = cos(bowl_side) * cos(bowl_side);
  const double border = 2.0 * std::numbers::pi * cos(bowl_side);
  // Standing 1 cm above the ground lowers the rim, 500 m away, by less than a millionth
  const double svf = answer_at(town_middle, "--engine exact --height 0").number(0, "svf");
  EXPECT_NEAR(svf, expected, sampling_error(default_rays, border));
  EXPECT_NEAR(answer_at(town_middle, "--engine rays --height 0").number(0, "svf"), svf, paper_error);
}

TEST_F(Terrain, BuildingsThatKnowOnlyTheirHeightStandOnIt) {
  folder.write("town.geojson", footprints_geojson(small_town()));
  pack(plane_m, "town.geojson");
  folder.must("farlod-svf a.farlod -o o.csv --surfaces roofs --spacing 30");
  const CsvTable roofs(folder.text_of("o.csv"));
  std::map<std::string, double> roof_m;
  for (std::size_t n = 0; n < roofs.size(); ++n) roof_m[roofs.text(n, "building")] = roofs.number(n, "z_m");
  for (const Block& b : small_town()) {
    double lowest_m = 1e9;
    for (const Point2d corner : {Point2d{-18.0, -18.0}, {18.0, -18.0}, {18.0, 18.0}, {-18.0, 18.0}})
      lowest_m = std::min(lowest_m, plane_m(p_projected(b.centre + corner) - town_middle));
    // Receivers float 1 cm above the roof; corners are off by 0.71 mm at most
    EXPECT_NEAR(roof_m.at(b.id), lowest_m + b.height_m + 0.01, plane_error_m + 0.11 * 0.00071) << b.id;
  }
}

TEST_F(Terrain, BetweenBuildingsReceiversStandOnTheTerrain) {
  folder.write("town.geojson", footprints_geojson(small_town()));
  pack(plane_m, "town.geojson");
  const Point2d street = p_projected({-60.0, 0.0});
  EXPECT_NEAR(answer_at(street, "").number(0, "z_m"), plane_m(street - town_middle) + 1.5, plane_error_m);
}

/// A plane that rises to the east, 2 km by 2 km around the town's middle, which is at 100 m.
constexpr Angle slope_angle = Angle::degrees(20.0);
constexpr double half_m = 1000.0;
double slope_m(double east_m) { return 100.0 + east_m * tan(slope_angle); }

/// Its corners, counter-clockwise from the south-west.
std::vector<Point3d> corners() {
  std::vector<Point3d> points;
  for (const Point2d d : {Point2d{-half_m, -half_m}, {half_m, -half_m}, {half_m, half_m}, {-half_m, half_m}}) {
    const Point2d p = town_middle + d;
    points.push_back({p.x, p.y, slope_m(d.x)});
  }
  return points;
}

std::string relief_cityjson() {
  nlohmann::json file = {{"type", "CityJSON"},
                         {"version", "2.0"},
                         {"transform", {{"scale", {0.001, 0.001, 0.001}}, {"translate", {0.0, 0.0, 0.0}}}},
                         {"metadata", {{"referenceSystem", "https://www.opengis.net/def/crs/EPSG/0/32632"}}},
                         {"vertices", nlohmann::json::array()}};
  for (const Point3d& p : corners())
    file["vertices"].push_back({std::llround(p.x * 1000), std::llround(p.y * 1000), std::llround(p.z * 1000)});
  file["CityObjects"]["slope"] = {
      {"type", "TINRelief"},
      {"geometry", {{{"type", "CompositeSurface"}, {"lod", "1"}, {"boundaries", {{{0, 1, 2}}, {{0, 2, 3}}}}}}}};
  return file.dump();
}

std::string triangle_gml(const Point3d& a, const Point3d& b, const Point3d& c) {
  std::ostringstream text;
  text.precision(12);
  text << "<gml:Triangle><gml:exterior><gml:LinearRing><gml:posList srsDimension=\"3\">";
  for (const Point3d& p : {a, b, c, a}) text << p.x << ' ' << p.y << ' ' << p.z << ' ';
  text << "</gml:posList></gml:LinearRing></gml:exterior></gml:Triangle>";
  return text.str();
}

std::string relief_citygml() {
  const std::vector<Point3d> p = corners();
  return R"(<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:dem="http://www.opengis.net/citygml/relief/2.0")"
         R"( xmlns:gml="http://www.opengis.net/gml"><gml:boundedBy><gml:Envelope srsName="EPSG:32632" srsDimension="3"/></gml:boundedBy>)"
         R"(<core:cityObjectMember><dem:ReliefFeature><dem:lod>1</dem:lod><dem:reliefComponent><dem:TINRelief><dem:lod>1</dem:lod><dem:tin>)"
         R"(<gml:TriangulatedSurface><gml:trianglePatches>)" +
         triangle_gml(p[0], p[1], p[2]) + triangle_gml(p[0], p[2], p[3]) +
         "</gml:trianglePatches></gml:TriangulatedSurface></dem:tin></dem:TINRelief></dem:reliefComponent></dem:ReliefFeature>"
         "</core:cityObjectMember></core:CityModel>";
}

/// Files have whole millimetres, and so have tables; packages keep floats of the height above their lowest whole metre.
constexpr double height_error_m = 0.0005 + 0.0005 + 0.0001;

/// Under a square of 20 m in the town's middle, turned with the town: at its westernmost corner.
double lowest_ground_m() {
  double west_m = 0.0;
  for (const Point2d corner : {Point2d{-10, -10}, Point2d{10, -10}, Point2d{10, 10}, Point2d{-10, 10}})
    west_m = std::min(west_m, GridRotation(town_bearing).city_from_grid(corner).x);
  return slope_m(west_m);
}

/// Receivers of a surface stand so far off it.
constexpr double off_surface_m = 0.01;

struct ReliefFile {
  const char* name;
  std::string (*text)();
};

class Relief : public testing::TestWithParam<ReliefFile> {
 protected:
  Relief() { folder.write(GetParam().name, GetParam().text()); }
  [[nodiscard]] CsvTable answer_at(Point2d p) const {
    folder.must("farlod-svf a.farlod -o at.csv --at " + text_of(p) + " --engine exact --rays 20000");
    return CsvTable(folder.text_of("at.csv"));
  }
  WorkFolder folder;
};

TEST_P(Relief, AloneIsASlopeWithItsKnownSkyViewFactor) {
  folder.must(std::string("farlod-pack ") + GetParam().name + " -o a.farlod --cell 200");
  // The slope hides what lies below tan(elevation) = tan(slope)·cos(azimuth) uphill: the mean of cos² over it is (1 + cos
  // slope)/2. From 1.5 m above, and with an end after 1 km, the horizon is lower by 1.5/1000; a ring of the sky has less than 1
  // in 100 of it
  constexpr double eye_m = 1.5, nearest_end_m = half_m - 100.0;
  const double error = eye_m / nearest_end_m + 1.0 / std::sqrt(20000.0) / 10.0;
  for (const double east_m : {0.0, -100.0, 57.5}) {
    const CsvTable answer = answer_at(town_middle + Point2d{east_m, 20.0});
    EXPECT_NEAR(answer.number(0, "z_m"), slope_m(east_m) + eye_m, height_error_m);
    EXPECT_NEAR(answer.number(0, "svf"), 0.5 * (1.0 + cos(slope_angle)), error);
  }
}

TEST_P(Relief, CarriesFootprints) {
  const Block house{"house", {}, 20.0, 10.0};
  folder.write("house.geojson", footprints_geojson({house}));
  folder.must(std::string("farlod-pack house.geojson ") + GetParam().name + " -o a.farlod");
  folder.must("farlod-svf a.farlod -o roofs.csv --surfaces roofs --spacing 5");
  const CsvTable roofs(folder.text_of("roofs.csv"));
  ASSERT_GT(roofs.size(), 0U);
  EXPECT_NEAR(roofs.number(0, "z_m"), lowest_ground_m() + 10.0 + off_surface_m, height_error_m);
}

TEST_P(Relief, TellsHowFarDownARoofOfKnownElevationReaches) {
  nlohmann::json town = nlohmann::json::parse(footprints_geojson({{"house", {}, 20.0, 10.0}}));
  town["features"][0]["properties"]["roof"] = 120.0;
  folder.write("house.geojson", town.dump());
  folder.must(std::string("farlod-pack house.geojson ") + GetParam().name + " --roof-field roof -o a.farlod");
  folder.must("farlod-svf a.farlod -o walls.csv --surfaces walls --spacing 5");
  const CsvTable walls(folder.text_of("walls.csv"));
  // Four walls of 20 m, from the lowest ground under the house up to 120 m; what lies below the ground has no value
  const double height_m = 120.0 - lowest_ground_m();
  double all_m2 = 0.0, seen_m2 = 0.0;
  for (std::size_t n = 0; n < walls.size(); ++n) {
    all_m2 += walls.number(n, "area_m2");
    seen_m2 += walls.text(n, "svf").empty() ? 0.0 : walls.number(n, "area_m2");
  }
  EXPECT_NEAR(all_m2, 80.0 * height_m, 80.0 * height_error_m + 4 * 0.002 * height_m);
  const CsvTable buildings(folder.text_of("walls.buildings.csv"));
  ASSERT_EQ(buildings.size(), 1U);
  EXPECT_NEAR(buildings.number(0, "wall_area_m2"), seen_m2, 1.0) << "areas are rounded, receiver by receiver";
  EXPECT_LT(seen_m2, all_m2) << "the ground is higher along the other walls";
}

TEST_P(Relief, OfAnotherPlaceIsNotUsedAndThatIsSaid) {
  folder.write("house.geojson", footprints_geojson({{"house", {5.0 * half_m, 0.0}, 20.0, 10.0}}));
  folder.must(std::string("farlod-pack house.geojson ") + GetParam().name + " -o a.farlod --summary s.json");
  EXPECT_TRUE(folder.json_of("s.json").at("skipped").contains("points of reliefs (none lies where the city is)"));
}

INSTANTIATE_TEST_SUITE_P(Files, Relief,
                         testing::Values(ReliefFile{"slope.city.json", relief_cityjson}, ReliefFile{"slope.gml", relief_citygml}),
                         [](const auto& test) {
                           return std::string(test.param.name).find(".gml") == std::string::npos ? "CityJson" : "CityGml";
                         });

}  // namespace
}  // namespace farlod::acceptance

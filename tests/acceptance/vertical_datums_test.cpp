// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <string>

#include "farlod/error.hpp"
#include "tests/acceptance/small_town.hpp"
#include "tests/acceptance/work_folder.hpp"

namespace farlod::acceptance {
namespace {

using testing::HasSubstr;

/// A house of 20 m × 20 m × 12 m as CityJSON.
std::string house(const std::string& crs, Point3d corner) {
  nlohmann::json vertices = nlohmann::json::array();
  for (const double z : {0.0, 12.0})
    for (const auto& [x, y] : {Point2d{0.0, 0.0}, Point2d{20.0, 0.0}, Point2d{20.0, 20.0}, Point2d{0.0, 20.0}})
      vertices.push_back({corner.x + x, corner.y + y, corner.z + z});
  const nlohmann::json shell = {{{3, 2, 1, 0}}, {{4, 5, 6, 7}}, {{0, 1, 5, 4}}, {{1, 2, 6, 5}}, {{2, 3, 7, 6}}, {{3, 0, 4, 7}}};
  const nlohmann::json solid = {{"type", "Solid"}, {"lod", "1"}, {"boundaries", nlohmann::json::array({shell})}};
  const nlohmann::json building = {{"type", "Building"}, {"geometry", nlohmann::json::array({solid})}};
  return nlohmann::json{{"type", "CityJSON"},
                        {"version", "1.0"},
                        {"metadata", {{"referenceSystem", crs}}},
                        {"CityObjects", {{"house", building}}},
                        {"vertices", vertices}}
      .dump();
}

constexpr Point2d baku{400'000.0, 4'470'000.0};
const std::string utm_39 = "urn:ogc:def:crs,crs:EPSG::32639,crs:EPSG::", baltic = utm_39 + "5705", caspian = utm_39 + "5611";

class VerticalDatums : public testing::Test {
 protected:
  /// Level ground of 600 m × 600 m around a place, in a CRS that an ASCII grid cannot name.
  void write_terrain(const std::string& name, const std::string& crs, Point2d middle, double height, double step = 20.0) const {
    std::string grid = "ncols 30\nnrows 30\ncellsize " + std::to_string(step);
    grid +=
        "\nxllcorner " + std::to_string(middle.x - 15.0 * step) + "\nyllcorner " + std::to_string(middle.y - 15.0 * step) + "\n";
    for (int n = 0; n < 30 * 30; ++n) grid += std::to_string(height) + (n % 30 == 29 ? "\n" : " ");
    folder.write(name + ".asc", grid);
    folder.write(name + ".vrt", "<VRTDataset rasterXSize=\"30\" rasterYSize=\"30\"><SRS dataAxisToSRSAxisMapping=\"1,2,3\">" +
                                    crs + "</SRS><GeoTransform>" + std::to_string(middle.x - 15.0 * step) + "," +
                                    std::to_string(step) + ",0," + std::to_string(middle.y + 15.0 * step) + ",0," +
                                    std::to_string(-step) +
                                    "</GeoTransform><VRTRasterBand dataType=\"Float32\" band=\"1\"><SimpleSource>" +
                                    "<SourceFilename relativeToVRT=\"1\">" + name + ".asc</SourceFilename></SimpleSource>" +
                                    "</VRTRasterBand></VRTDataset>");
  }
  /// The ground of the package that these inputs become, which is level.
  [[nodiscard]] double ground_of(const std::string& inputs) {
    const std::string name = std::to_string(++packages);
    const Outcome outcome = folder.run("farlod-pack " + inputs + " --strict -o " + name + ".farlod --summary " + name + ".json");
    EXPECT_EQ(outcome.exit_code, exit_done) << outcome.err;
    said = outcome.out;
    const nlohmann::json ground = folder.json_of(name + ".json").at("looks").at("ground_m");
    EXPECT_NEAR(ground.at("low"), ground.at("high"), level_m);
    return ground.at("low");
  }
  /// Heights are kept as floats, and those of a geoid change along the terrain.
  static constexpr double level_m = 0.02;
  WorkFolder folder;
  std::string said;
  int packages = 0;
};

/// EPSG:5438: the Caspian height of a point is its Baltic height and 28 m. It takes no grid.
TEST_F(VerticalDatums, ATerrainIsBroughtIntoThatOfTheCity) {
  folder.write("baltic.city.json", house(baltic, {baku.x, baku.y, -20.0}));
  folder.write("caspian.city.json", house(caspian, {baku.x, baku.y, 8.0}));
  write_terrain("in_baltic", "EPSG:32639+5705", baku, -20.0);
  write_terrain("in_caspian", "EPSG:32639+5611", baku, 8.0);
  EXPECT_EQ(ground_of("baltic.city.json --terrain in_baltic.vrt"), -20.0);
  EXPECT_THAT(said, testing::Not(HasSubstr("were brought")));
  EXPECT_EQ(ground_of("baltic.city.json --terrain in_caspian.vrt"), -20.0);
  EXPECT_THAT(said, HasSubstr("in_caspian.vrt: its heights were brought from Caspian height to Baltic 1977 height: -28.00 m"));
  EXPECT_EQ(ground_of("caspian.city.json --terrain in_baltic.vrt"), 8.0);
  EXPECT_THAT(said, HasSubstr("from Baltic 1977 height to Caspian height: +28.00 m"));
}

TEST_F(VerticalDatums, CitiesAreBroughtIntoThatOfTheFirst) {
  folder.write("a.city.json", house(baltic, {baku.x, baku.y, -20.0}));
  folder.write("b.city.json", house(caspian, {baku.x + 60.0, baku.y, 8.0}));
  EXPECT_NEAR(ground_of("a.city.json b.city.json"), -20.0, 1e-3);
  EXPECT_NEAR(ground_of("b.city.json a.city.json"), 8.0, 1e-3);
}

/// A point that the makers of EGM96 give to check programs, with the height of the geoid there. It takes their grid of 15', which
/// PROJ's data have, and between whose points it is a little rougher.
TEST_F(VerticalDatums, EllipsoidalHeightsAreLessThanThoseAboveTheGeoid) {
  constexpr double latitude_deg = -14.6212170, longitude_deg = 305.0211140 - 360.0, geoid_m = -2.969, by_grid_m = 0.1;
  // The same place in UTM zone 21S
  constexpr Point2d p_utm{717'702.0, 8'382'599.0};
  folder.write("a.city.json", house("urn:ogc:def:crs,crs:EPSG::32721,crs:EPSG::5773", {p_utm.x, p_utm.y, 250.0}));
  write_terrain("ellipsoidal", "EPSG:4979", {longitude_deg, latitude_deg}, 250.0 + geoid_m, 2e-4);
  EXPECT_NEAR(ground_of("a.city.json --terrain ellipsoidal.vrt"), 250.0, by_grid_m);
  EXPECT_THAT(said, HasSubstr("ellipsoidal.vrt: its heights were brought from "));
}

}  // namespace
}  // namespace farlod::acceptance

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/result_layer.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "farlod/error.hpp"
#include "farlod/surfaces.hpp"
#include "results/gdal_files.hpp"
#include "tests/library/packed_sample.hpp"
#include "tests/scenes/refusal.hpp"
#include "tests/scenes/temporary_folder.hpp"
#include "view/tile_surfaces.hpp"
#include "view/view_city.hpp"

namespace farlod {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::NanSensitiveFloatEq;

class Results : public testing::Test {
 protected:
  /// Writes a file, and says its name.
  [[nodiscard]] std::string file(const std::string& name, const std::string& text) const {
    const std::string path = (folder.path() / name).string();
    std::ofstream(path) << text;
    return path;
  }
  /// Three columns and two rows of 10 m, whose south-western corner is the origin of the view.
  [[nodiscard]] std::string grid(const std::string& name = "grid.asc") const {
    return file(name, "ncols 3\nnrows 2\nxllcorner " + number(frame.origin_projected.x) + "\nyllcorner " +
                          number(frame.origin_projected.y) + "\ncellsize 10\nNODATA_value -9999\n.1 .2 .3\n.4 -9999 .6\n");
  }
  [[nodiscard]] static std::string number(double value) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.6f", value);
    return text.data();
  }
  /// x and y of a place, in metres from the origin.
  [[nodiscard]] std::string place(double x, double y) const {
    return number(frame.origin_projected.x + x) + "," + number(frame.origin_projected.y + y);
  }
  [[nodiscard]] ResultLayer read(const std::string& request) const { return read_result_layer(request, package, frame); }
  [[nodiscard]] std::string refusal_of(const std::string& request) const {
    return scenes::refusal_of<InputError>([&] { (void)read(request); });
  }

  scenes::TemporaryFolder folder;
  library::PackedSample sample;
  Package package{sample.folder()};
  ViewFrame frame = view_frame_of(package);
};

TEST_F(Results, ARasterHasThePlacesOfItsPixels) {
  const ResultLayer layer = read(grid());
  EXPECT_EQ(layer.form, ResultForm::raster);
  EXPECT_EQ(layer.name, "grid.asc");
  EXPECT_THAT((std::vector{layer.width, layer.height}), ElementsAre(3U, 2U));
  EXPECT_EQ(layer.count, 6U);
  EXPECT_THAT(layer.values, ElementsAre(0.1F, 0.2F, 0.3F, 0.4F, NanSensitiveFloatEq(NAN), 0.6F));
  const std::array expected{0.0, 10.0, 0.0, 20.0, 0.0, -10.0};
  for (std::size_t n = 0; n < expected.size(); ++n) EXPECT_NEAR(layer.local_from_pixel[n], expected[n], 1e-5) << n;
  EXPECT_THAT(layer.range(), ElementsAre(0.0F, 1.0F));
}

TEST_F(Results, ALargeRasterIsThinnedToMeans) {
  const RasterBand band = gdal_files().read_raster(file("large.asc",
                                                        "ncols 4\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n"
                                                        "NODATA_value -1\n1 3 5 -1\n1 3 -1 7\n"),
                                                   {.band = "", .package_crs = "", .longest_side = 2});
  EXPECT_THAT((std::vector{band.width, band.height}), ElementsAre(2U, 1U));
  EXPECT_EQ(band.pixels_of_file, 8U);
  EXPECT_THAT(band.values, ElementsAre(2.0F, 6.0F)) << "what has no data does not count";
  EXPECT_THAT(band.projected_from_pixel, ElementsAre(0.0, 2.0, 0.0, 2.0, 0.0, -2.0));
}

TEST_F(Results, ARasterIsBroughtIntoTheCrsOfThePackage) {
  // A pixel of a hundredth of a degree, around 9° E on the equator: of UTM zone 32, whose easting there is 500 km
  const std::string path = file("degrees.asc", "ncols 2\nnrows 2\nxllcorner 8.99\nyllcorner 0\ncellsize 0.01\n1 2\n3 4\n");
  (void)file("degrees.prj", R"(GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],)"
                            R"(UNIT["degree",0.0174532925199433]])");
  const RasterBand band = gdal_files().read_raster(path, {.band = "", .package_crs = package.description().crs_wkt});
  ASSERT_EQ(package.description().epsg, 32632) << "the zone of this test";
  const double columns = (500000.0 + 100.0 - band.projected_from_pixel[0]) / band.projected_from_pixel[1];
  const double rows = (100.0 - band.projected_from_pixel[3]) / band.projected_from_pixel[5];
  ASSERT_TRUE(0.0 <= columns && columns < band.width && 0.0 <= rows && rows < band.height);
  EXPECT_EQ(band.values[static_cast<std::size_t>(rows) * band.width + static_cast<std::size_t>(columns)], 4.0F);
}

TEST_F(Results, PointsHaveValuesAndIds) {
  const ResultLayer layer =
      read(file("points.csv", "id,x,y,z,svf,hours\nwell," + place(1, 2) + "," + number(frame.origin_projected.z + 3) +
                                  ",.5,7\nmast," + place(-4, 0) + ",,,\n"));
  EXPECT_EQ(layer.form, ResultForm::points);
  EXPECT_EQ(layer.quantity, "svf");
  EXPECT_THAT(layer.labels, ElementsAre("well", "mast"));
  EXPECT_THAT(layer.values, ElementsAre(0.5F, NanSensitiveFloatEq(NAN)));
  ASSERT_EQ(layer.places_local.size(), 2U);
  EXPECT_THAT(layer.places_local[0], ElementsAre(1.0F, 2.0F, 3.0F));
  EXPECT_FALSE(std::isnan(layer.places_local[1][2])) << "as high as a receiver of a map";
}

TEST_F(Results, AFieldIsNamedBehindAColon) {
  const std::string path = file("points.csv", "id,x,y,svf,hours\na," + place(1, 2) + ",.5,7\nb," + place(1, 3) + ",.5,9\n");
  const ResultLayer layer = read(path + ":hours");
  EXPECT_EQ(layer.quantity, "hours");
  EXPECT_THAT(layer.values, ElementsAre(7.0F, 9.0F));
  EXPECT_THAT(layer.range(), ElementsAre(7.0F, 9.0F)) << "no share of the sky";
  EXPECT_THAT(refusal_of(path + ":years"),
              AllOf(HasSubstr("no field years"), HasSubstr("svf, hours"), HasSubstr("points.csv:FIELD")));
  EXPECT_THAT(refusal_of(grid() + ":svf_total"), AllOf(HasSubstr("no band svf_total"), HasSubstr("band 1")));
}

TEST_F(Results, IrradiationHasItsUnitAndARoundScale) {
  const auto layer_of = [&](const std::string& values) {
    return read(file("year.surfaces.csv", "building,surface,svf_mean,irradiation_mean,irradiation_kwh\na,1,.5," + values + "\n") +
                ":irradiation");
  };
  const ResultLayer layer = layer_of("1204.9,2409.8\nb,1,.5,143.2,300");
  EXPECT_EQ(layer.quantity, "irradiation_mean");
  EXPECT_EQ(layer.unit(), "kWh/m²");
  EXPECT_THAT(layer.range(), ElementsAre(0.0F, 1250.0F));
  EXPECT_THAT(layer_of("0.03,1").range(), ElementsAre(0.0F, 0.05F));
  EXPECT_THAT(layer_of("5,1").range(), ElementsAre(0.0F, 5.0F));
  EXPECT_THAT(layer_of("0.9,1").range(), ElementsAre(0.0F, 1.25F)) << "0 to 1 are the colours of shares of the sky";
  EXPECT_EQ(read(folder.file("year.surfaces.csv").string() + ":irradiation_kwh").unit(), "kWh");
  EXPECT_EQ(read(folder.file("year.surfaces.csv").string()).unit(), "");
}

TEST_F(Results, ATableHasValuesOfSurfaces) {
  const std::string path =
      file("walls.surfaces.csv", "building,surface,kind,svf_mean,svf_max\na,1,roof,.75,1\n\"b, c\",7,wall,.25,.5\na,2,wall,,\n");
  const ResultLayer layer = read(path);
  EXPECT_EQ(layer.form, ResultForm::surfaces);
  EXPECT_EQ(layer.quantity, "svf_mean");
  EXPECT_EQ(layer.count, 3U);
  EXPECT_THAT(layer.labels, ElementsAre("a", "b, c"));
  EXPECT_THAT(layer.surfaces, ElementsAre(ElementsAre(0U, 1U), ElementsAre(1U, 7U), ElementsAre(0U, 2U)));
  EXPECT_THAT(layer.values, ElementsAre(0.75F, 0.25F, NanSensitiveFloatEq(NAN)));
  std::array<float, 9> sent{};
  ASSERT_EQ(layer.bytes().size(), sizeof sent);
  std::memcpy(sent.data(), layer.bytes().data(), sizeof sent);
  EXPECT_THAT(sent, ElementsAre(0.0F, 1.0F, 0.75F, 1.0F, 7.0F, 0.25F, 0.0F, 2.0F, NanSensitiveFloatEq(NAN)));
  EXPECT_THAT(read(path + ":svf_max").values, ElementsAre(1.0F, 0.5F, NanSensitiveFloatEq(NAN)));
  EXPECT_THAT(refusal_of(path + ":hours"), AllOf(HasSubstr("no field hours"), HasSubstr("svf_mean, svf_max")));
}

TEST_F(Results, ATableOfSurfacesThatIsNoneIsRefused) {
  EXPECT_THAT(refusal_of(file("a.csv", "building,surface,svf_mean\na,first,.5\n")),
              HasSubstr("\"first\" is no number of a surface"));
  EXPECT_THAT(refusal_of(file("walls.buildings.csv", "building,roof_area_m2,svf_roofs\na,10,.5\n")),
              AllOf(HasSubstr("a row for each building"), HasSubstr("FILE.surfaces.csv")));
  // With places it has receivers
  EXPECT_EQ(read(file("b.csv", "building,surface,x_m,y_m,svf\na,1," + place(1, 2) + ",.5\n")).form, ResultForm::points);
}

TEST_F(Results, TheTableOfARunHasTheSurfacesOfTheTiles) {
  const SurfaceMeans means = evaluate_surfaces(package, {SurfaceChoice::all, 3.0});
  std::set<std::pair<std::string, std::uint32_t>> known;
  for (const SurfaceMean& s : means.surfaces) known.emplace(s.building, s.surface);
  const TileTree tree(frame);
  std::size_t checked = 0;
  for (const TileFeature& f : surfaces_of(package, frame, tree, {tree.level_of_cells(), 0, 0}).features) {
    if (f.kind != SurfaceKind::roof && f.kind != SurfaceKind::wall) continue;
    EXPECT_TRUE(known.contains({f.building, f.surface})) << f.building << ' ' << f.surface;
    ++checked;
  }
  EXPECT_GT(checked, 0U);
}

TEST_F(Results, AReportIsAsMarksAtItsHeights) {
  const std::string path = file("report.geojson", R"({"type": "FeatureCollection", "features": [{"type": "Feature",
    "geometry": {"type": "Point", "coordinates": [9, 50]}, "properties": {"code": 107, "problem": "zero_area", "effect": "left out",
    "place": "house_3", "position": [1, 2, 215.5], "detail": "All points lie on a line."}}]})");
  const ResultLayer layer = read(path);
  EXPECT_EQ(layer.form, ResultForm::problems);
  EXPECT_THAT(layer.labels, ElementsAre("107 zero_area, left out: house_3. All points lie on a line."));
  EXPECT_THAT(layer.values, IsEmpty());
  ASSERT_EQ(layer.places_local.size(), 1U);
  EXPECT_NEAR(layer.places_local[0][2], 215.5 - frame.origin_projected.z, 1e-3);
  EXPECT_NEAR(layer.places_local[0][0] + frame.origin_projected.x, 500000.0, 0.1) << "9° E is the middle of the zone";
}

TEST_F(Results, AReportMayBeOfACityWithoutProblems) {
  const ResultLayer layer = read(file("report.geojson", R"({"type": "FeatureCollection", "features": []})"));
  EXPECT_EQ(layer.form, ResultForm::problems);
  EXPECT_EQ(layer.count, 0U);
  // Without any position
  EXPECT_EQ(read(file("placeless.geojson", R"({"type": "FeatureCollection", "features": [{"type": "Feature", "geometry": null,
    "properties": {"code": 204, "problem": "x", "effect": "kept"}}]})"))
                .form,
            ResultForm::problems);
}

TEST_F(Results, WhatIsNoResultIsRefused) {
  EXPECT_THAT(refusal_of(file("roofs.geojson", R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {},
    "geometry": {"type": "LineString", "coordinates": [[9, 50], [9, 51]]}}]})")),
              HasSubstr("none of its 1 features is one"));
  EXPECT_THAT(refusal_of("nowhere.tif"), HasSubstr("nowhere.tif does not exist"));
  EXPECT_THAT(refusal_of(file("report.json", "[]")), HasSubstr("--report FILE.geojson"));
  EXPECT_NE(refusal_of(file("noise.tif", "no picture")), "no refusal");
}

TEST_F(Results, ThePageIsToldOfThem) {
  std::vector<ResultLayer> layers;
  layers.push_back(read(grid()));
  layers.push_back(read(file("points.csv", "id,x,y,z,svf\na," + place(1, 2) + "," + number(frame.origin_projected.z) + ",.5\n")));
  const ViewCity city(package, "village", frame, {}, std::move(layers));
  const json results = json::parse(city.answer("view.json", {}).body).at("results");
  ASSERT_EQ(results.size(), 2U);
  EXPECT_EQ(results[0].at("form"), "raster");
  EXPECT_EQ(results[1].at("url"), "results/1");
  EXPECT_EQ(city.answer("results/0", {}).body.size(), 6 * sizeof(float));
  std::array<float, 4> point{};
  const std::string bytes = city.answer("results/1", {}).body;
  ASSERT_EQ(bytes.size(), sizeof point);
  std::memcpy(point.data(), bytes.data(), sizeof point);
  EXPECT_THAT(point, ElementsAre(1.0F, 2.0F, 0.0F, 0.5F));
  EXPECT_EQ(json::parse(city.answer("results/1.json", {}).body), json::array({"a"}));
  for (const char* path : {"results/2", "results/-1", "results/", "results/x.json"})
    EXPECT_EQ(city.answer(path, {}).status, 404) << path;
}

}  // namespace
}  // namespace farlod

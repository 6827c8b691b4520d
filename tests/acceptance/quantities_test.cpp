// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>

#include "base/frame.hpp"
#include "farlod/box.hpp"
#include "farlod/error.hpp"
#include "tests/acceptance/packed_town.hpp"
#include "tests/analytic/oracles.hpp"
#include "tests/scenes/footprints_text.hpp"

// What farlod-svf computes besides the sky view factor, and where it computes it.

namespace farlod::acceptance {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

const Point2d middle_crossing = p_projected({-60.0, 0.0});

TEST_F(PackedTown, QuantitiesAreColumnsOfATable) {
  folder.must(
      "farlod-svf a.farlod -o o.csv --quantity svf,svf_solid,directional,hidden,horizon --horizons 8 --summary s.json --at " +
      text_of(middle_crossing));
  const CsvTable row = table("o.csv");
  EXPECT_THAT(row.header(), ElementsAre("id", "x_m", "y_m", "z_m", "height_above_ground_m", "svf", "svf_solid", "svfN", "svfE",
                                        "svfS", "svfW", "hidden_near", "hidden_far", "horizon_000", "horizon_045", "horizon_090",
                                        "horizon_135", "horizon_180", "horizon_225", "horizon_270", "horizon_315"));
  EXPECT_NEAR(0.5 * (row.number(0, "svfE") + row.number(0, "svfW")), row.number(0, "svf"), 3.0 * half_of_last_digit);
  EXPECT_NEAR(row.number(0, "hidden_near") + row.number(0, "hidden_far") + row.number(0, "svf"), 1.0, 3.0 * half_of_last_digit);
  EXPECT_EQ(folder.json_of("s.json").at("quantities").size(), 15U);
}

TEST_F(PackedTown, QuantitiesAreBandsOfARaster) {
  folder.must("farlod-svf a.farlod -o o.tif --grid 8 --quantity directional --sun 2026-06-21");
  EXPECT_THAT(band_names(folder.path("o.tif")), ElementsAre("svf", "svfN", "svfE", "svfS", "svfW", "sunlit_h"));
  const RasterFile svf = read_raster(folder.path("o.tif"), 1), north = read_raster(folder.path("o.tif"), 2),
                   south = read_raster(folder.path("o.tif"), 4), hours = read_raster(folder.path("o.tif"), 6);
  std::size_t compared = 0;
  for (std::size_t n = 0; n < svf.values.size(); ++n) {
    ASSERT_EQ(svf.values[n].has_value(), hours.values[n].has_value());
    if (!svf.values[n]) continue;
    EXPECT_NEAR(0.5 * (*north.values[n] + *south.values[n]), *svf.values[n], 1e-6);
    // At 50° north the longest day has 16.4 hours
    EXPECT_GE(*hours.values[n], 0.0);
    EXPECT_LE(*hours.values[n], 16.6);
    ++compared;
  }
  EXPECT_GT(compared, 500U);
}

TEST_F(PackedTown, TheSunOfTheOpenIsThatOfItsDay) {
  const Point3d open{town_middle.x, town_middle.y, 5000.0};
  folder.must("farlod-svf a.farlod -o o.csv --sun 2026-12-21 --at " + text_of(open));
  EXPECT_NEAR(table("o.csv").number(0, "sunlit_h"), 8.0, 0.25);
  folder.must("farlod-svf a.farlod -o o.csv --sun 2026 --at " + text_of(open));
  EXPECT_NEAR(table("o.csv").number(0, "sunlit_h"), 365.0 * 12.0, 80.0);
}

TEST_F(PackedTown, PatchesOfSurfacesComeWithTheirMeans) {
  folder.must("farlod-svf a.farlod -o o.csv --surfaces roofs --spacing 12 --sky-patches 145");
  const CsvTable points = table("o.csv");
  EXPECT_THAT(points.header(), Contains("patch_145"));
  EXPECT_EQ(points.number(0, "patch_145"), 1.0);
}

TEST_F(PackedTown, ThePictureOfTheSkyHasThePathsOfTheSun) {
  const std::string place = " --at " + text_of(Point3d{town_middle.x, town_middle.y, 200.0});
  const std::string june = "#b2182b", march = "#006048", december = "#542788";
  folder.must("farlod-svf a.farlod -o sky.svg" + place);
  for (const std::string& colour : {june, march, december}) EXPECT_THAT(folder.colours_of("sky.svg"), Not(Contains(colour)));
  folder.must("farlod-svf a.farlod -o sky.svg --sun 2026-06-21 --summary s.json" + place);
  EXPECT_THAT(folder.colours_of("sky.svg"), AllOf(Contains(june), Not(Contains(march)), Not(Contains(december))));
  EXPECT_EQ(folder.json_of("s.json").at("quantities").dump(), R"(["sunlit_h"])");
  folder.must("farlod-svf a.farlod -o sky.svg --sun 2026" + place);
  EXPECT_THAT(folder.colours_of("sky.svg"), AllOf(Contains(june), Contains(march), Contains(december)));
}

/// The hours of a day, with a sun of 500 W/m² and a sky of 200 W/m² around noon.
constexpr const char* day_of_weather =
    "time,global,direct,diffuse\n2026-03-20T10:00Z,500,500,200\n2026-03-20T11:00Z,530,500,200\n2026-03-20T12:00Z,520,500,200\n";

TEST_F(PackedTown, IrradiationOfAWeatherFileIsThatOfItsHours) {
  folder.write("day.csv", day_of_weather);
  const Point3d open{town_middle.x, town_middle.y, 5000.0};
  folder.must(
      "farlod-svf a.farlod -o o.csv --weather day.csv --quantity irradiation,irradiance,shade,sky_component --by month "
      "--summary s.json --at " +
      text_of(open));
  const CsvTable row = table("o.csv");
  EXPECT_THAT(row.header(), IsSupersetOf({"irradiation", "irradiation_direct", "irradiation_diffuse", "irradiation_reflected",
                                          "irradiation_03", "irradiance", "shade", "sky_component"}));
  EXPECT_NEAR(row.number(0, "irradiation_diffuse"), 0.6, 1e-3);
  // At 50° north the sun of the equinox stands 36 to 40° high around noon
  EXPECT_NEAR(row.number(0, "irradiation_direct"), 1.5 * 0.62, 0.03);
  EXPECT_NEAR(row.number(0, "irradiation_03"), row.number(0, "irradiation"), half_of_last_digit);
  EXPECT_NEAR(row.number(0, "irradiance"), 1000.0 * row.number(0, "irradiation") / 3.0, 0.2);
  EXPECT_EQ(row.number(0, "shade"), 0.0);
  EXPECT_NEAR(row.number(0, "sky_component"), 1.0, half_of_last_digit);
  folder.must(
      "farlod-svf a.farlod -o p.csv --weather day.csv --period 2026-03-20T11:00Z/12:00Z --quantity irradiation --sky-model "
      "isotropic --albedo 0,0 --at " +
      text_of(open));
  EXPECT_NEAR(table("p.csv").number(0, "irradiation_diffuse"), 0.2, 1e-3);
}

TEST_F(PackedTown, IrradiationIsTheSameForEachNumberOfThreads) {
  folder.write("day.csv", day_of_weather);
  const std::string run = "farlod-svf a.farlod --surfaces all --spacing 6 --quantity irradiation --weather day.csv --by month";
  folder.must(run + " -o one.csv --threads 1");
  folder.must(run + " -o four.csv --threads 4");
  EXPECT_EQ(folder.text_of("one.csv"), folder.text_of("four.csv"));
}

/// Sums over the receivers of a building's roofs (walls): kWh, and m² with at least the threshold.
std::pair<double, double> sums_of(const CsvTable& receivers, const std::string& building, const std::string& kind,
                                  double threshold) {
  std::pair<double, double> sums{0.0, 0.0};
  for (std::size_t n = 0; n < receivers.size(); ++n) {
    if (receivers.text(n, "building") != building || receivers.text(n, "kind") != kind) continue;
    const double kwh_m2 = receivers.number(n, "irradiation"), area_m2 = receivers.number(n, "area_m2");
    sums.first += kwh_m2 * area_m2;
    sums.second += kwh_m2 >= threshold ? area_m2 : 0.0;
  }
  return sums;
}

TEST_F(PackedTown, BuildingsHaveTheIrradiationOfTheirReceivers) {
  folder.write("day.csv", day_of_weather);
  // A roof in the open gets about 1.5 kWh/m², walls between .2 and 2
  folder.must(
      "farlod-svf a.farlod -o o.csv --surfaces all --spacing 4 --quantity irradiation --weather day.csv "
      "--irradiation-threshold 1.2");
  const CsvTable receivers = table("o.csv"), buildings = table("o.buildings.csv");
  double above_m2 = 0.0, below_m2 = 0.0;
  for (std::size_t n = 0; n < buildings.size(); ++n)
    for (const std::string kind : {"roof", "wall"}) {
      const auto [kwh, m2] = sums_of(receivers, buildings.text(n, "building"), kind, 1.2);
      const double area_m2 = buildings.number(n, kind + "_area_m2");
      // Areas of receivers are printed in thousandths
      EXPECT_NEAR(buildings.number(n, kind + "_irradiation_kwh"), kwh, 1e-3 * kwh + 1e-3);
      EXPECT_NEAR(buildings.number(n, "irradiation_" + kind + "s"), kwh / area_m2, 1e-3);
      EXPECT_NEAR(buildings.number(n, kind + "_area_above_m2"), m2, 1e-3 * m2 + 1e-3);
      above_m2 += m2;
      below_m2 += area_m2 - m2;
    }
  EXPECT_GT(above_m2, 100.0);
  EXPECT_GT(below_m2, 100.0);
}

TEST_F(PackedTown, APictureOfTheSkyShowsTheSunOfAPeriod) {
  const std::string run =
      "farlod-svf a.farlod --quantity irradiation --period 2026-06-21 --at " + text_of(p_projected({-60.0, 0.0}));
  folder.must(run + " -o sky.svg");
  folder.must(run + " -o sky.csv");
  const std::string svg = folder.text_of("sky.svg");
  EXPECT_GT(folder.colours_of("sky.svg").size(), 30U) << "one for each strength of the sun";
  folder.must("farlod-svf a.farlod -o without.svg --at " + text_of(p_projected({-60.0, 0.0})));
  EXPECT_LT(folder.colours_of("without.svg").size(), 15U);
  EXPECT_LT(folder.text_of("without.svg").size(), svg.size());
}

TEST_F(PackedTown, IrradiationOfAClearSkyNeedsNoFile) {
  folder.must("farlod-svf a.farlod -o o.tif --grid 8 --period 2026-06-21 --quantity irradiation --linke 4");
  EXPECT_THAT(band_names(folder.path("o.tif")),
              ElementsAre("svf", "irradiation", "irradiation_direct", "irradiation_diffuse", "irradiation_reflected"));
  const RasterFile all = read_raster(folder.path("o.tif"), 2);
  double most = 0.0;
  for (const auto& value : all.values) most = std::max(most, value.value_or(0.0));
  // The longest day at 50° north, some 8 kWh/m²
  EXPECT_GT(most, 7.0);
  EXPECT_LT(most, 9.5);
}

TEST_F(PackedTown, PicturesShowWhatIsNamedLast) {
  const auto picture_of = [&](const std::string& arguments) {
    folder.must("farlod-svf a.farlod --grid 8 --sun 2026-06-21 -o " + arguments);
    return folder.text_of("o.png");
  };
  const std::string sun = picture_of("o.png");
  EXPECT_TRUE(sun == picture_of("o.png --quantity sunlit"));
  EXPECT_TRUE(sun == picture_of("o.tif --preview o.png --quantity directional,sunlit"));
  EXPECT_FALSE(sun == picture_of("o.tif --preview o.png --quantity sunlit,svf"));
}

TEST_F(PackedTown, QuantitiesThatDoNotFitAreRefused) {
  const auto refused = [&](const std::string& arguments, const std::vector<std::string>& said) {
    expect_refusal(folder.run("farlod-svf a.farlod " + arguments), exit_usage, said);
  };
  refused("-o o.asc --grid 8 --quantity directional", {"--quantity", ".asc", "one quantity only"});
  refused("-o o.png --grid 8 --quantity directional,hidden", {"--quantity", ".png", "one quantity only"});
  refused("-o o.png --at 1,2 --sun 2026 --horizons 36", {"--horizons: a picture of the sky", "leave the option out"});
  refused("-o o.csv --at 1,2 --quantity light", {"--quantity", "light", "svf_solid"});
  refused("-o o.csv --at 1,2 --quantity sunlit", {"--quantity", "--sun"});
  refused("-o o.csv --at 1,2 --sun 2026-02-30", {"--sun", "2026-02-30"});
  refused("-o o.csv --at 1,2 --sun tomorrow", {"--sun", "tomorrow"});
  refused("-o o.csv --at 1,2 --sun-step 5", {"--sun-step", "--sun"});
  refused("-o o.csv --at 1,2 --horizons 2", {"--horizons"});
  refused("-o o.csv --at 1,2 --sky-patches 100", {"--sky-patches"});
  refused("-o o.csv --at 1,2 --quantity irradiation", {"--quantity", "--weather", "--period"});
  refused("-o o.csv --at 1,2 --weather a.epw", {"--weather", "irradiation"});
  refused("-o o.csv --at 1,2 --quantity irradiation --weather a.epw --linke 3", {"--linke", "--weather"});
  refused("-o o.csv --at 1,2 --quantity shade --weather a.epw --by month", {"--by", "irradiation"});
  refused("-o o.csv --at 1,2 --quantity irradiation --period someday", {"--period", "someday"});
  refused("-o o.csv --at 1,2 --quantity irradiation --period 2026 --albedo 0.2", {"--albedo", "0.2,0.3"});
  refused("-o o.csv --at 1,2 --quantity irradiation --period 2026 --albedo 0.2,1.5", {"--albedo", "0.2,1.5"});
  refused("-o o.csv --at 1,2 --quantity irradiation --period 2026 --sky-model blue", {"--sky-model", "isotropic"});
  refused("-o o.csv --at 1,2 --quantity irradiation --period 2026 --irradiation-threshold 800",
          {"--irradiation-threshold", "--surfaces"});
  refused("-o o.csv --surfaces all --quantity shade --period 2026 --irradiation-threshold 800",
          {"--irradiation-threshold", "irradiation"});
  refused("-o o.csv --at 1,2 --sky solid --quantity directional", {"--quantity", "--sky solid"});
}

/// A triangle over the west of the town, as GeoJSON.
void write_mask(const WorkFolder& folder) {
  std::vector<Point2d> corners;
  for (const Point2d d : {Point2d{-150.3, -150.3}, {10.0, 0.0}, {-150.3, 150.3}}) corners.push_back(town_middle + d);
  folder.write("mask.geojson", scenes::FootprintsText(town_crs).add("", corners).text());
}

TEST_F(PackedTown, AMaskLeavesTheReceiversWithinIt) {
  write_mask(folder);
  folder.must("farlod-svf a.farlod -o all.tif --grid 4 --bbox 499840,5499840,500012,5500152");
  folder.must("farlod-svf a.farlod -o o.tif --grid 4 --mask mask.geojson --summary s.json");
  folder.must("gdal_rasterize -q -burn 1 -ot Byte -tr 4 4 -te 499840 5499840 500012 5500152 mask.geojson inside.tif");
  const RasterFile all = raster("all.tif"), masked = raster("o.tif"), inside = raster("inside.tif");
  ASSERT_EQ(all.values.size(), inside.values.size());
  std::size_t kept = 0, left_out = 0;
  for (std::size_t n = 0; n < all.values.size(); ++n) {
    const bool is_inside = inside.values[n].value_or(0.0) == 1.0;
    const Point2d p = all.centre_of(n);
    const bool is_in_extent = masked.north_west.x < p.x &&
                              p.x < masked.north_west.x + static_cast<double>(masked.columns) * 4.0 &&
                              p.y < masked.north_west.y && masked.north_west.y - static_cast<double>(masked.rows) * 4.0 < p.y;
    const std::optional<double> got = is_in_extent ? masked.at(p) : std::nullopt;
    EXPECT_EQ(got.has_value(), is_inside && all.values[n].has_value()) << n;
    if (got) {
      EXPECT_NEAR(*got, *all.values[n], 1e-6);
    }
    kept += got ? 1 : 0;
    left_out += !is_inside && all.values[n] ? 1 : 0;
  }
  EXPECT_GT(kept, 300U);
  EXPECT_GT(left_out, 300U);
  EXPECT_GT(folder.json_of("s.json").at("outside_of_region"), 300);
}

TEST_F(PackedTown, AMaskLeavesThePointsAndSurfacesWithinIt) {
  write_mask(folder);
  folder.write("p.csv", "id,x,y,note\nout," + text_of(p_projected({60.0, 0.0})) + ",a\nin," + text_of(middle_crossing) + ",b\n");
  const Outcome outcome = folder.run("farlod-svf a.farlod -o o.csv --points p.csv --mask mask.geojson");
  EXPECT_THAT(outcome.out, HasSubstr("1 point lies outside of the mask or box"));
  EXPECT_EQ(table("o.csv").size(), 1U);
  EXPECT_EQ(table("o.csv").text(0, "note"), "b");
  folder.must("farlod-svf a.farlod -o o.csv --points p.csv --bbox 500050,5499900,500200,5500100");
  EXPECT_EQ(table("o.csv").text(0, "id"), "out");
  folder.must("farlod-svf a.farlod -o o.csv --surfaces roofs --spacing 6 --mask mask.geojson");
  const CsvTable roofs = table("o.csv");
  EXPECT_GT(roofs.size(), 20U);
  for (std::size_t n = 0; n < roofs.size(); ++n) EXPECT_LT(roofs.number(n, "x_m"), town_middle.x + 10.0);
  expect_refusal(folder.run("farlod-svf a.farlod -o o.csv --points p.csv --mask lost.gpkg"), exit_unusable_input, {"lost.gpkg"});
}

TEST_F(PackedTown, PointsAlongAStreetAreAnswered) {
  const Point2d end = p_projected({59.9, 0.0});
  folder.write("axes.geojson",
               R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:32632"}}, "features":
  [{"type": "Feature", "properties": {"street": "main"}, "geometry": {"type": "LineString", "coordinates": [[)" +
                   text_of(middle_crossing) + "], [" + text_of(end) + "]]}}]}");
  folder.must("farlod-svf a.farlod -o o.csv --along axes.geojson --spacing 5");
  const CsvTable points = table("o.csv");
  EXPECT_EQ(points.size(), 24U);
  EXPECT_EQ(points.text(3, "street"), "main");
  EXPECT_NEAR(points.number(0, "along_m"), 119.9 / 48.0, 0.001);
  EXPECT_GT(points.number(0, "svf"), 0.3);
}

/// Upright rectangles around the middle of the town.
struct House {
  const char* id;
  Box2d outline;
  double height_m;
};
std::string houses(const std::vector<House>& list) {
  scenes::FootprintsText text(town_crs);
  for (const auto& [id, outline, height_m] : list)
    text.add(scenes::building(id, height_m), Box2d{town_middle + outline.low, town_middle + outline.high});
  return text.text();
}

TEST(FacadeAverages, OfAnEndlessCanyonAreKnown) {
  constexpr double height_m = 20.0, width_m = 15.0, half_length_m = 1500.0;
  const WorkFolder folder;
  folder.write("canyon.geojson", houses({{"west", {{-20.0, -half_length_m}, {0.0, half_length_m}}, height_m},
                                         {"east", {{width_m, -half_length_m}, {width_m + 20.0, half_length_m}}, height_m}}));
  folder.must("farlod-pack canyon.geojson -o a.farlod");
  // The walls on either side of the street, in the middle
  folder.must("farlod-svf a.farlod -o o.csv --surfaces walls --spacing 0.5 --bbox 499999,5499980,500016,5500020");
  const CsvTable walls(folder.text_of("o.surfaces.csv"));
  ASSERT_EQ(walls.size(), 2U);
  const double expected = oracles::canyon_wall_mean(height_m / width_m);
  for (std::size_t n = 0; n < walls.size(); ++n) EXPECT_NEAR(walls.number(n, "svf_mean"), expected, 0.002);
}

TEST(FacadeAverages, LeaveOutWhatIsCovered) {
  const WorkFolder folder;
  // A low house leans on the whole eastern side of a high one
  folder.write("pair.geojson", houses({{"high", {{0.0, 0.0}, {10.0, 12.0}}, 15.0}, {"low", {{10.0, 0.0}, {18.0, 12.0}}, 6.0}}));
  folder.must("farlod-pack pair.geojson -o a.farlod");
  folder.must("farlod-svf a.farlod -o o.csv --surfaces walls --spacing 0.25");
  const CsvTable surfaces(folder.text_of("o.surfaces.csv")), buildings(folder.text_of("o.buildings.csv"));
  double covered_m2 = 0.0;
  for (std::size_t n = 0; n < surfaces.size(); ++n) {
    covered_m2 += surfaces.number(n, "covered_area_m2");
    // Of the high house's eastern wall, the part above the low roof sees half of the sky
    if (surfaces.text(n, "building") == "high" && std::abs(surfaces.number(n, "azimuth_deg") - 90.0) < 5.0) {
      EXPECT_NEAR(surfaces.number(n, "area_m2"), 12.0 * 9.0, 1.0);
      EXPECT_NEAR(surfaces.number(n, "covered_area_m2"), 12.0 * 6.0, 1.0);
      EXPECT_NEAR(surfaces.number(n, "svf_mean"), 0.5, 0.002);
    }
  }
  EXPECT_NEAR(covered_m2, 2.0 * 12.0 * 6.0, 2.0);
  double of_buildings_m2 = 0.0;
  for (std::size_t n = 0; n < buildings.size(); ++n) of_buildings_m2 += buildings.number(n, "covered_wall_area_m2");
  EXPECT_NEAR(of_buildings_m2, covered_m2, 0.01);
}

struct Place {
  const char* name;
  const char* crs;  ///< of the footprints
  Point2d middle;   ///< in it
  double unit;      ///< of its coordinates in metres
  const char* package_crs;
};
void PrintTo(const Place& place, std::ostream* out) { *out << place.name; }

class RasterInPlace : public testing::TestWithParam<Place> {};

/// A building's no-data footprint is its outline, as GDAL draws it into the same pixels.
TEST_P(RasterInPlace, HasNoDataWhereGdalDrawsTheBuildings) {
  const Place& place = GetParam();
  const WorkFolder folder;
  // An L and a triangle, turned so that the grid of cells is turned, too
  scenes::FootprintsText town(place.crs);
  for (const std::vector<Point2d>& local :
       {std::vector<Point2d>{{0, 0}, {41, 0}, {41, 17}, {19, 17}, {19, 38}, {0, 38}}, {{60, 5}, {97, 5}, {97, 44}}}) {
    std::vector<Point2d> ring;
    for (const Point2d& p : local)
      ring.push_back(place.middle + place.unit * GridRotation(Angle::degrees(-27.0)).city_from_grid(p));
    town.add(R"("height":12)", ring);
  }
  folder.write("town.geojson", town.text());
  folder.must("farlod-pack town.geojson -o a.farlod --cell 30");
  folder.must("farlod-svf a.farlod -o o.tif --grid 1");
  const RasterFile map = read_raster(folder.path("o.tif"));
  folder.must("ogr2ogr -q -t_srs " + std::string(place.package_crs) + " projected.gpkg town.geojson");
  std::array<char, 160> extent{};
  std::snprintf(extent.data(), extent.size(), "%.3f %.3f %.3f %.3f", map.north_west.x,
                map.north_west.y - static_cast<double>(map.rows), map.north_west.x + static_cast<double>(map.columns),
                map.north_west.y);
  folder.must("gdal_rasterize -q -burn 1 -ot Byte -tr 1 1 -te " + std::string(extent.data()) + " projected.gpkg drawn.tif");
  const RasterFile drawn = read_raster(folder.path("drawn.tif"));
  ASSERT_EQ(drawn.values.size(), map.values.size());
  const auto is_drawn = [&](std::size_t n) { return drawn.values[n].value_or(0.0) == 1.0; };
  std::size_t inside = 0, beside = 0;
  for (std::size_t n = map.columns + 1; n + map.columns + 1 < map.values.size(); ++n) {
    const bool touches = is_drawn(n - 1) || is_drawn(n + 1) || is_drawn(n - map.columns) || is_drawn(n + map.columns);
    if (is_drawn(n)) {
      EXPECT_FALSE(map.values[n]) << n;
      ++inside;
    } else if (touches) {
      EXPECT_TRUE(map.values[n]) << n;
      ++beside;
    }
  }
  EXPECT_GT(beside, 200U);
  EXPECT_GT(inside, 1500U);
}

INSTANTIATE_TEST_SUITE_P(Crs, RasterInPlace,
                         testing::Values(Place{"Germany", "EPSG:25832", {690000.0, 5335000.0}, 1.0, "EPSG:25832"},
                                         Place{"Netherlands", "EPSG:28992", {90000.0, 436000.0}, 1.0, "EPSG:28992"},
                                         Place{"Degrees", "OGC:CRS84", {-73.96, 40.77}, 1e-5, "EPSG:32618"}),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace farlod::acceptance

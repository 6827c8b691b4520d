// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/sky_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "results/picture/cell_picture.hpp"
#include "results/picture/error_map.hpp"
#include "results/picture/far_panorama.hpp"
#include "results/picture/picture.hpp"
#include "results/picture/raster_preview.hpp"
#include "results/picture/sky_light.hpp"
#include "sun/sun_positions.hpp"
#include "tests/runtime/results/picture/decoded_png.hpp"

namespace farlod {
namespace {

constexpr SkyProjection projections[]{SkyProjection::equidistant, SkyProjection::equal_area, SkyProjection::orthographic};
/// Of a few sines and arcs of doubles.
constexpr double rounding_error = 1e-9;

/// A basin whose horizon is at 30°, but for the east, where a near wall rises to 60°; what is hidden elsewhere is far.
Hemisphere basin_with_a_wall_in_the_east() {
  Hemisphere h{360, 90, std::vector(std::size_t{360} * 90, SkyPart::sky), std::vector<float>(360), 0.0, 0.0F, {}};
  for (std::size_t a = 0; a < 360; ++a) {
    const bool east = 45 <= a && a < 135;
    const std::size_t edge = east ? 60 : 30;
    h.horizon[a] = static_cast<float>(std::tan(static_cast<double>(edge) * rad_per_deg));
    for (std::size_t e = 0; e < edge; ++e) h.parts[a * 90 + e] = east ? SkyPart::near : SkyPart::far;
  }
  h.svf = static_cast<float>(0.75 * std::pow(std::cos(30.0 * rad_per_deg), 2) + 0.25 * std::pow(std::cos(60.0 * rad_per_deg), 2));
  return h;
}

/// The view factor of the pixels that are sky, each weighted by its solid angle and the cosine of its zenith angle.
double svf_of(const Picture& disk, SkyProjection projection) {
  const std::size_t edge = disk.size().width;
  const double pixel = 2.0 / static_cast<double>(edge);
  double sky = 0.0, all = 0.0;
  for (std::size_t y = 0; y < edge; ++y)
    for (std::size_t x = 0; x < edge; ++x) {
      const auto d =
          direction_of({(static_cast<double>(x) + 0.5) * pixel - 1.0, 1.0 - (static_cast<double>(y) + 0.5) * pixel}, projection);
      if (!d) continue;
      const double zenith = d->zenith_angle_deg * rad_per_deg;
      const double solid_angle = projection == SkyProjection::equidistant  ? std::sin(zenith) / std::max(zenith, 1e-3)
                                 : projection == SkyProjection::equal_area ? 1.0
                                                                           : 1.0 / std::cos(zenith);
      const double weight = solid_angle * std::cos(zenith);
      all += weight;
      if (disk.at({x, y}) == colour_of(SkyPart::sky)) sky += weight;
    }
  return sky / all;
}

TEST(SkyPicture, ADirectionComesBackFromItsPlace) {
  for (const SkyProjection projection : projections)
    for (const double azimuth : {1.0, 90.0, 200.0, 359.0})
      for (const double zenith : {1.0, 45.0, 89.0}) {
        const auto back = direction_of(disk_point_of({azimuth, zenith}, projection), projection);
        ASSERT_TRUE(back.has_value());
        EXPECT_NEAR(back->azimuth_deg, azimuth, rounding_error);
        EXPECT_NEAR(back->zenith_angle_deg, zenith, rounding_error);
      }
}

TEST(SkyPicture, NorthIsUpAndEastIsOnTheLeft) {
  for (const SkyProjection projection : projections) {
    const DiskPoint north = disk_point_of({0.0, 90.0}, projection), east = disk_point_of({90.0, 90.0}, projection);
    EXPECT_NEAR(north.v, 1.0, rounding_error);
    EXPECT_NEAR(east.u, -1.0, rounding_error);
  }
}

TEST(SkyPicture, PartsHaveTheirColoursWhereTheyAre) {
  const Picture disk = draw_sky_disk(basin_with_a_wall_in_the_east(), SkyProjection::equidistant, 300);
  EXPECT_EQ(disk.at({150, 150}), colour_of(SkyPart::sky));
  EXPECT_EQ(disk.at({75, 150}), colour_of(SkyPart::near));  // 45° high in the east
  EXPECT_EQ(disk.at({225, 150}), colour_of(SkyPart::sky));  // 45° high in the west
  EXPECT_EQ(disk.at({290, 150}), colour_of(SkyPart::far));
  EXPECT_EQ(disk.at({0, 0}), (Colour{255, 255, 255}));
}

TEST(SkyPicture, WeightedPixelsGiveTheViewFactor) {
  const Hemisphere hemisphere = basin_with_a_wall_in_the_east();
  for (const SkyProjection projection : projections)
    EXPECT_NEAR(svf_of(draw_sky_disk(hemisphere, projection, 400), projection), hemisphere.svf, 0.01);
}

/// The sun's way at 50° N on the longest day of 2026, where clocks show UTC.
SunOfSky longest_day() {
  SunCourse course{"2026-06-21", {}};
  for (const SunDirection& d : sun_course({Angle::degrees(0.0), Angle::degrees(50.0)},
                                          std::chrono::sys_days(std::chrono::year(2026) / std::chrono::June / 21)))
    course.minutes.push_back({d.azimuth.degrees(), 90.0 - d.elevation.degrees()});
  return {{course}, {"Local mean time"}};
}

/// The pixel of a direction in draw_sky's disk, by the definition of the equidistant projection.
Pixel equidistant_pixel(double azimuth_deg, double elevation_deg) {
  const double away = 400.0 * (90.0 - elevation_deg) / 90.0, azimuth = azimuth_deg * rad_per_deg;
  return {static_cast<std::size_t>(56.0 + 400.0 - away * std::sin(azimuth)),
          static_cast<std::size_t>(116.0 + 400.0 - away * std::cos(azimuth))};
}

Picture with_sun(const std::optional<SunOfSky>& sun) {
  return drawn(draw_sky(basin_with_a_wall_in_the_east(), SkyProjection::equidistant, {"svf", ""}, sun));
}

Pixel pixel_of_sun(int hour) {
  const SunDirection sun =
      sun_direction({Angle::degrees(0.0), Angle::degrees(50.0)},
                    std::chrono::sys_days(std::chrono::year(2026) / std::chrono::June / 21) + std::chrono::hours(hour));
  return equidistant_pixel(sun.azimuth.degrees(), sun.elevation.degrees());
}

TEST(SkyPicture, SaysTheSkyViewFactorRoundedAndWithTrees) {
  Hemisphere hemisphere = basin_with_a_wall_in_the_east();
  hemisphere.svf = 0.64406F;
  const auto title_of = [&](std::optional<float> svf_total) {
    return draw_sky(hemisphere, SkyProjection::equidistant, {"svf", "", svf_total}, {}, {}).title;
  };
  EXPECT_EQ(title_of({}), "Sky view factor (svf) 0.6441");
  EXPECT_EQ(title_of(0.163F), "Sky view factor (svf) 0.6441, with trees 0.1630");
}

TEST(SunInThePicture, HasADotWhereTheSunIsAtEachFullHour) {
  const Picture with = with_sun(longest_day()), without = with_sun({});
  for (const int hour : {11, 12, 14, 15}) {  // above 30° in the south and the west
    EXPECT_EQ(without.at(pixel_of_sun(hour)), colour_of(SkyPart::sky)) << hour;
    EXPECT_EQ(with.at(pixel_of_sun(hour)), (Colour{178, 24, 43})) << hour;
  }
  EXPECT_EQ(with.at(equidistant_pixel(180.0, 80.0)), colour_of(SkyPart::sky));  // where it never is
}

TEST(SunInThePicture, IsPaleWhereGeometryHidesTheSun) {
  const Picture picture = with_sun(longest_day());
  // In the morning behind the near wall in the east, in the evening behind what is far
  for (const int hour : {6, 8, 18}) EXPECT_EQ(picture.at(pixel_of_sun(hour)), (Colour{250, 200, 200})) << hour;
}

/// The discs of a drawing that are no wider than those of suns, by their middles.
std::vector<std::pair<PagePoint, Colour>> small_discs(const Drawing& drawing) {
  std::vector<std::pair<PagePoint, Colour>> discs;
  for (const auto& shape : drawing.shapes)
    if (const auto* polygon = std::get_if<Polygon>(&shape); polygon != nullptr && polygon->corners.size() > 4) {
      PagePoint sum{0.0, 0.0};
      for (const PagePoint p : polygon->corners) sum = {sum.x + p.x, sum.y + p.y};
      const auto count = static_cast<double>(polygon->corners.size());
      discs.emplace_back(PagePoint{sum.x / count, sum.y / count}, polygon->colour);
    }
  return discs;
}

TEST(LightInThePicture, HasTheSunsInTheColoursOfTheirLightWhereTheyAreSeen) {
  constexpr SkyProjection projection = SkyProjection::equal_area;
  // In the east a wall rises to 60°, elsewhere the horizon is at 30°
  const std::vector<LitSun> suns{{{180.0, 45.0}, 900.0}, {{180.0, 75.0}, 800.0}, {{90.0, 45.0}, 900.0}, {{90.0, 15.0}, 0.0}};
  const Drawing drawing = draw_sky(basin_with_a_wall_in_the_east(), projection, {"svf", ""}, {}, LightOfSky{suns, {"12 in all"}});
  const auto discs = small_discs(drawing);
  ASSERT_GE(discs.size(), suns.size());
  const std::vector<Colour> expected{colour_of_sun(900.0), discs[1].second, discs[1].second, colour_of_sun(0.0)};
  for (std::size_t n = 0; n < suns.size(); ++n) {
    const PagePoint place = sky_page_point(suns[n].direction, projection);
    EXPECT_NEAR(discs[n].first.x, place.x, 1e-6) << n;
    EXPECT_NEAR(discs[n].first.y, place.y, 1e-6) << n;
    EXPECT_EQ(discs[n].second, expected[n]) << n;
  }
  for (const double direct_w_m2 : {0.0, 250.0, 800.0, 1000.0}) EXPECT_NE(discs[1].second, colour_of_sun(direct_w_m2));
  const auto is_said = [](const auto& shape) {
    const auto* text = std::get_if<Text>(&shape);
    return text != nullptr && text->words == "12 in all";
  };
  EXPECT_TRUE(std::ranges::any_of(drawing.shapes, is_said));
}

TEST(LightInThePicture, ColoursGetDarkerWithTheSun) {
  const auto lightness = [](double direct_w_m2) {
    const Colour c = colour_of_sun(direct_w_m2);
    return 0.3 * c.red + 0.6 * c.green + 0.1 * c.blue;
  };
  for (double direct_w_m2 = 0.0; direct_w_m2 < 1000.0; direct_w_m2 += 50.0)
    EXPECT_GT(lightness(direct_w_m2), lightness(direct_w_m2 + 50.0)) << direct_w_m2;
  EXPECT_EQ(colour_of_sun(1000.0), colour_of_sun(1300.0));
}

TEST(SunInThePicture, IsNotDrawnBelowTheHorizon) {
  SunOfSky sun = longest_day();
  for (HemisphereDirection& d : sun.courses.front().minutes) d.zenith_angle_deg = 91.0;
  const Picture night = with_sun(sun), without = with_sun({});
  for (std::size_t y = 116; y < 916; ++y)
    for (std::size_t x = 56; x < 856; ++x) ASSERT_EQ(night.at({x, y}), without.at({x, y})) << x << ", " << y;
}

/// A cell of 10 m at the origin, turned counter-clockwise by some angle, with N = 3.
CellContents turned_cell(double turn_deg) {
  CellContents contents;
  contents.cell = {4, 7};
  contents.neighborhood = {3, 6, 6, 9};
  const Point2d east{10.0 * std::cos(turn_deg * rad_per_deg), 10.0 * std::sin(turn_deg * rad_per_deg)}, north{-east.y, east.x};
  contents.corners_projected = {Point2d{}, east, east + north, north};
  return contents;
}

/// A square with an edge of 2 m in the middle of a cell, as two triangles; of a building or of the ground.
MeshPart square_in(CellPlace cell, std::optional<std::uint32_t> building) {
  MeshPart part;
  part.cell = cell;
  part.building = building;
  const Point3d middle{10.0 * (cell.i - 4) + 5.0, 10.0 * (cell.j - 7) + 5.0, 3.0};
  for (const Point3d d : {Point3d{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}) part.vertices_projected.push_back(middle + d);
  const SurfaceKind kind = building ? SurfaceKind::roof : SurfaceKind::ground;
  part.triangles = {{{0, 1, 2}, kind}, {{0, 2, 3}, kind}};
  return part;
}

TEST(CellPlan, HasNorthUpAndTheCellInTheMiddle) {
  for (const double turn_deg : {0.0, 20.0, -44.0}) {
    const CellContents contents = turned_cell(turn_deg);
    const CellPlanFrame frame(contents, 500);
    const Point2d middle = 0.5 * (contents.corners_projected[0] + contents.corners_projected[2]);
    EXPECT_NEAR(frame.place_of(middle).x, 250.0, 1e-9);
    EXPECT_NEAR(frame.place_of(middle + Point2d{0.0, 1.0}).y, 250.0 - 1.0 / frame.metres_per_pixel(), 1e-9);
    EXPECT_GT(frame.place_of(middle + Point2d{1.0, 0.0}).x, 250.0);
    // All of the ring is on paper, and reaches its border
    double farthest = 0.0;
    for (const auto& [i, j] : {std::pair{-2, -2}, {3, -2}, {3, 3}, {-2, 3}}) {
      const PagePoint p = frame.corner(i, j);
      farthest = std::max({farthest, std::abs(p.x - 250.0), std::abs(p.y - 250.0)});
    }
    EXPECT_NEAR(farthest, 250.0, 1e-9);
  }
}

TEST(CellPlan, ColoursSayWhatBelongsToTheCell) {
  const CellContents contents = turned_cell(0.0);
  const CellPlanFrame frame(contents, 500);
  const std::vector<MeshPart> parts{square_in({4, 8}, std::nullopt), square_in({4, 7}, 1), square_in({5, 7}, 2),
                                    square_in({6, 9}, 3)};
  const Picture picture = draw_cell_plan(contents, parts, frame);
  const auto at = [&](double x, double y) {
    const PagePoint p = frame.place_of({x, y});
    return picture.at({static_cast<std::size_t>(p.x), static_cast<std::size_t>(p.y)});
  };
  EXPECT_EQ(at(5.0, 5.0), building_colour(CellZone::cell));
  EXPECT_EQ(at(15.0, 5.0), building_colour(CellZone::near));
  EXPECT_EQ(at(25.0, 25.0), building_colour(CellZone::far));
  EXPECT_EQ(at(5.0, 15.0), street_colour(CellZone::near));
  EXPECT_EQ(at(7.0, 5.0), (Colour{255, 255, 255})) << "nothing is there";
}

TEST(FarPanorama, PlacesAreSeenFromTheMiddleByTrueAzimuth) {
  const Point3d eye{100.0, 200.0, 10.0};
  const SeenPlace east = seen_from(eye, {150.0, 200.0, 60.0}, Angle::degrees(2.0));
  EXPECT_NEAR(east.azimuth_deg, 92.0, 1e-9);
  EXPECT_NEAR(east.elevation_deg, 45.0, 1e-9);
  EXPECT_NEAR(seen_from(eye, {99.0, 300.0, 10.0}, {}).azimuth_deg, 360.0 - std::atan(0.01) / rad_per_deg, 1e-9);
}

TEST(FarPanorama, SidesFollowTheStreets) {
  FarBoxView box;
  box.north_azimuth = Angle::degrees(30.0);
  EXPECT_NEAR(place_along_sides(30.0, box), 0.5, 1e-9);
  EXPECT_NEAR(place_along_sides(120.0, box), 1.5, 1e-9);
  EXPECT_NEAR(place_along_sides(300.0, box), 3.5, 1e-9);
  EXPECT_NEAR(place_along_sides(75.0, box), 1.0, 1e-9);
  EXPECT_NEAR(place_along_sides(0.0, box), 0.5 - 0.5 * std::tan(30.0 * rad_per_deg), 1e-9);
}

TEST(FarPanorama, HasRoomForTheHighestThatItShows) {
  FarView view;
  view.horizon.low = {0.1F};
  view.horizon.estimate = {0.2F};
  view.horizon.high = {std::numeric_limits<float>::infinity()};
  EXPECT_EQ(top_of_panorama_deg(view, {}), 15.0);  // atan 0.2 is 11.3°
  view.horizon.edges = {{{0.0, 100.0, 100.0}, {10.0, 100.0, 0.0}}};
  EXPECT_EQ(top_of_panorama_deg(view, {}), 50.0);
}

/// The residual city: everything low in the east is hidden for certain, higher it is undecided; elsewhere is sky.
TEST(CellPicture, UnfoldsTheHorizon) {
  CellScenery scenery;
  scenery.contents = turned_cell(0.0);
  scenery.contents.has_far_map = true;
  scenery.package = "town.farlod";
  scenery.far = FarView{};
  FarHorizonView& h = scenery.far->horizon;
  h.first_azimuth = Angle::degrees(-270.0);  // as clockwise bins that begin in the east
  h.low = {0.2F, 0.0F, 0.0F, 0.0F};
  h.estimate = {0.3F, 0.0F, 0.0F, 0.0F};
  h.high = {0.5F, 0.0F, 0.0F, 0.0F};
  const Picture picture = drawn(draw_cell(scenery));
  // The panorama begins at its upper left pixel that has the colour of the sky
  std::size_t left = 0, top = 0;
  const std::size_t width = picture.size().width;
  for (std::size_t n = 0; n < picture.pixels().size() && left == 0; ++n)
    if (picture.pixels()[n] == colour_of(SkyPart::sky)) {
      left = n % width;
      top = n / width;
    }
  ASSERT_GT(left, 0U);
  const double top_deg = top_of_panorama_deg(*scenery.far, {});
  const auto at = [&](double azimuth_deg, double elevation_deg) {
    return picture.at({left + static_cast<std::size_t>(azimuth_deg / 360.0 * 900.0),
                       top + static_cast<std::size_t>(300.0 * (1.0 - elevation_deg / top_deg))});
  };
  EXPECT_EQ(at(130.0, 7.0), colour_of(SkyPart::far));
  EXPECT_NE(at(130.0, 22.0), colour_of(SkyPart::far));
  EXPECT_NE(at(130.0, 22.0), colour_of(SkyPart::sky));
  EXPECT_EQ(at(130.0, 28.0), colour_of(SkyPart::sky));
  EXPECT_EQ(at(50.0, 7.0), colour_of(SkyPart::sky));
  EXPECT_EQ(at(230.0, 7.0), colour_of(SkyPart::sky));
}

TEST(CellPicture, SaysWhereThereIsNoFarMap) {
  CellScenery scenery;
  scenery.contents = turned_cell(0.0);
  std::string words;
  for (const auto& shape : draw_cell(scenery).shapes)
    if (const auto* text = std::get_if<Text>(&shape)) words += text->words + "\n";
  EXPECT_NE(words.find("Far map: none"), std::string::npos);
}

/// 400 × 300 pixels of half a metre, of which the eastern half has the value 1.
GreyMap half_a_map() {
  GreyMap map{{1000.0, 2000.0}, {400, 300, 0.5, std::vector<float>(std::size_t{400} * 300, NAN)}};
  for (std::size_t n = 0; n < map.raster.values.size(); ++n)
    if (n % 400 >= 200) map.raster.values[n] = 1.0F;
  return map;
}

/// Too large by .25 in the west, too small by .5 in the east.
const std::vector<VerifiedReceiver> two_receivers{{{1050.0, 1950.0, 3.0}, 0.75F, 0.5F}, {{1150.0, 1900.0, 3.0}, 0.25F, 0.75F}};
constexpr ErrorSummary errors_of_two{2, 0.375, 0.5, 0.5, -0.125, 20000};

TEST(ErrorMap, MarksHaveTheirColoursWhereTheReceiversAre) {
  const Picture picture = drawn(draw_error_map(half_a_map(), {}, two_receivers, errors_of_two, {"svf", "EPSG:1"}));
  const Pixel corner = preview_layout({400, 300}).map;
  const auto at = [&](std::size_t x, std::size_t y) { return picture.at({corner.x + x, corner.y + y}); };
  EXPECT_EQ(at(100, 100), colour_of_error(0.5));  // 50 m east of the corner and 50 m south of it, half a metre a pixel
  EXPECT_EQ(at(300, 200), colour_of_error(-1.0));
  EXPECT_EQ(at(50, 250), (Colour{255, 255, 255}));   // no data
  EXPECT_EQ(at(350, 250), (Colour{232, 232, 232}));  // open sky
  // One points up and one down: six pixels below the middle is the wide side of the first alone
  EXPECT_EQ(at(104, 103), colour_of_error(0.5));
  EXPECT_NE(at(304, 203), colour_of_error(-1.0));
  EXPECT_EQ(at(304, 197), colour_of_error(-1.0));
}

TEST(ErrorMap, LargerErrorsLieOnTop) {
  const std::vector<VerifiedReceiver> at_one_place{{{1050.0, 1950.0, 0.0}, 1.0F, 0.5F}, {{1050.0, 1950.0, 0.0}, 0.5F, 0.5F}};
  const Picture picture = drawn(draw_error_map(half_a_map(), {}, at_one_place, {2, 0.25, 0.5, 0.5, 0.25, 20000}, {"svf", ""}));
  const Pixel corner = preview_layout({400, 300}).map;
  EXPECT_EQ(picture.at({corner.x + 100, corner.y + 100}), colour_of_error(1.0));
}

TEST(ErrorMap, ColoursReachToARoundErrorAboveThe99thPercentile) {
  const auto full = [](double p99) { return error_of_full_colour({1, 0.0, p99, 1.0, 0.0, 1}); };
  EXPECT_DOUBLE_EQ(full(0.0), 0.0001);
  EXPECT_DOUBLE_EQ(full(0.0011), 0.002);
  EXPECT_DOUBLE_EQ(full(0.002), 0.002);
  EXPECT_DOUBLE_EQ(full(0.03), 0.05);
  EXPECT_DOUBLE_EQ(full(0.6), 1.0);
}

TEST(ErrorMap, OfPointsLiesAroundThem) {
  const GreyMap map = map_around(two_receivers, {});
  EXPECT_DOUBLE_EQ(map.north_west_m.x, 1030.0);  // 20 m
  EXPECT_DOUBLE_EQ(map.north_west_m.y, 1970.0);
  EXPECT_DOUBLE_EQ(map.raster.metres_per_pixel, 0.14);
  EXPECT_EQ(map.raster.columns, 1000U);
  EXPECT_NEAR(static_cast<double>(map.raster.rows), 90.0 / 0.14, 1.0);
  EXPECT_DOUBLE_EQ(map_around({}, {{0.0, 0.0}, {10.0, 20.0}}).north_west_m.y, 20.0);
}

}  // namespace
}  // namespace farlod

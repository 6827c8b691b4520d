// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/cell_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <variant>

#include "results/picture/far_panorama.hpp"
#include "results/picture/picture_style.hpp"
#include "results/picture/sky_picture.hpp"
#include "tests/runtime/results/picture/decoded_png.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

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
  const scenes::TemporaryFolder folder;
  write_drawing(draw_cell(scenery), folder.file("a.png"));
  const Picture picture = decoded_png(folder.file("a.png"));
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

}  // namespace
}  // namespace farlod

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/mesh/mesh_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "farlod/error.hpp"
#include "results/picture/picture.hpp"
#include "tests/runtime/results/picture/decoded_png.hpp"
#include "tests/scenes/glb_reader.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using scenes::Glb;

void expect_colour(const std::array<std::uint16_t, 4>& found, Colour wanted) {
  const double half_of_last_digit = 0.5 / 65535.0 + 1e-12;
  EXPECT_NEAR(found[0] / 65535.0, linear_channel(wanted.red), half_of_last_digit);
  EXPECT_NEAR(found[1] / 65535.0, linear_channel(wanted.green), half_of_last_digit);
  EXPECT_NEAR(found[2] / 65535.0, linear_channel(wanted.blue), half_of_last_digit);
  EXPECT_EQ(found[3], 65535);
}

/// Far from the origin of their CRS, where a float has half a metre: the third has no answer, the last no height.
const std::vector<PointRow> four_rows{{"a", {691000.125, 5335000.25}, 512.5, 0.0, {}, {}},
                                      {"b", {691010.5, 5335000.75}, 514.0, 1.0, {}, {}},
                                      {"c", {691002.0, 5335020.0}, 513.0, {}, {}, {}},
                                      {"d", {0.0, 0.0}, {}, {}, {}, {}}};

TableFrame frame_of_four() {
  TableFrame frame{{"svf"}};
  frame.epsg = 25832;
  frame.provenance = {"Far-LoD 1", "a \"town\"", "0123", "--height 1.5"};
  return frame;
}

Glb written_points(const std::vector<PointRow>& rows) {
  const scenes::TemporaryFolder folder;
  write_points_glb({rows.size(), [&](std::size_t n) { return rows[n]; }, nullptr, false}, frame_of_four(), folder.file("p.glb"));
  return Glb(scenes::text_of(folder.file("p.glb")));
}

TEST(PointsGlb, StandWhereTheyAreToTheMillimetre) {
  const Glb glb = written_points(four_rows);
  ASSERT_EQ(glb.positions.size(), 3U);
  const auto origin = glb.extras().at("origin_m").get<std::vector<double>>();
  EXPECT_EQ(origin, (std::vector{691005.0, 5335010.0, 512.0}));
  for (std::size_t n = 0; n < 3; ++n) {
    // Binary fractions, near enough that floats are exact: x east, y up, z south
    EXPECT_EQ(static_cast<double>(glb.positions[n][0]) + origin[0], four_rows[n].p_projected.x);
    EXPECT_EQ(static_cast<double>(glb.positions[n][1]) + origin[2], *four_rows[n].height_m);
    EXPECT_EQ(origin[1] - static_cast<double>(glb.positions[n][2]), four_rows[n].p_projected.y);
  }
  EXPECT_EQ(glb.json.at("meshes").at(0).at("primitives").at(0).at("mode"), 0);
}

TEST(PointsGlb, HaveLinearColoursThatNoLightChanges) {
  const Glb glb = written_points(four_rows);
  expect_colour(glb.colours.at(0), colour_of_svf(0.0));
  expect_colour(glb.colours.at(1), colour_of_svf(1.0));
  expect_colour(glb.colours.at(2), nodata_colour);
  EXPECT_TRUE(glb.json.at("accessors").at(1).at("normalized"));
  EXPECT_TRUE(glb.json.at("materials").at(0).at("extensions").contains("KHR_materials_unlit"));
  EXPECT_EQ(glb.json.at("extensionsUsed").dump(), R"(["KHR_materials_unlit"])");
}

TEST(PointsGlb, SayTheirExtentToTheBit) {
  const Glb glb = written_points(four_rows);
  for (std::size_t k = 0; k < 3; ++k) {
    float low = glb.positions[0][k], high = low;
    for (const auto& p : glb.positions) low = std::min(low, p[k]), high = std::max(high, p[k]);
    EXPECT_EQ(glb.json.at("accessors").at(0).at("min").at(k).get<double>(), static_cast<double>(low));
    EXPECT_EQ(glb.json.at("accessors").at(0).at("max").at(k).get<double>(), static_cast<double>(high));
  }
}

TEST(PointsGlb, SayWhatMadeThem) {
  const Glb glb = written_points(four_rows);
  EXPECT_EQ(glb.extras().at("crs"), "EPSG:25832");
  EXPECT_EQ(glb.extras().at("package"), "a \"town\"");
  EXPECT_EQ(glb.extras().at("settings"), "--height 1.5");
  EXPECT_EQ(glb.json.at("asset").at("generator"), "Far-LoD 1");
}

TEST(PointsGlb, WithoutAnyAreASceneOfNothing) {
  const Glb glb = written_points({four_rows.back()});
  EXPECT_TRUE(glb.positions.empty());
  EXPECT_FALSE(glb.json.contains("meshes"));
}

TEST(PointsGlb, AreManyToo) {
  // More than is kept in memory at once
  std::vector<PointRow> rows(10'000, four_rows[0]);
  for (std::size_t n = 0; n < rows.size(); ++n) rows[n].height_m = 512.0 + static_cast<double>(n % 64);
  const Glb glb = written_points(rows);
  ASSERT_EQ(glb.positions.size(), rows.size());
  for (std::size_t n = 0; n < rows.size(); ++n) ASSERT_EQ(glb.positions[n][1], static_cast<float>(n % 64));
}

TEST(SurfacesGlb, WithoutAPackageHaveTheirTables) {
  const scenes::TemporaryFolder folder;
  const auto files = SurfacesGlb({{"svf"}}, folder.file("s.glb")).commit({}, {});
  EXPECT_EQ(files, (std::vector{folder.file("s.glb"), folder.file("s.surfaces.csv"), folder.file("s.buildings.csv")}));
  EXPECT_TRUE(Glb(scenes::text_of(files[0])).positions.empty());
}

TEST(MeshObj, HasAGroupForEachBuildingAndCountsVerticesFromOne) {
  const std::vector<Point3d> corners{{500.5, 600.25, 1.0}, {501.5, 600.25, 1.00004}, {500.5, 601.25, 2.0}};
  const std::vector<MeshTriangle> one{{{0, 1, 2}, SurfaceKind::roof}};
  const std::vector<MeshPart> parts{{{0, 0}, std::nullopt, "", corners, one},
                                    {{0, 0}, 3, "town hall", corners, one},
                                    {{1, 0}, 3, "town hall", corners, one},
                                    {{1, 0}, 4, "", corners, one}};
  const scenes::TemporaryFolder folder;
  write_obj(parts, {500.0, 600.0}, {"a remark"}, folder.file("a.obj"));
  const std::string v = "v 0.5000 0.2500 1.0000\nv 1.5000 0.2500 1.0000\nv 0.5000 1.2500 2.0000\n";
  EXPECT_EQ(scenes::text_of(folder.file("a.obj")),
            "# a remark\n# Offset: add 500 to x and 600 to y; z is the height above sea level\n"
            "g ground\n" +
                v + "f 1 2 3\n" + "g town_hall\n" + v + "f 4 5 6\n" + v + "f 7 8 9\n" + "g building_4\n" + v + "f 10 11 12\n");
}

TEST(MeshObj, SaysWhereItCannotBeWritten) { EXPECT_THROW(write_obj({}, {}, {}, "/no such folder/a.obj"), OutputError); }

}  // namespace
}  // namespace farlod

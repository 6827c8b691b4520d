// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <string>

#include "farlod/error.hpp"
#include "results/picture/picture.hpp"
#include "tests/acceptance/packed_town.hpp"
#include "tests/analytic/tolerance.hpp"
#include "tests/scenes/glb_reader.hpp"

namespace farlod::acceptance {
namespace {

/// A corner is written in whole millimetres, so it moves by at most 0.71 mm, and a side's length by twice that.
const double side_error_m = std::sqrt(2.0) * 0.001;
double wall_error_m2(const Block& b) { return 4.0 * b.height_m * side_error_m; }
double roof_error_m2(const Block& b) { return 2.0 * b.edge_m * side_error_m; }

/// Each of n printed areas is off by at most half a square millimetre's digit.
double printing_error_m2(std::size_t n) { return 0.0005 * static_cast<double>(n); }

std::set<std::string> values_of(const CsvTable& table, const std::string& column) {
  std::set<std::string> values;
  for (std::size_t n = 0; n < table.size(); ++n) values.insert(table.text(n, column));
  return values;
}

TEST_F(PackedTown, SurfacesComeAsPointsSurfacesAndBuildings) {
  folder.must("farlod-svf a.farlod -o o.csv --surfaces all --spacing 4");
  EXPECT_EQ(table("o.csv").header(), (std::vector<std::string>{"building", "surface", "kind", "x_m", "y_m", "z_m", "azimuth_deg",
                                                               "tilt_deg", "area_m2", "svf"}));
  EXPECT_EQ(table("o.surfaces.csv").header(),
            (std::vector<std::string>{"building", "surface", "kind", "azimuth_deg", "tilt_deg", "area_m2", "receivers", "nodata",
                                      "svf_mean", "svf_min", "svf_max", "covered_area_m2"}));
  EXPECT_EQ(table("o.buildings.csv").header(),
            (std::vector<std::string>{"building", "roof_area_m2", "wall_area_m2", "receivers", "nodata", "svf_roofs", "svf_walls",
                                      "covered_roof_area_m2", "covered_wall_area_m2"}));
  const std::size_t blocks = small_town().size();
  EXPECT_EQ(table("o.buildings.csv").size(), blocks);
  EXPECT_EQ(table("o.surfaces.csv").size(), 5 * blocks);
}

/// Small triangles have a receiver as large ones have: a mean that counted both alike would be that of no area.
TEST_F(PackedTown, MeansOfARunWeighSurfacesByTheirArea) {
  folder.must("farlod-svf a.farlod -o o.csv --surfaces all --spacing 7 --quantity svf_solid --summary s.json");
  const CsvTable points = table("o.csv");
  std::map<std::string, double> sums;
  std::map<double, double> area_by_svf;
  double area_m2 = 0.0, alike = 0.0, count = 0.0;
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (points.text(n, "svf").empty()) continue;
    const double part_m2 = points.number(n, "area_m2");
    for (const char* name : {"svf", "svf_solid"}) sums[name] += part_m2 * points.number(n, name);
    area_by_svf[points.number(n, "svf")] += part_m2;
    area_m2 += part_m2;
    alike += points.number(n, "svf");
    ++count;
  }
  const nlohmann::json summary = folder.json_of("s.json");
  const double printed = half_of_last_digit + printing_error_m2(points.size()) / area_m2;
  EXPECT_NEAR(summary.at("svf").at("mean").get<double>(), sums.at("svf") / area_m2, printed);
  EXPECT_GT(std::abs(alike / count - sums.at("svf") / area_m2), 4.0 * printed) << "the scene tells the two apart";
  EXPECT_NEAR(summary.at("values").at("svf_solid").at("mean").get<double>(), sums.at("svf_solid") / area_m2, printed);
  double below_m2 = 0.0;
  auto middle = area_by_svf.begin();
  while (below_m2 + middle->second < 0.5 * area_m2) below_m2 += (middle++)->second;
  EXPECT_NEAR(summary.at("svf").at("median").get<double>(), middle->first, 0.0001);
}

TEST_F(PackedTown, AreasAddUp) {
  folder.must("farlod-svf a.farlod -o o.csv --surfaces all --spacing 4");
  const CsvTable points = table("o.csv"), surfaces = table("o.surfaces.csv"), buildings = table("o.buildings.csv");
  const auto by_surface = points.sums_by({"building", "surface"}, "area_m2");
  for (const auto& [surface, area_m2] : surfaces.sums_by({"building", "surface"}, "area_m2"))
    EXPECT_NEAR(by_surface.at(surface), area_m2, printing_error_m2(points.size())) << surface;
  const auto by_kind = surfaces.sums_by({"building", "kind"}, "area_m2");
  const auto roofs = buildings.sums_by({"building"}, "roof_area_m2"), walls = buildings.sums_by({"building"}, "wall_area_m2");
  for (const Block& b : small_town()) {
    const double printing = printing_error_m2(5);
    EXPECT_NEAR(by_kind.at(b.id + "/roof/"), roofs.at(b.id + "/"), printing);
    EXPECT_NEAR(by_kind.at(b.id + "/wall/"), walls.at(b.id + "/"), printing);
    EXPECT_NEAR(roofs.at(b.id + "/"), b.edge_m * b.edge_m, roof_error_m2(b) + printing) << b.id;
    EXPECT_NEAR(walls.at(b.id + "/"), 4.0 * b.edge_m * b.height_m, wall_error_m2(b) + printing) << b.id;
  }
}

/// A triangle of a mesh, by its normal of the length of its area: x east, y up, z south.
Point3d area_vector(const scenes::Glb& glb, std::size_t first) {
  const auto corner = [&](std::size_t n) {
    const auto& p = glb.positions[first + n];
    return Point3d{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  };
  return 0.5 * cross(corner(1) - corner(0), corner(2) - corner(0));
}

TEST_F(PackedTown, MeshesAndPointsAreWhatTheValidatorOfGltfTakes) {
  folder.write("validate.js", R"(
    const validator = require('gltf-validator'), fs = require('fs');
    Promise.all(process.argv.slice(2).map(name => validator.validateBytes(new Uint8Array(fs.readFileSync(name)))))
      .then(reports => reports.forEach(r => console.log(r.issues.numErrors + r.issues.numWarnings, r.info.totalVertexCount > 0)));
  )");
  const std::string node = "NODE_PATH=\"$(npm root -g)\" node validate.js";
  if (folder.run(node).exit_code != exit_done)
    GTEST_SKIP() << "gltf-validator is not installed (npm install --global gltf-validator)";
  folder.must("farlod-svf a.farlod -o mesh.glb --surfaces all --spacing 4");
  folder.must("farlod-svf a.farlod -o points.glb --at " + text_of(p_projected({-60.0, 0.0})));
  EXPECT_EQ(folder.run(node + " mesh.glb points.glb").out, "0 true\n0 true\n");
}

TEST_F(PackedTown, AMeshHasEachSurfaceOnceInTheColourOfItsMean) {
  folder.must("farlod-svf a.farlod -o o.glb --surfaces all --spacing 4");
  const scenes::Glb glb(folder.text_of("o.glb"));
  ASSERT_EQ(glb.positions.size() % 3, 0U);
  std::map<std::array<std::uint16_t, 4>, double> area_of_colour;
  double roofs_m2 = 0.0, walls_m2 = 0.0, floors_m2 = 0.0;
  for (std::size_t first = 0; first < glb.positions.size(); first += 3) {
    const Point3d a = area_vector(glb, first);
    const double area_m2 = std::sqrt(dot(a, a));
    (a.y > 0.5 * area_m2 ? roofs_m2 : a.y < -0.5 * area_m2 ? floors_m2 : walls_m2) += area_m2;
    area_of_colour[glb.colours[first]] += area_m2;
    EXPECT_EQ(glb.colours[first], glb.colours[first + 2]);
  }
  double wanted_roofs_m2 = 0.0, wanted_walls_m2 = 0.0, roof_error = 0.0, wall_error = 0.0;
  for (const Block& b : small_town()) {
    wanted_roofs_m2 += b.edge_m * b.edge_m;
    wanted_walls_m2 += 4.0 * b.edge_m * b.height_m;
    // Corners are floats some hundred metres from the origin, too: a tenth of a millimetre
    roof_error += 1.2 * roof_error_m2(b);
    wall_error += 1.2 * wall_error_m2(b);
  }
  EXPECT_NEAR(roofs_m2, wanted_roofs_m2, roof_error);
  EXPECT_NEAR(walls_m2, wanted_walls_m2, wall_error);
  EXPECT_NEAR(floors_m2, wanted_roofs_m2, roof_error);
  const CsvTable surfaces = table("o.surfaces.csv");
  for (std::size_t n = 0; n < surfaces.size(); ++n) {
    // As --at and PLY have it: the colour of the same value in sRGB, decoded by IEC 61966-2-1
    const Colour colour = colour_of_svf(surfaces.number(n, "svf_mean"));
    const auto matches = [&](const auto& found) {
      const auto near = [](std::uint16_t light, std::uint8_t channel) {
        const double v = channel / 255.0, wanted = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
        return std::abs(light / 65535.0 - wanted) < 0.01;  // the mean was printed: a channel may differ by one
      };
      return near(found.first[0], colour.red) && near(found.first[1], colour.green) && near(found.first[2], colour.blue);
    };
    double area_m2 = 0.0;
    for (const auto& found : area_of_colour)
      if (matches(found)) area_m2 += found.second;
    EXPECT_GE(area_m2, surfaces.number(n, "area_m2") - 1.0) << n;
  }
}

TEST_F(PackedTown, AMeshStandsWhereItsOriginSays) {
  folder.must("farlod-svf a.farlod -o o.glb --surfaces roofs --spacing 4");
  const scenes::Glb glb(folder.text_of("o.glb"));
  const auto origin = glb.extras().at("origin_m").get<std::vector<double>>();
  EXPECT_EQ(glb.extras().at("crs"), town_crs);
  const Block tower = tower_of(small_town());
  std::size_t on_top = 0;
  for (const auto& p : glb.positions) {
    if (std::abs(static_cast<double>(p[1]) + origin[2] - tower.height_m) > 0.01) continue;
    ++on_top;
    const Point2d place{origin[0] + static_cast<double>(p[0]), origin[1] - static_cast<double>(p[2])};
    EXPECT_LE(norm(place - p_projected(tower.centre)), tower.edge_m * std::sqrt(0.5) + 0.01);
  }
  EXPECT_GE(on_top, 6U);  // two triangles of its roof, and walls
}

TEST_F(PackedTown, RoofsAndWallsAreTheTwoHalvesOfAll) {
  std::vector<std::size_t> sizes;
  for (const char* choice : {"roofs", "walls", "all"}) {
    folder.must(std::string("farlod-svf a.farlod -o o.csv --spacing 4 --surfaces ") + choice);
    sizes.push_back(table("o.csv").size());
    if (std::string(choice) != "all") {
      EXPECT_EQ(values_of(table("o.csv"), "kind"), std::set{std::string(choice).substr(0, 4)});
    }
  }
  EXPECT_EQ(sizes[0] + sizes[1], sizes[2]);
}

TEST_F(PackedTown, SpacingSaysHowDenselyReceiversStand) {
  double area_m2 = 0.0;
  for (const Block& b : small_town()) area_m2 += 4.0 * b.edge_m * b.height_m;
  std::vector<std::size_t> counts;
  for (const double spacing_m : {2.0, 4.0, 8.0}) {
    folder.must("farlod-svf a.farlod -o o.csv --surfaces walls --summary s.json --spacing " + std::to_string(spacing_m));
    counts.push_back(folder.json_of("s.json").at("receivers"));
    EXPECT_GE(static_cast<double>(counts.back()), area_m2 / (spacing_m * spacing_m));
  }
  // Each triangle has at least one receiver, so that twice the spacing leaves a quarter of them and some more
  EXPECT_GT(counts[0], 2 * counts[1]);
  EXPECT_GT(counts[1], 2 * counts[2]);
}

TEST_F(PackedTown, AveragesAreWeighedByArea) {
  folder.must("farlod-svf a.farlod -o o.csv --surfaces walls --spacing 4");
  const CsvTable points = table("o.csv"), surfaces = table("o.surfaces.csv");
  std::map<std::string, double> weighted, area;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const std::string key = points.text(n, "building") + "/" + points.text(n, "surface");
    weighted[key] += points.number(n, "area_m2") * points.number(n, "svf");
    area[key] += points.number(n, "area_m2");
  }
  // An area of a square metre or more is known to a thousandth: so is the weight
  constexpr double weight_error = 0.0005;
  for (std::size_t n = 0; n < surfaces.size(); ++n) {
    const std::string key = surfaces.text(n, "building") + "/" + surfaces.text(n, "surface");
    EXPECT_NEAR(weighted.at(key) / area.at(key), surfaces.number(n, "svf_mean"), weight_error) << key;
    EXPECT_LE(surfaces.number(n, "svf_min"), surfaces.number(n, "svf_mean"));
    EXPECT_LE(surfaces.number(n, "svf_mean"), surfaces.number(n, "svf_max"));
  }
}

TEST_F(PackedTown, WallsFaceAlongTheStreets) {
  folder.must("farlod-svf a.farlod -o o.csv --surfaces walls --spacing 8");
  const CsvTable surfaces = table("o.surfaces.csv");
  // Two corners of a side, half a millimetre off each way; and grid north is true north on the central meridian to 180 m ·
  // sin(50°)/R
  const double tolerance_deg = Angle::radians(side_error_m / town_edge_m + 250.0 / 6.37e6).degrees() + half_of_last_digit;
  for (std::size_t n = 0; n < surfaces.size(); ++n) {
    const double turn = std::remainder(surfaces.number(n, "azimuth_deg") - town_bearing.degrees(), 90.0);
    EXPECT_NEAR(turn, 0.0, tolerance_deg + 0.0005) << surfaces.text(n, "building");
    EXPECT_NEAR(surfaces.number(n, "tilt_deg"), 90.0, 0.0005);
  }
}

TEST_F(PackedTown, RoofsLookUp) {
  folder.must("farlod-svf a.farlod -o o.csv --surfaces roofs --spacing 8");
  const CsvTable receivers = table("o.csv");
  ASSERT_GT(receivers.size(), 0U);
  for (std::size_t n = 0; n < receivers.size(); ++n) {
    EXPECT_EQ(receivers.text(n, "tilt_deg"), "0");
    EXPECT_EQ(receivers.text(n, "azimuth_deg"), "0");
  }
}

TEST(LoneBox, AzimuthsAreTrueFarFromTheCentralMeridian) {
  const WorkFolder folder;
  const Block block{"box", {200000.0, 0.0}, 20.0, 10.0};
  add_packed_town(folder, "far_box", {block});
  folder.must("farlod-svf a.farlod -o o.csv --surfaces walls");
  // On a sphere of the Earth's radius, the convergence is atan(tan(x/R / cos φ) · sin φ); the ellipsoid changes it by a hundredth
  constexpr double radius_m = 6.38e6, quarter_m = 1.0e7, scale = 0.9996;
  const Point2d p = p_projected(block.centre);
  const double latitude = 0.5 * std::numbers::pi * p.y / scale / quarter_m;
  const double longitude = (p.x - 500000.0) / scale / radius_m / std::cos(latitude);
  const Angle convergence = Angle::radians(std::atan(std::tan(longitude) * std::sin(latitude)));
  ASSERT_GT(convergence.degrees(), 1.0);
  const CsvTable walls(folder.text_of("o.surfaces.csv"));
  ASSERT_EQ(walls.size(), 4U);
  for (std::size_t n = 0; n < walls.size(); ++n) {
    const double turn = std::remainder(walls.number(n, "azimuth_deg") - town_bearing.degrees(), 90.0);
    EXPECT_NEAR(turn, convergence.degrees(), 0.02 * convergence.degrees()) << n;
  }
}

TEST_F(PackedTown, TheTallestRoofSeesTheWholeSky) {
  folder.must("farlod-svf a.farlod -o o.csv --surfaces roofs --engine exact --spacing 4");
  const CsvTable buildings = table("o.buildings.csv");
  for (std::size_t n = 0; n < buildings.size(); ++n) {
    const bool is_tower = buildings.text(n, "building") == tower_of(small_town()).id;
    if (is_tower) {
      EXPECT_EQ(buildings.number(n, "svf_roofs"), 1.0);
    }
    if (!is_tower) {
      EXPECT_LT(buildings.number(n, "svf_roofs"), 1.0);
    }
  }
}

TEST(LoneBox, AWallInTheOpenSeesHalfOfItsHemisphere) {
  const WorkFolder folder;
  add_packed_town(folder, "lone_box", {{"box", {}, 20.0, 10.0}});
  folder.must("farlod-svf a.farlod -o o.csv --surfaces all");
  const CsvTable surfaces(folder.text_of("o.surfaces.csv"));
  ASSERT_EQ(surfaces.size(), 5U);
  const double diameter = 2.0;  // the horizon, drawn on the unit disk of the wall's own hemisphere
  for (std::size_t n = 0; n < surfaces.size(); ++n) {
    const bool is_roof = surfaces.text(n, "kind") == "roof";
    EXPECT_NEAR(surfaces.number(n, "svf_mean"), is_roof ? 1.0 : 0.5, is_roof ? 0.0 : sampling_error(default_rays, diameter));
  }
}

/// Where two blocks touch. In the first pair that is on the border of two cells, which meet in the middle of the city.
struct Pair {
  const char* name;
  std::vector<Block> blocks;
};
void PrintTo(const Pair& pair, std::ostream* out) { *out << pair.name; }

class PartyWall : public testing::TestWithParam<Pair> {};

TEST_P(PartyWall, HasNoAnswerWhereItIsCovered) {
  const WorkFolder folder;
  add_packed_town(folder, std::string("pair_") + GetParam().name, GetParam().blocks);
  const Outcome said = folder.run("farlod-svf a.farlod -o o.csv --surfaces walls --summary s.json");
  ASSERT_EQ(said.exit_code, exit_done) << said.err;
  const CsvTable surfaces(folder.text_of("o.surfaces.csv")), points(folder.text_of("o.csv"));
  EXPECT_THAT(said.out, testing::HasSubstr("where another building or the ground covers the surface (party walls, cellars)"));
  EXPECT_THAT(said.out, testing::Not(testing::HasSubstr("inside buildings")));
  std::size_t without_answer = 0;
  for (std::size_t n = 0; n < surfaces.size(); ++n) {
    const bool has_none = surfaces.text(n, "nodata") == surfaces.text(n, "receivers");
    EXPECT_EQ(surfaces.text(n, "svf_mean").empty(), has_none);
    without_answer += has_none ? 1 : 0;
  }
  // The low one's party wall is covered whole; the high one's only below the low one's roof
  EXPECT_EQ(without_answer, 1U);
  for (std::size_t n = 0; n < points.size(); ++n) EXPECT_NE(points.text(n, "svf"), "0.000000") << points.text(n, "building");
}

INSTANTIATE_TEST_SUITE_P(
    Blocks, PartyWall,
    testing::Values(Pair{"OnACellsBorder", {{"low", {-10.0, 0.0}, 20.0, 10.0}, {"high", {10.0, 0.0}, 20.0, 30.0}}},
                    Pair{"WithinACell", {{"low", {-10.0, 0.0}, 20.0, 10.0}, {"high", {15.0, 0.0}, 30.0, 30.0}}}),
    [](const auto& pair) { return pair.param.name; });

TEST_F(PackedTown, AMatrixHasARowForEachRowOfItsTableWhateverTheThreads) {
  const std::string run = "farlod-svf a.farlod --surfaces all --spacing 5 --rays 200 --summary s.json ";
  folder.must(run + "-o o.csv --matrix one.npz --threads 1");
  const nlohmann::json matrix = folder.json_of("s.json").at("matrix");
  const CsvTable surfaces = table("o.surfaces.csv");
  EXPECT_EQ(matrix.at("surfaces"), surfaces.size());
  EXPECT_EQ(matrix.at("rays"), 200);
  EXPECT_EQ(matrix.at("threshold"), 1e-4);
  double answered = 0.0;
  for (std::size_t n = 0; n < surfaces.size(); ++n) answered += surfaces.number(n, "receivers") - surfaces.number(n, "nodata");
  EXPECT_EQ(matrix.at("receivers"), answered);
  EXPECT_GT(matrix.at("entries"), 2 * surfaces.size());
  folder.must(run + "-o p.csv --matrix four.npz --threads 4");
  EXPECT_TRUE(folder.text_of("one.npz") == folder.text_of("four.npz"));
  EXPECT_TRUE(folder.text_of("o.surfaces.csv") == folder.text_of("p.surfaces.csv"));
  folder.must(run + "-o q.csv --matrix coarse.npz --matrix-threshold 0.5");
  EXPECT_LT(folder.json_of("s.json").at("matrix").at("entries"), matrix.at("entries"));
}

TEST_F(PackedTown, ObjectsOfEnergyPlusHaveTheViewFactorsOfTheTable) {
  folder.must("farlod-svf a.farlod --surfaces walls --spacing 5 --rays 200 -o o.csv --energyplus o.IDF --summary s.json");
  EXPECT_EQ(folder.json_of("s.json").at("quantities").at(0), "view_sky");
  const CsvTable surfaces = table("o.surfaces.csv");
  std::istringstream lines(folder.text_of("o.IDF"));
  std::size_t row = 0;
  for (std::string line; std::getline(lines, line);) {
    const bool is_ground = line.find("!- Ground View Factor") != std::string::npos;
    if (!is_ground && line.find("!- Sky View Factor") == std::string::npos) continue;
    // Both are rounded, and one of the parts gives a millionth or some
    EXPECT_NEAR(std::stod(line), surfaces.number(row, is_ground ? "view_ground_mean" : "view_sky_mean"), 1e-5) << row;
    if (is_ground) ++row;
  }
  EXPECT_EQ(row, surfaces.size());
}

}  // namespace
}  // namespace farlod::acceptance

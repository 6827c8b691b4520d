// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/acceptance/random_towns.hpp"

namespace farlod::acceptance {
namespace {

class EnrichedRandomCityGml : public EnrichedRandomCity, public testing::WithParamInterface<std::uint32_t> {};

TEST_P(EnrichedRandomCityGml, HasTheValuesOfItsOwnSurfaces) {
  const CityGmlTown town(GetParam());
  folder.write("town.gml", town.text());
  run("town.gml");
  const std::string after = folder.text_of("out_town.gml");
  EXPECT_TRUE(std::regex_replace(after, gml_attribute, "") == town.text());
  expect_own_values(town.surfaces(), values_in_gml(after));
}

INSTANTIATE_TEST_SUITE_P(Seeds, EnrichedRandomCityGml, testing::Range(1U, 9U));

class EnrichedRandomCityJson : public EnrichedRandomCity, public testing::WithParamInterface<std::uint32_t> {};

TEST_P(EnrichedRandomCityJson, HasTheValuesOfItsOwnSurfaces) {
  const CityJsonTown town(GetParam());
  folder.write("town.city.json", town.text());
  run("town.city.json");
  const std::string after = folder.text_of("out_town.city.json");
  EXPECT_TRUE(without_values(after) == town.text());
  FoundValues found;
  collect_marks(json::parse(after), found);
  expect_own_values(town.surfaces(), found);
}

INSTANTIATE_TEST_SUITE_P(Seeds, EnrichedRandomCityJson, testing::Range(1U, 9U));

// ---- A round building, and prototypes with long rings

/// The foot of a wall's first edge. No two walls have the same azimuth and area.
Corner round_corner(int n, int walls) {
  const double turn = 2.0 * std::numbers::pi * (n % walls) / walls,
               radius = 100.0 + 20.0 * std::sin(3.0 * turn) + 0.01 * (n % walls);
  return {500'000.0 + radius * std::cos(turn), 5'500'000.0 + radius * std::sin(turn), 0.0};
}
double height_of_wall(int n) { return 10.0 + 0.05 * n; }

/// 15 placements of a prototype whose ring has 500,005 points, of which the packer takes some: the surfaces behind them keep
/// their numbers.
std::string round_building(int walls) {
  std::string text =
      "<?xml version='1.0'?>\n<CityModel xmlns='http://www.opengis.net/citygml/2.0' xmlns:gml='http://www.opengis.net/gml' "
      "xmlns:xlink='http://www.w3.org/1999/xlink' xmlns:bldg='http://www.opengis.net/citygml/building/2.0'>\n"
      "<cityObjectMember><bldg:Building gml:id='round'>";
  const auto placement = [&](int n) {
    std::string ring;
    if (n == 0) {
      ring = "<gml:MultiSurface gml:id='much'><gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>";
      for (int k = 0; k < 250'002; ++k) ring += "0 0 0 0 0 1 ";
      ring += "0 0 0</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember></gml:MultiSurface>";
    }
    return "<bldg:outerBuildingInstallation><bldg:BuildingInstallation><bldg:lod2ImplicitRepresentation><ImplicitGeometry>"
           "<relativeGMLGeometry" +
           (n == 0 ? ">" + ring + "</relativeGMLGeometry>" : std::string(" xlink:href='#much'/>")) +
           "<referencePoint><gml:Point><gml:pos>500000 " + std::to_string(5'500'000 + n) +
           " 0</gml:pos></gml:Point></referencePoint></ImplicitGeometry></bldg:lod2ImplicitRepresentation>"
           "</bldg:BuildingInstallation></bldg:outerBuildingInstallation>\n";
  };
  for (int n = 0; n < 15; ++n) text += placement(n);
  for (int n = 0; n < walls; ++n) {
    const Corner a = round_corner(n, walls), b = round_corner(n + 1, walls);
    const double height = height_of_wall(n);
    const Corner c{b[0], b[1], height}, d{a[0], a[1], height};
    text += "<bldg:boundedBy><bldg:WallSurface gml:id=\"i" + std::to_string(n) +
            "\"><bldg:lod2MultiSurface><gml:MultiSurface><gml:surfaceMember>" +
            gml_polygon({a, b, c, d}, "p" + std::to_string(n)) +
            "</gml:surfaceMember></gml:MultiSurface></bldg:lod2MultiSurface></bldg:WallSurface></bldg:boundedBy>\n";
  }
  return text + "</bldg:Building></cityObjectMember></CityModel>\n";
}

/// Where the table has a wall, by its azimuth and area; nothing where no row or several have these.
std::optional<std::size_t> row_of_wall(const CsvTable& table, int n, int walls) {
  const Corner a = round_corner(n, walls), b = round_corner(n + 1, walls);
  const double east = b[1] - a[1], north = a[0] - b[0], area_m2 = std::hypot(east, north) * height_of_wall(n),
               azimuth_deg = std::fmod(std::atan2(east, north) * 180.0 / std::numbers::pi + 360.0, 360.0);
  std::optional<std::size_t> found;
  for (std::size_t row = 0; row < table.size(); ++row) {
    if (std::abs(std::remainder(table.number(row, "azimuth_deg") - azimuth_deg, 360.0)) > 0.05) continue;
    if (std::abs(table.number(row, "area_m2") + table.number(row, "covered_area_m2") - area_m2) > 0.01) continue;
    if (found) return std::nullopt;
    found = row;
  }
  return found;
}

class EnrichedRoundBuilding : public EnrichedRandomCity, public testing::WithParamInterface<int> {};

TEST_P(EnrichedRoundBuilding, HasTheValuesOfItsWalls) {
  const int walls = GetParam();
  folder.write("town.gml", round_building(walls));
  run("town.gml");
  const std::string after = folder.text_of("out_town.gml");
  // The long ring is none for a regular expression
  const FoundValues found = values_in_gml(after.substr(after.rfind("outerBuildingInstallation")));
  ASSERT_EQ(found.size(), static_cast<std::size_t>(walls));
  const CsvTable table(folder.text_of("a.surfaces.csv"));
  for (int n = 0; n < walls; ++n) {
    const auto& values = found.at("i" + std::to_string(n));
    const std::optional<std::size_t> row = row_of_wall(table, n, walls);
    ASSERT_TRUE(row.has_value()) << "wall " << n << " is not one row of the table";
    EXPECT_EQ(values.at("svf_area_m2"), table.text(*row, "area_m2")) << "wall " << n;
    EXPECT_EQ(values.at("covered_area_m2"), table.text(*row, "covered_area_m2")) << "wall " << n;
    EXPECT_EQ(values.contains("svf_mean") ? values.at("svf_mean") : "", table.text(*row, "svf_mean")) << "wall " << n;
  }
}

INSTANTIATE_TEST_SUITE_P(Walls, EnrichedRoundBuilding, testing::Values(40, 400));

}  // namespace
}  // namespace farlod::acceptance

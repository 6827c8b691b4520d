// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <map>
#include <regex>

#include "farlod/error.hpp"
#include "tests/acceptance/csv_table.hpp"
#include "tests/acceptance/random_towns.hpp"
#include "tests/acceptance/real_city.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod::acceptance {
namespace {

using nlohmann::json;

constexpr const char* rotterdam = "rotterdam/delfshaven.city.json";
constexpr const char* surfaces = " --surfaces all --spacing 4 --quantity svf,directional ";

class EnrichedCity : public RealCity {
 protected:
  /// Packs a city, and writes it again with its values, and these as CSV.
  void enrich(const std::string& file, const std::string& pack_options = "") const {
    folder.must("farlod-pack " + data(file) + " -o a.farlod --quiet " + pack_options);
    folder.must("farlod-svf a.farlod -o a.city.json --city " + data(file) + surfaces);
    folder.must("farlod-svf a.farlod -o a.csv --quiet" + std::string(surfaces));
  }
};

class EnrichedRotterdam : public EnrichedCity {
 protected:
  void SetUp() override {
    needs({rotterdam});
    if (!IsSkipped()) enrich(rotterdam);
  }
};

/// The rows of a table by building and surface.
std::map<std::pair<std::string, std::size_t>, std::size_t> rows_by_surface(const CsvTable& table) {
  std::map<std::pair<std::string, std::size_t>, std::size_t> rows;
  for (std::size_t n = 0; n < table.size(); ++n)
    rows[{table.text(n, "building"), static_cast<std::size_t>(table.number(n, "surface"))}] = n;
  return rows;
}

/// The value is that of the table, or absent where that is empty.
void expect_value(const json& object, const std::string& name, const CsvTable& table, std::size_t row,
                  const std::string& column) {
  if (table.text(row, column).empty())
    EXPECT_FALSE(object.contains(name)) << object;
  else
    EXPECT_EQ(object.value(name, -1.0), table.number(row, column)) << object << name;
}

TEST_F(EnrichedRotterdam, IsTheInputByteForByteButForTheValues) {
  const std::string before = scenes::text_of(data(rotterdam)), after = folder.text_of("a.city.json");
  EXPECT_GT(after.size(), before.size() + 100000U);
  EXPECT_TRUE(without_values(after) == before);
}

TEST_F(EnrichedRotterdam, HasTheValuesOfTheTables) {
  const json city = folder.json_of("a.city.json");
  const CsvTable table(folder.text_of("a.surfaces.csv")), buildings(folder.text_of("a.buildings.csv"));
  for (std::size_t n = 0; n < buildings.size(); ++n) {
    const json& attributes = city.at("CityObjects").at(buildings.text(n, "building")).at("attributes");
    for (const char* name : {"svf_roofs", "svf_walls", "roof_area_m2", "covered_wall_area_m2"})
      expect_value(attributes, name, buildings, n, name);
  }
  std::size_t single = 0, all = 0;
  const auto rows = rows_by_surface(table);
  for (const auto& [id, object] : city.at("CityObjects").items()) {
    // All buildings of this file have one geometry, a MultiSurface: the surface is the number of the polygon
    const json& semantics = object.at("geometry").at(0).at("semantics");
    std::map<std::size_t, std::vector<std::size_t>> rows_of;
    for (std::size_t k = 0; k < semantics.at("values").size(); ++k)
      if (const auto row = rows.find({id, k}); row != rows.end())
        rows_of[semantics.at("values").at(k).get<std::size_t>()].push_back(row->second);
    for (const auto& [k, of_surface] : rows_of) {
      const json& surface = semantics.at("surfaces").at(k);
      EXPECT_EQ(surface.at("type"), table.text(of_surface.front(), "kind") == "roof" ? "RoofSurface" : "WallSurface");
      all += of_surface.size();
      if (of_surface.size() > 1) continue;
      ++single;
      for (const char* name : {"svf_mean", "svf_min", "svf_max", "svfN_mean", "covered_area_m2"})
        expect_value(surface, name, table, of_surface.front(), name);
    }
  }
  EXPECT_EQ(all, table.size());
  EXPECT_GT(single, 50U);
}

TEST_F(EnrichedRotterdam, ThreadsChangeNothing) {
  folder.must("farlod-svf a.farlod -o b.city.json --threads 1 --city " + data(rotterdam) + surfaces);
  EXPECT_TRUE(folder.text_of("a.city.json") == folder.text_of("b.city.json"));
}

TEST_F(EnrichedCity, AModelWithoutSemanticsHasValuesOfBuildings) {
  const std::string delft = "delft/delft.city.json";
  needs({delft});
  if (IsSkipped()) return;
  enrich(delft);
  EXPECT_TRUE(without_values(folder.text_of("a.city.json")) == scenes::text_of(data(delft)));
  EXPECT_THAT(folder.text_of("a.city.json"), testing::HasSubstr("\"svf_walls\":"));
  EXPECT_THAT(folder.text_of("a.city.json"), testing::Not(testing::HasSubstr("\"svf_mean\":")));
  const Outcome outcome = folder.run("farlod-svf a.farlod -o b.city.json --city " + data(delft) + surfaces);
  EXPECT_THAT(outcome.out, testing::HasSubstr("no semantics of their own"));
}

TEST_F(EnrichedCity, FindsTheLevelOfDetailOfThePackage) {
  const std::string town = "formats/cityjson_multi_lod.city.json";
  needs({town});
  if (IsSkipped()) return;
  // Only the geometries of LoD 2.2 have semantics
  enrich(town, "--crs EPSG:28992");
  EXPECT_THAT(folder.text_of("a.city.json"), testing::HasSubstr("\"svf_mean\":"));
  folder.must("rm -r a.farlod");
  enrich(town, "--crs EPSG:28992 --lod 1");
  EXPECT_THAT(folder.text_of("a.city.json"), testing::Not(testing::HasSubstr("\"svf_mean\":")));
  EXPECT_THAT(folder.text_of("a.city.json"), testing::HasSubstr("\"svf_walls\":"));
}

TEST_F(EnrichedCity, PartsOfBuildingsHaveTheirOwnValues) {
  const std::string zurich = "zurich/zurich_subset.city.json";
  needs({zurich});
  if (IsSkipped()) return;
  enrich(zurich);
  EXPECT_TRUE(without_values(folder.text_of("a.city.json")) == scenes::text_of(data(zurich)));
  std::size_t parts = 0;
  const json city = folder.json_of("a.city.json");
  for (const auto& [id, object] : city.at("CityObjects").items())
    parts += object.at("type") == "BuildingPart" && object.at("attributes").contains("svf_walls") ? 1 : 0;
  EXPECT_GT(parts, 150U);
}

TEST_F(EnrichedCity, ASequenceHasTheValuesOfTheTables) {
  const std::string town = "formats/cityjsonseq.city.jsonl";
  needs({town});
  if (IsSkipped()) return;
  folder.must("farlod-pack " + data(town) + " -o a.farlod --quiet --crs EPSG:25832");
  folder.must("farlod-svf a.farlod -o a.city.jsonl --city " + data(town) + surfaces);
  folder.must("farlod-svf a.farlod -o a.csv --quiet" + std::string(surfaces));
  EXPECT_TRUE(without_values(folder.text_of("a.city.jsonl")) == scenes::text_of(data(town)));
  json buildings;
  for (const std::string& line : lines_of(folder.text_of("a.city.jsonl"))) buildings.update(json::parse(line).at("CityObjects"));
  const CsvTable table(folder.text_of("a.surfaces.csv"));
  EXPECT_EQ(table.size(), 600U);
  for (std::size_t n = 0; n < table.size(); ++n) {
    // Each building is a solid with one shell
    const json& semantics = buildings.at(table.text(n, "building")).at("geometry").at(0).at("semantics");
    const auto number = static_cast<std::size_t>(table.number(n, "surface"));
    const json& surface = semantics.at("surfaces").at(semantics.at("values").at(0).at(number).get<std::size_t>());
    EXPECT_EQ(surface.at("type"), table.text(n, "kind") == "roof" ? "RoofSurface" : "WallSurface");
    EXPECT_TRUE(surface.contains("svf_mean")) << surface;
    expect_value(surface, "svf_mean", table, n, "svf_mean");
  }
}

TEST_F(EnrichedRotterdam, AnotherFileIsRefused) {
  std::string text = scenes::text_of(data(rotterdam));
  text.back() = ' ';
  folder.write("changed.city.json", text);
  const std::string command = "farlod-svf a.farlod --surfaces all --city ";
  expect_refusal(folder.run(command + "changed.city.json -o b.city.json"), exit_unusable_input,
                 {"changed.city.json is not a file that a.farlod was made of", "checksum"});
  expect_refusal(folder.run(command + data(rotterdam) + " -o /proc/b.city.json"), exit_unusable_input,
                 {"cannot write /proc/b.city.json"});
  EXPECT_FALSE(folder.has("b.city.json"));
}

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
  std::string text;
  for (int n = 0; n < 15; ++n) text += placement(n);
  for (int n = 0; n < walls; ++n) {
    const Corner a = round_corner(n, walls), b = round_corner(n + 1, walls);
    const double height = height_of_wall(n);
    const Corner c{b[0], b[1], height}, d{a[0], a[1], height};
    text += gml_boundary("WallSurface", " gml:id=\"i" + std::to_string(n) + "\">",
                         gml_polygon({a, b, c, d}, "p" + std::to_string(n)));
  }
  return gml_model(gml_building("round", text));
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

// ---- What the package says of its sources

class SourcesOfPackage : public EnrichedRandomCity {
 protected:
  SourcesOfPackage() { folder.write("town.gml", CityGmlTown(1).text()); }
  void pack(const std::string& options) const { folder.must("farlod-pack town.gml --quiet --crs EPSG:25832 " + options); }
  [[nodiscard]] Outcome enrich(const std::string& options) const {
    return folder.run("farlod-svf a.farlod --surfaces all --quiet " + options);
  }
  void edit_manifest(const std::function<void(json&)>& edit) const {
    std::string text = folder.text_of("a.farlod/manifest.json");
    json manifest = json::parse(text);
    manifest.erase("xxh3");
    edit(manifest);
    folder.write("a.farlod/manifest.json", scenes::sealed(manifest.dump(1) + "\n"));
  }
};

TEST_F(SourcesOfPackage, AreTheSameForAnyThreadsAndShards) {
  pack("-o a.farlod --threads 1 --cell 10");
  pack("-o b.farlod --threads 4 --cell 10");
  for (const char* shard : {"1/2", "0/2"}) pack("-o c.farlod --cell 10 --shard " + std::string(shard));
  folder.must("farlod-pack -o c.farlod --merge --quiet");
  EXPECT_TRUE(folder.has("a.farlod/sources.bin"));
  pack("-o b.farlod --threads 4 --cell 10 --force");
  folder.must("diff -r a.farlod b.farlod && diff -r a.farlod c.farlod");
}

TEST_F(SourcesOfPackage, AreChecked) {
  pack("-o a.farlod");
  EXPECT_EQ(folder.run("farlod-info a.farlod --check").exit_code, exit_done);
  std::string bytes = folder.text_of("a.farlod/sources.bin");
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  folder.write("a.farlod/sources.bin", bytes);
  const Outcome checked = folder.run("farlod-info a.farlod --check");
  EXPECT_EQ(checked.exit_code, exit_damaged_package);
  EXPECT_THAT(checked.out + checked.err, testing::HasSubstr("sources.bin"));
  expect_refusal(enrich("--city town.gml -o b.gml"), exit_damaged_package, {"sources.bin", "damaged"});
  expect_refusal(enrich("-o b.csv"), exit_damaged_package, {"sources.bin", "damaged"});
  EXPECT_EQ(folder.run("farlod-svf a.farlod -o b.asc --grid 20").exit_code, exit_done)
      << "who asks for no surfaces does not read them";
}

TEST_F(SourcesOfPackage, OlderPackagesDoNotSayThem) {
  pack("-o a.farlod");
  edit_manifest([](json& manifest) {
    manifest["version"] = 8;
    manifest.erase("sources");
  });
  expect_refusal(enrich("--city town.gml -o b.gml"), exit_unusable_input,
                 {"a.farlod has format version 8", "town.gml", "pack the file again"});
  EXPECT_EQ(enrich("-o b.csv").exit_code, exit_done);
}

TEST_F(SourcesOfPackage, APackedFileHasIdsAlone) {
  folder.must("gzip -k town.gml && farlod-pack town.gml.gz -o a.farlod --quiet --crs EPSG:25832");
  EXPECT_TRUE(folder.has("a.farlod/sources.bin"));
  expect_refusal(enrich("--city town.gml.gz -o b.gml"), exit_unusable_input, {"town.gml.gz has no places", "archive"});
  expect_refusal(enrich("--city town.gml -o b.gml"), exit_unusable_input, {"town.gml is not a file that a.farlod was made of"});
}

TEST_F(SourcesOfPackage, OfSeveralFilesEachComesBackByItself) {
  const CityJsonTown other(2);
  std::string renamed = other.text();
  for (std::size_t at = renamed.find("\"b"); at != renamed.npos; at = renamed.find("\"b", at + 1))
    if (std::isdigit(static_cast<unsigned char>(renamed[at + 2])) != 0) renamed.replace(at, 2, "\"c");
  folder.write("other.city.json", renamed);
  folder.must("farlod-pack town.gml other.city.json -o a.farlod --quiet --crs EPSG:25832");
  for (const std::string& name : {std::string("town.gml"), std::string("other.city.json")})
    EXPECT_EQ(enrich("--city " + name + " -o out_" + name).exit_code, exit_done);
  EXPECT_TRUE(std::regex_replace(folder.text_of("out_town.gml"), gml_attribute, "") == folder.text_of("town.gml"));
  EXPECT_TRUE(without_values(folder.text_of("out_other.city.json")) == renamed);
  EXPECT_THAT(folder.text_of("out_other.city.json"), testing::HasSubstr("\"svf_mean\":"));
  EXPECT_THAT(folder.text_of("out_town.gml"), testing::HasSubstr("\"svf_mean\""));
}

TEST_F(SourcesOfPackage, BuildingsThatShareAnIdGetNothing) {
  std::string text = folder.text_of("town.gml");
  for (const char* id : {"\"b1\"", "\"b2\""}) text.replace(text.find(id), 4, "\"b0\"");
  folder.write("town.gml", text);
  pack("-o a.farlod");
  const Outcome outcome = folder.run("farlod-svf a.farlod --surfaces all --city town.gml -o b.gml");
  EXPECT_THAT(outcome.out, testing::HasSubstr("3 buildings share their ids with others of the package"));
  const std::string after = folder.text_of("b.gml");
  EXPECT_TRUE(after.substr(0, text.find("\"b3\"")) == text.substr(0, text.find("\"b3\"")));
}

}  // namespace
}  // namespace farlod::acceptance

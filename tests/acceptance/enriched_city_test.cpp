// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <map>
#include <regex>

#include "farlod/error.hpp"
#include "tests/acceptance/csv_table.hpp"
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

/// A text without the attributes that farlod-svf adds.
std::string without_values(const std::string& text) {
  const std::string names = "\"(svf[A-Za-z]*_(roofs|walls|mean|min|max|area_m2)|(covered_)?(roof_|wall_)?area_m2)\":[0-9.]+";
  const std::regex object(",\"attributes\":\\{" + names + "(," + names + ")*\\}"), member("," + names),
      first("\\{" + names + "(," + names + ")*\\}");
  return std::regex_replace(std::regex_replace(std::regex_replace(text, object, ""), first, "{}"), member, "");
}

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

TEST_F(EnrichedCity, IsTheInputByteForByteButForTheValues) {
  needs({rotterdam});
  if (IsSkipped()) return;
  enrich(rotterdam);
  const std::string before = scenes::text_of(data(rotterdam)), after = folder.text_of("a.city.json");
  EXPECT_GT(after.size(), before.size() + 100000U);
  EXPECT_TRUE(without_values(after) == before);
}

TEST_F(EnrichedCity, HasTheValuesOfTheTables) {
  needs({rotterdam});
  if (IsSkipped()) return;
  enrich(rotterdam);
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

TEST_F(EnrichedCity, ThreadsChangeNothing) {
  needs({rotterdam});
  if (IsSkipped()) return;
  enrich(rotterdam);
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

TEST_F(EnrichedCity, AnotherFileIsRefused) {
  needs({rotterdam});
  if (IsSkipped()) return;
  enrich(rotterdam);
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

}  // namespace
}  // namespace farlod::acceptance

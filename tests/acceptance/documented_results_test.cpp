// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "farlod/version.hpp"
#include "results/output_format.hpp"
#include "results/provenance.hpp"
#include "tests/acceptance/packed_town.hpp"
#include "tests/acceptance/street_trees.hpp"

// docs/stages/results.md, and the formats of README.md, against what the programs write.

namespace farlod::acceptance {
namespace {

using nlohmann::json;
using Keys = std::set<std::string>;

/// The lines of a section of the document, without its subsections' titles.
std::vector<std::string> section(const std::string& title) {
  std::ifstream file(std::filesystem::path(FARLOD_SOURCE_DIR) / "docs/stages/results.md");
  std::vector<std::string> lines;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("## ")) inside = line == "## " + title;
    if (inside) lines.push_back(line);
  }
  EXPECT_GT(lines.size(), 5U) << title;
  return lines;
}

/// The keys of a table of the document: those that are always there, or all. A row is of the keys in its first cell; the second
/// begins with an option in brackets where they are not always there.
Keys documented_keys(const std::string& title, bool always_only) {
  static const std::regex row("^\\| (`[a-z0-9_.]+`(?:, `[a-z0-9_.]+`)*) \\| ([^|]+) \\|"), name("`([^`]+)`");
  Keys keys;
  for (const std::string& line : section(title)) {
    std::smatch cells;
    if (!std::regex_match(line, cells, row) || (always_only && cells[2].str().starts_with("("))) continue;
    const std::string first = cells[1];
    for (std::sregex_iterator match(first.begin(), first.end(), name); match != std::sregex_iterator(); ++match)
      EXPECT_TRUE(keys.insert((*match)[1]).second) << (*match)[1] << " has two rows in " << title;
  }
  return keys;
}

/// Keys with dots; an object that the document names as a whole counts as one key.
void add_keys(const json& object, const std::string& prefix, const Keys& documented, Keys& keys) {
  for (const auto& [key, value] : object.items()) {
    if (value.is_object() && !documented.contains(prefix + key))
      add_keys(value, prefix + key + ".", documented, keys);
    else
      keys.insert(prefix + key);
  }
}

Keys keys_of(const json& summary, const std::string& title) {
  Keys keys;
  add_keys(summary, "", documented_keys(title, false), keys);
  return keys;
}

using DocumentedResults = PackedTown;

TEST_F(DocumentedResults, SummaryOfSvfHasTheDocumentedKeysAndNoOthers) {
  const std::string title = "Summary of farlod-svf";
  folder.must("farlod-svf a.farlod -o o.csv --surfaces roofs --spacing 10 --summary s.json");
  EXPECT_EQ(keys_of(folder.json_of("s.json"), title), documented_keys(title, true));
  folder.must(
      "farlod-svf a.farlod -o o.csv --surfaces roofs --spacing 10 --quantity svf_total --bounds --max-error 0.05 --verify 3 "
      "--summary s.json");
  Keys keys = keys_of(folder.json_of("s.json"), title);
  const Keys of_points{"notes", "skipped_features"};
  keys.insert(of_points.begin(), of_points.end());
  folder.must("farlod-svf a.farlod -o o.csv --surfaces roofs --quantity directional --dry-run --summary s.json");
  keys.merge(keys_of(folder.json_of("s.json"), title));
  folder.must(
      "farlod-svf a.farlod -o o.csv --surfaces roofs --spacing 10 --quantity irradiation --period 2026-06-21 --matrix m.npz "
      "--summary s.json");
  keys.merge(keys_of(folder.json_of("s.json"), title));
  EXPECT_EQ(keys, documented_keys(title, false));
#ifdef FARLOD_WITH_GDAL
  folder.write("mixed.geojson", R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "properties": {}, "geometry": {"type": "Point", "coordinates": [9, 49.65]}},
    {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": [[9, 49.65], [9, 49.66]]}}]})");
  folder.must("farlod-svf a.farlod -o o.csv --points mixed.geojson --summary s.json");
  keys = documented_keys(title, true);
  keys.insert(of_points.begin(), of_points.end());
  EXPECT_EQ(keys_of(folder.json_of("s.json"), title), keys);
  EXPECT_EQ(folder.json_of("s.json").at("skipped_features"), 1);
#endif
}

TEST_F(DocumentedResults, SummaryOfPackHasTheDocumentedKeysAndNoOthers) {
  const std::string title = "Summary of farlod-pack";
  folder.must("farlod-pack town.geojson -o b.farlod --summary s.json");
  EXPECT_EQ(keys_of(folder.json_of("s.json"), title), documented_keys(title, true));
  // A tree is no part of the city
  const std::string city =
      R"({"type": "CityJSON", "version": "1.1", "transform": {"scale": [1, 1, 1], "translate": [500000, 5500000, 0]},
    "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/25832"},
    "vertices": [[0, 0, 0], [9, 0, 0], [9, 9, 0], [0, 9, 0], [0, 0, 5], [9, 0, 5], [9, 9, 5], [0, 9, 5]],
    "CityObjects": {"tree": {"type": "SolitaryVegetationObject"}, "house": {"type": "Building", "geometry": [{"type": "Solid", "lod": "1",
    "boundaries": [[[[0, 3, 2, 1]], [[4, 5, 6, 7]], [[0, 1, 5, 4]], [[1, 2, 6, 5]], [[2, 3, 7, 6]], [[3, 0, 4, 7]]]]}]}}})";
  folder.write("house.city.json", city);
  folder.write("ground.asc", "ncols 2\nnrows 2\nxllcorner 499000\nyllcorner 5499000\ncellsize 1000\n0.0 0.0\n0.0 0.0\n");
  // The second time, far maps are added
  for (const std::string area : {"500000,5500000,500001,5500001", "500008,5500008,500009,5500009"})
    folder.must(
        "farlod-pack house.city.json -o c.farlod --max-error 0.05 --cell 4 --terrain ground.asc --summary s.json --area " + area);
  auto keys = keys_of(folder.json_of("s.json"), title);
  folder.must("farlod-pack town.geojson -o d.farlod --shard 0/2 --summary s.json");
  keys.merge(keys_of(folder.json_of("s.json"), title));
  folder.write("trees.csv", street_trees());
  folder.must("farlod-pack town.geojson -o e.farlod --trees trees.csv --summary s.json");
  keys.merge(keys_of(folder.json_of("s.json"), title));
  EXPECT_EQ(keys, documented_keys(title, false));
}

TEST_F(DocumentedResults, FactsOfAPackageHaveTheDocumentedKeysAndNoOthers) {
  const std::string title = "What a package holds";
  const auto keys_said = [&](const std::string& arguments) {
    return keys_of(json::parse(folder.run("farlod-info " + arguments + " --json").out), title);
  };
  Keys keys = documented_keys(title, true);
  EXPECT_GT(keys.size(), 20U);
  const Keys of_horizons{"far_map.azimuth_bins", "far_map.squares_per_edge", "far_map.layers", "far_map.tolerance"};
  const Keys of_boxes{"far_map.side_columns", "far_map.rows"};
  keys.insert(of_horizons.begin(), of_horizons.end());
  EXPECT_EQ(keys_said("a.farlod"), keys);
  folder.must("farlod-pack town.geojson -o box.farlod --far-map box --quiet");
  const std::string cell = json::parse(folder.run("farlod-info a.farlod --json").out).at("grid").at("cells").dump();
  const std::string first = cell.substr(1, cell.find(',', cell.find(',') + 1) - 1);
  keys = keys_said("box.farlod --check --cell " + first);
  keys.insert(of_horizons.begin(), of_horizons.end());
  EXPECT_EQ(keys, documented_keys(title, false));
  folder.must("farlod-info a.farlod --quiet --summary s.json");
  keys = keys_said("a.farlod");
  keys.insert({"seconds.total", "peak_memory_mib", "settings.PACKAGE", "settings.quiet"});
  EXPECT_EQ(keys_of(folder.json_of("s.json"), title), keys);
}

TEST_F(DocumentedResults, FilesSayWhatMadeThemAndNothingOfThreads) {
  const std::string run =
      "farlod-svf a.farlod/ -o p.ply --height 2.25 --engine rays --rays 64 --at " + text_of(p_projected({-60.0, 0.0}));
  folder.must(run + " --threads 1");
  const std::string one = folder.text_of("p.ply");
  EXPECT_THAT(one, testing::HasSubstr(std::string("\ncomment software: Far-LoD ") + software_version + "\n"));
  EXPECT_THAT(one, testing::HasSubstr("\ncomment package: a.farlod\n"));
  EXPECT_THAT(one, testing::HasSubstr(
                       "\ncomment package_manifest_xxh3: " + xxh3_of_file(folder.path("a.farlod") / "manifest.json") + "\n"));
  EXPECT_THAT(one, testing::HasSubstr("\ncomment settings: --height 2.25 --engine rays --sky cosine --rays 64\n"));
  folder.must(run + " --threads 2");
  EXPECT_TRUE(one == folder.text_of("p.ply"));
}

TEST(DocumentedFormats, AreThoseOfTheProgram) {
  static const std::regex row("^\\| (`\\.[^|]+`) \\| ([^|(]+?) (?:\\(needs GDAL\\) )?\\|([^|]+)\\|([^|]+)\\|.*");
  std::vector<std::string> documented, found;
  for (const std::string& line : section("Formats")) {
    std::smatch cells;
    if (!std::regex_match(line, cells, row)) continue;
    const auto is_for = [&](const char* receivers) { return cells[3].str().find(receivers) != std::string::npos; };
    const std::string holds =
        is_for("--preview") ? " picture" : (is_for("--grid") ? " raster" : "") + std::string(is_for("--points") ? " table" : "");
    documented.push_back(cells[1].str() + " " + cells[2].str() + holds + (cells[4] == " none " ? "" : " with bounds"));
  }
  for (const OutputFormat& f : output_formats()) {
    const std::string endings =
        "`" + std::string(f.endings[0]) + "`" + (f.endings[1].empty() ? "" : ", `" + std::string(f.endings[1]) + "`");
    const std::string holds =
        f.is_picture ? " picture" : (f.holds_rasters() ? " raster" : "") + std::string(f.holds_tables() ? " table" : "");
    found.push_back(endings + " " + std::string(f.name) + holds + (f.holds_bounds ? " with bounds" : ""));
  }
#ifdef FARLOD_WITH_GDAL
  EXPECT_EQ(found, documented);
#else
  EXPECT_THAT(documented, testing::IsSupersetOf(found));
#endif
}

/// The words of a text, with one space between any two.
std::string words_of(const std::string& text) {
  std::istringstream stream(text);
  std::string words;
  for (std::string word; stream >> word;) words.append(words.empty() ? "" : " ").append(word);
  return words;
}

TEST(DocumentedFormats, EachHasAParagraph) {
  for (const OutputFormat& f : output_formats()) {
    std::string text;
    for (const std::string& line : section(f.raster_writer == nullptr ? "Tables" : "Rasters and pictures")) text += line + "\n";
    EXPECT_THAT(text, testing::HasSubstr(f.name));
  }
}

TEST(DocumentedFormats, TheReadmeListsThem) {
  const std::string readme = words_of(scenes::text_of(std::filesystem::path(FARLOD_SOURCE_DIR) / "README.md"));
  static const std::regex sentence("`farlod-svf` writes these \\[formats\\]\\([^)]*\\): ([^.]+)\\.");
  std::smatch list;
  ASSERT_TRUE(std::regex_search(readme, list, sentence));
  std::string names;
  for (const OutputFormat& f : output_formats()) names.append(names.empty() ? "" : ", ").append(f.name);
#ifdef FARLOD_WITH_GDAL
  EXPECT_EQ(list[1], names);
#else
  for (const OutputFormat& f : output_formats()) EXPECT_THAT(list[1].str(), testing::HasSubstr(f.name));
#endif
}

/// The columns in the row of a table of the document that begins with `file`.
std::vector<std::string> documented_columns(const std::string& file) {
  std::vector<std::string> columns;
  for (const std::string& line : section("Tables")) {
    if (!line.starts_with("| " + file)) continue;
    const std::size_t begin = line.find('|', 2), end = line.find('|', begin + 1);
    static const std::regex name("`([a-z0-9_]+)`");
    const std::string cell = line.substr(begin, end - begin);
    for (std::sregex_iterator match(cell.begin(), cell.end(), name); match != std::sregex_iterator(); ++match)
      columns.push_back((*match)[1]);
  }
  return columns;
}

/// The columns of a table but the means of further quantities, which the document has as `…_mean`, `…_roofs` and `…_walls`.
std::vector<std::string> without_further_means(std::vector<std::string> columns) {
  std::erase_if(columns, [](const std::string& name) {
    return name.starts_with("irradiation") && (name.ends_with("_mean") || name.ends_with("_roofs") || name.ends_with("_walls"));
  });
  return columns;
}

TEST_F(DocumentedResults, TablesHaveTheDocumentedColumns) {
  folder.must("farlod-svf a.farlod -o s.csv --surfaces roofs --spacing 10");
  folder.must("farlod-svf a.farlod -o p.csv --at " + text_of(p_projected({-60.0, 0.0})));
  EXPECT_EQ(table("p.csv").header(), documented_columns("`--points`"));
  EXPECT_EQ(table("s.csv").header(), documented_columns("`--surfaces`"));
  folder.must(
      "farlod-svf a.farlod -o s.csv --surfaces roofs --spacing 10 --quantity irradiation --period 2026-06-21 "
      "--irradiation-threshold 1");
  std::vector<std::string> of_surfaces = without_further_means(table("s.surfaces.csv").header());
  // Footprints have no ids of surfaces: tests/acceptance/enriched_folder_test.cpp has them
  of_surfaces.emplace_back("surface_id");
  EXPECT_EQ(of_surfaces, documented_columns("`OUT.surfaces.csv`"));
  EXPECT_EQ(without_further_means(table("s.buildings.csv").header()), documented_columns("`OUT.buildings.csv`"));
}

}  // namespace
}  // namespace farlod::acceptance

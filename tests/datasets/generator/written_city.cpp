// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/datasets/generator/written_city.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <vector>

#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using Json = nlohmann::json;

std::int64_t mm(double value_m) { return std::llround(value_m * 1000.0); }

int epsg_in(const std::string& text, const std::string& pattern) {
  std::smatch found;
  return std::regex_search(text, found, std::regex(pattern)) ? std::stoi(found[1]) : 0;
}

/// What lies between two marks, from `at` on, which moves behind the second; empty at the end of the text.
std::string between(const std::string& text, std::size_t& at, const std::string& before, const std::string& after) {
  const std::size_t begin = text.find(before, at);
  if (begin == std::string::npos) return {};
  const std::size_t end = text.find(after, begin + before.size());
  at = end + after.size();
  return text.substr(begin + before.size(), end - begin - before.size());
}

void set_base(WrittenBuilding& building) {
  building.base_mm = building.places.empty() ? 0 : (*building.places.begin())[2];
  std::int64_t top_mm = building.base_mm;
  for (const PlaceMm& p : building.places) building.base_mm = std::min(building.base_mm, p[2]), top_mm = std::max(top_mm, p[2]);
  building.height_mm = top_mm - building.base_mm;
}

}  // namespace

WrittenCity read_cityjson(const std::filesystem::path& path) {
  const Json json = Json::parse(scenes::text_of(path));
  WrittenCity city{epsg_in(json.at("metadata").at("referenceSystem"), "/EPSG/0/(\\d+)$"), {}};
  const Json &scale = json.at("transform").at("scale"), &translate = json.at("transform").at("translate");
  for (const auto& [id, object] : json.at("CityObjects").items()) {
    if (object.at("type") == "Building") {
      WrittenBuilding& building = city.buildings[id];
      building.height_mm = mm(object.at("attributes").at("measuredHeight"));
      for (const Json& child : object.value("children", Json::array())) building.children.insert(child.get<std::string>());
    } else {
      EXPECT_TRUE(city.buildings[object.at("parents").at(0)].said_by_children.insert(id).second);
    }
    WrittenBuilding& building =
        city.buildings[object.at("type") == "Building" ? id : object.at("parents").at(0).get<std::string>()];
    for (const Json& geometry : object.value("geometry", Json::array())) {
      const Json& boundaries = geometry.at("boundaries");
      const Json& shell = geometry.at("type") == "Solid" ? boundaries.at(0) : boundaries;
      building.solids += geometry.at("type") == "Solid" ? 1 : 0;
      building.polygons += shell.size();
      for (const Json& facet : shell)
        for (const Json& ring : facet)
          for (const Json& vertex : ring) {
            const Json& v = json.at("vertices").at(vertex.get<std::size_t>());
            PlaceMm place;
            for (std::size_t k = 0; k < 3; ++k)
              place[k] = mm(v[k].get<double>() * scale[k].get<double>() + translate[k].get<double>());
            building.places.insert(place);
          }
    }
  }
  for (auto& [id, building] : city.buildings) {
    const std::int64_t height_mm = building.height_mm;
    set_base(building);
    building.height_mm = height_mm;
  }
  return city;
}

WrittenCity read_geojson(const std::filesystem::path& path) {
  const Json json = Json::parse(scenes::text_of(path));
  WrittenCity city{epsg_in(json.at("crs").at("properties").at("name"), "EPSG::(\\d+)$"), {}};
  for (const Json& feature : json.at("features")) {
    WrittenBuilding& building = city.buildings[feature.at("properties").at("id")];
    building.base_mm = mm(feature.at("properties").at("base"));
    building.height_mm = mm(feature.at("properties").at("height"));
    for (const Json& ring : feature.at("geometry").at("coordinates"))
      for (const Json& p : ring) building.places.insert({mm(p.at(0)), mm(p.at(1)), 0});
  }
  return city;
}

WrittenCity read_obj(const std::filesystem::path& path) {
  const std::string text = scenes::text_of(path);
  WrittenCity city{epsg_in(text, "# CRS: EPSG:(\\d+)\n"), {}};
  std::vector<PlaceMm> vertices;
  WrittenBuilding* building = nullptr;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "g") words >> word, building = &city.buildings[word];
    double x, y, z;
    if (word == "v" && words >> x >> y >> z) vertices.push_back({mm(x), mm(y), mm(z)});
    if (word != "f") continue;
    ++building->polygons;
    for (std::size_t k; words >> k;) building->places.insert(vertices.at(k - 1));
  }
  for (auto& [id, b] : city.buildings) set_base(b);
  return city;
}

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + word.size())) ++count;
  return count;
}

WrittenCity read_citygml(const std::filesystem::path& path) {
  const std::string text = scenes::text_of(path);
  WrittenCity city{epsg_in(text, "srsName=\"urn:ogc:def:crs:EPSG::(\\d+)\""), {}};
  std::size_t at = 0;
  for (std::string one; !(one = between(text, at, "<bldg:Building gml:id=\"", "</bldg:Building>")).empty();) {
    WrittenBuilding& building = city.buildings[one.substr(0, one.find('"'))];
    std::size_t ring_at = 0;
    for (std::string list; !(list = between(one, ring_at, "<gml:posList>", "</gml:posList>")).empty();) {
      std::istringstream numbers(list);
      for (double x, y, z; numbers >> x >> y >> z;) building.places.insert({mm(x), mm(y), mm(z)});
    }
    building.polygons = count_of(one, "<gml:Polygon");
    building.solids = count_of(one, "<gml:Solid>");
    for (const char* element : {"<bldg:BuildingPart gml:id=\"", "<bldg:BuildingInstallation gml:id=\""}) {
      std::size_t child_at = 0;
      for (std::string id; !(id = between(one, child_at, element, "\"")).empty();) building.children.insert(id);
    }
    building.said_by_children = building.children;
    set_base(building);
    std::size_t height_at = 0;
    building.height_mm = mm(std::stod(between(one, height_at, "<bldg:measuredHeight uom=\"m\">", "<")));
  }
  return city;
}

}  // namespace farlod

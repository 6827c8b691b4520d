// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/acceptance/small_town.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/frame.hpp"
#include "tests/acceptance/work_folder.hpp"
#include "tests/scenes/packed_once.hpp"

namespace farlod::acceptance {
namespace {

using Json = nlohmann::ordered_json;

double whole_millimetres(double x) { return std::round(1000.0 * x) / 1000.0; }

Json corner(Point2d p_town) {
  const Point2d p = p_projected(p_town);
  return {whole_millimetres(p.x), whole_millimetres(p.y)};
}

Json feature(const Block& b) {
  const double h = 0.5 * b.edge_m;
  Json ring = Json::array();
  for (const Point2d d : {Point2d{-h, -h}, {h, -h}, {h, h}, {-h, h}, {-h, -h}}) ring.push_back(corner(b.centre + d));
  Json polygon = {{"type", "Polygon"}, {"coordinates", Json::array({ring})}};
  return {{"type", "Feature"}, {"properties", {{"id", b.id}, {"height", b.height_m}, {"floors", 3}}}, {"geometry", polygon}};
}

}  // namespace

std::vector<Block> small_town() {
  std::vector<Block> town;
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 6; ++i) {
      const bool is_tower = i == 2 && j == 3;
      const double height_m = is_tower ? tower_height_m : 8.0 + 3.0 * ((7 * i + 3 * j) % 5);
      const Point2d centre{-150.0 + town_pitch_m * i, -150.0 + town_pitch_m * j};
      town.push_back({"block" + std::to_string(i) + std::to_string(j), centre, town_edge_m, height_m});
    }
  return town;
}

Block tower_of(const std::vector<Block>& town) {
  return *std::max_element(town.begin(), town.end(), [](const Block& a, const Block& b) { return a.height_m < b.height_m; });
}

Point2d p_projected(Point2d p_town) { return town_middle + GridRotation(town_bearing).city_from_grid(p_town); }

std::string text_of(Point2d p) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.3f,%.3f", p.x, p.y);
  return text.data();
}

std::string text_of(const Point3d& p) {
  std::array<char, 32> height{};
  std::snprintf(height.data(), height.size(), ",%.3f", p.z);
  return text_of(horizontal(p)) + height.data();
}

std::string footprints_geojson(const std::vector<Block>& blocks) {
  Json city = {{"type", "FeatureCollection"},
               {"crs", {{"type", "name"}, {"properties", {{"name", town_crs}}}}},
               {"features", Json::array()}};
  for (const Block& b : blocks) city["features"].push_back(feature(b));
  return city.dump(1);
}

std::string ascii_grid(const std::function<double(Point2d)>& height_m, double step_m, double half_m, Point2d middle) {
  const int nodes = 1 + static_cast<int>(std::lround(2.0 * half_m / step_m));
  std::ostringstream text;
  text.precision(12);
  const Point2d corner = middle - (half_m + 0.5 * step_m) * Point2d{1.0, 1.0};
  text << "ncols " << nodes << "\nnrows " << nodes << "\nxllcorner " << corner.x << "\nyllcorner " << corner.y << "\ncellsize "
       << step_m << "\nNODATA_value -9999\n";
  for (int row = 0; row < nodes; ++row) {
    for (int column = 0; column < nodes; ++column) text << height_m({-half_m + column * step_m, half_m - row * step_m}) << ' ';
    text << '\n';
  }
  return text.str();
}

std::string box_obj() {
  std::string text = "g box\n";
  for (const double z : {0.0, 10.0})
    for (const Point2d d : {Point2d{0.0, 0.0}, {20.0, 0.0}, {20.0, 20.0}, {0.0, 20.0}}) {
      const Point2d p = town_middle + d;
      std::array<char, 96> line{};
      std::snprintf(line.data(), line.size(), "v %.3f %.3f %.3f\n", p.x, p.y, z);
      text += line.data();
    }
  return text + "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
}

void add_packed_town(const WorkFolder& folder, const std::string& name, const std::vector<Block>& blocks,
                     const std::string& settings) {
  const std::string town = footprints_geojson(blocks), command = "farlod-pack town.geojson -o a.farlod " + settings;
  folder.write("town.geojson", town);
  const scenes::PackedFrom from{name, town + command, std::filesystem::path(FARLOD_BIN_DIR) / "farlod-pack"};
  const std::filesystem::path packed = scenes::packed_once(from, [&](const std::filesystem::path& into) {
    const WorkFolder other;
    other.write("town.geojson", town);
    other.must(command);
    if (!other.has("a.farlod")) return false;
    std::filesystem::copy(other.path("a.farlod"), into, std::filesystem::copy_options::recursive);
    return true;
  });
  std::filesystem::copy(packed, folder.path("a.farlod"), std::filesystem::copy_options::recursive);
}

}  // namespace farlod::acceptance

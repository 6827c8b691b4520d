// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/package_facts.hpp"
#include "console/run_program.hpp"

namespace farlod {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const CellRectangle& c) { return {c.i_begin, c.j_begin, c.i_end, c.j_end}; }
Json json_of(CellPlace c) { return {c.i, c.j}; }
Json number_or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json crs_json(const PackageDescription& d) {
  return {{"name", d.crs_name}, {"epsg", d.epsg ? Json(*d.epsg) : Json(nullptr)}, {"wkt", d.crs_wkt}};
}

Json grid_json(const PackageFacts& facts) {
  const PackageDescription& d = facts.description;
  const PackageInventory& i = facts.inventory;
  return {{"bearing_deg", d.grid_bearing.degrees()},
          {"true_bearing_deg", (d.grid_bearing + d.convergence).degrees()},
          {"convergence_deg", d.convergence.degrees()},
          {"origin_m", {i.origin_m.x, i.origin_m.y}},
          {"height_origin_m", i.height_origin_m},
          {"cell_m", d.cell_edge_m},
          {"neighborhood", d.neighborhood},
          {"cells", json_of(i.cells)},
          {"cell_count", d.columns * d.rows},
          {"block_edge", i.block_edge},
          {"block_count", i.blocks}};
}

Json far_map_json(const PackageFacts& facts) {
  const PackageInventory& i = facts.inventory;
  Json json = {{"kind", facts.description.far_map_kind}, {"cells", facts.description.cells_with_far_map}};
  if (i.azimuth_bins > 0) {
    json["azimuth_bins"] = i.azimuth_bins;
    json["squares_per_edge"] = i.squares_per_edge;
    json["layers"] = i.layers;
    json["tolerance"] = i.tolerance;
  } else {
    json["side_columns"] = i.side_columns;
    json["rows"] = i.rows;
  }
  return json;
}

Json inputs_json(const PackageInventory& inventory) {
  Json inputs = Json::array();
  for (const PackedInput& input : inventory.inputs)
    inputs.push_back({{"name", input.name}, {"bytes", input.bytes}, {"xxh3", fmt::format("{:016x}", input.xxh3)}});
  return inputs;
}

Json problems_json(const PackageInventory& inventory) {
  Json problems = Json::object();
  for (const auto& [code, count] : inventory.problems) problems[std::to_string(code)] = count;
  return problems;
}

Json crowns_json(const PackedCrowns& c) {
  return {{"count", c.all()}, {"spheroids", c.spheroids}, {"cylinders", c.cylinders}, {"prisms", c.prisms}, {"bytes", c.bytes}};
}

Json check_json(const PackageCheck& check) {
  Json damage = Json::array();
  for (const PackageDamage& d : check.damage)
    damage.push_back({{"file", d.file}, {"cell", d.cell ? json_of(*d.cell) : Json(nullptr)}, {"what", d.what}});
  Json json = {{"files", check.files}, {"bytes", check.bytes}, {"tiles", check.cells}, {"far_maps", check.far_maps}};
  json["crowns"] = check.crowns;
  json["damage"] = damage;
  return json;
}

Json cell_json(const CellContents& c) {
  Json corners = Json::array(), near = Json::array();
  for (const Point2d p : c.corners_projected) corners.push_back({p.x, p.y});
  for (const NeighborCell& n : c.near_cells) near.push_back({{"cell", json_of(n.cell)}, {"triangles", n.triangles}});
  return {{"cell", json_of(c.cell)},
          {"corners", corners},
          {"triangles", c.triangles},
          {"vertices", c.vertices},
          {"buildings", c.buildings},
          {"edges", {{"grounded", c.grounded_edges}, {"overhang", c.overhang_edges}, {"underside", c.underside_edges}}},
          {"low_m", number_or_null(c.low_m)},
          {"high_m", number_or_null(c.high_m)},
          {"tile_bytes", c.tile_bytes},
          {"far_map_bytes", c.has_far_map ? Json(c.far_map_bytes) : Json(nullptr)},
          {"explicit_edges", c.explicit_edges},
          {"neighborhood", json_of(c.neighborhood)},
          {"near", near}};
}

Json json_of(const PackageFacts& facts) {
  const PackageDescription& d = facts.description;
  const PackageInventory& i = facts.inventory;
  const auto json_of_box = [](const Box2d& b) { return Json{b.low.x, b.low.y, b.high.x, b.high.y}; };
  Json json = {{"format_version", i.format_version},
               {"software", d.software},
               {"crs", crs_json(d)},
               {"extent_m", json_of_box(d.outline_projected)},
               {"city_m", json_of_box(d.city_projected)},
               {"buildings_m", d.buildings_projected ? json_of_box(*d.buildings_projected) : Json(nullptr)},
               {"grid", grid_json(facts)},
               {"buildings", d.buildings},
               {"polygons", d.polygons},
               {"triangles", d.triangles},
               {"assign", i.assign},
               {"far_map", far_map_json(facts)},
               {"tile_bytes", i.tile_bytes},
               {"far_map_bytes", i.far_map_bytes},
               {"crowns", crowns_json(i.crowns)},
               {"inputs", inputs_json(i)},
               {"problems", problems_json(i)}};
  if (facts.check) json["check"] = check_json(*facts.check);
  if (facts.cell) json["cell"] = cell_json(*facts.cell);
  return json;
}

}  // namespace

std::string facts_json(const PackageFacts& facts) { return json_of(facts).dump(1) + "\n"; }

std::string info_summary_json(const PackageFacts& facts, double total_seconds, const std::string& settings_json) {
  Json json = json_of(facts);
  json["seconds"] = {{"total", total_seconds}};
  json["peak_memory_mib"] = peak_memory_mib();
  json["settings"] = Json::parse(settings_json);
  return json.dump(1) + "\n";
}

}  // namespace farlod

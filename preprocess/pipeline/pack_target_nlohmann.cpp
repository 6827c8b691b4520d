// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "pipeline/pack_target.hpp"

namespace farlod::pipeline {
namespace {

using Json = nlohmann::ordered_json;

// A value of a record is written and read by two functions side by side. Numbers come back to the bit.

Json json_of(const Grid& g) {
  const CellRange& c = g.cells;
  return {g.rotation.bearing().radians(), g.cell_edge_m, g.neighborhood, g.block_edge, c.i_begin, c.j_begin, c.i_end, c.j_end};
}
Grid grid_from(const Json& j) {
  Grid grid;
  grid.rotation = GridRotation(Angle::radians(j.at(0)));
  j.at(1).get_to(grid.cell_edge_m);
  j.at(2).get_to(grid.neighborhood);
  j.at(3).get_to(grid.block_edge);
  grid.cells = {j.at(4), j.at(5), j.at(6), j.at(7)};
  return grid;
}

Json json_of(const package::FarMapShape& s) {
  return {s.kind, s.side_columns, s.rows, s.azimuth_bins, s.squares_per_edge, s.layers, s.tolerance};
}
package::FarMapShape shape_from(const Json& j) { return {j.at(0), j.at(1), j.at(2), j.at(3), j.at(4), j.at(5), j.at(6)}; }

Json json_of(const package::CanopyFile& c) { return {c.stamp.bytes, c.stamp.xxh3, c.crowns_of_shape}; }
package::CanopyFile canopy_from(const Json& j) {
  package::CanopyFile canopy{{j.at(0), j.at(1)}, {}};
  j.at(2).get_to(canopy.crowns_of_shape);
  return canopy;
}

Json json_of(const std::optional<package::FileStamp>& stamp) { return stamp ? Json{stamp->bytes, stamp->xxh3} : Json(); }
std::optional<package::FileStamp> stamp_from(const Json& j) {
  return j.is_null() ? std::nullopt : std::optional(package::FileStamp{j.at(0), j.at(1)});
}

Json json_of(const package::SurfacePixels& p) {
  const auto count = [](const std::optional<std::uint64_t>& n) { return n ? Json(*n) : Json(); };
  return {p.north_west_m.x, p.north_west_m.y, p.step_m, p.columns, p.rows, json_of(p.heights), count(p.walls), count(p.squares)};
}
package::SurfacePixels pixels_from(const Json& j) {
  package::SurfacePixels pixels{{j.at(0), j.at(1)}, j.at(2), j.at(3), j.at(4), stamp_from(j.at(5)), {}};
  if (!j.at(6).is_null()) pixels.walls = j.at(6).get<std::uint64_t>();
  if (!j.at(7).is_null()) pixels.squares = j.at(7).get<std::uint64_t>();
  return pixels;
}

Json json_of(const Box2d& box) { return {box.low.x, box.low.y, box.high.x, box.high.y}; }
Box2d box_from(const Json& j) { return {{j.at(0), j.at(1)}, {j.at(2), j.at(3)}}; }

Json json_of(const package::Manifest& m) {
  Json inputs = Json::array();
  for (const package::InputFile& i : m.inputs) inputs.push_back({i.name, i.stamp.bytes, i.stamp.xxh3});
  return {{"software", m.software},
          {"crs", {m.crs_wkt, m.crs_name, m.epsg ? Json(*m.epsg) : Json()}},
          {"origin", {m.origin_m.x, m.origin_m.y, m.height_origin_m}},
          {"convergence", m.convergence.radians()},
          {"grid", json_of(m.grid)},
          {"assign", m.assign},
          {"far_map", json_of(m.far_map)},
          {"inputs", inputs},
          {"counts", {m.buildings, m.polygons, m.triangles}},
          {"buildings_box", m.buildings_projected ? json_of(*m.buildings_projected) : Json()},
          {"problems", m.problem_counts},
          {"canopy", m.canopy ? json_of(*m.canopy) : Json()},
          {"sources", json_of(m.sources)},
          {"far_terrain", json_of(m.far_terrain)},
          {"pixels", m.pixels ? json_of(*m.pixels) : Json()}};
}
package::Manifest manifest_from(const Json& j) {
  package::Manifest m;
  m.software = j.at("software");
  const Json &crs = j.at("crs"), &origin = j.at("origin"), &counts = j.at("counts");
  m.crs_wkt = crs.at(0);
  m.crs_name = crs.at(1);
  if (!crs.at(2).is_null()) m.epsg = crs.at(2).get<int>();
  m.origin_m = {origin.at(0), origin.at(1)};
  m.height_origin_m = origin.at(2);
  m.convergence = Angle::radians(j.at("convergence"));
  m.grid = grid_from(j.at("grid"));
  m.assign = j.at("assign");
  m.far_map = shape_from(j.at("far_map"));
  for (const Json& i : j.at("inputs")) m.inputs.push_back({i.at(0), {i.at(1), i.at(2)}});
  m.buildings = counts.at(0);
  m.polygons = counts.at(1);
  m.triangles = counts.at(2);
  if (const Json& box = j.at("buildings_box"); !box.is_null()) m.buildings_projected = box_from(box);
  j.at("problems").get_to(m.problem_counts);
  if (const Json& canopy = j.at("canopy"); !canopy.is_null()) m.canopy = canopy_from(canopy);
  m.sources = stamp_from(j.at("sources"));
  m.far_terrain = stamp_from(j.at("far_terrain"));
  if (const Json& pixels = j.at("pixels"); !pixels.is_null()) m.pixels = pixels_from(pixels);
  return m;
}

Json json_of(const FarErrorEstimate& e) {
  return {e.receivers, e.mean_error, e.max_error, e.p99_half_width, e.explicit_edges_per_cell, e.near_triangles_per_cell};
}
FarErrorEstimate error_from(const Json& j) { return {j.at(0), j.at(1), j.at(2), j.at(3), j.at(4), j.at(5)}; }

Json json_of(const ChosenGrid& c) {
  Json best;
  if (c.best)
    best = {c.best->cell_edge_m, c.best->neighborhood, c.best->tolerance, json_of(c.best->far_error), c.best->receiver_us};
  return {{"best", best}, {"measured", json_of(c.measured)}};
}
ChosenGrid chosen_from(const Json& j) {
  const Json& best = j.at("best");
  ChosenGrid chosen{{}, error_from(j.at("measured"))};
  if (!best.is_null()) chosen.best = GridChoice{best.at(0), best.at(1), best.at(2), error_from(best.at(3)), best.at(4)};
  return chosen;
}

Json json_of(const PackEstimate& e) { return {e.cells, e.far_maps, e.seconds, e.memory_mib, e.package_mib, e.least_memory_mib}; }
PackEstimate estimate_from(const Json& j) { return {j.at(0), j.at(1), j.at(2), j.at(3), j.at(4), j.at(5)}; }

Json json_of(const CityLooks::Heights& h) { return {h.least_m, h.median_m, h.tallest_m}; }
CityLooks::Heights heights_from(const Json& j) { return {j.at(0), j.at(1), j.at(2)}; }

Json json_of(const CityLooks& l) {
  Json j = {{"country", l.country}};
  if (l.lon_lat_deg) j["lon_lat"] = {l.lon_lat_deg->x, l.lon_lat_deg->y};
  if (l.heights) j["heights"] = json_of(*l.heights);
  if (l.ground) j["ground"] = {l.ground->low_m, l.ground->high_m, l.ground->source};
  if (l.ground && l.ground->feet)
    j["feet"] = {json_of(l.ground->feet->above_m), l.ground->feet->lowest_id, l.ground->feet->highest_id};
  return j;
}
CityLooks looks_from(const Json& j) {
  CityLooks looks;
  looks.country = j.at("country");
  if (const auto p = j.find("lon_lat"); p != j.end()) looks.lon_lat_deg = Point2d{p->at(0), p->at(1)};
  if (const auto h = j.find("heights"); h != j.end()) looks.heights = heights_from(*h);
  if (const auto g = j.find("ground"); g != j.end())
    looks.ground = CityLooks::Ground{g->at(0), g->at(1), g->at(2).get<GroundSource>()};
  if (const auto f = j.find("feet"); f != j.end() && looks.ground)
    looks.ground->feet = CityLooks::Feet{heights_from(f->at(0)), f->at(1), f->at(2)};
  return looks;
}

Json json_of(const PackedCity& r) {
  return {{"manifest", json_of(r.manifest)},
          {"looks", json_of(r.looks)},
          {"streets", {r.street_bearing.radians(), r.alignment_strength}},
          {"chosen", r.chosen ? json_of(*r.chosen) : Json()},
          {"facets", r.facets},
          {"foundations", r.foundations},
          {"crowns", {r.crowns.of_trees, r.crowns.of_canopy}},
          {"skipped", r.skipped},
          {"notes", r.notes},
          {"estimate", json_of(r.estimate)}};
}
PackedCity result_from(const Json& j) {
  PackedCity r;
  r.manifest = manifest_from(j.at("manifest"));
  r.looks = looks_from(j.at("looks"));
  r.street_bearing = Angle::radians(j.at("streets").at(0));
  r.alignment_strength = j.at("streets").at(1);
  if (!j.at("chosen").is_null()) r.chosen = chosen_from(j.at("chosen"));
  r.facets = j.at("facets");
  r.foundations = j.at("foundations");
  r.crowns = {j.at("crowns").at(0), j.at("crowns").at(1)};
  j.at("skipped").get_to(r.skipped);
  j.at("notes").get_to(r.notes);
  r.estimate = estimate_from(j.at("estimate"));
  return r;
}

Json json_of(const BlockPlan& plan) {
  Json blocks = Json::array();
  for (const PlannedBlock& b : plan.blocks) {
    // As a finished block is noted down
    const auto text = [](const package::BlockFiles& files) { return farlod::record_text(files); };
    blocks.push_back({text({b.block, {}, {}, b.mapped}), b.kept ? Json(text(*b.kept)) : Json()});
  }
  return {{"blocks", blocks}, {"far_maps", plan.far_maps}, {"outside", plan.shapes_outside_of_grid}};
}
BlockPlan plan_from(const Json& j) {
  BlockPlan plan{{}, j.at("far_maps"), j.at("outside")};
  for (const Json& b : j.at("blocks")) {
    std::optional<package::BlockFiles> files = block_files_from(b.at(0));
    PlannedBlock& planned = plan.blocks.emplace_back();
    planned.block = files.value().block;
    planned.mapped = std::move(files->mapped);
    if (!b.at(1).is_null()) planned.kept = block_files_from(b.at(1));
  }
  return plan;
}

Json json_of(const Problem& p) {
  Json position, lon_lat;
  if (p.position) position = {p.position->x, p.position->y, p.position->z};
  if (p.lon_lat_deg) lon_lat = {p.lon_lat_deg->x, p.lon_lat_deg->y};
  return {static_cast<int>(p.code), p.source, p.place, p.detail, position, lon_lat, p.ring};
}
Problem problem_from(const Json& j) {
  Problem p{static_cast<ProblemCode>(j.at(0).get<int>()), j.at(1), j.at(2), j.at(3)};
  if (const Json& at = j.at(4); !at.is_null()) p.position = Point3d{at.at(0), at.at(1), at.at(2)};
  if (const Json& at = j.at(5); !at.is_null()) p.lon_lat_deg = Point2d{at.at(0), at.at(1)};
  p.ring = j.at(6);
  return p;
}

}  // namespace

std::string record_text(const CityRecord& record) {
  Json problems = Json::array();
  for (const Problem& problem : record.problems) problems.push_back(json_of(problem));
  const PackMemory& m = record.memory;
  const Json j = {{"result", json_of(record.result)},
                  {"memory", {m.always_mib, m.block_mib, m.on_disk_mib}},
                  {"plan", json_of(record.plan)},
                  {"costs", record.costs},
                  {"problems", problems}};
  return j.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::optional<CityRecord> city_record_from(const std::string& text) {
  try {
    const Json j = Json::parse(text);
    const Json& memory = j.at("memory");
    CityRecord record{result_from(j.at("result")), {memory.at(0), memory.at(1), memory.at(2)}, plan_from(j.at("plan")), {}, {}};
    j.at("costs").get_to(record.costs);
    for (const Json& problem : j.at("problems")) record.problems.push_back(problem_from(problem));
    return record;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  } catch (const std::bad_optional_access&) {
    return std::nullopt;
  }
}

}  // namespace farlod::pipeline

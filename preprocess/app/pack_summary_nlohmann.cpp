// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "app/pack_options.hpp"
#include "console/run_program.hpp"

namespace farlod {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& j) { return j.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; }

Json json_of(const FarErrorEstimate& v) {
  return {
      {"receivers", v.receivers}, {"mean_error", v.mean_error}, {"max_error", v.max_error}, {"p99_half_width", v.p99_half_width}};
}

Json json_of(const ChosenGrid& chosen) {
  Json j = {{"keeps_error", chosen.best.has_value()}};
  if (chosen.best) {
    j["tolerance"] = chosen.best->tolerance;
    j["expected"] = json_of(chosen.best->far_error);
  }
  j["measured"] = json_of(chosen.measured);
  return j;
}

Json json_of(const std::optional<Point2d>& lon_lat_deg) {
  return lon_lat_deg ? Json::array({lon_lat_deg->x, lon_lat_deg->y}) : Json();
}

Json json_of(const Problem& p) {
  const ProblemDescription& d = describe(p.code);
  return {{"code", static_cast<int>(p.code)},
          {"problem", d.slug},
          {"effect", name_of(d.effect)},
          {"source", p.source},
          {"place", p.place},
          {"ring", p.ring.empty() ? Json() : Json(p.ring)},
          {"position", p.position ? Json::array({p.position->x, p.position->y, p.position->z}) : Json()},
          {"lon_lat", json_of(p.lon_lat_deg)},
          {"detail", p.detail}};
}

Json point_of(const std::optional<Point2d>& lon_lat_deg) {
  if (!lon_lat_deg) return nullptr;
  return {{"type", "Point"}, {"coordinates", json_of(lon_lat_deg)}};
}

Json seconds_of(const PackResult& result, double total_seconds) {
  Json seconds = {{"total", total_seconds}};
  for (const auto& [stage, value] : result.stage_seconds) seconds[stage] = value;
  return seconds;
}

Json json_of(const PackEstimate& estimate) {
  return {{"seconds", estimate.seconds},
          {"memory_mib", estimate.memory_mib},
          {"least_memory_mib", estimate.least_memory_mib},
          {"package_mib", estimate.package_mib}};
}

Json json_of(const CityLooks& l) {
  Json j = Json::object();
  if (l.lon_lat_deg) {
    j["latitude"] = l.lon_lat_deg->y;
    j["longitude"] = l.lon_lat_deg->x;
  }
  if (!l.country.empty()) j["country"] = l.country;
  if (l.heights)
    j["heights_m"] = {{"least", l.heights->least_m}, {"median", l.heights->median_m}, {"tallest", l.heights->tallest_m}};
  if (l.ground) j["ground_m"] = {{"low", l.ground->low_m}, {"high", l.ground->high_m}, {"from", name_of(l.ground->source)}};
  if (l.ground && l.ground->feet) {
    const auto& [above_m, lowest_id, highest_id] = *l.ground->feet;
    j["ground_m"]["buildings_above"] = {above_m.least_m, above_m.median_m, above_m.tallest_m};
    j["ground_m"]["lowest_and_highest_building"] = {lowest_id, highest_id};
  }
  return j;
}

}  // namespace

std::string_view name_of(GroundSource source) {
  switch (source) {
    case GroundSource::terrain:
      return "terrain";
    case GroundSource::relief:
      return "relief";
    case GroundSource::bases:
      return "bases of buildings";
    case GroundSource::surface:
      return "surface model";
    case GroundSource::nothing:
      break;
  }
  return "nothing";
}

std::size_t buildings_left_out(const Report& report) {
  std::size_t count = 0;
  for (const ProblemCode code :
       {ProblemCode::no_height, ProblemCode::height_not_positive, ProblemCode::no_geometry, ProblemCode::absurd_height})
    count += report.count(code);
  return count;
}

std::string pack_summary_json(const PackResult& result, const Report& report, double total_seconds,
                              const std::string& settings_json) {
  const PackageDescription& m = result.package;
  Json j = {{"buildings", m.buildings},
            {"polygons", m.polygons},
            {"facets", result.facets},
            {"triangles", m.triangles},
            {"problems", report.problems().size()},
            {"foundations", result.foundations},
            {"crowns", {{"of_trees", result.crowns.of_trees}, {"of_canopy", result.crowns.of_canopy}}},
            {"cells", m.columns * m.rows},
            {"cells_with_far_map", m.cells_with_far_map},
            {"grid_rotation_deg", m.grid_bearing.degrees()},
            {"alignment_strength", result.alignment_strength},
            {"cell_m", m.cell_edge_m},
            {"neighborhood", m.neighborhood},
            {"seconds", seconds_of(result, total_seconds)},
            {"peak_memory_mib", peak_memory_mib()},
            {"package_bytes", result.package_bytes},
            {"far_map_bytes", result.far_map_bytes},
            {"estimate", json_of(result.estimate)}};
  j.update(Json{{"blocks", result.blocks}, {"blocks_finished_before", result.blocks_found}});
  j.update(Json{{"buildings_left_out", buildings_left_out(report)}, {"looks", json_of(result.looks)}, {"notes", result.notes}});
  if (!result.skipped.empty()) j["skipped"] = result.skipped;
  if (result.chosen) j["chosen"] = json_of(*result.chosen);
  j["settings"] = Json::parse(settings_json);
  return text_of(j);
}

std::string report_json(const Report& report) {
  Json entries = Json::array();
  for (const Problem& p : report.problems()) entries.push_back(json_of(p));
  return text_of(entries);
}

std::string report_geojson(const Report& report) {
  Json features = Json::array();
  for (const Problem& p : report.problems())
    features.push_back({{"type", "Feature"}, {"geometry", point_of(p.lon_lat_deg)}, {"properties", json_of(p)}});
  return text_of({{"type", "FeatureCollection"}, {"features", features}});
}

}  // namespace farlod

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "app/pack_summary.hpp"
#include "console/peak_memory.hpp"

namespace farlod {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& j) { return j.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace

std::string pack_summary_json(const PackResult& result, const Report& report, double total_seconds) {
  const package::Manifest& m = result.manifest;
  Json seconds = {{"total", total_seconds}};
  for (const auto& [stage, value] : result.stage_seconds) seconds[stage] = value;
  return text_of({{"buildings", m.buildings},
                  {"polygons", m.polygons},
                  {"facets", result.facets},
                  {"triangles", m.triangles},
                  {"problems", report.problems().size()},
                  {"cells", m.grid.cells.size()},
                  {"grid_rotation_deg", m.grid.rotation.bearing().degrees()},
                  {"alignment_strength", result.alignment.strength},
                  {"cell_m", m.grid.cell_edge_m},
                  {"neighborhood", m.grid.neighborhood},
                  {"seconds", seconds},
                  {"peak_memory_mib", peak_memory_mib()},
                  {"package_bytes", result.package_bytes},
                  {"far_map_bytes", result.far_map_bytes}});
}

std::string report_json(const Report& report) {
  Json entries = Json::array();
  for (const Problem& p : report.problems()) {
    const ProblemDescription& d = describe(p.code);
    entries.push_back({{"code", static_cast<int>(p.code)},
                       {"problem", d.slug},
                       {"effect", name_of(d.effect)},
                       {"source", p.source},
                       {"place", p.place},
                       {"detail", p.detail}});
  }
  return text_of(entries);
}

}  // namespace farlod

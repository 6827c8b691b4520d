// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "base/expects.hpp"
#include "package/file_stamp.hpp"
#include "package/layout.hpp"
#include "package/manifest.hpp"

namespace farlod {
namespace {

using Json = nlohmann::ordered_json;
using package::Manifest;

Json json_of(const package::FileStamp& stamp) {
  // A checksum is 64 bits; numbers in JSON are safe to 53
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(stamp.xxh3));
  return {{"bytes", stamp.bytes}, {"xxh3", digits.data()}};
}

Json json_of(const package::FarMapShape& shape) {
  if (shape.is_box()) return {{"kind", shape.kind}, {"side_columns", shape.side_columns}, {"rows", shape.rows}};
  return {{"kind", shape.kind},
          {"azimuth_bins", shape.azimuth_bins},
          {"squares_per_edge", shape.squares_per_edge},
          {"layers", shape.layers},
          {"tolerance", shape.tolerance}};
}

Json place_of(const Manifest& m) {
  Json j;
  j["crs"] = {{"name", m.crs_name}, {"epsg", m.epsg ? Json(*m.epsg) : Json(nullptr)}, {"wkt", m.crs_wkt}};
  j["frame"] = {{"origin_m", {m.origin_m.x, m.origin_m.y}},
                {"height_origin_m", m.height_origin_m},
                {"grid_rotation_deg", m.grid.rotation.bearing().degrees()},
                {"convergence_deg", m.convergence.degrees()}};
  const CellRange& c = m.grid.cells;
  j["grid"] = {{"cell_m", m.grid.cell_edge_m},
               {"neighborhood", m.grid.neighborhood},
               {"block_edge", m.grid.block_edge},
               {"cells", {c.i_begin, c.j_begin, c.i_end, c.j_end}}};
  return j;
}

Json json_of(const package::BlockFiles& b) {
  Json j = {{"i", b.block.i}, {"j", b.block.j}, {"tiles", json_of(b.tiles)}};
  j["far_map"] = b.has_far_maps() ? json_of(b.far_map) : Json(nullptr);
  if (!b.mapped) return j;
  j["cells_with_far_map"] = Json::array();
  for (const package::CellRun& run : b.mapped->runs) j["cells_with_far_map"].push_back({run.begin, run.end});
  return j;
}

Json json_of(const package::CanopyFile& canopy) {
  Json j = json_of(canopy.stamp);
  for (std::size_t n = 0; n < crown_shape_count; ++n) j[package::crown_shape_keys[n]] = canopy.crowns_of_shape[n];
  return j;
}

Json inputs_of(const Manifest& m) {
  Json inputs = Json::array();
  for (const package::InputFile& input : m.inputs) {
    Json j = {{"name", input.name}};
    j.update(json_of(input.stamp));
    inputs.push_back(std::move(j));
  }
  return inputs;
}

/// Puts a checksum of the text before it into the place of the last brace.
std::string sealed(std::string text) {
  constexpr std::string_view brace = "\n}";
  FARLOD_EXPECTS(text.ends_with(brace));
  text.replace(text.size() - brace.size(), brace.size(), ",\n ");
  text += package::ManifestSeal::text_of(stamp_of(std::as_bytes(std::span(text))).xxh3);
  return text;
}

}  // namespace

std::string manifest_text(const Manifest& m) {
  Json j = {{"format", "farlod-package"}, {"version", package::version_of(m)}, {"software", m.software}};
  j.update(place_of(m));
  j["settings"] = {{"assign", m.assign}, {"far_map", json_of(m.far_map)}};
  j["inputs"] = inputs_of(m);
  j["counts"] = {{"buildings", m.buildings}, {"polygons", m.polygons}, {"triangles", m.triangles}};
  if (const auto& box = m.buildings_projected) j["buildings_box_m"] = {box->low.x, box->low.y, box->high.x, box->high.y};
  j["problems"] = Json::object();
  for (const auto& [code, count] : m.problem_counts) j["problems"][std::to_string(code)] = count;
  j["blocks"] = Json::array();
  for (const package::BlockFiles& b : m.blocks) j["blocks"].push_back(json_of(b));
  if (m.pixels)
    j["pixels"] = {{"north_west_m", {m.pixels->north_west_m.x, m.pixels->north_west_m.y}},
                   {"step_m", m.pixels->step_m},
                   {"columns", m.pixels->columns},
                   {"rows", m.pixels->rows}};
  if (m.pixels && m.pixels->heights) j["pixels"]["heights"] = json_of(*m.pixels->heights);
  if (m.pixels && m.pixels->walls) j["pixels"]["walls"] = *m.pixels->walls;
  if (m.pixels && m.pixels->squares) j["pixels"]["squares"] = *m.pixels->squares;
  if (m.canopy) j["canopy"] = json_of(*m.canopy);
  if (m.sources) j["sources"] = json_of(*m.sources);
  if (m.far_terrain) j["far_terrain"] = json_of(*m.far_terrain);
  // An id or a name with broken UTF-8 must not end the run
  return sealed(j.dump(1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace farlod

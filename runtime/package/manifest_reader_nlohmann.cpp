// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>

#include "farlod/package/layout.hpp"
#include "package/manifest_reader.hpp"
#include "package/package_error.hpp"

namespace farlod {
namespace {

using nlohmann::json;
using namespace package;

constexpr std::int64_t most_cells = std::int64_t{1} << 34;

void require(bool rule, const std::string& what) {
  if (!rule) throw std::runtime_error(what);
}

FileStamp stamp_from(const json& j) {
  FileStamp stamp{j.at("bytes").get<std::uint64_t>(), 0};
  const auto text = j.at("xxh3").get<std::string>();
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), stamp.xxh3, 16);
  require(error == std::errc() && end == text.data() + text.size(), "a checksum is not a hexadecimal number");
  return stamp;
}

Grid grid_from(const json& j, double rotation_deg) {
  Grid grid;
  grid.rotation = GridRotation(Angle::degrees(rotation_deg));
  grid.cell_edge_m = j.at("cell_m").get<double>();
  grid.neighborhood = j.at("neighborhood").get<int>();
  grid.block_edge = j.at("block_edge").get<int>();
  const auto cells = j.at("cells").get<std::vector<std::int32_t>>();
  require(cells.size() == 4, "\"cells\" does not hold four numbers");
  grid.cells = {cells[0], cells[1], cells[2], cells[3]};
  require(grid.cell_edge_m > 0.0 && grid.cell_edge_m == exact_cell_edge_m(grid.cell_edge_m), "the cell edge is impossible");
  require(grid.neighborhood >= 1 && grid.neighborhood % 2 == 1 && grid.neighborhood < 10000, "the neighbourhood is not an odd number");
  require(grid.block_edge >= 1 && grid.block_edge <= 4096, "the block edge is impossible");
  require(grid.cells.size() > 0 && grid.cells.width() <= most_cells && grid.cells.height() <= most_cells &&
              grid.cells.size() <= most_cells && std::abs(static_cast<double>(cells[0])) < 1e8 && std::abs(static_cast<double>(cells[1])) < 1e8,
          "the range of cells is impossible");
  return grid;
}

void read_place(const json& j, Manifest& m) {
  const json& crs = j.at("crs");
  m.crs_wkt = crs.at("wkt").get<std::string>();
  m.crs_name = crs.at("name").get<std::string>();
  if (!crs.at("epsg").is_null()) m.epsg = crs.at("epsg").get<int>();
  const json& frame = j.at("frame");
  m.origin_m = {frame.at("origin_m").at(0).get<double>(), frame.at("origin_m").at(1).get<double>()};
  m.height_origin_m = frame.at("height_origin_m").get<double>();
  m.convergence = Angle::degrees(frame.at("convergence_deg").get<double>());
  m.grid = grid_from(j.at("grid"), frame.at("grid_rotation_deg").get<double>());
}

void read_contents(const json& j, Manifest& m) {
  for (const json& input : j.at("inputs")) m.inputs.push_back({input.at("name").get<std::string>(), stamp_from(input)});
  m.buildings = j.at("counts").at("buildings").get<std::uint64_t>();
  m.polygons = j.at("counts").at("polygons").get<std::uint64_t>();
  m.triangles = j.at("counts").at("triangles").get<std::uint64_t>();
  for (const auto& [code, count] : j.at("problems").items()) m.problem_counts.emplace_back(std::stoi(code), count.get<std::uint64_t>());
  for (const json& b : j.at("blocks"))
    m.blocks.push_back({{b.at("i").get<std::int32_t>(), b.at("j").get<std::int32_t>()}, stamp_from(b.at("tiles")), stamp_from(b.at("far_map"))});
  const std::vector<Block> expected = m.grid.blocks();
  require(m.blocks.size() == expected.size(), "it does not list each block of the grid");
  for (std::size_t n = 0; n < expected.size(); ++n) require(m.blocks[n].block == expected[n], "its blocks are not in order");
}

Manifest manifest_from(const json& j) {
  Manifest m;
  m.software = j.at("software").get<std::string>();
  read_place(j, m);
  m.assign = j.at("settings").at("assign").get<std::string>();
  const json& far_map = j.at("settings").at("far_map");
  m.far_map_kind = far_map.at("kind").get<std::string>();
  m.far_map_side_columns = far_map.at("side_columns").get<std::uint32_t>();
  m.far_map_rows = far_map.at("rows").get<std::uint32_t>();
  require(m.far_map_kind == "box", "its far maps are of the unknown kind \"" + m.far_map_kind + "\"");
  require(m.far_map_side_columns >= 1 && m.far_map_side_columns <= 65536 && m.far_map_rows >= 1 && m.far_map_rows <= 65536,
          "the size of its far maps is impossible");
  read_contents(j, m);
  return m;
}

}  // namespace

Manifest read_manifest(const std::filesystem::path& package_folder) {
  const std::filesystem::path path = package_folder / manifest_file;
  if (!std::filesystem::is_directory(package_folder))
    throw PackageUnusable(package_folder.string() + " is not a package: there is no such folder. farlod-pack makes one.");
  std::ifstream file(path);
  if (!file)
    throw PackageUnusable(package_folder.string() + " is not a finished package: it has no " + manifest_file +
                          ". Was farlod-pack interrupted? Pack the city again.");
  try {
    const json j = json::parse(file);
    require(j.is_object() && j.value("format", "") == "farlod-package", "it does not say that it is one");
    const int version = j.at("version").get<int>();
    if (version > static_cast<int>(format_version))
      throw PackageUnusable(path.string() + " has format version " + std::to_string(version) + ", this program reads up to " +
                            std::to_string(format_version) + ". Use a newer farlod-svf, or pack the city again.");
    require(version == static_cast<int>(format_version), "its format version does not exist");
    return manifest_from(j);
  } catch (const PackageUnusable&) {
    throw;
  } catch (const std::exception& reason) {
    throw PackageDamaged(path.string() + " is damaged: " + reason.what() + ". Pack the city again.");
  }
}

}  // namespace farlod

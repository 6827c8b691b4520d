// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "package/layout.hpp"
#include "package/manifest.hpp"
#include "package/no_package.hpp"
#include "package/package_folder.hpp"

namespace farlod {
namespace {

using nlohmann::json;
using namespace package;

constexpr std::int64_t most_cells = std::int64_t{1} << 34;
/// Eastings with a zone's number in front come to some ten million metres; no reference system reaches a thousand million.
constexpr double farthest_origin_m = 1e9;
/// A map of 64 × 64 texels a side, 4096 times over: more than that is not a map of one cell.
constexpr std::uint64_t most_texels = std::uint64_t{1} << 26;

/// Some five million blocks, of 1024 cells each: more than that is not the list of a city.
constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 30;
/// Values within values: what is known takes six levels, and what is not may take some.
constexpr int deepest = 32;

void require(bool rule, const std::string& what) {
  if (!rule) throw std::runtime_error(what);
}

/// The text that a message repeats may be as long as the file.
std::string shortened(std::string text) {
  constexpr std::size_t longest = 200;
  if (text.size() <= longest) return text;
  std::size_t end = longest;
  // Not within a character of UTF-8
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.substr(0, end) + "…";
}

/// How deep the values of a JSON text are nested, at the most. Counted beforehand: nlohmann-json can count while it reads, but
/// then takes a time that grows with the square of a list.
int depth_of(std::string_view text) {
  int depth = 0, most = 0;
  bool in_string = false;
  for (std::size_t n = 0; n < text.size(); ++n) {
    const char c = text[n];
    if (c == '"') in_string = !in_string;
    if (in_string && c == '\\') ++n;
    if (in_string) continue;
    if (c == '[' || c == '{') most = std::max(most, ++depth);
    if (c == ']' || c == '}') --depth;
  }
  return most;
}

json parsed(std::string_view text) {
  require(depth_of(text) <= deepest, "its values are nested deeper than " + std::to_string(deepest));
  return json::parse(text);
}

/// nlohmann-json would cut 1.5 to 1 and 2³² + 1 to 1.
template <class T>
T whole_number(const json& j) {
  const bool fits = j.is_number_unsigned() ? std::in_range<T>(j.get<std::uint64_t>())
                                           : j.is_number_integer() && std::in_range<T>(j.get<std::int64_t>());
  require(fits, "a whole number was expected where it has " + shortened(j.dump()));
  return static_cast<T>(j.get<std::int64_t>());
}

template <class T>
T number_from(std::string_view digits, int base) {
  T number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number, base);
  require(error == std::errc() && end == digits.data() + digits.size(), "\"" + std::string(digits) + "\" is not a number");
  return number;
}

FileStamp stamp_from(const json& j) {
  return {whole_number<std::uint64_t>(j.at("bytes")), number_from<std::uint64_t>(j.at("xxh3").get<std::string>(), 16)};
}

CellRange cells_from(const json& j) {
  require(j.size() == 4, "\"cells\" does not hold four numbers");
  std::vector<std::int32_t> k;
  for (const json& index : j) k.push_back(whole_number<std::int32_t>(index));
  const bool near =
      std::all_of(k.begin(), k.end(), [](std::int32_t n) { return -farthest_cell_index <= n && n <= farthest_cell_index; });
  const CellRange cells{k[0], k[1], k[2], k[3]};
  // Neither side exceeds 2³⁰ now, so that the product cannot overflow
  require(near && cells.size() > 0 && cells.size() <= most_cells, "the range of cells is impossible");
  return cells;
}

/// Grid::blocks().size(), without making a list that a damaged manifest could make endless.
std::int64_t block_count(const Grid& grid) {
  const Block first = grid.block_of({grid.cells.i_begin, grid.cells.j_begin});
  const Block last = grid.block_of({grid.cells.i_end - 1, grid.cells.j_end - 1});
  return (std::int64_t{last.i} - first.i + 1) * (std::int64_t{last.j} - first.j + 1);
}

Grid grid_from(const json& j, double rotation_deg) {
  Grid grid;
  grid.rotation = GridRotation(Angle::degrees(rotation_deg));
  grid.cell_edge_m = j.at("cell_m").get<double>();
  grid.neighborhood = whole_number<int>(j.at("neighborhood"));
  grid.block_edge = whole_number<int>(j.at("block_edge"));
  grid.cells = cells_from(j.at("cells"));
  // Between a centimetre and a thousand kilometres, so that an index of a cell near the city fits 32 bits
  require(grid.cell_edge_m >= 0.01 && grid.cell_edge_m <= 1e6 && grid.cell_edge_m == exact_cell_edge_m(grid.cell_edge_m),
          "the cell edge is impossible");
  require(grid.neighborhood >= 1 && grid.neighborhood % 2 == 1 && grid.neighborhood < 10000,
          "the neighborhood is not an odd number");
  require(grid.block_edge >= 1 && grid.block_edge <= 4096, "the block edge is impossible");
  return grid;
}

void read_place(const json& j, Manifest& m) {
  const json& crs = j.at("crs");
  m.crs_wkt = crs.at("wkt").get<std::string>();
  m.crs_name = crs.at("name").get<std::string>();
  if (!crs.at("epsg").is_null()) m.epsg = whole_number<int>(crs.at("epsg"));
  const json& frame = j.at("frame");
  m.origin_m = {frame.at("origin_m").at(0).get<double>(), frame.at("origin_m").at(1).get<double>()};
  m.height_origin_m = frame.at("height_origin_m").get<double>();
  require(std::abs(m.origin_m.x) <= farthest_origin_m && std::abs(m.origin_m.y) <= farthest_origin_m &&
              std::abs(m.height_origin_m) <= farthest_origin_m,
          "its origin lies nowhere on Earth");
  m.convergence = Angle::degrees(frame.at("convergence_deg").get<double>());
  m.grid = grid_from(j.at("grid"), frame.at("grid_rotation_deg").get<double>());
}

/// The cells of a block that have far maps; absent where all have one.
std::optional<CellRuns> mapped_from(const json& j) {
  if (!j.contains("cells_with_far_map")) return std::nullopt;
  CellRuns cells;
  for (const json& run : j.at("cells_with_far_map")) {
    require(run.size() == 2, "a run of cells with far maps does not hold two numbers");
    const CellRun next{whole_number<std::uint32_t>(run.at(0)), whole_number<std::uint32_t>(run.at(1))};
    require(next.begin < next.end && (cells.runs.empty() || cells.runs.back().end < next.begin),
            "its cells with far maps are not in order");
    cells.runs.push_back(next);
  }
  return cells;
}

BlockFiles block_from(const json& j) {
  BlockFiles files{{whole_number<std::int32_t>(j.at("i")), whole_number<std::int32_t>(j.at("j"))}, stamp_from(j.at("tiles")), {}};
  files.mapped = mapped_from(j);
  if (files.has_far_maps()) files.far_map = stamp_from(j.at("far_map"));
  return files;
}

SurfacePixels pixels_from(const json& j) {
  SurfacePixels pixels;
  pixels.north_west_m = {j.at("north_west_m").at(0).get<double>(), j.at("north_west_m").at(1).get<double>()};
  pixels.step_m = j.at("step_m").get<double>();
  pixels.columns = whole_number<std::uint32_t>(j.at("columns"));
  pixels.rows = whole_number<std::uint32_t>(j.at("rows"));
  require(std::abs(pixels.north_west_m.x) <= farthest_origin_m && std::abs(pixels.north_west_m.y) <= farthest_origin_m &&
              pixels.step_m >= 1e-3 && pixels.step_m <= 1e6 && pixels.columns >= 1 && pixels.rows >= 1,
          "its pixels are impossible");
  if (j.contains("heights")) pixels.heights = stamp_from(j.at("heights"));
  if (j.contains("walls")) pixels.walls = whole_number<std::uint64_t>(j.at("walls"));
  return pixels;
}

/// A version whose tiles are partly in heights.bin has them.
void read_squares(const json& j, Manifest& m) {
  require(m.heights().has_value(), "it has no heights, of which its tiles are made");
  m.pixels->squares = whole_number<std::uint64_t>(j.at("squares"));
  require(*m.pixels->squares <= std::uint64_t{m.pixels->columns} * m.pixels->rows, "it has more squares than pixels");
}

CanopyFile canopy_from(const json& j) {
  constexpr std::uint64_t most_crowns = std::uint64_t{1} << 36;
  CanopyFile canopy{stamp_from(j), {}};
  for (std::size_t n = 0; n < crown_shape_count; ++n) {
    canopy.crowns_of_shape[n] = whole_number<std::uint64_t>(j.at(crown_shape_keys[n]));
    require(canopy.crowns_of_shape[n] <= most_crowns, "its number of crowns is impossible");
  }
  require(canopy.crowns() > 0, "it names crowns, and counts none");
  return canopy;
}

/// Some cells of the block have far maps, and not all.
void require_some_of(const std::optional<CellRuns>& mapped, std::int64_t cell_count) {
  if (!mapped) return;
  require(mapped->runs.empty() || mapped->runs.back().end <= cell_count, "a cell with a far map does not exist");
  require(std::cmp_less(mapped->size(), cell_count), "it lists all cells of a block where some are to be listed");
}

Box2d box_from(const json& j) {
  const Box2d box{{j.at(0).get<double>(), j.at(1).get<double>()}, {j.at(2).get<double>(), j.at(3).get<double>()}};
  require(!box.empty() && norm(box.low) <= 2.0 * farthest_origin_m && norm(box.high) <= 2.0 * farthest_origin_m,
          "the box of its buildings is impossible");
  return box;
}

void read_contents(const json& j, std::uint32_t version, Manifest& m) {
  for (const json& input : j.at("inputs")) m.inputs.push_back({input.at("name").get<std::string>(), stamp_from(input)});
  m.buildings = whole_number<std::uint64_t>(j.at("counts").at("buildings"));
  m.polygons = whole_number<std::uint64_t>(j.at("counts").at("polygons"));
  m.triangles = whole_number<std::uint64_t>(j.at("counts").at("triangles"));
  if (j.contains("buildings_box_m")) m.buildings_projected = box_from(j.at("buildings_box_m"));
  for (const auto& [code, count] : j.at("problems").items())
    m.problem_counts.emplace_back(number_from<int>(code, 10), whole_number<std::uint64_t>(count));
  const bool may_lack_crowns = version > canopy_format_version && !j.contains("canopy");
  if (version >= canopy_format_version && !may_lack_crowns) m.canopy = canopy_from(j.at("canopy"));
  if (version > canopy_format_version && j.contains("sources")) m.sources = stamp_from(j.at("sources"));
  if (j.contains("pixels")) m.pixels = pixels_from(j.at("pixels"));
  const bool may_lack_far_terrain = version > far_terrain_format_version && !j.contains("far_terrain");
  if (version >= far_terrain_format_version && !may_lack_far_terrain) m.far_terrain = stamp_from(j.at("far_terrain"));
  if (version >= relief_format_version) read_squares(j.at("pixels"), m);
  for (const json& b : j.at("blocks")) m.blocks.push_back(block_from(b));
  require(std::cmp_equal(m.blocks.size(), block_count(m.grid)), "it does not list each block of the grid");
  const std::vector<Block> expected = m.grid.blocks();
  for (std::size_t n = 0; n < expected.size(); ++n) {
    require(m.blocks[n].block == expected[n], "its blocks are not in order");
    require_some_of(m.blocks[n].mapped, m.grid.cells_of(expected[n]).size());
  }
}

FarMapShape far_map_from(const json& j) {
  FarMapShape shape;
  shape.kind = j.at("kind").get<std::string>();
  require(shape.kind == "box" || shape.kind == "horizon", "its far maps are of the unknown kind \"" + shape.kind + "\"");
  if (shape.is_box()) {
    shape.side_columns = whole_number<std::uint32_t>(j.at("side_columns"));
    shape.rows = whole_number<std::uint32_t>(j.at("rows"));
    require(shape.side_columns >= 1 && shape.rows >= 1 && shape.side_columns <= most_texels / 4 / shape.rows,
            "the size of its far maps is impossible");
    return shape;
  }
  shape.azimuth_bins = whole_number<std::uint32_t>(j.at("azimuth_bins"));
  shape.squares_per_edge = whole_number<std::uint32_t>(j.at("squares_per_edge"));
  shape.layers = whole_number<std::uint32_t>(j.at("layers"));
  shape.tolerance = j.at("tolerance").get<double>();
  require(shape.azimuth_bins >= 1 && shape.azimuth_bins <= 65536 && shape.squares_per_edge >= 1 && shape.squares_per_edge <= 4 &&
              shape.layers >= 1 && shape.layers <= most_layers && shape.tolerance >= 0.0,
          "the size of its far maps is impossible");
  return shape;
}

Manifest manifest_from(const json& j, std::uint32_t version) {
  Manifest m;
  m.version = version;
  m.software = j.at("software").get<std::string>();
  read_place(j, m);
  m.assign = j.at("settings").at("assign").get<std::string>();
  require(m.assign == "clip" || m.assign == "whole", "its buildings are assigned in the unknown way \"" + m.assign + "\"");
  m.far_map = far_map_from(j.at("settings").at("far_map"));
  read_contents(j, version, m);
  return m;
}

/// Whether the manifest has a checksum, which is right.
bool has_seal(std::string_view text) {
  const auto seal = ManifestSeal::of(text);
  require(!seal || checksum_of_manifest(seal->sealed) == seal->checksum, "its checksum is not that of its text");
  return seal.has_value();
}

Manifest read_text(std::string_view text, const std::string& name) {
  // First, so that a version which damage has made is not taken for one of another release
  const bool is_sealed = has_seal(text);
  const json j = parsed(text);
  require(j.is_object() && j.value("format", "") == "farlod-package", "it is not the manifest of a package");
  const auto version = whole_number<std::uint32_t>(j.at("version"));
  require_readable_version(name, version, oldest_format_version, newest_format_version);
  require(is_sealed, "its checksum is not at its end");
  Manifest manifest = manifest_from(j, version);
  manifest.file_xxh3 = checksum_of_manifest(text);
  return manifest;
}

std::string text_of(const PackageFolder& folder) {
  const PackageFile manifest = folder.plain_file(manifest_file);
  std::ifstream file(manifest.path, std::ios::binary);
  if (!file) throw no_package(folder.name());
  std::error_code unread;
  if (std::filesystem::file_size(manifest.path, unread) > most_bytes)
    throw PackageDamaged(manifest.name + " is damaged: it has more than " + std::to_string(most_bytes) +
                         " bytes. Copy it again, or pack the city again.");
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

Manifest manifest_from_text(std::string_view text, const std::string& name) {
  try {
    return read_text(text, name);
  } catch (const PackageUnusable&) {
    throw;
  } catch (const PackageDamaged&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& reason) {
    throw PackageDamaged(name + " is damaged: " + shortened(reason.what()) + ". Copy it again, or pack the city again.");
  }
}

Manifest read_manifest(const PackageFolder& package_folder) {
  return manifest_from_text(text_of(package_folder), package_folder.file(manifest_file).name);
}

Manifest read_manifest(const std::filesystem::path& package_folder) { return read_manifest(PackageFolder(package_folder)); }

}  // namespace farlod

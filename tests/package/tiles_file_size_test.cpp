// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "package/layout.hpp"
#include "package/tiles_writer.hpp"
#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"

namespace farlod {
namespace {

using package::Header;
using package::Section;
using package::SectionKind;

/// What a package may take for the geometry of its cells, as a multiple of what the bare mesh takes: 12 bytes for each vertex and
/// 12 for each triangle. The rest is what the mesh belongs to: surfaces, buildings, cells and their horizon. Large cells cut
/// surfaces into fewer triangles, and on hills the ground has more horizon edges than buildings have.
constexpr double most_bytes_of_bare_mesh = 1.5;

struct Bytes {
  std::uint64_t tiles = 0, bare_mesh = 0;
};

/// Adds a tiles file without what its far maps need.
void add(Bytes& sum, std::span<const std::byte> file) {
  Header header{};
  std::memcpy(&header, file.data(), sizeof header);
  sum.tiles += file.size();
  for (std::uint32_t n = 0; n < header.section_count; ++n) {
    Section section{};
    std::memcpy(&section, file.data() + sizeof header + n * sizeof section, sizeof section);
    const std::uint64_t bytes = section.count * section.element_bytes;
    if (section.kind >= SectionKind::far_cells && section.kind <= SectionKind::explicit_edges) sum.tiles -= bytes;
    if (section.kind == SectionKind::vertices || section.kind == SectionKind::triangles) sum.bare_mesh += bytes;
  }
}

struct Town {
  CitySettings settings;
  double cell_edge_m;
};

class TilesFileSize : public testing::TestWithParam<Town> {};

TEST_P(TilesFileSize, IsCloseToThatOfTheBareMesh) {
  const CityModel city = scenes::generated_town(GetParam().settings);
  const Grid grid = scenes::grid_covering(city, Angle::degrees(17.0), GetParam().cell_edge_m, 3);
  Report ignored;
  const TileSet tiles = tiles::cut_into_tiles({city, {}}, grid, Assign::clip, {}, ignored);
  Bytes bytes;
  for (const Block block : grid.blocks()) {
    const BakedBoxes no_far_city(static_cast<std::size_t>(grid.cells_of(block).size()));
    add(bytes, farlod::tiles_file(tiles, no_far_city, grid, block));
  }
  // All triangles are written, and neighbors share their vertices: there are fewer of those than of triangles
  EXPECT_GT(bytes.bare_mesh, tiles.triangle_count() * sizeof(Triangle));
  EXPECT_LT(bytes.bare_mesh, tiles.triangle_count() * (sizeof(Triangle) + sizeof(Point3f)));
  EXPECT_LE(static_cast<double>(bytes.tiles), most_bytes_of_bare_mesh * static_cast<double>(bytes.bare_mesh))
      << static_cast<double>(bytes.tiles) / static_cast<double>(bytes.bare_mesh);
}

Town flat(int lod, double cell_edge_m) {
  Town town{{}, cell_edge_m};
  town.settings.lod = lod;
  return town;
}

Town on_hills_with_overhangs(double cell_edge_m) {
  Town town = flat(2, cell_edge_m);
  town.settings.overhangs = true;
  town.settings.terrain_relief_m = 20.0;
  return town;
}

INSTANTIATE_TEST_SUITE_P(Towns, TilesFileSize,
                         testing::Values(flat(1, 50.0), flat(2, 50.0), on_hills_with_overhangs(50.0), flat(1, 100.0),
                                         flat(2, 100.0), on_hills_with_overhangs(100.0)),
                         [](const auto& instance) {
                           const CitySettings& settings = instance.param.settings;
                           return "Lod" + std::to_string(settings.lod) + (settings.overhangs ? "OnHillsWithOverhangs" : "") +
                                  "InCellsOf" + std::to_string(static_cast<int>(instance.param.cell_edge_m)) + "m";
                         });

}  // namespace
}  // namespace farlod

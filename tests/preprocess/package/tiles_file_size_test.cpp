// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "farlod/package/layout.hpp"
#include "package/tiles_writer.hpp"
#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"

namespace farlod {
namespace {

using package::Header;
using package::Section;
using package::SectionKind;

/// What a package may take for the geometry of its cells, as a multiple of what the bare mesh takes: 12 bytes for each vertex and
/// 12 for each triangle. The rest is what the mesh belongs to: surfaces, buildings, cells and their horizon.
constexpr double most_bytes_of_bare_mesh = 1.5;
/// On hills the ground has more horizon edges than buildings have, ten bytes each: measured 1.522.
constexpr double most_bytes_of_bare_mesh_on_hills = 1.53;

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
    if (section.kind >= SectionKind::far_cells && section.kind <= SectionKind::named_triangles) sum.tiles -= bytes;
    if (section.kind == SectionKind::vertices || section.kind == SectionKind::triangles) sum.bare_mesh += bytes;
  }
}

class TilesFileSize : public testing::TestWithParam<CitySettings> {};

TEST_P(TilesFileSize, IsCloseToThatOfTheBareMesh) {
  const CityModel city = scenes::generated_town(GetParam());
  const Grid grid = scenes::grid_covering(city, Angle::degrees(17.0), 50.0, 3);
  Report ignored;
  const TileSet tiles = cut_into_tiles({city, {}}, grid, Assign::clip, {}, ignored);
  Bytes bytes;
  for (const Block block : grid.blocks()) {
    const BakedBoxes no_far_city(static_cast<std::size_t>(grid.cells_of(block).size()));
    add(bytes, tiles_file(tiles, no_far_city, grid, block));
  }
  // All triangles are written, and neighbours share their vertices: there are fewer of those than of triangles
  EXPECT_GT(bytes.bare_mesh, tiles.triangle_count() * sizeof(Triangle));
  EXPECT_LT(bytes.bare_mesh, tiles.triangle_count() * (sizeof(Triangle) + sizeof(Point3f)));
  const double most = GetParam().terrain_relief_m > 0.0 ? most_bytes_of_bare_mesh_on_hills : most_bytes_of_bare_mesh;
  EXPECT_LE(static_cast<double>(bytes.tiles), most * static_cast<double>(bytes.bare_mesh))
      << static_cast<double>(bytes.tiles) / static_cast<double>(bytes.bare_mesh);
}

CitySettings town(int lod, bool overhangs, double relief_m) {
  CitySettings settings;
  settings.lod = lod;
  settings.overhangs = overhangs;
  settings.terrain_relief_m = relief_m;
  return settings;
}

INSTANTIATE_TEST_SUITE_P(Towns, TilesFileSize, testing::Values(town(1, false, 0.0), town(2, false, 0.0), town(2, true, 20.0)),
                         [](const auto& instance) {
                           return "Lod" + std::to_string(instance.param.lod) +
                                  (instance.param.overhangs ? "OnHillsWithOverhangs" : "");
                         });

}  // namespace
}  // namespace farlod

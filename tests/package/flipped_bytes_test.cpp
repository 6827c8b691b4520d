// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "package/block_tiles.hpp"
#include "package/manifest_reader.hpp"
#include "tests/package/small_package.hpp"

// Each byte of a file is changed in turn. The reader may refuse, or hand out a view that can be read whole; nothing else.

namespace farlod {
namespace {

using namespace package;

/// A low bit, the sign of a number, and everything.
constexpr std::byte changes[] = {std::byte{0x01}, std::byte{0x80}, std::byte{0xFF}};

template <class T>
bool lies_within(std::span<const T> part, const Bytes& bytes) {
  const auto whole = std::span<const std::byte>(bytes);
  const auto inner = std::as_bytes(part);
  return inner.empty() || (inner.data() >= whole.data() && inner.data() + inner.size() <= whole.data() + whole.size());
}

bool runs_cover_triangles(const TileView& tile) {
  std::uint32_t begin = 0;
  for (const SurfaceRun& run : tile.surface_runs) {
    if (run.end <= begin) return false;
    begin = run.end;
  }
  return begin == tile.mesh.triangles.size();
}

bool is_finite(const Point3f& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

bool edge_is_sound(const HorizonEdge& e) {
  return is_finite(e.a) && is_finite(e.b) && static_cast<std::size_t>(e.role) < edge_role_count;
}

bool tile_is_sound(const TileView& tile, const Bytes& bytes) {
  const auto is_inside = [&](const auto& part) { return lies_within(part, bytes); };
  if (!is_inside(tile.mesh.vertices) || !is_inside(tile.mesh.triangles) || !is_inside(tile.surface_runs) ||
      !is_inside(tile.surfaces) || !is_inside(tile.buildings) ||
      !std::all_of(tile.edge_sides.begin(), tile.edge_sides.end(), is_inside) || !is_inside(tile.loose_edges) ||
      !runs_cover_triangles(tile))
    return false;
  const auto vertices_exist = [&](const Triangle& t) { return std::max({t.a, t.b, t.c}) < tile.mesh.vertices.size(); };
  const auto skipped = [](std::size_t sum, const TileEdge& e) {
    return sum + e.sides_skipped + (e.sides_skipped < 255 ? 1U : 0U);
  };
  const auto sides_exist = [&](std::span<const TileEdge> sides) {
    return std::accumulate(sides.begin(), sides.end(), std::size_t{0}, skipped) <= 3 * tile.mesh.triangles.size();
  };
  const auto surface_exists = [&](const SurfaceRun& r) {
    return r.surface < tile.surfaces.size() &&
           (tile.surfaces[r.surface].building == no_building || tile.surfaces[r.surface].building < tile.buildings.size());
  };
  return std::all_of(tile.mesh.vertices.begin(), tile.mesh.vertices.end(), is_finite) &&
         std::all_of(tile.mesh.triangles.begin(), tile.mesh.triangles.end(), vertices_exist) &&
         std::all_of(tile.edge_sides.begin(), tile.edge_sides.end(), sides_exist) &&
         std::all_of(tile.loose_edges.begin(), tile.loose_edges.end(), edge_is_sound) &&
         std::all_of(tile.surface_runs.begin(), tile.surface_runs.end(), surface_exists);
}

bool far_map_is_sound(const ExplicitOccluders& occluders, const std::vector<float>& levels_m, const Bytes& bytes) {
  const auto is_inside = [&](const auto& part) { return lies_within(part, bytes); };
  if (!is_inside(occluders.edges) || !is_inside(occluders.explicit_edges)) return false;
  const auto exist = [](const std::span<const ExplicitOccluder>& list, std::size_t count) {
    return std::all_of(list.begin(), list.end(), [count](const ExplicitOccluder& n) { return n.row < count; });
  };
  return exist(occluders.explicit_edges, occluders.edges.size()) &&
         std::all_of(occluders.edges.begin(), occluders.edges.end(), edge_is_sound) &&
         std::is_sorted(levels_m.begin(), levels_m.end()) && std::isfinite(levels_m.front() + levels_m.back());
}

bool is_sound(const BlockTiles& tiles, const Bytes& bytes) {
  for (std::size_t n = 0; n < static_cast<std::size_t>(SmallPackage::cells_of_two.size()); ++n) {
    const Cell cell = SmallPackage::cells_of_two.cell_at(n);
    if (!tile_is_sound(tiles.tile(cell), bytes)) return false;
    if (!tiles.has_far_cells()) continue;
    if (!far_map_is_sound(tiles.explicit_occluders(cell, 20.0), tiles.levels_m(cell, most_layers), bytes)) return false;
  }
  return std::all_of(tiles.buildings().begin(), tiles.buildings().end(), [&](const BuildingRecord& b) {
    const std::string_view id = tiles.id_of(b);
    return lies_within(std::span(id.data(), id.size()), bytes);
  });
}

enum class Outcome { refused, sound, unsound };

Outcome outcome_of(const Bytes& bytes) {
  try {
    return is_sound(BlockTiles(bytes, SmallPackage::cells_of_two, "tiles.bin"), bytes) ? Outcome::sound : Outcome::unsound;
  } catch (const PackageDamaged&) {
  } catch (const PackageUnusable&) {
  }
  return Outcome::refused;
}

class FlippedBytes : public testing::TestWithParam<FarMapKind> {};

TEST_P(FlippedBytes, OfTilesAreRefusedOrHarmless) {
  Bytes bytes = bytes_of(SmallPackage(GetParam()).file(SmallPackage::two_cells, tiles_file));
  ASSERT_EQ(outcome_of(bytes), Outcome::sound);
  std::size_t refused = 0;
  for (std::size_t n = 0; n < bytes.size(); ++n)
    for (const std::byte change : changes) {
      bytes[n] ^= change;
      const Outcome outcome = outcome_of(bytes);
      EXPECT_NE(outcome, Outcome::unsound) << "byte " << n << " ^ " << static_cast<int>(change);
      refused += outcome == Outcome::refused ? 1U : 0U;
      bytes[n] ^= change;
    }
  // Magic, version and length alone are 20 bytes
  EXPECT_GT(refused, 20 * std::size(changes));
}

TEST_P(FlippedBytes, OfTheManifestAreRefusedOrHarmless) {
  const SmallPackage small(GetParam());
  const auto path = small.folder() / manifest_file;
  Bytes bytes = bytes_of(path);
  for (std::size_t n = 0; n < bytes.size(); ++n)
    for (const std::byte change : {std::byte{0x01}, std::byte{0x10}, std::byte{0x80}}) {
      bytes[n] ^= change;
      write_bytes(path, bytes);
      try {
        const Manifest m = read_manifest(small.folder());
        EXPECT_EQ(m.blocks.size(), m.grid.blocks().size());
        EXPECT_TRUE(m.grid.cells.size() > 0 && m.grid.cell_edge_m > 0 && m.far_map.picture_rows() > 0 &&
                    m.far_map.picture_columns() > 0);
      } catch (const PackageDamaged&) {
      } catch (const PackageUnusable&) {
      }
      bytes[n] ^= change;
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, FlippedBytes, testing::Values(FarMapKind::box, FarMapKind::horizon),
                         [](const auto& test) { return scenes::name_of(test.param); });

}  // namespace
}  // namespace farlod

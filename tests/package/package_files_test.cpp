// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "package/block_tiles.hpp"
#include "package/manifest.hpp"
#include "package/package_reader.hpp"
#include "tests/package/small_package.hpp"

// A package whose files are not those that its manifest tells of.

namespace farlod {
namespace {

using namespace package;
using package::far_map_file;
using package::tiles_file;
using testing::AllOf;
using testing::HasSubstr;

/// What a user meets who asks for everything.
std::string damage_of(const SmallPackage& small) {
  return damage_met_by([&] {
    const PackageReader package(small.folder());
    const bool is_box = package.manifest().far_map.is_box();
    for (const Cell cell : {Cell{0, 0}, {1, 0}, {2, 0}})
      is_box ? (void)package.box_far_map(cell) : (void)package.far_horizon(cell);
  });
}

void append_byte(const std::filesystem::path& file) {
  Bytes bytes = bytes_of(file);
  bytes.push_back({});
  write_bytes(file, bytes);
}

class PackageFiles : public testing::TestWithParam<FarMapKind> {};

TEST_P(PackageFiles, UndamagedOpens) {
  const SmallPackage small(GetParam());
  EXPECT_EQ(damage_of(small), "no damage");
  small.stamp_anew();
  EXPECT_EQ(damage_of(small), "no damage");
}

TEST_P(PackageFiles, ChecksumMismatch) {
  for (const char* name : {tiles_file, far_map_file})
    for (const double place : {0.0, 0.5, 0.999}) {
      const SmallPackage small(GetParam());
      const auto file = small.file(SmallPackage::one_cell, name);
      Bytes bytes = bytes_of(file);
      bytes[static_cast<std::size_t>(place * static_cast<double>(bytes.size()))] ^= std::byte{1};
      write_bytes(file, bytes);
      EXPECT_THAT(damage_of(small), AllOf(HasSubstr(file.string()), HasSubstr("checksum")));
    }
}

TEST_P(PackageFiles, SizeMismatch) {
  for (const char* name : {tiles_file, far_map_file}) {
    const SmallPackage small(GetParam());
    append_byte(small.file(SmallPackage::two_cells, name));
    EXPECT_THAT(damage_of(small), AllOf(HasSubstr(name), HasSubstr("bytes, the manifest says")));
  }
}

TEST_P(PackageFiles, MissingFile) {
  for (const char* name : {tiles_file, far_map_file}) {
    const SmallPackage small(GetParam());
    const auto file = small.file(SmallPackage::one_cell, name);
    std::filesystem::remove(file);
    EXPECT_THAT(damage_of(small), HasSubstr(file.string()));
    std::filesystem::create_directory(file);
    EXPECT_THAT(damage_of(small), HasSubstr(file.string()));
  }
}

TEST_P(PackageFiles, EmptyFile) {
  for (const char* name : {tiles_file, far_map_file}) {
    const SmallPackage small(GetParam());
    write_bytes(small.file(SmallPackage::one_cell, name), {});
    EXPECT_THAT(damage_of(small), HasSubstr("has 0 bytes"));
    small.stamp_anew();
    EXPECT_THAT(damage_of(small), HasSubstr(name));
  }
}

TEST_P(PackageFiles, TilesOfAnotherBlock) {
  const SmallPackage small(GetParam());
  write_bytes(small.file(SmallPackage::two_cells, tiles_file), bytes_of(small.file(SmallPackage::one_cell, tiles_file)));
  small.stamp_anew();
  EXPECT_THAT(damage_of(small), HasSubstr("does not hold the cells of its block"));
}

TEST_P(PackageFiles, FarMapsOfAnotherBlock) {
  const SmallPackage small(GetParam());
  write_bytes(small.file(SmallPackage::two_cells, far_map_file), bytes_of(small.file(SmallPackage::one_cell, far_map_file)));
  EXPECT_THAT(damage_of(small), HasSubstr("far.exr is damaged"));
  small.stamp_anew();
  EXPECT_THAT(damage_of(small), HasSubstr("does not hold a map for each cell"));
}

TEST_P(PackageFiles, FarMapsOfAnotherSize) {
  const SmallPackage small(GetParam());
  nlohmann::json m = small.manifest();
  m["settings"]["far_map"][GetParam() == FarMapKind::box ? "rows" : "layers"] = 8;
  small.write_manifest(m);
  EXPECT_THAT(damage_of(small), HasSubstr("not of the size that the manifest says"));
}

TEST_P(PackageFiles, FarMapsTruncated) {
  const SmallPackage small(GetParam());
  const auto file = small.file(SmallPackage::two_cells, far_map_file);
  const Bytes whole = bytes_of(file);
  for (std::size_t cut = 0; cut < whole.size(); cut += 13) {
    write_bytes(file, std::span(whole).first(cut));
    small.stamp_anew();
    EXPECT_THAT(damage_of(small), HasSubstr(file.string())) << cut << " of " << whole.size();
  }
}

TEST_P(PackageFiles, FarMapsThatAreAnotherPicture) {
  const SmallPackage small(GetParam());
  const std::string text = "P3 1 1 255 0 0 0";
  write_bytes(small.file(SmallPackage::one_cell, far_map_file), std::as_bytes(std::span(text)));
  small.stamp_anew();
  EXPECT_THAT(damage_of(small), HasSubstr("cannot be read as a far map"));
}

TEST_P(PackageFiles, WhatIsNotAskedForIsNotOpened) {
  const SmallPackage small(GetParam());
  std::filesystem::remove(small.file(SmallPackage::one_cell, tiles_file));
  const PackageReader package(small.folder());
  EXPECT_GT(package.tile({0, 0}).mesh.triangles.size(), 0U);
  EXPECT_THROW((void)package.tile({2, 0}), PackageDamaged);
  EXPECT_THROW((void)package.tile({2, 0}), PackageDamaged) << "asking again must not help";
}

/// Everything below the folder of a package: its files, and the folders on the way to them.
std::vector<std::filesystem::path> names_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    names.push_back(entry.path().lexically_relative(folder));
  return names;
}

/// What farlod-info --check meets.
std::string damage_checked_in(const SmallPackage& small) {
  std::string all;
  const std::string of_manifest = damage_met_by([&] {
    const PackageFolder folder(small.folder());
    const package::Manifest manifest = read_manifest(folder);
    for (std::size_t n = 0; n < manifest.blocks.size(); ++n) {
      const BlockCheck check(folder, manifest, n);
      for (const BlockDamage& damage : check.damage()) all += damage.what;
    }
  });
  return of_manifest == "no damage" ? all : of_manifest;
}

TEST_P(PackageFiles, LinksWithinAPackageAreRefused) {
  for (const std::filesystem::path& name : names_in(SmallPackage(GetParam()).folder())) {
    const SmallPackage small(GetParam());
    const std::filesystem::path outside = small.folder().parent_path() / "outside";
    std::filesystem::rename(small.folder() / name, outside);
    std::filesystem::create_symlink(outside, small.folder() / name);
    EXPECT_THAT(damage_of(small), AllOf(HasSubstr(name.string()), HasSubstr("is a link"))) << name;
    EXPECT_THAT(damage_checked_in(small), AllOf(HasSubstr(name.string()), HasSubstr("is a link"))) << name;
  }
}

TEST_P(PackageFiles, APackageMayBeALink) {
  const SmallPackage small(GetParam());
  const std::filesystem::path link = small.folder().parent_path() / "link.farlod";
  std::filesystem::create_directory_symlink(small.folder(), link);
  EXPECT_EQ(damage_met_by([&] { (void)PackageReader(link).tile({0, 0}); }), "no damage");
  const PackageFolder folder(link);
  const package::Manifest manifest = read_manifest(folder);
  EXPECT_TRUE(BlockCheck(folder, manifest, 0).damage().empty());
}

TEST_P(PackageFiles, NobodyWaitsForAPipe) {
  for (const std::filesystem::path& name : names_in(SmallPackage(GetParam()).folder())) {
    const SmallPackage small(GetParam());
    std::filesystem::remove_all(small.folder() / name);
    ASSERT_EQ(mkfifo((small.folder() / name).c_str(), 0600), 0);
    EXPECT_THAT(damage_of(small), AllOf(HasSubstr(name.string()), HasSubstr("is not a f"))) << name;
    EXPECT_THAT(damage_checked_in(small), AllOf(HasSubstr(name.string()), HasSubstr("is not a f"))) << name;
  }
}

TEST(Package, HorizonsWithoutNamesAreRefused) {
  // The tiles of a package of the other kind, with matching stamps
  const SmallPackage small(FarMapKind::horizon), other(FarMapKind::box);
  for (const Block block : {SmallPackage::one_cell, SmallPackage::two_cells})
    write_bytes(small.file(block, tiles_file), bytes_of(other.file(block, tiles_file)));
  small.stamp_anew();
  EXPECT_THAT(damage_of(small), HasSubstr("does not name what its far maps need"));
}

TEST(Package, FarMapsOfTheOtherKindAreRefused) {
  for (const FarMapKind kind : {FarMapKind::box, FarMapKind::horizon}) {
    const SmallPackage small(kind), other(kind == FarMapKind::box ? FarMapKind::horizon : FarMapKind::box);
    write_bytes(small.file(SmallPackage::one_cell, far_map_file), bytes_of(other.file(SmallPackage::one_cell, far_map_file)));
    small.stamp_anew();
    EXPECT_THAT(damage_of(small), HasSubstr("far.exr is damaged"));
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, PackageFiles, testing::Values(FarMapKind::box, FarMapKind::horizon),
                         [](const auto& test) { return scenes::name_of(test.param); });

// Each byte of a file is changed in turn. The reader may refuse, or hand out a view that can be read whole; nothing else.

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

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/layout.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <type_traits>

#include "package/crown.hpp"
#include "package/pixel_heights.hpp"
#include "package/sources_layout.hpp"

// Another reader is written from docs/package_format.md. Where the document and the header differ, the header wins, and this test
// fails.

namespace farlod::package {
namespace {

std::string format_document() {
  std::ifstream file(std::string(FARLOD_SOURCE_DIR) + "/docs/package_format.md");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The part of the document below a heading, up to the next.
std::string chapter(const std::string& heading) {
  const std::string all = format_document();
  const std::size_t begin = all.find("# " + heading + "\n");
  if (begin == std::string::npos) return {};
  return all.substr(begin, all.find("\n#", begin + 1) - begin);
}

/// Bytes of a type as the tables name it: `u32`, `3 × f32`, `8 bytes`.
std::size_t bytes_of(const std::string& type) {
  static const std::regex numbers("(?:(\\d+) × )?[uif](\\d+)"), bytes("(\\d+) bytes");
  std::smatch match;
  if (std::regex_match(type, match, bytes)) return std::stoul(match[1]);
  if (std::regex_match(type, match, numbers)) return (match[1].matched ? std::stoul(match[1]) : 1) * std::stoul(match[2]) / 8;
  return type == "AdjacentSlopes" ? sizeof(AdjacentSlopes) : 0;
}

/// Bytes of the field that a table has at an offset; 0 if it has no such row.
std::size_t documented_bytes(const std::string& record, std::size_t offset, const std::string& field) {
  const std::string table = chapter(record);
  const std::regex row("\\| " + std::to_string(offset) + " \\| `" + field + "` \\| ([^|]+) \\|");
  std::smatch match;
  return std::regex_search(table, match, row) ? bytes_of(match[1]) : 0;
}

#define EXPECT_DOCUMENTED(record, field)                                                       \
  EXPECT_EQ(documented_bytes(#record, offsetof(record, field), #field), sizeof(record::field)) \
      << "docs/package_format.md, " #record ": " #field " at " << offsetof(record, field)

TEST(Layout, HeaderIsDocumented) {
  EXPECT_DOCUMENTED(Header, magic);
  EXPECT_DOCUMENTED(Header, version);
  EXPECT_DOCUMENTED(Header, section_count);
  EXPECT_DOCUMENTED(Header, block_i);
  EXPECT_DOCUMENTED(Header, block_j);
  EXPECT_DOCUMENTED(Header, file_bytes);
  EXPECT_DOCUMENTED(Header, reserved);
}

TEST(Layout, SectionIsDocumented) {
  EXPECT_DOCUMENTED(Section, kind);
  EXPECT_DOCUMENTED(Section, element_bytes);
  EXPECT_DOCUMENTED(Section, offset);
  EXPECT_DOCUMENTED(Section, count);
  EXPECT_DOCUMENTED(Section, reserved);
}

TEST(Layout, CellRecordIsDocumented) {
  EXPECT_DOCUMENTED(CellRecord, i);
  EXPECT_DOCUMENTED(CellRecord, j);
  EXPECT_DOCUMENTED(CellRecord, vertex_count);
  EXPECT_DOCUMENTED(CellRecord, triangle_count);
  EXPECT_DOCUMENTED(CellRecord, z_low_m);
  EXPECT_DOCUMENTED(CellRecord, z_high_m);
  EXPECT_DOCUMENTED(CellRecord, capture_x_m);
  EXPECT_DOCUMENTED(CellRecord, capture_y_m);
  EXPECT_DOCUMENTED(CellRecord, capture_z_m);
  EXPECT_DOCUMENTED(CellRecord, far_map_top);
  EXPECT_DOCUMENTED(CellRecord, flags);
  EXPECT_DOCUMENTED(CellRecord, edge_counts);
  EXPECT_DOCUMENTED(CellRecord, loose_edge_count);
}

TEST(Layout, SurfaceRunIsDocumented) {
  EXPECT_DOCUMENTED(SurfaceRun, surface);
  EXPECT_DOCUMENTED(SurfaceRun, end);
}

TEST(Layout, TileEdgeIsDocumented) {
  EXPECT_DOCUMENTED(TileEdge, sides_skipped);
  EXPECT_DOCUMENTED(TileEdge, adjacent);
}

TEST(Layout, AdjacentSlopesAreDocumented) {
  EXPECT_DOCUMENTED(AdjacentSlopes, left);
  EXPECT_DOCUMENTED(AdjacentSlopes, right);
}

TEST(Layout, HorizonEdgeIsDocumented) {
  EXPECT_DOCUMENTED(HorizonEdge, a);
  EXPECT_DOCUMENTED(HorizonEdge, b);
  EXPECT_DOCUMENTED(HorizonEdge, adjacent);
  EXPECT_DOCUMENTED(HorizonEdge, role);
}

TEST(Layout, SurfaceRecordIsDocumented) {
  EXPECT_DOCUMENTED(SurfaceRecord, building);
  EXPECT_DOCUMENTED(SurfaceRecord, number);
  EXPECT_DOCUMENTED(SurfaceRecord, part);
  EXPECT_DOCUMENTED(SurfaceRecord, packed);
  for (const char* bits : {"| 0 | 3 | `kind` |", "| 3 | 1 | `grounded` |", "| 4 | 22 | `normal_u` |", "| 26 | 22 | `normal_v` |"})
    EXPECT_NE(chapter("SurfaceRecord").find(bits), std::string::npos) << "docs/package_format.md, SurfaceRecord lacks: " << bits;
}

TEST(Layout, BitsOfSurfaceRecordsLieWhereTheyAreDocumented) {
  const auto word = [](const SurfaceRecord& record) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, reinterpret_cast<const char*>(&record) + 8, sizeof bits);
    return bits;
  };
  SurfaceRecord record{};
  record.part = 0xFFFF;
  EXPECT_EQ(word(record), 0xFFFFU);
  record = {};
  record.pack(SurfaceKind{5}, false, {0, 0});
  EXPECT_EQ(word(record), std::uint64_t{5} << 16U);
  record.pack(SurfaceKind{0}, true, {0, 0});
  EXPECT_EQ(word(record), std::uint64_t{1} << 19U);
  record.pack(SurfaceKind{0}, false, {0x3FFFFE, 0});
  EXPECT_EQ(word(record), std::uint64_t{0x3FFFFE} << 20U);
  record.pack(SurfaceKind{0}, false, {0, 0x3FFFFE});
  EXPECT_EQ(word(record), std::uint64_t{0x3FFFFE} << 42U);
}

TEST(Layout, SurfaceRecordsGiveBackWhatWasPacked) {
  SurfaceRecord record{};
  record.part = 0x1234;
  for (const SurfaceKind kind : {SurfaceKind::ground, SurfaceKind::floor, SurfaceKind::foundation})
    for (const bool is_grounded : {false, true})
      for (const OctNormal normal :
           {OctNormal{0, 2 * OctNormal::steps}, OctNormal{2 * OctNormal::steps, 0}, OctNormal{1, 0x155555}}) {
        record.pack(kind, is_grounded, normal);
        EXPECT_EQ(record.kind(), kind);
        EXPECT_EQ(record.is_grounded(), is_grounded);
        EXPECT_EQ(record.normal(), normal);
        EXPECT_EQ(record.part, 0x1234);
      }
}

TEST(Layout, BuildingRecordIsDocumented) {
  EXPECT_DOCUMENTED(BuildingRecord, text_offset);
  EXPECT_DOCUMENTED(BuildingRecord, text_bytes);
  EXPECT_DOCUMENTED(BuildingRecord, number);
}

TEST(Layout, FarCellRecordIsDocumented) {
  EXPECT_DOCUMENTED(FarCellRecord, first_explicit_edge);
  EXPECT_DOCUMENTED(FarCellRecord, explicit_edge_count);
  EXPECT_DOCUMENTED(FarCellRecord, levels_m);
  EXPECT_DOCUMENTED(FarCellRecord, reserved);
}

TEST(Layout, ExplicitOccluderIsDocumented) {
  EXPECT_DOCUMENTED(ExplicitOccluder, row);
  EXPECT_DOCUMENTED(ExplicitOccluder, squares);
  EXPECT_DOCUMENTED(ExplicitOccluder, layers);
}

TEST(Layout, CrownsAreDocumented) {
  EXPECT_DOCUMENTED(CrownsHeader, magic);
  EXPECT_DOCUMENTED(CrownsHeader, version);
  EXPECT_DOCUMENTED(CrownsHeader, largest_half_width_m);
  EXPECT_DOCUMENTED(CrownsHeader, cell_count);
  EXPECT_DOCUMENTED(CrownsHeader, crown_count);
  EXPECT_DOCUMENTED(CrownsHeader, file_bytes);
  EXPECT_DOCUMENTED(CrownsHeader, reserved);
  EXPECT_DOCUMENTED(CrownCellRecord, i);
  EXPECT_DOCUMENTED(CrownCellRecord, j);
  EXPECT_DOCUMENTED(CrownCellRecord, first_crown);
  EXPECT_DOCUMENTED(CrownCellRecord, crown_count);
  EXPECT_DOCUMENTED(CrownCellRecord, z_low_m);
  EXPECT_DOCUMENTED(CrownCellRecord, z_high_m);
  EXPECT_DOCUMENTED(CrownCellRecord, reserved);
  EXPECT_DOCUMENTED(Crown, x_m);
  EXPECT_DOCUMENTED(Crown, y_m);
  EXPECT_DOCUMENTED(Crown, bottom_m);
  EXPECT_DOCUMENTED(Crown, top_m);
  EXPECT_DOCUMENTED(Crown, half_width_m);
  EXPECT_DOCUMENTED(Crown, shape);
  EXPECT_DOCUMENTED(Crown, foliage);
  EXPECT_DOCUMENTED(Crown, turn);
  EXPECT_NE(chapter("CrownsHeader").find("| 8 | `version` | u32 | " + std::to_string(crowns_version) + " |"), std::string::npos);
  EXPECT_NE(chapter("Versions").find("* **" + std::to_string(canopy_format_version) + "** is"), std::string::npos);
  EXPECT_EQ(crowns_file_bytes(3, 5), 64U + 3U * 32U + 5U * 24U);
}

TEST(Layout, SourcesAreDocumented) {
  EXPECT_DOCUMENTED(SourcesHeader, magic);
  EXPECT_DOCUMENTED(SourcesHeader, version);
  EXPECT_DOCUMENTED(SourcesHeader, file_count);
  EXPECT_DOCUMENTED(SourcesHeader, building_count);
  EXPECT_DOCUMENTED(SourcesHeader, file_bytes);
  EXPECT_DOCUMENTED(SourcesHeader, reserved);
  EXPECT_NE(chapter("SourcesHeader")
                .find("| 8 | `version` | u32 | " + std::to_string(sources_version) + ", or " +
                      std::to_string(sources_version_with_ids) + " where a surface has an id |"),
            std::string::npos);
  EXPECT_NE(chapter("Versions").find("* **" + std::to_string(format_version) + "** may have [sources.bin]"), std::string::npos);
}

TEST(Layout, HeightsAreDocumented) {
  EXPECT_DOCUMENTED(HeightsHeader, magic);
  EXPECT_DOCUMENTED(HeightsHeader, version);
  EXPECT_DOCUMENTED(HeightsHeader, columns);
  EXPECT_DOCUMENTED(HeightsHeader, rows);
  EXPECT_DOCUMENTED(HeightsHeader, reserved);
  EXPECT_DOCUMENTED(HeightsHeader, file_bytes);
  EXPECT_NE(chapter("HeightsHeader")
                .find("| 8 | `version` | u32 | " + std::to_string(heights_version) + ", or " +
                      std::to_string(placed_heights_version) + " "),
            std::string::npos);
  EXPECT_DOCUMENTED(PixelsInGrid, first_x_m);
  EXPECT_DOCUMENTED(PixelsInGrid, first_y_m);
  EXPECT_DOCUMENTED(PixelsInGrid, step_m);
  EXPECT_DOCUMENTED(PixelsInGrid, cos);
  EXPECT_DOCUMENTED(PixelsInGrid, sin);
  for (const char* key : {"`pixels.heights.bytes`", "`pixels.heights.xxh3`", "`pixels.squares`"})
    EXPECT_NE(chapter("manifest.json").find(key), std::string::npos) << key;
}

TEST(Layout, VersionAndChannelsAreDocumented) {
  const std::string document = format_document();
  EXPECT_NE(document.find("| 8 | `version` | u32 | " + std::to_string(tiles_version) + " |"), std::string::npos);
  EXPECT_NE(document.find("# The package format, version " + std::to_string(newest_format_version) + "\n"), std::string::npos);
  for (const char* channel : {sky_channel, distance_channel, estimate_channel, low_channel, high_channel, overhang_channel})
    EXPECT_NE(chapter("far.exr").find("| `" + std::string(channel) + "` |"), std::string::npos) << channel;
}

TEST(Layout, SectionKindsAndElementSizesAreDocumented) {
  const struct {
    SectionKind kind;
    const char* name;
    std::size_t bytes;
  } kinds[] = {{SectionKind::cells, "cells", sizeof(CellRecord)},
               {SectionKind::vertices, "vertices", sizeof(Point3f)},
               {SectionKind::triangles, "triangles", sizeof(Triangle)},
               {SectionKind::surface_runs, "surface_runs", sizeof(SurfaceRun)},
               {SectionKind::surfaces, "surfaces", sizeof(SurfaceRecord)},
               {SectionKind::buildings, "buildings", sizeof(BuildingRecord)},
               {SectionKind::text, "text", 1},
               {SectionKind::far_cells, "far_cells", sizeof(FarCellRecord)},
               {SectionKind::far_edges, "far_edges", sizeof(HorizonEdge)},
               {SectionKind::explicit_edges, "explicit_edges", sizeof(ExplicitOccluder)},
               {SectionKind::tile_edges, "tile_edges", sizeof(TileEdge)},
               {SectionKind::loose_edges, "loose_edges", sizeof(HorizonEdge)}};
  EXPECT_EQ(std::size(kinds), section_count);
  for (const auto& [kind, name, bytes] : kinds) {
    const std::string expected =
        "| " + std::to_string(static_cast<int>(kind)) + " | `" + name + "` | " + std::to_string(bytes) + " |";
    EXPECT_NE(chapter("Section").find(expected), std::string::npos) << "docs/package_format.md, Section lacks: " << expected;
  }
}

TEST(Layout, RecordsCanBeMapped) {
  static_assert(std::is_trivially_copyable_v<Header> && std::is_trivially_copyable_v<Section> &&
                std::is_trivially_copyable_v<CellRecord> && std::is_trivially_copyable_v<SurfaceRecord> &&
                std::is_trivially_copyable_v<BuildingRecord> && std::is_trivially_copyable_v<FarCellRecord> &&
                std::is_trivially_copyable_v<ExplicitOccluder> && std::is_trivially_copyable_v<HorizonEdge> &&
                std::is_trivially_copyable_v<SurfaceRun> && std::is_trivially_copyable_v<TileEdge>);
  static_assert(section_alignment % alignof(CellRecord) == 0 && section_alignment % alignof(SurfaceRecord) == 0 &&
                section_alignment % alignof(FarCellRecord) == 0);
  static_assert(end_padding >= 16 - sizeof(Point3f), "the last vertex is read as 16 bytes");
}

TEST(Layout, BlocksHaveFoldersOfTheirOwn) {
  EXPECT_EQ(block_folder({0, 0}), "blocks/0_0");
  EXPECT_EQ(block_folder({-1, 12}), "blocks/-1_12");
  EXPECT_NE(block_folder({1, 11}), block_folder({11, 1}));
}

}  // namespace
}  // namespace farlod::package

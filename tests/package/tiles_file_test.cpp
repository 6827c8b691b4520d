// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "package/block_tiles.hpp"
#include "tests/package/small_package.hpp"

// What is wrong with the bytes of a tiles.bin, one rule a test. Checksums are no help here: a faulty program writes matching
// ones.

namespace farlod {
namespace {

using namespace package;
using testing::AllOf;
using testing::HasSubstr;

TilesBytes whole_file() {
  static const Bytes bytes = bytes_of(SmallPackage(FarMapKind::horizon).file(SmallPackage::two_cells, package::tiles_file));
  return TilesBytes(bytes);
}

BlockTiles open(TilesBytes& file) { return {file.bytes(), SmallPackage::cells_of_two, "small/tiles.bin"}; }

constexpr std::array<SectionKind, section_count> all_kinds{
    SectionKind::cells,     SectionKind::vertices,       SectionKind::triangles,  SectionKind::surface_runs,
    SectionKind::surfaces,  SectionKind::buildings,      SectionKind::text,       SectionKind::far_cells,
    SectionKind::far_edges, SectionKind::explicit_edges, SectionKind::tile_edges, SectionKind::loose_edges};

std::string damage_of(TilesBytes& file) {
  return damage_met_by([&] { (void)open(file); });
}

/// What the reader says after `change`.
std::string damage_after(const std::function<void(TilesBytes&)>& change) {
  TilesBytes file = whole_file();
  change(file);
  return damage_of(file);
}

/// Puts all sections and their table behind `before` new entries of the table.
TilesBytes with_sections_in_front(const std::vector<Section>& before) {
  TilesBytes file = whole_file();
  const std::size_t shift = (before.size() * sizeof(Section) + section_alignment - 1) / section_alignment * section_alignment;
  for (std::uint32_t n = 0; n < section_count; ++n) file.at<Section>(sizeof(Header) + n * sizeof(Section)).offset += shift;
  const auto added = std::as_bytes(std::span(before));
  const auto table_end = file.bytes().begin() + sizeof(Header) + section_count * sizeof(Section);
  // Between the table and the first section, so that the old entries keep their place
  Bytes padded(added.begin(), added.end());
  padded.resize(shift);
  file.bytes().insert(table_end, padded.begin(), padded.end());
  std::rotate(
      file.bytes().begin() + sizeof(Header), file.bytes().begin() + sizeof(Header) + section_count * sizeof(Section),
      file.bytes().begin() + static_cast<std::ptrdiff_t>(sizeof(Header) + section_count * sizeof(Section) + added.size()));
  file.header().section_count += static_cast<std::uint32_t>(before.size());
  file.header().file_bytes = file.bytes().size();
  return file;
}

TEST(Package, WholeFileOpens) {
  EXPECT_EQ(damage_after([](TilesBytes&) {}), "no damage");
}

TEST(Package, MessagesNameTheFileTheRuleAndWhatToDo) {
  EXPECT_THAT(
      damage_after([](TilesBytes& f) { f.header().magic[3] = 'X'; }),
      AllOf(HasSubstr("small/tiles.bin"), HasSubstr("does not begin as a tiles file"), HasSubstr("Pack the city again.")));
}

TEST(Package, Magic) {
  for (std::size_t n = 0; n < magic.size(); ++n)
    EXPECT_THAT(damage_after([n](TilesBytes& f) { ++f.header().magic[n]; }), HasSubstr("does not begin")) << n;
}

TEST(Package, AnotherVersion) {
  for (const std::uint32_t version : {1U, tiles_version - 1, tiles_version + 1, 77U, 0xFFFFFFFFU}) {
    TilesBytes file = whole_file();
    file.header().version = version;
    EXPECT_THROW((void)open(file), PackageUnusable) << version;
  }
  EXPECT_THAT(damage_after([](TilesBytes& f) { f.header().version = 0; }), HasSubstr("format version does not exist"));
}

TEST(Package, Truncated) {
  TilesBytes whole = whole_file();
  std::vector<std::size_t> cuts{
      0, 1, sizeof(Header) - 1, sizeof(Header), sizeof(Header) + 1, sizeof(Header) + section_count * sizeof(Section)};
  for (const SectionKind kind : all_kinds) {
    const Section& s = whole.section(kind);
    for (const std::uint64_t border : {s.offset, s.offset + s.count * s.element_bytes})
      for (const std::uint64_t cut : {border - 1, border, border + 1}) cuts.push_back(cut);
  }
  for (std::size_t cut = 7; cut < whole.bytes().size(); cut += 97) cuts.push_back(cut);
  for (const std::size_t cut : cuts) {
    if (cut >= whole.bytes().size()) continue;
    EXPECT_NE(damage_after([cut](TilesBytes& f) { f.bytes().resize(cut); }), "no damage") << cut << " bytes";
  }
}

TEST(Package, TruncatedByAWriterThatKnowsIt) {
  TilesBytes whole = whole_file();
  for (const SectionKind kind : all_kinds) {
    const Section& s = whole.section(kind);
    const std::size_t cut = s.offset + s.count * s.element_bytes - 1;
    const auto cut_off = [cut](TilesBytes& f) {
      f.bytes().resize(cut);
      f.header().file_bytes = cut;
    };
    EXPECT_THAT(damage_after(cut_off), HasSubstr("reaches beyond the end")) << "section " << static_cast<int>(kind);
  }
}

TEST(Package, TooLong) {
  EXPECT_THAT(damage_after([](TilesBytes& f) { f.bytes().push_back({}); }), HasSubstr("length"));
}

TEST(Package, FutureSectionIsSkipped) {
  // One that would break every rule, were it read
  TilesBytes file = with_sections_in_front({{SectionKind{4711}, 3, 1, std::uint64_t{1} << 60, 5}});
  ASSERT_EQ(damage_of(file), "no damage");
  EXPECT_GT(open(file).tile({1, 0}).mesh.triangles.size(), 0U);
}

TEST(Package, MissingSection) {
  for (const SectionKind kind : all_kinds)
    EXPECT_THAT(damage_after([kind](TilesBytes& f) { f.section(kind).kind = SectionKind{99}; }), HasSubstr("section is missing"));
}

TEST(Package, ElementsOfAnotherSize) {
  for (const SectionKind kind : all_kinds)
    EXPECT_THAT(damage_after([kind](TilesBytes& f) { ++f.section(kind).element_bytes; }), HasSubstr("another size"));
}

TEST(Package, Misaligned) {
  for (const SectionKind kind : all_kinds)
    for (const std::uint64_t shift : {1U, 4U, 32U})
      EXPECT_THAT(damage_after([=](TilesBytes& f) { f.section(kind).offset -= shift; }), HasSubstr("not aligned"));
}

TEST(Package, OffsetsBeyondTheEnd) {
  for (const SectionKind kind : all_kinds)
    for (const std::uint64_t offset :
         {std::uint64_t{1} << 20, std::uint64_t{1} << 32, std::uint64_t{1} << 63, ~std::uint64_t{63}})
      EXPECT_THAT(damage_after([=](TilesBytes& f) { f.section(kind).offset = offset; }), HasSubstr("beyond the end")) << offset;
}

TEST(Package, CountsThatOverflow) {
  for (const SectionKind kind : all_kinds) {
    const std::uint64_t bytes = whole_file().section(kind).element_bytes;
    std::vector<std::uint64_t> counts{std::uint64_t{1} << 32, ~std::uint64_t{0}};
    // With this many, count · bytes wraps around to next to nothing; a byte of text cannot
    if (bytes > 1) counts.push_back(~std::uint64_t{0} / bytes + 1);
    for (const std::uint64_t count : counts)
      EXPECT_THAT(damage_after([=](TilesBytes& f) { f.section(kind).count = count; }), HasSubstr("beyond the end")) << count;
  }
}

TEST(Package, MoreSectionsThanTheFileHolds) {
  for (const std::uint32_t count : {1000U, 1U << 27, 0xFFFFFFFFU})
    EXPECT_THAT(damage_after([=](TilesBytes& f) { f.header().section_count = count; }), HasSubstr("table of sections")) << count;
}

TEST(Package, CellsOfAnotherBlock) {
  EXPECT_THAT(damage_after([](TilesBytes& f) { f.element<CellRecord>(SectionKind::cells, 0).i = 7; }), HasSubstr("not in order"));
  EXPECT_THAT(damage_after([](TilesBytes& f) { --f.section(SectionKind::cells).count; }), HasSubstr("does not hold the cells"));
}

TEST(Package, CellsOwnMoreThanTheFileHolds) {
  const auto cell = [](TilesBytes& f) -> CellRecord& { return f.element<CellRecord>(SectionKind::cells, 1); };
  for (const std::uint32_t more : {1U, 1000U, 0xFFFF0000U}) {
    EXPECT_THAT(damage_after([=](TilesBytes& f) { cell(f).vertex_count += more; }), HasSubstr("vertices reach beyond"));
    EXPECT_THAT(damage_after([=](TilesBytes& f) { cell(f).triangle_count += more; }), HasSubstr("triangles reach beyond"));
  }
}

TEST(Package, CellsOwnLessThanTheFileHolds) {
  const auto cell = [](TilesBytes& f) -> CellRecord& { return f.element<CellRecord>(SectionKind::cells, 1); };
  EXPECT_THAT(damage_after([=](TilesBytes& f) { --cell(f).vertex_count; }), HasSubstr("more than its cells own"));
  EXPECT_THAT(damage_after([=](TilesBytes& f) { cell(f).triangle_count = 0; }), HasSubstr("more than its cells own"));
}

TEST(Package, TriangleNamesMissingVertex) {
  const std::uint32_t vertices = whole_file().element<CellRecord>(SectionKind::cells, 0).vertex_count;
  for (auto corner : {&Triangle::a, &Triangle::b, &Triangle::c})
    EXPECT_THAT(damage_after([=](TilesBytes& f) { f.element<Triangle>(SectionKind::triangles, 2).*corner = vertices; }),
                HasSubstr("names a vertex that does not exist"));
}

TEST(Package, TriangleNamesMissingSurface) {
  EXPECT_THAT(damage_after([](TilesBytes& f) {
                f.element<SurfaceRun>(SectionKind::surface_runs, 2).surface =
                    static_cast<std::uint32_t>(f.section(SectionKind::surfaces).count);
              }),
              HasSubstr("names a surface that does not exist"));
  EXPECT_THAT(damage_after([](TilesBytes& f) { --f.section(SectionKind::surface_runs).count; }),
              HasSubstr("not every triangle has a surface"));
}

TEST(Package, RunsOfTrianglesOutOfOrder) {
  const auto run = [](TilesBytes& f, std::size_t n) -> SurfaceRun& {
    return f.element<SurfaceRun>(SectionKind::surface_runs, n);
  };
  TilesBytes whole = whole_file();
  const std::uint32_t triangles = whole.element<CellRecord>(SectionKind::cells, 0).triangle_count;
  for (const std::uint32_t end : {0U, run(whole, 0).end, triangles + 1, 0xFFFFFFFFU})
    EXPECT_THAT(damage_after([=](TilesBytes& f) { run(f, 1).end = end; }), HasSubstr("not in order")) << end;
  // One that covers all triangles of its cell leaves the others to the next cell
  EXPECT_THAT(damage_after([=](TilesBytes& f) { run(f, 0).end = triangles; }),
              testing::AnyOf(HasSubstr("not in order"), HasSubstr("more than its cells own")));
}

TEST(Package, RisesBesideFarEdgesBeyondARightAngle) {
  constexpr std::int8_t beyond = -128;
  for (auto side : {&AdjacentSlopes::left, &AdjacentSlopes::right}) {
    EXPECT_THAT(damage_after([=](TilesBytes& f) { f.element<HorizonEdge>(SectionKind::far_edges, 0).adjacent.*side = beyond; }),
                HasSubstr("beyond a right angle"));
    for (const std::int8_t right : {std::int8_t{-127}, std::int8_t{127}})
      EXPECT_EQ(damage_after([=](TilesBytes& f) { f.element<HorizonEdge>(SectionKind::far_edges, 0).adjacent.*side = right; }),
                "no damage");
  }
}

TEST(Package, SurfaceNamesMissingBuilding) {
  EXPECT_THAT(damage_after([](TilesBytes& f) {
                f.element<SurfaceRecord>(SectionKind::surfaces, 1).building =
                    static_cast<std::uint32_t>(f.section(SectionKind::buildings).count);
              }),
              HasSubstr("names a building that does not exist"));
}

TEST(Package, SurfaceOfUnknownKind) {
  for (const SurfaceKind kind : {SurfaceKind{0}, SurfaceKind{6}, SurfaceKind{7}})
    EXPECT_THAT(damage_after([=](TilesBytes& f) { f.element<SurfaceRecord>(SectionKind::surfaces, 1).pack(kind, true, {}); }),
                HasSubstr("of a kind that does not exist"));
}

TEST(Package, IdReachesBeyondTheText) {
  const auto building = [](TilesBytes& f) -> BuildingRecord& {
    return f.element<BuildingRecord>(SectionKind::buildings, f.section(SectionKind::buildings).count - 1);
  };
  EXPECT_THAT(damage_after([=](TilesBytes& f) { ++building(f).text_bytes; }), HasSubstr("id reaches beyond"));
  EXPECT_THAT(damage_after([=](TilesBytes& f) { building(f).text_offset = ~std::uint32_t{0}; }), HasSubstr("id reaches beyond"));
}

TEST(Package, BuildingsThatShareTheirText) {
  // A thousand buildings whose ids are all of a text of a megabyte would take a gigabyte
  EXPECT_THAT(damage_after([](TilesBytes& f) {
                const auto& buildings = f.section(SectionKind::buildings);
                ASSERT_GT(buildings.count, 1U);
                for (std::size_t n = 0; n < buildings.count; ++n) {
                  auto& building = f.element<BuildingRecord>(SectionKind::buildings, n);
                  building.text_offset = 0;
                  building.text_bytes = static_cast<std::uint32_t>(f.section(SectionKind::text).count);
                }
              }),
              HasSubstr("share the bytes of their ids"));
}

TEST(Package, NotANumber) {
  for (const float bad : {not_a_number, infinite, -infinite}) {
    for (auto part : {&Point3f::x, &Point3f::y, &Point3f::z})
      EXPECT_THAT(damage_after([=](TilesBytes& f) { f.element<Point3f>(SectionKind::vertices, 3).*part = bad; }),
                  HasSubstr("a vertex"));
    for (auto part : {&CellRecord::capture_x_m, &CellRecord::capture_y_m, &CellRecord::capture_z_m})
      EXPECT_THAT(damage_after([=](TilesBytes& f) { f.element<CellRecord>(SectionKind::cells, 1).*part = bad; }),
                  HasSubstr("capture point"));
    EXPECT_THAT(damage_after([=](TilesBytes& f) { f.element<CellRecord>(SectionKind::cells, 1).far_map_top = bad; }),
                HasSubstr("far map's height"));
    for (auto part : {&CellRecord::z_low_m, &CellRecord::z_high_m})
      EXPECT_THAT(damage_after([=](TilesBytes& f) { f.element<CellRecord>(SectionKind::cells, 1).*part = bad; }),
                  HasSubstr("cell's heights"));
    EXPECT_THAT(damage_after([=](TilesBytes& f) { f.element<HorizonEdge>(SectionKind::far_edges, 0).b.y = bad; }),
                HasSubstr("an edge lies nowhere on Earth"));
  }
}

TEST(Package, NowhereOnEarth) {
  // A ray index drops triangles this large without a word
  for (const float huge : {2e7F, -1e20F, std::numeric_limits<float>::max()})
    for (auto part : {&Point3f::x, &Point3f::y, &Point3f::z})
      EXPECT_THAT(damage_after([=](TilesBytes& f) { f.element<Point3f>(SectionKind::vertices, 3).*part = huge; }),
                  HasSubstr("nowhere on Earth"));
}

TEST(Package, HeightsThatAreNotTheVertices) {
  for (auto part : {&CellRecord::z_low_m, &CellRecord::z_high_m})
    for (const float shift : {-1.0F, 1.0F})
      EXPECT_THAT(damage_after([=](TilesBytes& f) { f.element<CellRecord>(SectionKind::cells, 1).*part += shift; }),
                  HasSubstr("cell's heights"));
}

TEST(Package, FarPlacesNowhereOnEarth) {
  for (const float huge : {2e7F, -1e20F})
    for (auto part : {&Point3f::x, &Point3f::y, &Point3f::z})
      for (auto end : {&HorizonEdge::a, &HorizonEdge::b})
        EXPECT_THAT(damage_after([=](TilesBytes& f) { f.element<HorizonEdge>(SectionKind::far_edges, 0).*end.*part = huge; }),
                    HasSubstr("an edge lies nowhere on Earth"));
}

TEST(Package, NotEveryCellHasAFarMap) {
  EXPECT_THAT(damage_after([](TilesBytes& f) { --f.section(SectionKind::far_cells).count; }),
              HasSubstr("not every cell has a far map"));
  // None at all is the other kind
  TilesBytes file = whole_file();
  for (const SectionKind kind : {SectionKind::far_cells, SectionKind::far_edges, SectionKind::explicit_edges})
    file.section(kind).count = 0;
  EXPECT_EQ(damage_of(file), "no damage");
  EXPECT_FALSE(open(file).has_far_cells());
}

TEST(Package, FarMapReachesBeyondItsSections) {
  const auto cell = [](TilesBytes& f) -> FarCellRecord& { return f.element<FarCellRecord>(SectionKind::far_cells, 1); };
  for (const std::uint64_t first : {std::uint64_t{1} << 33, ~std::uint64_t{0}})
    EXPECT_THAT(damage_after([=](TilesBytes& f) { cell(f).first_explicit_edge = first; }), HasSubstr("edges reach beyond"));
  EXPECT_THAT(damage_after([=](TilesBytes& f) { ++cell(f).explicit_edge_count; }), HasSubstr("edges reach beyond"));
}

TEST(Package, FarMapNamesWhatDoesNotExist) {
  TilesBytes whole = whole_file();
  const auto edges = static_cast<std::uint32_t>(whole.section(SectionKind::far_edges).count);
  ASSERT_GT(edges, 0U);
  for (const std::uint32_t beyond : {0U, 7U})
    EXPECT_THAT(
        damage_after([=](TilesBytes& f) { f.element<ExplicitOccluder>(SectionKind::explicit_edges, 0).row = edges + beyond; }),
        HasSubstr("names an edge that does not exist"));
}

TEST(Package, LevelsOfAFarMapOutOfOrder) {
  const auto level = [](TilesBytes& f, std::size_t l) -> float& {
    return f.element<FarCellRecord>(SectionKind::far_cells, 1).levels_m[l];
  };
  for (std::size_t l = 0; l < most_layers; ++l)
    for (const float bad : {not_a_number, infinite, -infinite, 2e7F, -2e7F})
      EXPECT_THAT(damage_after([=](TilesBytes& f) { level(f, l) = bad; }), HasSubstr("levels of a far map")) << l << ": " << bad;
  EXPECT_THAT(damage_after([=](TilesBytes& f) { level(f, 1) = std::nextafter(level(f, 0), -infinite); }),
              HasSubstr("levels of a far map"));
  // Layers may be without thickness
  EXPECT_EQ(damage_after([=](TilesBytes& f) { level(f, 1) = level(f, 0); }), "no damage");
}

TEST(Package, ReservedFieldsAndUnknownFlagsAreSkipped) {
  EXPECT_EQ(damage_after([](TilesBytes& f) {
              f.header().reserved.fill(0xFF);
              f.section(SectionKind::cells).reserved = 1;
              f.element<CellRecord>(SectionKind::cells, 0).flags = 0xFFFFFFFF;
              f.element<FarCellRecord>(SectionKind::far_cells, 1).reserved = 1;
              f.element<ExplicitOccluder>(SectionKind::explicit_edges, 0).squares = 0xFFFF;
              f.element<ExplicitOccluder>(SectionKind::explicit_edges, 0).layers = 0xFFFF;
            }),
            "no damage");
}

}  // namespace
}  // namespace farlod

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/same_tiles.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "package/layout.hpp"
#include "package/tiles_writer.hpp"

namespace farlod {
namespace {

using namespace package;

/// A block of two cells, a roof in the first, with far maps of either kind, with those of the second cell alone, and without.
class SameTiles : public testing::Test {
 protected:
  SameTiles() {
    grid_.cells = tiles_.cells = {0, 0, 2, 1};
    tiles_.tiles.resize(2);
    tiles_.building_ids = {"house"};
    tiles_.surfaces = {{0, 7, 0, SurfaceKind::roof, {0, 0, 1}, 8.0, false}};
    tiles_.tiles[0].add_polygon({{0, 0, 1}, {4, 0, 1}, {4, 4, 2}}, 0);
    without_ = tiles_file_without_maps(tiles_, grid_, {0, 0});
  }
  [[nodiscard]] std::vector<std::byte> with(const BakedBlock& maps, const std::optional<CellRuns>& mapped = {}) const {
    return farlod::tiles_file(tiles_, maps, grid_, {0, 0}, mapped);
  }
  [[nodiscard]] static BakedHorizon horizon() {
    return {ReceiverPatches(50.0, 1, {0.0F, 2.0F}), {{0, 1, 1}}, {0.0F, 0.0F}, {0.0F, 0.0F}, {0.0F, 0.0F}, {0.0F, 0.0F}};
  }

  Grid grid_;
  TileSet tiles_;
  std::vector<std::byte> without_;
};

TEST_F(SameTiles, FarMapsDoNotCount) {
  EXPECT_TRUE(same_tiles(without_, without_));
  const BakedBox box{{25.0F, 25.0F, 1.5F}, {4, 4, 0.5F}, {}};
  const HorizonEdge edge{{1, 2, 3}, {4, 5, 6}, {}, EdgeRole::grounded};
  const CellRuns second{{{1, 2}}};
  for (const auto& file :
       {with(BakedBoxes{box, box}), with(BakedBoxes{box}, second), with(BakedHorizons{{edge}, {horizon(), horizon()}}),
        with(BakedHorizons{{edge}, {horizon()}}, second)}) {
    EXPECT_NE(file, without_);
    EXPECT_TRUE(same_tiles(file, without_));
  }
}

/// Each byte of the sections of tiles counts.
TEST_F(SameTiles, AByteThatIsChangedIsFound) {
  std::size_t found = 0;
  for (std::size_t n = 0; n < section_count; ++n) {
    Section section{};
    std::memcpy(&section, without_.data() + sizeof(Header) + n * sizeof(Section), sizeof(Section));
    for (std::size_t k = 0; k < section.count * section.element_bytes; ++k) {
      std::vector<std::byte> changed = without_;
      changed.at(section.offset + k) ^= std::byte{0x40};
      // The last five numbers of a cell but its flags are of its far map
      const std::size_t in_cell = k % sizeof(CellRecord);
      const bool is_of_map = section.kind == SectionKind::cells && in_cell >= offsetof(CellRecord, capture_x_m) &&
                             in_cell < offsetof(CellRecord, flags);
      EXPECT_EQ(same_tiles(changed, without_), is_of_map) << n << ' ' << k;
      found += is_of_map ? 0 : 1;
    }
  }
  EXPECT_GT(found, 100U);
}

TEST_F(SameTiles, AFileThatIsCutOffIsAnother) {
  for (std::size_t length = 0; length < without_.size() - end_padding; ++length)
    EXPECT_FALSE(same_tiles(std::span(without_).first(length), without_)) << length;
}

}  // namespace
}  // namespace farlod

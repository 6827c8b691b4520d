// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfTiledInputFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstring>

#include "package/far_map.hpp"
#include "package/far_map_reader.hpp"
#include "package/layout.hpp"
#include "package/package_reader.hpp"
#include "tests/package/small_package.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"

// A wall to the north must appear where the format says, by our own reader and by OpenEXR alone: writer and reader could be wrong
// alike.

namespace farlod {
namespace {

using testing::HasSubstr;

constexpr std::uint32_t W = 16, H = 20;
constexpr double cell_m = 40.0, eye_m = 1.5;
constexpr double distance_m = 50.0, half_width_m = 21.0,
                 height_m = 30.0;  // of the wall, from the eye in the middle of cell (0, 0)
/// Distances lose all but 11 digits.
constexpr double map_precision = 1.0 / 2048;

class WallToTheNorth : public testing::Test {
 protected:
  WallToTheNorth() {
    scenes::SceneBuilder builder({0.5 * cell_m, 0.5 * cell_m, 0.0});
    builder.add_wall({-half_width_m, distance_m}, {half_width_m, distance_m}, 0.0, eye_m + height_m);
    builder.add_box({{-0.5, -0.5}, {0.5, 0.5}}, 0.0, 0.01);
    scenes::pack_city(builder.city(), scenes::grid_covering(builder.city(), {}, cell_m, 1, 4), folder_.path() / "wall.farlod",
                      scenes::box_maps(W, H));
  }

  /// Whether the format says that a texel of the map of cell (0, 0) is hidden.
  static bool is_hidden(std::uint32_t column, std::uint32_t row, double top) {
    if (column / W != static_cast<std::uint32_t>(BoxSide::north)) return false;
    const double across = 2.0 * (column % W + 0.5) / W - 1.0;
    return std::abs(across) * distance_m < half_width_m && top * (row + 0.5) / H < height_m / distance_m;
  }

  scenes::TemporaryFolder folder_;
};

TEST_F(WallToTheNorth, IsInTheNorthernColumns) {
  const PackageReader package(folder_.path() / "wall.farlod");
  const BoxFarMap map = package.box_far_map({0, 0});
  const double top = map.shape().top;
  // The box is as high as the wall of the nearest cell could be, seen from the middle
  EXPECT_GE(top, height_m / distance_m);
  for (std::uint32_t row = 0; row < H; ++row)
    for (std::uint32_t column = 0; column < 4 * W; ++column) {
      const Point3d d = map.shape().direction_of({column, row});
      ASSERT_EQ(map.blocks(d), is_hidden(column, row, top)) << "row " << row << ", column " << column;
      if (!map.blocks(d)) continue;
      EXPECT_NEAR(map.distance_m(d), distance_m * norm(d), distance_m * norm(d) * map_precision);
    }
}

TEST_F(WallToTheNorth, OpenExrSeesItUpright) {
  const double top = PackageReader(folder_.path() / "wall.farlod").box_far_map({0, 0}).shape().top;
  Imf::TiledInputFile file((folder_.path() / "wall.farlod" / package::block_folder({0, 0}) / package::far_map_file).c_str());
  ASSERT_EQ(file.tileXSize(), 4 * W);
  ASSERT_EQ(file.tileYSize(), H);
  std::vector<float> sky(std::size_t{4} * W * H), distance(sky.size());
  Imf::FrameBuffer frame;
  frame.insert("Y", Imf::Slice::Make(Imf::FLOAT, sky.data(), Imath::V2i(0, 0), 4 * W, H));
  frame.insert("Z", Imf::Slice::Make(Imf::FLOAT, distance.data(), Imath::V2i(0, 0), 4 * W, H));
  file.setFrameBuffer(frame);
  file.readTile(0, 0);
  for (std::uint32_t pixel_row = 0; pixel_row < H; ++pixel_row)
    for (std::uint32_t column = 0; column < 4 * W; ++column) {
      const std::size_t n = std::size_t{pixel_row} * 4 * W + column;
      const bool hidden = is_hidden(column, H - 1 - pixel_row, top);
      ASSERT_EQ(sky[n], hidden ? 0.0F : 1.0F) << "pixel row " << pixel_row << ", column " << column;
      ASSERT_EQ(std::isinf(distance[n]), !hidden);
    }
}

FarHorizon three_layers() { return {ReceiverPatches(20.0, 1, {-2.0F, 3.0F, 9.5F}), AzimuthBins{8}, {}, {}, {}, {}, {}}; }

TEST(FarHorizon, HeightsMeetTheExplicitEdgesOfTheirLayersAndOfTheOneAbove) {
  const FarHorizon map = three_layers();
  EXPECT_EQ(map.layers_met_from(0.0F, 0.0F) & 0b111U, 0b011U);
  EXPECT_EQ(map.layers_met_from(3.0F, 9.4F) & 0b111U, 0b110U);
  EXPECT_EQ(map.layers_met_from(0.0F, 3.0F) & 0b111U, 0b111U);
  EXPECT_EQ(map.layers_met_from(9.5F, 400.0F) & 0b111U, 0b100U);
}

TEST(FarHorizon, BelowTheLowestLevelItIsMetAsInTheLowestLayer) {
  EXPECT_EQ(three_layers().layers_met_from(-9.0F, -5.0F) & 0b111U, 0b011U);
}

TEST(FarHorizon, FloorAboveIsReachedEvenly) {
  const FarHorizon map = three_layers();
  EXPECT_EQ(map.floor_above(0, -2.0F), std::pair(1U, 0.0F));
  EXPECT_EQ(map.floor_above(0, 0.5F), std::pair(1U, 0.5F));
  EXPECT_EQ(map.floor_above(2, 50.0F), std::pair(2U, 0.0F));
}

// Far maps as somebody would write them who wants a reader to run out of memory. Their checksums would be right.

constexpr CellRange one_cell{0, 0, 1, 1};

package::FarMapShape horizons_of(std::uint32_t bins, std::uint32_t squares, std::uint32_t layers) {
  package::FarMapShape shape;
  shape.kind = "horizon";
  shape.azimuth_bins = bins;
  shape.squares_per_edge = squares;
  shape.layers = layers;
  return shape;
}

FarHorizon empty_map(const package::FarMapShape& shape) {
  const std::vector<float> levels_m(shape.layers);
  return {ReceiverPatches{20.0, shape.squares_per_edge, levels_m}, AzimuthBins{shape.azimuth_bins}, {}, {}, {}, {}, {}};
}

class HostileFarMap : public testing::Test {
 protected:
  /// A file of one tile of this shape, with the four channels that it needs and some more. Without pixels, it ends with its
  /// table.
  void write(const package::FarMapShape& shape, int more_channels, bool with_pixels) const {
    const auto columns = static_cast<int>(shape.picture_columns()), rows = static_cast<int>(shape.picture_rows());
    Imf::Header header(columns, rows);
    header.setTileDescription({static_cast<unsigned>(columns), static_cast<unsigned>(rows)});
    std::vector<std::string> names{"low", "Y", "high", "overhang"};
    for (int n = 0; n < more_channels; ++n) names.push_back("other" + std::to_string(n));
    for (const std::string& name : names) header.channels().insert(name, Imf::Channel(Imf::HALF));
    Imf::TiledOutputFile out(file_.c_str(), header, 0);
    if (!with_pixels) return;
    std::vector<half> pixels(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), half(0.5F));
    Imf::FrameBuffer frame;
    for (const std::string& name : names)
      frame.insert(name, Imf::Slice::Make(Imf::HALF, pixels.data(), Imath::V2i(0, 0), columns, rows));
    out.setFrameBuffer(frame);
    out.writeTile(0, 0);
  }
  /// Puts a tile of a few bytes where the table of a file without pixels ends.
  void append_tile() const {
    Bytes bytes = bytes_of(file_);
    const std::uint64_t at = bytes.size();
    std::memcpy(bytes.data() + bytes.size() - sizeof at, &at, sizeof at);
    constexpr std::array<std::int32_t, 7> column_row_levels_size_data{0, 0, 0, 0, 8, 0x789C, 0x0300};
    const auto tile = std::as_bytes(std::span(column_row_levels_size_data));
    bytes.insert(bytes.end(), tile.begin(), tile.end());
    write_bytes(file_, bytes);
  }
  [[nodiscard]] std::string damage_of(const package::FarMapShape& shape) const {
    return damage_met_by([&] {
      FarHorizon map = empty_map(shape);
      FarMapReader(file_, one_cell, shape).read_slopes({0, 0}, map);
    });
  }

  scenes::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / package::far_map_file;
};

TEST_F(HostileFarMap, ChannelsOfLaterWritersAreSkipped) {
  const package::FarMapShape shape = horizons_of(8, 1, 2);
  write(shape, 12, true);
  EXPECT_EQ(damage_of(shape), "no damage");
}

TEST_F(HostileFarMap, MoreChannelsThanAnybodyNeedsAreRefused) {
  const package::FarMapShape shape = horizons_of(8, 1, 2);
  write(shape, 13, true);
  EXPECT_THAT(damage_of(shape), HasSubstr("more than 16 channels"));
}

TEST_F(HostileFarMap, ATileThatCannotHoldItsPixelsIsRefusedBeforeThereIsMemoryForThem) {
  // 64 MiB of pixels in 8 bytes
  const package::FarMapShape shape = horizons_of(65536, 4, 8);
  write(shape, 0, false);
  append_tile();
  EXPECT_THAT(damage_of(shape), HasSubstr("larger than what is stored of it can be"));
}

TEST_F(HostileFarMap, TheSamePixelsEverywhereAreNoAttack) {
  // Nothing can be compressed better
  const package::FarMapShape shape = horizons_of(4096, 4, 8);
  write(shape, 0, true);
  EXPECT_EQ(damage_of(shape), "no damage");
}

}  // namespace
}  // namespace farlod

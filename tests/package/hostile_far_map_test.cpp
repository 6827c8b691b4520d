// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gmock/gmock.h>

#include <array>
#include <cstring>

#include "package/far_map_reader.hpp"
#include "tests/package/small_package.hpp"

// Far maps as somebody would write them who wants a reader to run out of memory. Their checksums would be right.

namespace farlod {
namespace {

using testing::HasSubstr;

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

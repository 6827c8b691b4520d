// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfTiledInputFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gmock/gmock.h>
#include <half.h>

#include <limits>
#include <string>
#include <vector>

#include "farlod/package/layout.hpp"
#include "package/far_map_reader.hpp"
#include "package/far_map_writer.hpp"
#include "tests/runtime/package/small_package.hpp"

// The far.exr of the kind `horizon`: slopes that are rounded to the safe side, and what is refused.

namespace farlod {
namespace {

using testing::HasSubstr;

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

/// A block of one cell, with one patch: its picture is one row.
class OneRow {
 public:
  explicit OneRow(std::uint32_t bins) {
    shape_.kind = "horizon";
    shape_.azimuth_bins = bins;
    shape_.squares_per_edge = shape_.layers = 1;
  }
  [[nodiscard]] FarHorizon written_and_read(const std::vector<float>& lower, const std::vector<float>& likely,
                                            const std::vector<float>& upper) const {
    write_far_maps(file(), BakedHorizons{{}, {}, {BakedHorizon{patches_, {}, {}, lower, likely, upper}}}, cells_, shape_);
    return read();
  }
  [[nodiscard]] FarHorizon read() const {
    FarHorizon map{patches_, AzimuthBins{shape_.azimuth_bins}, {}, {}, {}, {}};
    FarMapReader(file(), cells_, shape_).read_slopes({0, 0}, map);
    return map;
  }
  [[nodiscard]] std::string file() const { return (folder_.path() / package::far_map_file).string(); }

 private:
  scenes::TemporaryFolder folder_;
  CellRange cells_{0, 0, 1, 1};
  ReceiverPatches patches_{20.0, 1, {0.0F}};
  package::FarMapShape shape_;
};

half next(half h) {
  h.setBits(static_cast<unsigned short>(h.bits() + 1));
  return h;
}

TEST(HorizonFile, BoundsAreRoundedOutwards) {
  // Zero, below the least half and at it, numbers that a half is and is not, around its greatest, beyond it
  const std::vector<float> slopes{0.0F, 1e-9F,    0x1p-24F, 0x1.8p-24F, 1e-5F,    1.0F / 3.0F, 1.0F,    1.0005F, 1.0F + 0x1p-10F,
                                  2.7F, 65504.0F, 65505.0F, 65519.9F,   65520.0F, 1e9F,        infinite};
  const OneRow row(static_cast<std::uint32_t>(slopes.size()));
  const FarHorizon map = row.written_and_read(slopes, slopes, slopes);
  for (std::size_t n = 0; n < slopes.size(); ++n) {
    EXPECT_LE(map.lower[n], slopes[n]);
    EXPECT_GE(map.upper[n], slopes[n]);
    // No half lies between the two but the slope itself
    const half low(map.lower[n]), high(map.upper[n]);
    EXPECT_TRUE(low == high ? static_cast<float>(low) == slopes[n] : next(low) == high) << slopes[n];
  }
}

TEST(HorizonFile, ZeroStaysZero) {
  const FarHorizon map = OneRow(1).written_and_read({0.0F}, {0.0F}, {0.0F});
  EXPECT_EQ(map.upper[0], 0.0F);
  EXPECT_EQ(map.lower[0], 0.0F);
}

TEST(HorizonFile, PatchesRunDownwardsFromTheFirst) {
  const SmallPackage small(FarMapKind::horizon);
  const Package package(small.folder());
  const FarHorizon map = package.far_horizon({1, 0});
  Imf::TiledInputFile file(small.file(SmallPackage::two_cells, package::far_map_file).c_str());
  const auto columns = static_cast<int>(map.bins.count), rows = static_cast<int>(map.patches.count());
  ASSERT_EQ(static_cast<int>(file.tileXSize()), columns);
  ASSERT_EQ(static_cast<int>(file.tileYSize()), rows);
  std::vector<float> upper(map.upper.size());
  Imf::FrameBuffer frame;
  frame.insert("upper", Imf::Slice::Make(Imf::FLOAT, upper.data(), Imath::V2i(columns, 0), columns, rows));
  file.setFrameBuffer(frame);
  file.readTile(1, 0);
  EXPECT_EQ(upper, map.upper);
}

TEST(HorizonFile, BoundsOutOfOrder) {
  const struct {
    float lower, likely, upper;
  } rows[] = {{2.0F, 1.0F, 1.0F},         {-0.5F, 0.0F, 1.0F}, {0.0F, -0.5F, 1.0F},       {not_a_number, 0.0F, 1.0F},
              {0.0F, not_a_number, 1.0F}, {-1.0F, 0.0F, 1.0F}, {0.0F, 0.0F, not_a_number}};
  const OneRow row(2);
  for (const auto& [lower, likely, upper] : rows) {
    const auto read = [&, lo = lower, li = likely, up = upper] {
      (void)row.written_and_read({0.0F, lo}, {0.0F, li}, {1.0F, up});
    };
    EXPECT_THAT(damage_met_by(read), HasSubstr("its bounds are not in order")) << lower << ", " << likely << ", " << upper;
  }
}

TEST(HorizonFile, WhatIsLikelyMayLieOutsideOfTheBounds) {
  // Viewpoints are samples: who reads puts them between the bounds
  EXPECT_EQ(OneRow(1).written_and_read({0.5F}, {0.25F}, {1.0F}).likely[0], 0.25F);
}

/// A file with these channels alone, all zero.
void write_picture(const std::string& path, int columns, const std::vector<std::string>& channels) {
  Imf::Header header(columns, 1);
  for (const std::string& name : channels) header.channels().insert(name, Imf::Channel(Imf::HALF));
  header.setTileDescription(Imf::TileDescription(static_cast<unsigned>(columns), 1, Imf::ONE_LEVEL));
  std::vector<half> zeros(static_cast<std::size_t>(columns), half(0.0F));
  Imf::FrameBuffer frame;
  for (const std::string& name : channels)
    frame.insert(name, Imf::Slice::Make(Imf::HALF, zeros.data(), Imath::V2i(0, 0), columns, 1));
  Imf::TiledOutputFile file(path.c_str(), header);
  file.setFrameBuffer(frame);
  file.writeTile(0, 0);
}

TEST(HorizonFile, MissingChannels) {
  const OneRow row(4);
  for (const std::vector<std::string>& some :
       {std::vector<std::string>{"lower", "upper"}, {"Y", "upper"}, {"Y", "lower"}, {"Y", "Z"}}) {
    write_picture(row.file(), 4, some);
    EXPECT_THAT(damage_met_by([&] { (void)row.read(); }), HasSubstr("it has no slopes"));
  }
}

TEST(HorizonFile, UnknownChannelsAreSkipped) {
  const OneRow row(4);
  write_picture(row.file(), 4, {"Y", "lower", "upper", "colour"});
  EXPECT_EQ(row.read().upper, std::vector<float>(4, 0.0F));
}

}  // namespace
}  // namespace farlod

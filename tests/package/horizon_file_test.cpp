// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfTiledInputFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gmock/gmock.h>
#include <half.h>

#include <array>
#include <atomic>
#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "package/far_map_reader.hpp"
#include "package/layout.hpp"
#include "package/package_writer.hpp"
#include "tests/package/small_package.hpp"

// The far.exr of the kind `horizon`: slopes that are rounded to the safe side, and what is refused.

namespace farlod {
namespace {

using testing::HasSubstr;

/// A block of one cell, with one patch: its picture is one row.
class OneRow {
 public:
  explicit OneRow(std::uint32_t bins) {
    shape_.kind = "horizon";
    shape_.azimuth_bins = bins;
    shape_.squares_per_edge = shape_.layers = 1;
  }
  [[nodiscard]] FarHorizon written_and_read(const std::vector<float>& lower, const std::vector<float>& estimate,
                                            const std::vector<float>& upper, const std::vector<float>& overhang) const {
    write_far_maps(file(), BakedHorizons{{}, {BakedHorizon{patches_, {}, lower, estimate, upper, overhang}}}, cells_, shape_);
    return read();
  }
  [[nodiscard]] FarHorizon read() const {
    FarHorizon map{patches_, AzimuthBins{shape_.azimuth_bins}, {}, {}, {}, {}, {}};
    FarMapReader(std::filesystem::path(file()), cells_, shape_).read_slopes({0, 0}, map);
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
  const FarHorizon map = row.written_and_read(slopes, slopes, slopes, slopes);
  for (std::size_t n = 0; n < slopes.size(); ++n) {
    EXPECT_LE(map.low[n], slopes[n]);
    EXPECT_GE(map.high[n], slopes[n]);
    EXPECT_EQ(map.overhang[n], map.high[n]);
    // No half lies between the two but the slope itself
    const half low(map.low[n]), high(map.high[n]);
    EXPECT_TRUE(low == high ? static_cast<float>(low) == slopes[n] : next(low) == high) << slopes[n];
  }
}

TEST(HorizonFile, ZeroStaysZero) {
  const FarHorizon map = OneRow(1).written_and_read({0.0F}, {0.0F}, {0.0F}, {0.0F});
  EXPECT_EQ(map.high[0], 0.0F);
  EXPECT_EQ(map.low[0], 0.0F);
  EXPECT_EQ(map.overhang[0], 0.0F) << "a map without overhangs is told by its zeros";
}

TEST(HorizonFile, PatchesRunDownwardsFromTheFirst) {
  const SmallPackage small(FarMapKind::horizon);
  const PackageReader package(small.folder());
  const FarHorizon map = package.far_horizon({1, 0});
  Imf::TiledInputFile file(small.file(SmallPackage::two_cells, package::far_map_file).c_str());
  const auto columns = static_cast<int>(map.bins.count), rows = static_cast<int>(map.patches.count());
  ASSERT_EQ(static_cast<int>(file.tileXSize()), columns);
  ASSERT_EQ(static_cast<int>(file.tileYSize()), rows);
  std::vector<float> upper(map.high.size());
  Imf::FrameBuffer frame;
  frame.insert("high", Imf::Slice::Make(Imf::FLOAT, upper.data(), Imath::V2i(columns, 0), columns, rows));
  file.setFrameBuffer(frame);
  file.readTile(1, 0);
  EXPECT_EQ(upper, map.high);
}

/// A file of three tiles in a row: 0, long runs, and next to no runs.
class ThreeTiles {
 public:
  ThreeTiles() {
    shape_.kind = "horizon";
    shape_.azimuth_bins = columns;
    shape_.squares_per_edge = 2;
    shape_.layers = rows / 4;
    std::mt19937 random(1);
    for (std::size_t n = 0; n < zeros_.size(); ++n) {
      const std::size_t tile = n % (3 * columns) / columns;
      noise_[n] = half(tile == 2 ? static_cast<float>(random() % 1000) / 256.0F : tile == 1 ? static_cast<float>(n / 700) : 0.0F);
    }
  }
  void write(Imf::Compression compression) {
    Imf::Header header(3 * columns, rows);
    header.compression() = compression;
    header.setTileDescription(Imf::TileDescription(columns, rows, Imf::ONE_LEVEL));
    Imf::FrameBuffer frame;
    for (const auto& [name, pixels] : {std::pair{"Y", &noise_}, {"low", &zeros_}, {"overhang", &noise_}, {"high", &noise_}}) {
      header.channels().insert(name, Imf::Channel(Imf::HALF));
      frame.insert(name, Imf::Slice::Make(Imf::HALF, pixels->data(), header.dataWindow()));
    }
    Imf::TiledOutputFile file(path().c_str(), header);
    file.setFrameBuffer(frame);
    file.writeTiles(0, 2, 0, 0);
  }
  [[nodiscard]] FarMapReader reader() const { return {std::filesystem::path(path()), {0, 0, 3, 1}, shape_}; }
  [[nodiscard]] static FarHorizon read(const FarMapReader& reader, std::int32_t tile) {
    FarHorizon map{ReceiverPatches(20.0, 2, std::vector<float>(rows / 4)), AzimuthBins{columns}, {}, {}, {}, {}, {}};
    reader.read_slopes({tile, 0}, map);
    return map;
  }
  [[nodiscard]] std::vector<float> written(std::int32_t tile) const {
    std::vector<float> result;
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t column = 0; column < columns; ++column)
        result.push_back(noise_[row * 3 * columns + static_cast<std::size_t>(tile) * columns + column]);
    return result;
  }
  [[nodiscard]] std::string path() const { return (folder_.path() / package::far_map_file).string(); }

 private:
  static constexpr std::size_t columns = 64, rows = 12;
  scenes::TemporaryFolder folder_;
  package::FarMapShape shape_;
  std::vector<half> zeros_ = std::vector<half>(3 * columns * rows, half(0.0F)), noise_ = zeros_;
};

TEST(HorizonFile, AnyCompressionThatLosesNothing) {
  ThreeTiles file;
  for (const Imf::Compression compression : {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION,
                                             Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION}) {
    file.write(compression);
    const FarMapReader reader = file.reader();
    for (std::int32_t tile = 0; tile < 3; ++tile) {
      const FarHorizon map = ThreeTiles::read(reader, tile);
      EXPECT_EQ(map.estimate, file.written(tile)) << "compression " << compression << ", tile " << tile;
      EXPECT_EQ(map.high, map.estimate);
      EXPECT_EQ(map.overhang, map.estimate);
      EXPECT_EQ(map.low, std::vector<float>(map.high.size()));
    }
  }
}

TEST(HorizonFile, ManyThreadsReadOneFile) {
  ThreeTiles file;
  file.write(Imf::RLE_COMPRESSION);
  const FarMapReader reader = file.reader();
  std::array<std::thread, 4> threads;
  std::atomic<int> alike = 0;
  for (std::thread& thread : threads)
    thread = std::thread([&] {
      for (std::int32_t n = 0; n < 300; ++n) alike += ThreeTiles::read(reader, n % 3).estimate == file.written(n % 3) ? 1 : 0;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(alike, 1200);
}

TEST(HorizonFile, DamagedTilesAreToldAndNothingIsPrinted) {
  ThreeTiles file;
  for (const Imf::Compression compression : {Imf::RLE_COMPRESSION, Imf::ZIP_COMPRESSION}) {
    file.write(compression);
    const auto bytes = std::filesystem::file_size(file.path());
    testing::internal::CaptureStderr();
    // The end of the last tile's bytes, then of the table that says where they are, then the header
    for (const auto left : {bytes - 5, std::uintmax_t{370}, std::uintmax_t{100}}) {
      std::filesystem::resize_file(file.path(), left);
      EXPECT_NE(damage_met_by([&] { (void)ThreeTiles::read(file.reader(), 2); }), "no damage") << left;
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  }
}

TEST(HorizonFile, BoundsOutOfOrder) {
  const struct {
    float lower, estimate, upper, overhang = 0.0F;
  } rows[] = {{2.0F, 1.0F, 1.0F},         {-0.5F, 0.0F, 1.0F},        {0.0F, -0.5F, 1.0F},
              {not_a_number, 0.0F, 1.0F}, {0.0F, not_a_number, 1.0F}, {-1.0F, 0.0F, 1.0F},
              {0.0F, 0.0F, not_a_number}, {0.0F, 0.0F, 1.0F, -0.5F},  {0.0F, 0.0F, 1.0F, not_a_number}};
  const OneRow row(2);
  for (const auto& [lower, estimate, upper, overhang] : rows) {
    const auto read = [&, lo = lower, li = estimate, up = upper, over = overhang] {
      (void)row.written_and_read({0.0F, lo}, {0.0F, li}, {1.0F, up}, {0.0F, over});
    };
    EXPECT_THAT(damage_met_by(read), HasSubstr("its bounds are not in order")) << lower << ", " << estimate << ", " << upper;
  }
}

TEST(HorizonFile, TheEstimateMayLieOutsideOfTheBounds) {
  // Viewpoints are samples: who reads puts them between the bounds
  EXPECT_EQ(OneRow(1).written_and_read({0.5F}, {0.25F}, {1.0F}, {0.0F}).estimate[0], 0.25F);
}

TEST(HorizonFile, OverhangsMayRiseAboveAllThatHides) {
  // What is explicit hides, and is not in the rows
  EXPECT_EQ(OneRow(1).written_and_read({0.5F}, {0.5F}, {1.0F}, {4.0F}).overhang[0], 4.0F);
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
  for (const std::vector<std::string>& some : {std::vector<std::string>{"low", "high", "overhang"},
                                               {"Y", "high", "overhang"},
                                               {"Y", "low", "overhang"},
                                               {"Y", "low", "high"},
                                               {"Y", "Z"}}) {
    write_picture(row.file(), 4, some);
    EXPECT_THAT(damage_met_by([&] { (void)row.read(); }), HasSubstr("it has no slopes"));
  }
}

TEST(HorizonFile, UnknownChannelsAreSkipped) {
  const OneRow row(4);
  // Before, among and after the known ones, and of each type
  const std::pair<const char*, Imf::PixelType> channels[] = {{"A", Imf::FLOAT},   {"Y", Imf::HALF},      {"Z", Imf::UINT},
                                                             {"low", Imf::HALF},  {"middle", Imf::HALF}, {"overhang", Imf::HALF},
                                                             {"high", Imf::HALF}, {"vague", Imf::UINT}};
  Imf::Header header(4, 1);
  Imf::FrameBuffer frame;
  std::array<std::uint32_t, 4> ones{0x3C003C00, 0x3C003C00, 0x3C003C00, 0x3C003C00};  // halfs of 1, in pairs
  for (const auto& [name, type] : channels) {
    header.channels().insert(name, Imf::Channel(type));
    frame.insert(name, Imf::Slice::Make(type, ones.data(), Imath::V2i(0, 0), 4, 1));
  }
  header.setTileDescription(Imf::TileDescription(4, 1, Imf::ONE_LEVEL));
  {
    Imf::TiledOutputFile file(row.file().c_str(), header);
    file.setFrameBuffer(frame);
    file.writeTile(0, 0);
  }
  const FarHorizon map = row.read();
  for (const auto* slopes : {&map.low, &map.estimate, &map.high, &map.overhang}) EXPECT_EQ(*slopes, std::vector<float>(4, 1.0F));
}

/// Of a block of three cells, the first and the last have far maps, which differ.
TEST(HorizonFile, SomeCellsAreReadWhereTheyWereWritten) {
  const scenes::TemporaryFolder folder;
  const CellRange cells{0, 0, 3, 1};
  const ReceiverPatches patches{20.0, 1, {0.0F}};
  package::FarMapShape shape;
  shape.kind = "horizon";
  shape.azimuth_bins = 1;
  shape.squares_per_edge = shape.layers = 1;
  const auto baked = [&](float slope) { return BakedHorizon{patches, {}, {slope}, {slope}, {slope}, {slope}}; };
  const package::CellRuns ends{{{0, 1}, {2, 3}}}, begin{{{0, 2}}}, all_but_one{{{0, 1}}};
  const std::filesystem::path file = folder.path() / package::far_map_file;
  write_far_maps(file, BakedHorizons{{}, {baked(0.25F), baked(0.5F)}}, cells, shape, ends);
  const FarMapReader reader(file, cells, shape, ends);
  for (const auto& [i, slope] : {std::pair(0, 0.25F), std::pair(2, 0.5F)}) {
    FarHorizon map{patches, AzimuthBins{1}, {}, {}, {}, {}, {}};
    reader.read_slopes({i, 0}, map);
    EXPECT_EQ(map.estimate, std::vector<float>{slope}) << i;
  }
  // As many other cells are not told apart, which the checksums are for; more or fewer are
  EXPECT_EQ(damage_met_by([&] { FarMapReader(file, cells, shape, begin); }), "no damage");
  EXPECT_THAT(damage_met_by([&] { FarMapReader(file, cells, shape, all_but_one); }),
              HasSubstr("each cell that the manifest names"));
  EXPECT_THAT(damage_met_by([&] { FarMapReader(file, cells, shape); }), HasSubstr("each cell of its block"));
}

}  // namespace
}  // namespace farlod

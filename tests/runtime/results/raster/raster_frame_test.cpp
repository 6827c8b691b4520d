// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/raster_writer.hpp"

#include <gmock/gmock.h>

#include <set>

#include "farlod/error.hpp"
#include "results/spool_file.hpp"
#include "tests/runtime/results/raster/small_raster.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::NanSensitiveFloatEq;
using testing::Pointwise;

TEST(SvfBands, AreTheQuantityAndItsBounds) {
  std::string names;
  for (const Band& band : svf_bands("svf_solid", RasterBands::svf_and_bounds)) {
    names += band.name + " ";
    EXPECT_EQ(band.unit, "1");
    EXPECT_THAT(band.definition, testing::HasSubstr("share of the solid angle"));
  }
  EXPECT_EQ(names, "svf_solid svf_solid_low svf_solid_high ");
  ASSERT_EQ(svf_bands("svf", RasterBands::svf).size(), 1U);
  EXPECT_THAT(svf_bands("svf", RasterBands::svf)[0].definition, testing::StartsWith("sky view factor"));
}

TEST(BandsOf, AreInTheOrderOfTheFrame) {
  const RasterTile one({}, RasterBands::svf), three({}, RasterBands::svf_and_bounds);
  ASSERT_EQ(bands_of(one).size(), 1U);
  EXPECT_EQ(bands_of(one)[0].data(), one.svf.data());
  ASSERT_EQ(bands_of(three).size(), svf_bands("svf", RasterBands::svf_and_bounds).size());
  EXPECT_EQ(bands_of(three)[1].data(), three.low.data());
  EXPECT_EQ(bands_of(three)[2].data(), three.high.data());
}

constexpr std::size_t threads_of_run = 2;

/// What became of a writer, and which threads asked it.
struct Diary {
  std::size_t tiles = 0;
  bool is_committed = false;
  std::set<std::thread::id> threads;
};

class DiaryWriter : public RasterWriter {
 public:
  explicit DiaryWriter(Diary& diary) : diary_(diary) { diary_.threads.insert(std::this_thread::get_id()); }
  void write(const RasterTile& tile) override {
    diary_.tiles += tile.place.column;
    diary_.threads.insert(std::this_thread::get_id());
  }
  void commit() override {
    diary_.is_committed = true;
    diary_.threads.insert(std::this_thread::get_id());
  }

 private:
  Diary& diary_;
};

RasterTile tile_in_column(std::size_t column) { return RasterTile({0, column}, RasterBands::svf); }

TEST(AwaitedRasterWriter, DoesAllInOneThreadOfItsOwn) {
  Diary diary;
  {
    AwaitedRasterWriter writer([&] { return std::make_unique<DiaryWriter>(diary); }, threads_of_run);
    writer.write(tile_in_column(1));
    writer.write(tile_in_column(2));
    EXPECT_EQ(diary.tiles, 3U);  // A tile is written when write() returns
    writer.commit();
    EXPECT_TRUE(diary.is_committed);
  }
  EXPECT_EQ(diary.threads.size(), 1U);
  EXPECT_FALSE(diary.threads.contains(std::this_thread::get_id()));
}

TEST(AwaitedRasterWriter, TellsEachTimeThatThereIsNone) {
  AwaitedRasterWriter writer([]() -> std::unique_ptr<RasterWriter> { throw InputError("no module"); }, threads_of_run);
  EXPECT_THROW(writer.write(tile_in_column(0)), InputError);
  EXPECT_THROW(writer.commit(), InputError);
}

TEST(AwaitedRasterWriter, MayBeGivenUpBeforeItsFirstTile) {
  Diary diary;
  {
    const AwaitedRasterWriter writer([&] { return std::make_unique<DiaryWriter>(diary); }, threads_of_run);
  }
  EXPECT_EQ(diary.threads.size(), 1U);
  EXPECT_FALSE(diary.is_committed);
}

/// Two tiles by two, of which the last are cut; each pixel another value.
WholeRaster raster_of_four_tiles() {
  WholeRaster raster;
  raster.columns = raster_tile_edge + 3;
  raster.rows = raster_tile_edge + 2;
  for (std::size_t n = 0; n < raster.columns * raster.rows; ++n) raster.svf.push_back(static_cast<float>(n));
  return raster;
}

std::vector<float> all_pixels(TileSpool& spool) {
  std::vector<float> pixels = spool.pixels_of_tile_row(0);
  for (const float svf : spool.pixels_of_tile_row(1)) pixels.push_back(svf);
  return pixels;
}

TEST(TileSpool, GivesBackWholeRowsInWhateverOrderTilesCome) {
  const scenes::TemporaryFolder folder;
  const WholeRaster raster = raster_of_four_tiles();
  TileSpool spool(raster, folder.file("a.asc"));
  for (const TilePlace place : {TilePlace{1, 0}, {0, 1}, {1, 1}, {0, 0}}) spool.add(tile_of(raster, place));
  EXPECT_EQ(all_pixels(spool), raster.svf);
}

TEST(TileSpool, TilesThatDoNotComeHaveNoData) {
  const scenes::TemporaryFolder folder;
  WholeRaster raster = raster_of_four_tiles();
  TileSpool spool(raster, folder.file("a.asc"));
  for (const TilePlace place : {TilePlace{0, 0}, {1, 1}}) spool.add(tile_of(raster, place));
  for (std::size_t row = 0; row < raster.rows; ++row)
    for (std::size_t column = 0; column < raster.columns; ++column)
      if ((row < raster_tile_edge) != (column < raster_tile_edge)) raster.svf[row * raster.columns + column] = std::nanf("");
  EXPECT_THAT(all_pixels(spool), Pointwise(NanSensitiveFloatEq(), raster.svf));
}

}  // namespace
}  // namespace farlod

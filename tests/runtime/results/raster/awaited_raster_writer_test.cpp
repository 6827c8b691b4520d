// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/awaited_raster_writer.hpp"

#include <gtest/gtest.h>

#include <set>

#include "farlod/error.hpp"

namespace farlod {
namespace {

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

}  // namespace
}  // namespace farlod

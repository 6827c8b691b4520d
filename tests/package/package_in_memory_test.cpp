// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <vector>

#include "evaluate/sky_evaluator.hpp"
#include "farmap/horizon_map_baker.hpp"
#include "package/far_map_writer.hpp"
#include "package/package_reader.hpp"
#include "tests/package/small_package.hpp"
#include "tests/scenes/generated_town.hpp"

// A package that is tried out in memory answers as it will from the disk.

namespace farlod {
namespace {

CityModel town() {
  CitySettings settings;
  settings.size_m = 250;
  settings.seed = 5;
  settings.tower_share = 0.5;
  settings.overhangs = true;
  return scenes::generated_town(settings);
}

class InMemory : public testing::Test {
 protected:
  InMemory() { scenes::pack_tiles(tiles_, grid_, folder_, {}); }

  [[nodiscard]] static TileSet cut(const CityModel& city, const Grid& grid) {
    Report ignored;
    return tiles::cut_into_tiles({city, {}}, grid, Assign::clip, {}, ignored);
  }
  [[nodiscard]] PackageInMemory contents_of(const PackageReader& disk) {
    PackageInMemory memory{disk.manifest(), {}, {}};
    for (const Block block : grid_.blocks())
      bytes_.push_back(bytes_of(folder_ / package::block_folder(block) / package::tiles_file));
    for (const Bytes& bytes : bytes_) memory.tiles.emplace_back(bytes);
    for (std::size_t n = 0; n < static_cast<std::size_t>(grid_.cells.size()); ++n)
      memory.far_horizons.emplace(grid_.cells.cell_at(n), disk.far_horizon(grid_.cells.cell_at(n)));
    return memory;
  }
  [[nodiscard]] std::vector<float> answers_of(const PackageReader& package, Engine engine) const {
    const SkyEvaluator evaluator(package, {engine, SkyWeight::cosine, 145});
    std::vector<float> all;
    for (std::size_t n = 0; n < static_cast<std::size_t>(grid_.cells.size()); n += 5) {
      CellReceivers receivers{grid_.cells.cell_at(n), {}};
      for (const float x : {1.0F, 11.0F, 26.0F}) receivers.receivers.push_back({receivers.receivers.size(), {x, 17.0F, 3.0F}});
      std::vector<float> svf(3), low(3), high(3);
      evaluator.evaluate(receivers, SkyAnswers(svf, low, high));
      for (const auto& some : {svf, low, high}) all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }

  CityModel city_ = town();
  Grid grid_ = scenes::grid_covering(city_, Angle::degrees(4), 30.0, 3, 4);
  TileSet tiles_ = cut(city_, grid_);
  scenes::TemporaryFolder temporary_;
  std::filesystem::path folder_ = temporary_.path() / "town.farlod";
  std::vector<Bytes> bytes_;
};

TEST_F(InMemory, AnswersAreThoseFromTheDisk) {
  const PackageReader disk(folder_);
  const PackageReader memory(contents_of(disk));
  for (const Engine engine : {Engine::automatic, Engine::rays, Engine::exact}) {
    const std::vector<float> answers = answers_of(memory, engine);
    EXPECT_EQ(answers, answers_of(disk, engine));
    EXPECT_GT(std::count_if(answers.begin(), answers.end(), [](float svf) { return svf > 0.0F && svf < 1.0F; }), 10);
  }
}

TEST_F(InMemory, DamagedTilesAreRefusedAsOnTheDisk) {
  const PackageReader disk(folder_);
  PackageInMemory contents = contents_of(disk);
  contents.tiles.front() = contents.tiles.front().first(100);
  const PackageReader memory(std::move(contents));
  EXPECT_THROW((void)memory.tile(grid_.cells.cell_at(0)), PackageDamaged);
}

TEST_F(InMemory, SlopesComeBackAsTheyAreRounded) {
  const PackageReader disk(folder_);
  const HorizonMapBaker baker(tiles_, grid_, {});
  std::size_t changed = 0;
  for (const Block block : grid_.blocks()) {
    BakedHorizons baked = baker.bake(block);
    for (std::size_t n = 0; n < baked.cells.size(); ++n) {
      BakedHorizon& map = baked.cells[n];
      const std::vector<float> exact = map.high;
      round_as_stored(map);
      changed += map.high != exact ? 1 : 0;
      const FarHorizon read = disk.far_horizon(grid_.cells_of(block).cell_at(n));
      EXPECT_EQ(read.low, map.low);
      EXPECT_EQ(read.estimate, map.estimate);
      EXPECT_EQ(read.high, map.high);
      EXPECT_EQ(read.overhang, map.overhang);
    }
  }
  EXPECT_GT(changed, 0U) << "the test would test nothing";
}

}  // namespace
}  // namespace farlod

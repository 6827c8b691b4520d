// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/package_reader.hpp"

#include <gmock/gmock.h>

#include <array>
#include <atomic>
#include <cmath>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "package/crown.hpp"
#include "tests/package/small_package.hpp"
#include "tests/scenes/planted_crowns.hpp"

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(LruCache, KeepsEverythingWithoutALimit) {
  LruCache used;
  for (std::size_t n = 0; n < 100; ++n) EXPECT_THAT(used.use(n, 1'000'000'000'000), IsEmpty());
  // All of them were kept: the first limit evicts them
  used.keep_at_most(1);
  EXPECT_EQ(used.use(0, 1'000'000'000'000).size(), 99U);
}

TEST(LruCache, WhatWasNotUsedTheLongestGoesFirst) {
  LruCache used;
  used.keep_at_most(30);
  for (const std::size_t n : {1U, 2U, 3U, 1U}) EXPECT_THAT(used.use(n, 10), IsEmpty());
  EXPECT_THAT(used.use(4, 10), ElementsAre(2U));
  EXPECT_THAT(used.use(5, 20), ElementsAre(3U, 1U));
  EXPECT_THAT(used.use(6, 1), ElementsAre(4U));
}

TEST(LruCache, ASingleThingIsKeptHoweverLarge) {
  LruCache used;
  used.keep_at_most(10);
  EXPECT_THAT(used.use(1, 5), IsEmpty());
  EXPECT_THAT(used.use(2, 1000), ElementsAre(1U));
  EXPECT_THAT(used.use(2, 1000), IsEmpty());
}

TEST(LruCache, ALowerLimitCountsFromTheNextUse) {
  LruCache used;
  for (const std::size_t n : {1U, 2U, 3U}) EXPECT_THAT(used.use(n, 10), IsEmpty());
  used.keep_at_most(10);
  EXPECT_THAT(used.use(2, 10), ElementsAre(1U, 3U));
}

/// How often a file is mapped with at least a page of it in memory, as the system counts.
std::size_t mappings_in_memory(const std::filesystem::path& file) {
  std::ifstream maps("/proc/self/smaps");
  std::size_t count = 0;
  bool is_of_file = false;
  for (std::string line; std::getline(maps, line);) {
    // The first line of a mapping begins with its address and ends with its file. The others begin with a key
    if (std::isupper(static_cast<unsigned char>(line[0])) == 0) is_of_file = line.ends_with(" " + file.string());
    if (is_of_file && line.starts_with("Rss:")) count += std::stoul(line.substr(4)) > 0 ? 1 : 0;
  }
  return count;
}

class HeldBlocks : public testing::TestWithParam<FarMapKind> {
 protected:
  [[nodiscard]] static std::size_t tiles_in_memory(const SmallPackage& small) {
    return mappings_in_memory(small.file(SmallPackage::one_cell, package::tiles_file)) +
           mappings_in_memory(small.file(SmallPackage::two_cells, package::tiles_file));
  }
};

TEST_P(HeldBlocks, AllAreHeldWithoutALimit) {
  const SmallPackage small(GetParam());
  const PackageReader package(small.folder());
  EXPECT_EQ(tiles_in_memory(small), 0U);
  for (const Cell cell : {Cell{0, 0}, {1, 0}, {2, 0}}) (void)package.tile(cell);
  EXPECT_EQ(tiles_in_memory(small), 2U);
}

TEST_P(HeldBlocks, OneBlockAtATimeIsHeldAtTheLowestLimit) {
  const SmallPackage small(GetParam());
  PackageReader package(small.folder());
  package.hold_at_most(1);
  for (int round = 0; round < 3; ++round)
    for (const Cell cell : {Cell{0, 0}, {2, 0}, {1, 0}}) {
      const TileView tile = package.tile(cell);
      // Reading a vertex brings its page back
      EXPECT_TRUE(std::isfinite(tile.mesh.vertices.front().x));
      EXPECT_EQ(tiles_in_memory(small), 1U);
    }
}

TEST_P(HeldBlocks, OneBlockAtATimeGivesTheSameAnswers) {
  const SmallPackage small(GetParam());
  const PackageReader roomy(small.folder());
  PackageReader tight(small.folder());
  tight.hold_at_most(1);
  for (int round = 0; round < 3; ++round)
    for (const Cell cell : {Cell{0, 0}, {2, 0}, {1, 0}}) {
      const TileView expected = roomy.tile(cell), tile = tight.tile(cell);
      EXPECT_TRUE(std::equal(tile.mesh.vertices.begin(), tile.mesh.vertices.end(), expected.mesh.vertices.begin(),
                             expected.mesh.vertices.end()));
      if (GetParam() == FarMapKind::box) {
        const Point3d direction = normalized(Point3d{1.0, 0.1, 0.1});
        EXPECT_EQ(tight.box_far_map(cell).distance_m(direction), roomy.box_far_map(cell).distance_m(direction));
      } else {
        EXPECT_EQ(tight.far_horizon(cell).high, roomy.far_horizon(cell).high);
      }
    }
}

TEST_P(HeldBlocks, WhatWasHandedOutStaysReadable) {
  const SmallPackage small(GetParam());
  PackageReader package(small.folder());
  package.hold_at_most(1);
  const TileView first = package.tile({0, 0});
  const std::vector<Point3f> before(first.mesh.vertices.begin(), first.mesh.vertices.end());
  (void)package.tile({2, 0});
  EXPECT_EQ(mappings_in_memory(small.file(SmallPackage::two_cells, package::tiles_file)), 0U);
  EXPECT_TRUE(std::equal(before.begin(), before.end(), first.mesh.vertices.begin(), first.mesh.vertices.end()));
  EXPECT_EQ(package.tile({0, 0}).mesh.vertices.data(), first.mesh.vertices.data());
}

TEST_P(HeldBlocks, CrownsGoWithThem) {
  const SmallPackage small(GetParam());
  CrownsOfCity crowns = scenes::crowns_for(small.folder());
  for (int n = 0; n < 500; ++n) crowns.add({0.1 * n, 10.0}, 3.0, 9.0, 2.0, CrownShape::spheroid, Foliage::deciduous);
  scenes::plant(crowns, small.folder());
  PackageReader package(small.folder());
  package.hold_at_most(1);
  const auto file = small.folder() / package::crowns_file;
  for (int round = 0; round < 3; ++round)
    for (const Cell cell : {Cell{0, 0}, {2, 0}}) {
      (void)package.tile(cell);
      EXPECT_EQ(mappings_in_memory(file), 0U);
      const std::span<const Crown> of_cell = package.crowns_of(cell);
      ASSERT_FALSE(of_cell.empty());
      EXPECT_EQ(of_cell.front().half_width_m, 2.0F);
      EXPECT_EQ(mappings_in_memory(file), 1U);
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, HeldBlocks, testing::Values(FarMapKind::box, FarMapKind::horizon),
                         [](const auto& test) { return scenes::name_of(test.param); });

// A package may be asked from many threads, also while blocks come and go. ThreadSanitizer runs these tests.

constexpr std::array cells{Cell{0, 0}, Cell{1, 0}, Cell{2, 0}};
constexpr int rounds = 100;

template <class Work>
void in_many_threads(const Work& work) {
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) threads.emplace_back(work, t);
  for (std::thread& thread : threads) thread.join();
}

class PackageThreads : public testing::TestWithParam<FarMapKind> {
 protected:
  /// Something of the tile and of the far map of a cell.
  static std::vector<float> read(const PackageReader& package, Cell cell) {
    std::vector<float> values{package.tile(cell).cell->far_map_top};
    if (GetParam() == FarMapKind::box) {
      values.push_back(package.box_far_map(cell).shape().top);
    } else {
      const FarHorizon map = package.far_horizon(cell);
      values.insert(values.end(), map.estimate.begin(), map.estimate.end());
    }
    return values;
  }
  [[nodiscard]] std::vector<std::vector<float>> read_alone() const {
    const PackageReader package(small_.folder());
    std::vector<std::vector<float>> all;
    for (const Cell cell : cells) all.push_back(read(package, cell));
    return all;
  }
  /// How many times a thread reads what is in the package, out of 4 × rounds.
  [[nodiscard]] int right_answers_of(const PackageReader& package) const {
    const std::vector<std::vector<float>> expected = read_alone();
    std::atomic<int> right = 0;
    in_many_threads([&](int thread) {
      for (int n = 0; n < rounds; ++n) {
        const auto place = static_cast<std::size_t>(n + thread) % cells.size();
        right += read(package, cells[place]) == expected[place] ? 1 : 0;
      }
    });
    return right;
  }

  SmallPackage small_{GetParam()};
};

TEST_P(PackageThreads, ShareAPackage) { EXPECT_EQ(right_answers_of(PackageReader(small_.folder())), 4 * rounds); }

TEST_P(PackageThreads, ShareAPackageWhoseBlocksComeAndGo) {
  PackageReader package(small_.folder());
  package.hold_at_most(1);
  EXPECT_EQ(right_answers_of(package), 4 * rounds);
}

TEST_P(PackageThreads, OpenAPackageEach) {
  const std::vector<std::vector<float>> expected = read_alone();
  std::atomic<int> right = 0;
  in_many_threads([&](int) {
    for (int n = 0; n < 10; ++n) {
      const PackageReader package(small_.folder());
      for (std::size_t place = 0; place < cells.size(); ++place) right += read(package, cells[place]) == expected[place] ? 1 : 0;
    }
  });
  EXPECT_EQ(right, 4 * 10 * static_cast<int>(cells.size()));
}

INSTANTIATE_TEST_SUITE_P(Kinds, PackageThreads, testing::Values(FarMapKind::box, FarMapKind::horizon),
                         [](const auto& test) { return scenes::name_of(test.param); });

}  // namespace
}  // namespace farlod

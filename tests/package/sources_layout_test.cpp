// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/sources_layout.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "package/manifest.hpp"

namespace farlod::package {
namespace {

/// A building drawn at random: numbers may be any that the types hold.
BuildingOrigin random_origin(std::mt19937_64& random) {
  const auto below = [&](std::uint64_t count) { return random() % count; };
  BuildingOrigin origin;
  const auto add_places = [&](std::vector<AttributePlace>& places, std::uint64_t count) {
    while (places.size() < count)
      places.push_back(
          {below(3) == 0 ? random() >> 4U : below(100'000), static_cast<std::uint32_t>(below(4) == 0 ? random() : below(3))});
  };
  add_places(origin.objects, 1 + below(4));
  add_places(origin.semantics, below(6));
  std::uint32_t surface = 0;
  for (std::uint64_t n = below(20); n > 0; --n) {
    surface += static_cast<std::uint32_t>(below(20) == 0 ? below(1'000'000'000) : below(3));
    SurfaceOrigin& added = origin.surfaces.emplace_back();
    added.surface = surface;
    added.object = static_cast<std::uint32_t>(below(origin.objects.size()));
    if (!origin.semantics.empty() && below(3) > 0) added.semantics = static_cast<std::uint32_t>(below(origin.semantics.size()));
  }
  return origin;
}

TEST(SourcesLayout, AnOriginComesBackFromItsBytes) {
  std::mt19937_64 random(1);
  for (int n = 0; n < 20'000; ++n) {
    const BuildingOrigin origin = random_origin(random);
    std::vector<std::uint8_t> bytes;
    append_origin(bytes, origin);
    ASSERT_EQ(origin_from(bytes), origin) << "the " << n << "th of the seed";
  }
}

TEST(SourcesLayout, BytesThatAreCutOrGoOnAreNoOrigin) {
  std::mt19937_64 random(2);
  for (int n = 0; n < 500; ++n) {
    std::vector<std::uint8_t> bytes;
    append_origin(bytes, random_origin(random));
    for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_FALSE(origin_from(std::span(bytes).first(size)).has_value());
    bytes.push_back(0);
    EXPECT_FALSE(origin_from(bytes).has_value());
  }
}

TEST(SourcesLayout, AnyBytesAreAnOriginOfWhatIsThereOrNone) {
  std::mt19937_64 random(3);
  std::size_t origins = 0;
  for (int n = 0; n < 200'000; ++n) {
    std::vector<std::uint8_t> bytes(random() % 24);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() % (random() % 8 == 0 ? 256 : 6));
    const std::optional<BuildingOrigin> origin = origin_from(bytes);
    if (!origin) continue;
    ++origins;
    ASSERT_FALSE(origin->objects.empty());
    for (std::size_t k = 0; k < origin->surfaces.size(); ++k) {
      const SurfaceOrigin& surface = origin->surfaces[k];
      ASSERT_LT(surface.object, origin->objects.size());
      ASSERT_TRUE(!surface.semantics || *surface.semantics < origin->semantics.size());
      ASSERT_TRUE(k == 0 || origin->surfaces[k - 1].surface <= surface.surface);
    }
  }
  EXPECT_GT(origins, 100U);
}

TEST(SourcesLayout, WhatFollowsTakesOneByte) {
  // 100 walls, each of a semantic surface of its own, 120 bytes from one to the next
  BuildingOrigin origin{{{1000, 1}}, {}, {}};
  for (std::uint32_t n = 0; n < 100; ++n) {
    origin.semantics.push_back({1100 + 120 * std::uint64_t{n}, 1});
    origin.surfaces.push_back({n, 0, n});
  }
  std::vector<std::uint8_t> bytes;
  append_origin(bytes, origin);
  EXPECT_LE(bytes.size(), 10U + 2U * 100U + 100U);
}

TEST(SourcesLayout, NumbersOfAllSizesComeBack) {
  std::vector<std::uint8_t> bytes;
  std::vector<std::uint64_t> numbers{0, 1, 127, 128, 16'383, 16'384, 0x7FFF'FFFF'FFFF'FFFF, 0xFFFF'FFFF'FFFF'FFFF};
  for (const std::uint64_t number : numbers) append_number(bytes, number);
  SourcesCursor cursor(bytes);
  for (const std::uint64_t number : numbers) EXPECT_EQ(cursor.number(), number);
  EXPECT_TRUE(cursor.at_end() && !cursor.failed());
  for (const std::uint64_t number : numbers) EXPECT_EQ(difference_of(unsigned_of(number)), number);
  EXPECT_EQ(unsigned_of(std::uint64_t{0} - 1), 1U);
  // One bit more than 64
  const std::vector<std::uint8_t> too_large{255, 255, 255, 255, 255, 255, 255, 255, 255, 2};
  SourcesCursor beyond(too_large);
  EXPECT_EQ(beyond.number(), 0U);
  EXPECT_TRUE(beyond.failed());
}

TEST(CellRuns, OfNeighborsIsOneRun) {
  const std::vector<std::size_t> places{0, 1, 2, 5, 7, 8};
  EXPECT_EQ(CellRuns::of(places), (CellRuns{{{0, 3}, {5, 6}, {7, 9}}}));
  EXPECT_EQ(CellRuns::of({}), CellRuns{});
}

/// A set of numbers says the same.
TEST(CellRuns, SayWhatASetSays) {
  std::mt19937 random(3);
  for (int n = 0; n < 50; ++n) {
    std::set<std::size_t> set;
    for (std::size_t k = random() % 40; k > 0; --k) set.insert(random() % 40);
    const std::vector<std::size_t> places(set.begin(), set.end());
    const CellRuns runs = CellRuns::of(places);
    EXPECT_EQ(runs.size(), set.size());
    EXPECT_EQ(runs.places(), places);
    std::size_t before = 0;
    for (std::size_t place = 0; place < 45; ++place) {
      EXPECT_EQ(runs.contains(place), set.contains(place)) << place;
      EXPECT_EQ(runs.count_before(place), before) << place;
      before += set.contains(place) ? 1 : 0;
    }
  }
}

TEST(CellRuns, TilesOfAPictureAreInOneColumn) {
  const CellRange cells{-1, 2, 2, 4};
  const std::vector<std::size_t> places{1, 3, 5};
  const std::optional<CellRuns> some = CellRuns::of(places);
  EXPECT_EQ(picture_tiles(cells, some).columns, 1);
  EXPECT_EQ(picture_tiles(cells, some).rows, 3);
  for (std::int32_t k = 0; k < 3; ++k) {
    const PictureTile tile = picture_tile(cells.cell_at(places[static_cast<std::size_t>(k)]), cells, some);
    EXPECT_EQ(tile.column, 0);
    EXPECT_EQ(tile.row, k);
  }
  EXPECT_EQ(picture_tiles(cells, std::nullopt).columns, 3);
  EXPECT_EQ(picture_tile({1, 3}, cells, std::nullopt).column, 2);
  EXPECT_EQ(picture_tile({1, 3}, cells, std::nullopt).row, 1);
}

}  // namespace
}  // namespace farlod::package

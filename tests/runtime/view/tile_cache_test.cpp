// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/tile_cache.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace farlod {
namespace {

TEST(TileCache, KeepsWhatWasAskedForLast) {
  TileCache cache(250);
  int made = 0;
  const auto get = [&](std::uint32_t x) {
    return cache.get({0, x, 0}, [&] {
      ++made;
      return std::string(100, static_cast<char>('a' + x));
    });
  };
  EXPECT_EQ(*get(0), std::string(100, 'a'));
  EXPECT_EQ(*get(1), std::string(100, 'b'));
  EXPECT_EQ(*get(0), std::string(100, 'a'));
  EXPECT_EQ(made, 2);
  const auto held = get(1);
  (void)get(0);
  (void)get(2);  // 1 goes
  EXPECT_EQ(made, 3);
  (void)get(0);
  EXPECT_EQ(made, 3);
  (void)get(1);
  EXPECT_EQ(made, 4);
  EXPECT_EQ(*held, std::string(100, 'b')) << "who holds a tile keeps it";
}

TEST(TileCache, OneMakesATileForAllWhoWait) {
  TileCache cache(1000);
  constexpr int clients = 8;
  std::atomic<int> made = 0;
  std::latch all_ask(clients);
  const auto make = [&] {
    ++made;
    all_ask.wait();
    return std::string("tile");
  };
  const auto ask = [&] {
    all_ask.count_down();
    EXPECT_EQ(*cache.get({}, make), "tile");
  };
  std::vector<std::jthread> asking;
  for (int n = 0; n < clients; ++n) asking.emplace_back(ask);
  asking.clear();
  EXPECT_EQ(made, 1);
}

TEST(TileCache, AfterAFailureTheNextOneTries) {
  TileCache cache(1000);
  EXPECT_THROW((void)cache.get({}, []() -> std::string { throw std::runtime_error("damaged"); }), std::runtime_error);
  EXPECT_EQ(*cache.get({}, [] { return std::string("mended"); }), "mended");
}

TEST(TileCache, ATileLargerThanAllIsGivenToo) {
  TileCache cache(10);
  EXPECT_EQ(cache.get({}, [] { return std::string(100, 'a'); })->size(), 100U);
}

}  // namespace
}  // namespace farlod

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "ingest/ordered/ordered_work.hpp"

#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include <numeric>
#include <stdexcept>
#include <vector>

namespace farlod::ingest {
namespace {

constexpr int pieces = 1'000;

TEST(OrderedWork, BeginsAndEndsInOrderWithinItsPlaces) {
  for (const int threads : {1, 4})
    oneapi::tbb::task_arena(threads).execute([&] {
      EXPECT_EQ(threads_here(), static_cast<std::size_t>(threads));
      std::vector<int> piece_at(3, -1), ended;
      int next = 0;
      const auto begin = [&](std::size_t place) {
        EXPECT_EQ(piece_at.at(place), -1) << "the place is free";
        if (next == pieces) return false;
        piece_at[place] = next++;
        return true;
      };
      const auto work = [&](std::size_t place) { piece_at[place] *= 2; };
      const auto end = [&](std::size_t place) {
        ended.push_back(piece_at[place] / 2);
        piece_at[place] = -1;
      };
      run_in_order(piece_at.size(), {begin, work, end});
      std::vector<int> all(pieces);
      std::iota(all.begin(), all.end(), 0);
      EXPECT_EQ(ended, all);
    });
}

TEST(OrderedWork, EndsWithWhatIsThrown) {
  const auto go_on = [](std::size_t) {};
  const auto fail = [](std::size_t) { throw std::runtime_error("no more"); };
  for (const int threads : {1, 4})
    oneapi::tbb::task_arena(threads).execute([&] {
      EXPECT_THROW(run_in_order(2, {[](std::size_t) -> bool { throw std::runtime_error("no more"); }, go_on, go_on}),
                   std::runtime_error);
      EXPECT_THROW(run_in_order(2, {[](std::size_t) { return true; }, fail, go_on}), std::runtime_error);
      EXPECT_THROW(run_in_order(2, {[](std::size_t) { return true; }, go_on, fail}), std::runtime_error);
    });
}

}  // namespace
}  // namespace farlod::ingest

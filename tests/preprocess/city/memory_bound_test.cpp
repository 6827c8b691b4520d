// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "base/paging/memory_bound.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "base/paging/paged_array.hpp"
#include "tests/preprocess/city/temporary_files.hpp"

namespace farlod {
namespace {

constexpr std::uint64_t mib = std::uint64_t{1} << 20;

std::uint64_t resident_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmRSS:")) return std::stoull(line.substr(6)) << 10;
  return 0;
}

/// Of a bound that looks only when it is told to: when its thread gets a core depends on what else the machine does.
constexpr std::chrono::hours never{1};

/// Writes to each page, some times over, and has the bound look after each mebibyte. Tells the most that files took of memory
/// meanwhile.
double most_file_mib(PagedArray<std::uint64_t>& numbers, int rounds) {
  constexpr std::size_t step = mib / sizeof(std::uint64_t);
  double most_mib = 0.0;
  for (int round = 0; round < rounds; ++round)
    for (std::size_t begin = 0; begin < numbers.size(); begin += step) {
      for (std::size_t n = begin; n < std::min(begin + step, numbers.size()); ++n) numbers[n] += n;
      MemoryBound::look_now();
      most_mib = std::max(most_mib, test::resident_file_mib());
    }
  return most_mib;
}

TEST(MemoryBound, LetsGoOfFilesNearTheLimitAndLosesNothing) {
  constexpr std::size_t count = 400 * mib / sizeof(std::uint64_t);
  PagedArray<std::uint64_t> numbers;
  numbers.resize(count);
  numbers.let_go();
  const double before_mib = test::resident_file_mib();
  {
    const MemoryBound bound(resident_bytes() + 192 * mib, {}, never);
    EXPECT_LT(most_file_mib(numbers, 3) - before_mib, 192.0);
    EXPECT_FALSE(bound.is_exceeded());
  }
  std::uint64_t wrong = 0;
  for (std::uint64_t n = 0; n < count; ++n) wrong += numbers[n] == 3 * n ? 0 : 1;
  EXPECT_EQ(wrong, 0U);
}

TEST(MemoryBound, KeepsFilesDownWithoutALimit) {
  PagedArray<std::uint64_t> numbers;
  numbers.resize(1000 * mib / sizeof(std::uint64_t));
  numbers.let_go();
  const double before_mib = test::resident_file_mib();
  const MemoryBound bound({}, {}, never);
  EXPECT_LT(most_file_mib(numbers, 1) - before_mib, 800.0);
}

TEST(MemoryBound, LeavesToFilesWhatTheWorkLeaves) {
  PagedArray<std::uint64_t> numbers;
  numbers.resize(400 * mib / sizeof(std::uint64_t));
  numbers.let_go();
  const double before_mib = test::resident_file_mib();
  const std::uint64_t limit = resident_bytes() + 2000 * mib;
  MemoryBound bound(limit, {}, never);
  bound.expect(limit - 300 * mib);
  EXPECT_LT(most_file_mib(numbers, 1) - before_mib, 200.0);
}

TEST(MemoryBound, AsksToStopWhereMemoryAloneExceedsTheLimit) {
  const std::uint64_t limit = resident_bytes() + 64 * mib;
  const MemoryBound bound(limit);  // which looks by itself
  EXPECT_FALSE(bound.stop().stop_requested());
  const std::vector<char> much(192 * mib, 'm');
  // For ever, where it does not: ctest has a limit
  while (!bound.stop().stop_requested()) std::this_thread::yield();
  EXPECT_TRUE(bound.is_exceeded());
  EXPECT_GT(bound.exceeded_at(), limit);
  EXPECT_EQ(much.back(), 'm');
}

TEST(MemoryBound, StopsWhenTheCallerAsks) {
  std::stop_source caller;
  const MemoryBound bound({}, caller.get_token());
  EXPECT_FALSE(bound.stop().stop_requested());
  caller.request_stop();
  EXPECT_TRUE(bound.stop().stop_requested());
  EXPECT_FALSE(bound.is_exceeded());
}

}  // namespace
}  // namespace farlod

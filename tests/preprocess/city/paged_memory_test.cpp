// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <string>
#include <vector>

#include "base/paging/memory_bound.hpp"
#include "base/paging/page_file.hpp"
#include "base/paging/paged_array.hpp"
#include "base/paging/paged_heap.hpp"
#include "base/paging/pages.hpp"
#include "tests/preprocess/city/temporary_files.hpp"
#include "tests/scenes/temporary_folder.hpp"

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

using Numbers = PagedArray<std::uint64_t>;
constexpr std::size_t few = 1000, many = 3 * Pages::least_on_disk / sizeof(std::uint64_t);

Numbers counted(std::size_t count) {
  Numbers numbers;
  for (std::uint64_t n = 0; n < count; ++n) numbers.push_back(n);
  return numbers;
}

void expect_counted(const Numbers& numbers, std::size_t count) {
  ASSERT_EQ(numbers.size(), count);
  std::uint64_t wrong = 0;
  for (std::uint64_t n = 0; n < count; ++n) wrong += numbers[n] == n ? 0 : 1;
  EXPECT_EQ(wrong, 0U);
}

TEST(PagedArray, HoldsWhatAVectorWould) {
  for (const std::size_t count : {std::size_t{0}, few, many}) {
    Numbers numbers = counted(count);
    expect_counted(numbers, count);
    const Numbers copy = numbers;
    numbers.resize(count / 2);
    expect_counted(numbers, count / 2);
    const Numbers moved = std::move(numbers);
    expect_counted(moved, count / 2);
    expect_counted(copy, count);
    EXPECT_TRUE(numbers.empty());  // NOLINT(bugprone-use-after-move): what moving leaves is promised
  }
}

TEST(PagedArray, AppendsAndGrowsWithZeros) {
  std::vector<std::uint64_t> some(many);
  std::iota(some.begin(), some.end(), 0U);
  Numbers numbers;
  numbers.append(some);
  expect_counted(numbers, many);
  numbers.resize(many + few);
  EXPECT_EQ(numbers.back(), 0U);
  numbers.push_back(numbers[7]);
  EXPECT_EQ(numbers.back(), 7U);
}

TEST(PagedArray, GivesTheMemoryOfALongOneBack) {
  const double before_mib = test::resident_file_mib();
  Numbers numbers = counted(many);
  const double all_mib = static_cast<double>(many * sizeof(std::uint64_t)) / 1048576.0;
  EXPECT_LT(test::resident_file_mib() - before_mib, 0.5 * all_mib) << "what is behind is let go";
  for (std::uint64_t& n : numbers) ++n;
  EXPECT_GT(test::resident_file_mib() - before_mib, 0.9 * all_mib);
  numbers.let_go(0, many / 2);
  EXPECT_LT(test::resident_file_mib() - before_mib, 0.6 * all_mib);
  numbers.let_go();
  EXPECT_LT(test::resident_file_mib() - before_mib, 0.1 * all_mib);
  for (std::uint64_t& n : numbers) --n;
  expect_counted(numbers, many);
}

TEST(PagedArray, LeavesNoFileBehind) {
  const scenes::TemporaryFolder folder;
  const test::TemporaryFiles files(folder.path());
  const double before_mib = test::resident_file_mib();
  const Numbers numbers = counted(many);
  expect_counted(numbers, many);
  EXPECT_GT(test::resident_file_mib(), before_mib + 1.0);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(PagedArray, StaysInMemoryWhereNoFileCanBeMade) {
  const test::TemporaryFiles files("/nowhere/at/all");
  const double before_mib = test::resident_file_mib();
  const Numbers numbers = counted(many);
  EXPECT_LT(test::resident_file_mib(), before_mib + 1.0);
  numbers.let_go();
  expect_counted(numbers, many);
}

using Piece = std::vector<std::uint64_t, PagedAllocator<std::uint64_t>>;
constexpr std::size_t piece_bytes = std::size_t{1} << 20;
constexpr double bytes_per_mib = 1048576.0;

/// Each with numbers of its own.
std::vector<Piece> filled_pieces(std::size_t count) {
  std::vector<Piece> pieces;
  for (std::uint64_t n = 0; n < count; ++n) {
    pieces.emplace_back(piece_bytes / sizeof(std::uint64_t));
    std::iota(pieces.back().begin(), pieces.back().end(), n << 32);
  }
  return pieces;
}

void expect_filled(const std::vector<Piece>& pieces) {
  std::uint64_t wrong = 0;
  for (std::uint64_t n = 0; n < pieces.size(); ++n)
    for (std::uint64_t k = 0; k < pieces[n].size(); ++k) wrong += pieces[n][k] == (n << 32) + k ? 0 : 1;
  EXPECT_EQ(wrong, 0U);
}

TEST(PagedHeap, KeepsOnDiskWhatIsBeyondTheFirst) {
  ASSERT_EQ(PagedHeap::bytes_on_disk(), 0U);
  constexpr std::size_t few = Pages::least_on_disk / piece_bytes, many = 6 * few;
  std::vector<Piece> pieces = filled_pieces(few);
  EXPECT_EQ(PagedHeap::bytes_on_disk(), 0U);
  pieces = filled_pieces(many);
  EXPECT_GE(PagedHeap::bytes_on_disk(), (many - few) * piece_bytes);
  EXPECT_LT(PagedHeap::bytes_on_disk(), 2 * many * piece_bytes);
  expect_filled(pieces);
  const double all_mib = static_cast<double>((many - few) * piece_bytes) / bytes_per_mib, filled_mib = test::resident_file_mib();
  PageFile::let_go_of_all();
  EXPECT_LT(test::resident_file_mib(), filled_mib - 0.8 * all_mib);
  expect_filled(pieces);
  pieces.clear();
  EXPECT_EQ(PagedHeap::bytes_on_disk(), 0U);
}

TEST(PagedHeap, StaysInMemoryWhereNoFileCanBeMade) {
  const test::TemporaryFiles files("/nowhere/at/all");
  const std::vector<Piece> pieces = filled_pieces(40);
  EXPECT_EQ(PagedHeap::bytes_on_disk(), 0U);
  PageFile::let_go_of_all();
  expect_filled(pieces);
}

}  // namespace
}  // namespace farlod

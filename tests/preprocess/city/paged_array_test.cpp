// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "base/paging/paged_array.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <numeric>
#include <vector>

#include "tests/preprocess/city/temporary_files.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

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

}  // namespace
}  // namespace farlod

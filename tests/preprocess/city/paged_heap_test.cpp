// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "base/paging/paged_heap.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <vector>

#include "base/paging/page_file.hpp"
#include "base/paging/pages.hpp"
#include "tests/preprocess/city/temporary_files.hpp"

namespace farlod {
namespace {

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

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <thread>
#include <vector>

#include "package/package_reader.hpp"
#include "tests/package/small_package.hpp"

// A package may be asked from many threads, also while blocks come and go. ThreadSanitizer runs these tests.

namespace farlod {
namespace {

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

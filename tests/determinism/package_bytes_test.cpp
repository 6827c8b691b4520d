// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>

#include "farmap/far_map_baker.hpp"
#include "package/package_writer.hpp"
#include "tests/determinism/crooked_town.hpp"
#include "tests/determinism/threads.hpp"

// Same input and settings, same bytes.

namespace farlod {
namespace {

using Files = std::map<std::string, std::string>;

/// Each file below a folder, with its bytes.
Files files_in(const std::filesystem::path& folder) {
  Files files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream file(entry.path(), std::ios::binary);
    files[entry.path().lexically_relative(folder).string()] = {std::istreambuf_iterator<char>(file), {}};
  }
  return files;
}

Files package_made_with(std::size_t threads, FarMapKind kind, Assign assign) {
  const scenes::TemporaryFolder folder;
  with_threads(threads, [&] {
    scenes::pack_city(crooked_town(), crooked_grid(), folder.path() / "town.farlod", scenes::small_maps(kind), assign);
  });
  return files_in(folder.path());
}

/// Names of the files that differ; a dump of bytes would help nobody.
std::vector<std::string> differences(const Files& a, const Files& b) {
  std::vector<std::string> names;
  for (const auto& [name, bytes] : a)
    if (!b.contains(name) || b.at(name) != bytes) names.push_back(name);
  for (const auto& [name, bytes] : b)
    if (!a.contains(name)) names.push_back(name);
  return names;
}

class PackageBytes : public testing::TestWithParam<FarMapKind> {};

TEST_P(PackageBytes, DoNotDependOnTheNumberOfThreads) {
  for (const Assign assign : {Assign::clip, Assign::whole}) {
    const Files alone = package_made_with(1, GetParam(), assign);
    EXPECT_GT(alone.size(), 10U) << "too few blocks to tell";
    for (int n = 0; n < repeats; ++n)
      EXPECT_EQ(differences(alone, package_made_with(many_threads, GetParam(), assign)), std::vector<std::string>());
  }
}

Files blocks_written_in(const std::vector<Block>& order, FarMapKind kind) {
  const Grid grid = crooked_grid();
  Report report;
  const TileSet tiles = tiles::cut_into_tiles({crooked_town(), {}}, grid, Assign::clip, std::nullopt, report);
  const FarMapSettings settings = scenes::small_maps(kind);
  const FarMapBaker baker(tiles, grid, Assign::clip, settings);
  const scenes::TemporaryFolder folder;
  PackageWriter writer(folder.path() / "town.farlod");
  for (const Block block : order) (void)writer.write_block(tiles, baker.bake(block), grid, block, shape_of(settings));
  return files_in(folder.path());
}

TEST_P(PackageBytes, DoNotDependOnTheOrderOfBlocks) {
  std::vector<Block> blocks = crooked_grid().blocks();
  const Files forwards = blocks_written_in(blocks, GetParam());
  std::reverse(blocks.begin(), blocks.end());
  EXPECT_EQ(differences(forwards, blocks_written_in(blocks, GetParam())), std::vector<std::string>());
}

INSTANTIATE_TEST_SUITE_P(Kinds, PackageBytes, testing::Values(FarMapKind::box, FarMapKind::horizon),
                         [](const auto& test) { return scenes::name_of(test.param); });

}  // namespace
}  // namespace farlod

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "generator/plan_frame.hpp"
#include "tests/counted/held_memory.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

namespace fs = std::filesystem;

struct CityRun {
  double buildings, held_bytes;
};

/// Makes a city in a process of its own, which tells the most that it has held at a time.
CityRun make_city(const fs::path& folder, const std::string& file, int size_m) {
  const std::string command = "cd '" + folder.string() + "' && LD_PRELOAD='" + FARLOD_HELD_MEMORY_LIBRARY +
                              "' FARLOD_HELD_MEMORY=held '" + FARLOD_BIN_DIR + "/farlod-city' --quiet --overhangs -o " + file +
                              " --size " + std::to_string(size_m) + " --summary summary.json";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  std::ifstream text(folder / "summary.json"), held(folder / "held");
  CityRun run{nlohmann::json::parse(text).at("buildings"), 0.0};
  held >> run.held_bytes;
  EXPECT_TRUE(held);
  return run;
}

/// Whoever kept a city in memory would keep its corners at least, and no building has fewer than eight.
constexpr double least_bytes_of_a_kept_building = 8.0 * sizeof(PointMm);

class Memory : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Formats, Memory, ::testing::Values("c.gml", "c.city.json", "c.obj", "c.geojson"));

TEST_P(Memory, DoesNotGrowWithTheCity) {
  if (!HeldMemory::counts_malloc) GTEST_SKIP() << "a sanitizer has a malloc of its own";
  const scenes::TemporaryFolder folder;
  // Both cities are large enough to fill the writers' buffers, which are of fixed size
  const CityRun small = make_city(folder.path(), GetParam(), 3000), large = make_city(folder.path(), GetParam(), 5000);
  ASSERT_GT(large.buildings, 2.0 * small.buildings);
  EXPECT_LT(large.held_bytes - small.held_bytes, least_bytes_of_a_kept_building * (large.buildings - small.buildings));
  RecordProperty("growth_bytes", std::to_string(large.held_bytes - small.held_bytes));
}

}  // namespace
}  // namespace farlod

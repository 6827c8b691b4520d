// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "package/manifest.hpp"
#include "tests/counted/steps.hpp"
#include "tests/package/small_package.hpp"
#include "tests/scenes/sealed_manifest.hpp"

namespace farlod {
namespace {

using nlohmann::json;

/// Steps of reading a manifest with a list of so many entries.
std::uint64_t steps_of_reading(std::size_t entries) {
  const SmallPackage small;
  json m = small.manifest();
  m["weather"] = json::array();
  for (std::size_t n = 0; n < entries; ++n) m["weather"].push_back(json::object());
  const std::string text = scenes::sealed(m.dump(1) + "\n");
  const CountedSteps steps;
  (void)manifest_from_text(text, "manifest.json");
  return steps.count();
}

TEST(Package, ManifestsAreReadInStepsThatGrowWithTheirLength) {
  // A reader that walks through a list for each of its entries takes the square: 64 times as many
  const std::uint64_t of_few = steps_of_reading(5'000), of_many = steps_of_reading(40'000);
  EXPECT_GT(of_few, 5'000U) << "nothing is counted";
  EXPECT_LT(of_many, 10 * of_few);
}

}  // namespace
}  // namespace farlod

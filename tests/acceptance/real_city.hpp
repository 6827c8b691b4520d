// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/acceptance/work_folder.hpp"
#include "tests/scenes/test_data.hpp"

namespace farlod::acceptance {

/// What farlod-pack said of a city.
struct PackedCity {
  nlohmann::json summary;
  std::map<int, std::size_t> problems;     ///< entries of the report by code
  std::map<int, std::size_t> told_counts;  ///< sums of the first number in each entry's detail, by code
  std::optional<double> held_mib;          ///< WorkFolder::held_mib() of packing

  [[nodiscard]] std::size_t count(const std::string& key) const { return summary.at(key).get<std::size_t>(); }
};

/// A test on data that is not part of the project.
class RealCity : public testing::Test {
 protected:
  /// The path of a file of the test data; the test is skipped by `needs` when it is not there.
  [[nodiscard]] static std::string data(const std::string& name) { return scenes::test_data(name).string(); }
  void needs(const std::vector<std::string>& names) const {
    for (const std::string& name : names)
      if (!std::filesystem::exists(data(name))) GTEST_SKIP() << scenes::absence_of(data(name));
  }
  /// Packs with default settings.
  [[nodiscard]] PackedCity pack(const std::string& arguments) const;
  /// Evaluates a map of 10 m of what was packed, and compares some of it with exact answers.
  void expect_sound_map() const;

  WorkFolder folder;
};

}  // namespace farlod::acceptance

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/acceptance/real_city.hpp"

#include <cmath>

#include "tests/acceptance/packed_town.hpp"

namespace farlod::acceptance {
namespace {

std::size_t first_number_in(const std::string& text) {
  const std::size_t place = text.find_first_of("0123456789");
  return place == std::string::npos ? 0 : std::stoul(text.substr(place));
}

}  // namespace

PackedCity RealCity::pack(const std::string& arguments) const {
  const std::optional<double> held_mib =
      folder.held_mib("farlod-pack " + arguments + " -o a.farlod --summary pack.json --report report.json --quiet");
  PackedCity city{folder.json_of("pack.json"), {}, {}, held_mib};
  for (const nlohmann::json& entry : folder.json_of("report.json")) {
    ++city.problems[entry.at("code")];
    city.told_counts[entry.at("code")] += first_number_in(entry.at("detail"));
  }
  return city;
}

void RealCity::expect_sound_map() const {
  folder.must("farlod-svf a.farlod -o map.asc --grid 10 --verify 100 --summary svf.json --quiet");
  const nlohmann::json summary = folder.json_of("svf.json");
  EXPECT_GT(summary.at("receivers"), 0);
  EXPECT_LE(summary.at("svf").at("max"), 1.0);
  EXPECT_GE(summary.at("svf").at("min"), 0.0);
  EXPECT_LT(summary.at("verify").at("max_abs_error"), paper_error);
  EXPECT_LT(std::abs(summary.at("verify").at("bias").get<double>()), 0.1 * paper_error);
}

}  // namespace farlod::acceptance

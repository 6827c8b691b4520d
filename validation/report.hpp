// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "validation/alignment_study.hpp"
#include "validation/city_study.hpp"
#include "validation/error_shares.hpp"

namespace farlod::validation {

/// All that was measured in one city.
struct CityResults {
  CityStudy far_field;
  std::vector<SamplingRow> sampling;
  AlignmentStudy alignment;
};

struct Results {
  Extent extent;
  std::vector<CityResults> cities;
  std::vector<CityStudy> models;  ///< cells of 50 m, N = 3
  bool lacks_real_cities = false;
  std::string city_of_settings;
  std::vector<SettingRow> settings;
};

/// The tables behind docs/validation.md, in Markdown; their plots go to a folder, to which the text refers as `figures/`.
[[nodiscard]] std::string markdown(const Results& results);
void write_plots(const Results& results, const std::filesystem::path& folder);

}  // namespace farlod::validation

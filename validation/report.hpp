// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "validation/city_study.hpp"
#include "validation/error_shares.hpp"

namespace farlod::validation {

/// The grid turned away from the streets, at cells of 50 m, N = 3, around the middle of the city.
struct TurnedRow {
  double turn_deg = 0.0;
  ErrorSummary box, horizon;
  double box_bytes_a_cell = 0.0, bytes_a_cell = 0.0, bake_ms_a_cell = 0.0;
};

/// What another grid changes in answers of the kind `horizon`, all with the same rays.
struct MovedGrid {
  double mean_change = 0.0, max_change = 0.0;
  double max_stated = 0.0;  ///< the largest error that the bounds of the two grids together allow
  std::size_t beyond = 0;   ///< receivers that change by more than their own bounds allow
};

struct AlignmentStudy {
  std::vector<TurnedRow> turned;
  MovedGrid by_a_third_of_a_cell, turned_by_10_deg;
};
[[nodiscard]] AlignmentStudy study_alignment(const StudiedCity& city, const Extent& extent);

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

/// The tables behind docs/validation.md, in Markdown.
[[nodiscard]] std::string markdown(const Results& results);

}  // namespace farlod::validation

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "validation/city_study.hpp"

namespace farlod::validation {

/// Errors of the sampling of the sky alone: the engine `exact` against itself with many more rays.
struct SamplingRow {
  std::size_t rays = 0;
  ErrorSummary ground, roofs, facades;                    ///< cosine
  ErrorSummary ground_solid, roofs_solid, facades_solid;  ///< --sky solid

  [[nodiscard]] std::array<const ErrorSummary*, 6> all() const {
    return {&ground, &roofs, &facades, &ground_solid, &roofs_solid, &facades_solid};
  }
};
[[nodiscard]] std::vector<SamplingRow> study_sampling(const StudiedCity& city, const StudySites& sites, const Extent& extent);

/// The largest max_abs_error · rays^(3/4) of all rows: to compare with sampling_error_factor.
[[nodiscard]] double sampling_constant(const std::vector<SamplingRow>& rows);

/// Far maps of the kind `horizon` with one setting changed, at cells of 50 m, N = 3, around the middle of the city.
struct SettingRow {
  std::string setting, value;
  bool is_default = false;
  ErrorSummary ground, facades;  ///< with the rays of the reference
  BoundsSummary ground_bounds;
  double bytes_a_cell = 0.0, bake_ms_a_cell = 0.0;
};
[[nodiscard]] std::vector<SettingRow> study_settings(const StudiedCity& city, const Extent& extent);

}  // namespace farlod::validation

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "benchmark/contest.hpp"

namespace farlod::benchmark {

/// A line sweep over the whole city's raster at so many azimuths.
struct SweepRow {
  std::size_t azimuths = 0;
  Errors errors;  ///< at the receivers of the ground contest that have a pixel without a building
  double seconds = 0.0;
};
struct SweepStudy {
  double pixel_m = 0.0, raster_s = 0.0;  ///< making the raster is not part of a row's time
  std::size_t pixels = 0, receivers = 0, compared = 0;
  std::vector<SweepRow> rows;
};
[[nodiscard]] SweepStudy study_sweep(const City& city, const Extent& extent);

}  // namespace farlod::benchmark

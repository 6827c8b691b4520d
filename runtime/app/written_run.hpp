// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/svf_options.hpp"
#include "farlod/evaluation.hpp"
#include "farlod/package.hpp"
#include "farlod/run.hpp"

namespace farlod {

/// What became of a run whose results are in files.
struct WrittenRun {
  EvaluationSummary summary;
  std::vector<std::filesystem::path> files = {};
  double open_s = 0.0;
  double write_s = 0.0;                           ///< besides EvaluationSeconds::deliver
  std::vector<std::string> further_columns = {};  ///< names of the further quantities
  std::vector<std::string> notes = {};            ///< what the user should know of how the points were read, a sentence each
  std::size_t skipped_features = 0;               ///< of the file of points, which are no points
};

/// The three kinds of run: each evaluates and writes its files. They throw what the library throws, and PointsError.
[[nodiscard]] WrittenRun write_raster(const Package& package, const SvfOptions& options, RunSettings run);
[[nodiscard]] WrittenRun write_points(const Package& package, const SvfOptions& options, RunSettings run);
[[nodiscard]] WrittenRun write_surfaces(const Package& package, const SvfOptions& options, const RunSettings& run);
/// The sky above --at, as a picture. Throws InputError where there is no answer.
[[nodiscard]] WrittenRun write_sky(const Package& package, const SvfOptions& options, const RunSettings& run);

/// "svf" or "svf_solid": never one ambiguous name.
[[nodiscard]] std::string quantity_name(SkyWeight weight);

}  // namespace farlod

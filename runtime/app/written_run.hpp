// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/svf_options.hpp"
#include "farlod/evaluation.hpp"
#include "farlod/package.hpp"
#include "farlod/quantities.hpp"
#include "farlod/run.hpp"
#include "farlod/surfaces.hpp"
#include "farlod/view_factor_matrix.hpp"
#include "farlod/weather.hpp"
#include "results/picture/error_map.hpp"

namespace farlod {

/// What became of a matrix of view factors.
struct WrittenMatrix {
  std::size_t surfaces = 0, columns = 0, entries = 0;
  double threshold = 0.0;
  MatrixFigures figures;
  double seconds = 0.0;
};

/// What became of a run whose results are in files.
struct WrittenRun {
  EvaluationSummary summary;
  std::vector<std::filesystem::path> files = {};
  double output_bytes = 0.0;  ///< of a dry run: how large they would be, more or less
  double open_s = 0.0;
  double write_s = 0.0;                                 ///< besides EvaluationSeconds::deliver
  std::vector<ColumnDescription> further_columns = {};  ///< of the further quantities
  std::vector<std::string> notes = {};       ///< what the user should know of how the points were read, a sentence each
  std::size_t skipped_features = 0;          ///< of the file of points, which are no points
  std::optional<GreyMap> grey_map = {};      ///< of a raster, if a map of its errors is asked for
  std::optional<PeriodLight> light = {};     ///< what is known of it, but for its intervals, if any is asked for
  std::optional<WrittenMatrix> matrix = {};  ///< if one is asked for
};

/// No receiver has an answer: nothing is written.
class NoAnswer : public InputError {
 public:
  using InputError::InputError;
};

/// The three kinds of run: each evaluates and writes its files. They throw what the library throws, PointsError and NoAnswer.
[[nodiscard]] WrittenRun write_raster(const Package& package, const SvfOptions& options, RunSettings run);
[[nodiscard]] WrittenRun write_points(const Package& package, const SvfOptions& options, RunSettings run);
[[nodiscard]] WrittenRun write_surfaces(const Package& package, const SvfOptions& options, const RunSettings& run);
/// The matrix of view factors between surfaces that have these means: evaluates it, and writes its file.
[[nodiscard]] WrittenMatrix write_matrix(const Package& package, const SvfOptions& options, const SurfaceMeans& means,
                                         const RunSettings& run);
/// The sky above --at, as a picture. Throws InputError where there is no answer.
[[nodiscard]] WrittenRun write_sky(const Package& package, const SvfOptions& options, const RunSettings& run);

/// The option that says where receivers are, without its dashes.
[[nodiscard]] const char* option_of_place(const SvfOptions& options);

/// Throws NoAnswer where no receiver has an answer: says where the receivers are, and where the city is.
void require_answers(const EvaluationSummary& summary, const SvfOptions& options, const PackageDescription& city);

/// Calls `work`, and returns its seconds.
template <class Work>
double seconds_of(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// "svf" or "svf_solid": never one ambiguous name.
[[nodiscard]] std::string quantity_name(SkyWeight weight);

}  // namespace farlod

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "app/light_options.hpp"
#include "app/quantity_options.hpp"
#include "console/run_options.hpp"
#include "farlod/box.hpp"
#include "farlod/evaluation.hpp"
#include "farlod/shard.hpp"
#include "farlod/surfaces.hpp"
#include "farlod/view_factor_matrix.hpp"
#include "inputs/requested_points.hpp"
#include "results/output_format.hpp"
#include "results/picture/sky_picture.hpp"

namespace farlod {

/// Where the receivers are: exactly one of these.
enum class ReceiverSource { grid, points, lines, surfaces, at };

/// The command line of farlod-svf, resolved.
struct SvfOptions {
  std::filesystem::path package, output;
  const OutputFormat* format = nullptr;          ///< of `output`; once the options are resolved, null for a city file alone
  const OutputFormat* preview_format = nullptr;  ///< of `preview_file`; null when there is none
  const OutputFormat* verify_format = nullptr;   ///< of `verify_file`, a picture or a table; null when there is none
  ReceiverSource source = ReceiverSource::grid;
  double grid_step_m = 0.0;
  std::filesystem::path grid_like;    ///< a raster whose pixels are the receivers; empty: pixels of `grid_step_m`
  bool own_pixels = false;            ///< those of the raster that the city is are the receivers
  std::filesystem::path points_file;  ///< of points, or of lines
  std::string points_crs, points_layer;
  SurfaceSettings surfaces;
  std::filesystem::path city_file;    ///< or a folder: what comes back with the values of surfaces; empty: tables are written
  std::filesystem::path matrix_file;  ///< of view factors between surfaces; empty: none is computed
  MatrixSettings matrix;
  std::filesystem::path energyplus_file;  ///< of what surfaces see, for EnergyPlus; empty: none
  RequestedPoint at;
  Placing placing;
  std::optional<Box2d> bbox_projected;
  std::filesystem::path mask_file;    ///< of polygons; empty: no mask
  EvaluationSettings evaluation;      ///< but for the sun and its light, which depend on where the package is
  std::optional<SunPeriod> sunshine;  ///< when hours of sunshine are counted, if they are
  bool names_quantities = false;      ///< whether any are asked for: else a city with trees has svf_total, too
  std::string drawn_quantity;         ///< that a picture of a raster shows; empty: nobody named any
  std::optional<LightSource> light;   ///< where the light of a period comes from, if any is asked for
  std::string preview_file, verify_file, histogram_file;
  SkyProjection projection = SkyProjection::equal_area;
  std::optional<std::uint64_t> memory_limit_mib;
  bool resume = false, merge = false;
  std::optional<Shard> shard;
  RunOptions run;

  [[nodiscard]] bool city_is_folder() const {
    std::error_code error;
    return std::filesystem::is_directory(city_file, error);
  }
  /// Estimates write nothing, and shards leave that to whoever merges them.
  [[nodiscard]] bool writes() const { return !evaluation.dry_run && !shard; }
  /// Whether the answers of a run that is interrupted are kept: single places and estimates take no time.
  [[nodiscard]] bool keeps_answers() const { return !evaluation.dry_run && source != ReceiverSource::at; }
};

/// The options, or the exit code when there is nothing to do (help, version) or the command line is wrong; what there is
/// to say has been said then.
struct ParsedSvfOptions {
  std::optional<SvfOptions> options;
  int exit_code = 0;
};
[[nodiscard]] ParsedSvfOptions parse_svf_options(int argc, char** argv);

/// Hands over the command line, from which the completions are made.
void describe_svf_options(const CommandLineVisitor& visit);

}  // namespace farlod

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/enriched_city.hpp"

#include <chrono>
#include <system_error>

#include "app/run_histogram.hpp"
#include "farlod/error.hpp"
#include "farlod/surfaces.hpp"
#include "results/city/enriched_city_file.hpp"
#include "results/spool_file.hpp"

namespace farlod {
namespace {

/// Asked before the work, which may take hours.
void require_writable(const SvfOptions& options) {
  std::error_code does_not_exist;
  if (std::filesystem::equivalent(options.output, options.city_file, does_not_exist))
    throw OutputError(options.output, "it is the file of --city; choose another name");
  const SpoolFile probe(options.output);
}

}  // namespace

WrittenRun write_enriched_city(const Package& package, const SvfOptions& options, const RunSettings& run) {
  require_writable(options);
  const EnrichedCityFile city(package, options.package.string(), options.city_file,
                              {quantity_name(options.evaluation.weight), BoundsColumns::no,
                               column_descriptions_of(options.evaluation.further)});
  city.require_fitting(options.output);
  RunHistogram histogram(options);
  const OnSurfacePoints count = [&histogram](std::size_t, std::span<const SurfacePoint> points) { histogram.add(points); };
  const SurfaceMeans means =
      evaluate_surfaces(package, options.surfaces, options.evaluation, histogram.is_wanted() ? count : OnSurfacePoints{}, run);
  WrittenRun written{means.summary};
  written.output_bytes = static_cast<double>(std::filesystem::file_size(options.city_file));
  if (!options.writes()) return written;
  written.files = {options.output};
  const auto start = std::chrono::steady_clock::now();
  written.notes = city.write(package, means, options.output);
  histogram.write(options);
  written.write_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return written;
}

}  // namespace farlod

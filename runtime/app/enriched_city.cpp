// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/enriched_city.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <system_error>

#include "app/run_histogram.hpp"
#include "farlod/error.hpp"
#include "farlod/inspection.hpp"
#include "farlod/surfaces.hpp"
#include "results/city/enriched_city_file.hpp"
#include "results/provenance.hpp"
#include "results/spool_file.hpp"

namespace farlod {
namespace {

/// The numbers of surfaces hold for the file that was packed, and for no later version of it.
void require_packed(const Package& package, const SvfOptions& options) {
  const std::string file = options.city_file.string(), digits = xxh3_of_file(options.city_file);
  if (digits.empty()) throw InputError(file + " cannot be read");
  const auto is_file = [&](const PackedInput& input) { return fmt::format("{:016x}", input.xxh3) == digits; };
  if (std::ranges::none_of(inventory_of(package).inputs, is_file))
    throw InputError(file + " is not a file that " + options.package.string() +
                     " was made of: its checksum is not in the manifest. Give the file as it was packed, or pack this one.");
}

/// Asked before the work, which may take hours.
void require_writable(const SvfOptions& options) {
  std::error_code does_not_exist;
  if (std::filesystem::equivalent(options.output, options.city_file, does_not_exist))
    throw OutputError(options.output, "it is the file of --city; choose another name");
  const SpoolFile probe(options.output);
}

}  // namespace

WrittenRun write_enriched_city(const Package& package, const SvfOptions& options, RunSettings run) {
  require_packed(package, options);
  require_writable(options);
  const EnrichedCityFile city(options.city_file, {quantity_name(options.evaluation.weight), BoundsColumns::no,
                                                  column_descriptions_of(options.evaluation.further)});
  city.require_fitting(options.output);
  run.caller_bytes = city.bytes();
  RunHistogram histogram(options);
  const OnSurfacePoints count = [&histogram](std::size_t, std::span<const SurfacePoint> points) { histogram.add(points); };
  const SurfaceMeans means =
      evaluate_surfaces(package, options.surfaces, options.evaluation, histogram.is_wanted() ? count : OnSurfacePoints{}, run);
  WrittenRun written{means.summary};
  written.output_bytes = static_cast<double>(std::filesystem::file_size(options.city_file));
  if (!options.writes()) return written;
  written.files = {options.output};
  const auto start = std::chrono::steady_clock::now();
  const auto extent = options.evaluation.region ? EnrichedExtent::part_of_the_city : EnrichedExtent::whole_buildings;
  written.notes = city.write(means, extent, options.output);
  histogram.write(options);
  written.write_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return written;
}

}  // namespace farlod

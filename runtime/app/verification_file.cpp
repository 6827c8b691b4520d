// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/verification_file.hpp"

#include <string>
#include <utility>

#include "results/picture/error_map.hpp"
#include "results/picture/plan_background.hpp"
#include "results/table/verification_csv.hpp"

namespace farlod {
namespace {

void write_map(const Package& package, const SvfOptions& options, std::size_t threads, const WrittenRun& written) {
  const PackageDescription& city = package.description();
  const EvaluationSummary& run = written.summary;
  const GreyMap map = written.grey_map ? *written.grey_map : map_around(run.verified, city.outline_projected);
  const ErrorMapCaption caption{quantity_name(options.evaluation.weight),
                                city.epsg ? "EPSG:" + std::to_string(*city.epsg) : city.crs_name};
  const PlanBackground background = plan_background(package, map.plan(), threads);
  write_drawing(draw_error_map(map, background.outlines, run.verified, *run.errors, caption), options.verify_file);
}

}  // namespace

void write_verification(const Package& package, const SvfOptions& options, std::size_t threads, WrittenRun& written) {
  written.write_s += seconds_of([&] {
    if (options.verify_format->is_picture)
      write_map(package, options, threads, written);
    else
      write_verification_csv(written.summary.verified, quantity_name(options.evaluation.weight), options.verify_file);
  });
  written.files.emplace_back(options.verify_file);
}

}  // namespace farlod

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/matrix_options.hpp"

#include <CLI/CLI.hpp>

#include "console/option_list.hpp"

namespace farlod {

void add_matrix_options(CLI::App& app, SvfOptions& o) {
  auto* const matrix =
      app.add_option(
             "--matrix", o.matrix_file,
             "With --surfaces: also write the view factors between surfaces, and from them to the ground of each cell, the "
             "sky and crowns, as this sparse matrix (NPZ of SciPy), by --rays that see the whole city")
          ->type_name(file_value)
          ->group("Output");
  app.add_option("--matrix-threshold", o.matrix.threshold,
                 "View factors below it are no entries of --matrix, but their sum is: the column \"dropped\"")
      ->check(between(0.0, 1.0))
      ->capture_default_str()
      ->needs(matrix)
      ->group("Output");
}

void resolve_matrix(const SvfOptions& o) {
  if (o.matrix_file.empty()) return;
  const auto refuse = [](const char* why) { throw CLI::ValidationError("--matrix", why); };
  if (o.source != ReceiverSource::surfaces) refuse("it goes with --surfaces");
  if (o.matrix_file.extension() != ".npz") refuse("the matrix is written as NPZ: choose a name that ends in .npz");
  if (!o.city_file.empty())
    refuse("its rows are those of a table of surfaces, which --city does not write: leave one of the two out");
  if (o.evaluation.weight != SkyWeight::cosine) refuse("view factors are weighted by the cosine: leave --sky out");
  if (o.evaluation.dry_run) refuse("--dry-run does not tell what it takes: leave one of the two out");
  if (o.shard) refuse("shards compute sky view factors alone: give it with --merge");
}

}  // namespace farlod

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/matrix_options.hpp"

#include <CLI/CLI.hpp>

#include "base/lower_case.hpp"
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
  app.add_option("--energyplus", o.energyplus_file,
                 "With --surfaces: also write what each of them sees as objects of EnergyPlus (IDF: "
                 "SurfaceProperty:SurroundingSurfaces), by --quantity view_factors")
      ->type_name(file_value)
      ->group("Output");
}

namespace {

void resolve_energyplus(SvfOptions& o) {
  if (o.energyplus_file.empty()) return;
  const auto refuse = [](const char* why) { throw CLI::ValidationError("--energyplus", why); };
  if (o.source != ReceiverSource::surfaces) refuse("it goes with --surfaces");
  if (lower_case(o.energyplus_file.extension().string()) != ".idf")
    refuse("EnergyPlus reads IDF: choose a name that ends in .idf");
  if (!o.city_file.empty()) refuse("it goes with a table of surfaces, not with --city: leave one of the two out");
  if (o.evaluation.weight != SkyWeight::cosine) refuse("view factors are weighted by the cosine: leave --sky out");
  if (o.shard) refuse("shards compute sky view factors alone: give it with --merge");
  if (o.evaluation.further.wall_sectors != Quantities().wall_sectors)
    refuse("its objects have walls by four azimuths: leave --wall-sectors out");
  o.evaluation.further.view_factors = true;
}

}  // namespace

void resolve_matrix(SvfOptions& o) {
  resolve_energyplus(o);
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

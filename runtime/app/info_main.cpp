// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "app/city_scenery.hpp"
#include "app/info_options.hpp"
#include "app/package_facts.hpp"
#include "console/named_files.hpp"
#include "console/run_program.hpp"
#include "farlod/error.hpp"
#include "farlod/morphology.hpp"
#include "farlod/raster.hpp"
#include "farlod/version.hpp"
#include "results/mesh/mesh_file.hpp"
#include "results/output_format.hpp"
#include "results/picture/cell_picture.hpp"
#include "results/table/morphology_table.hpp"
#ifdef FARLOD_WITH_GDAL
#include "results/gdal_files.hpp"
#endif

namespace farlod {
namespace {

using Clock = std::chrono::steady_clock;

/// The name alone, also where the user writes a slash behind it.
std::string name_of(const std::filesystem::path& package) {
  return (package.has_filename() ? package : package.parent_path()).filename().string();
}

/// A cell that is not there is a wrong input: nobody knows the cells by heart.
void require_cell(const PackageInventory& inventory, CellPlace cell, const InfoOptions& options) {
  const CellRectangle& all = inventory.cells;
  if (all.contains(cell)) return;
  throw InputError(fmt::format("{} has no cell {},{}: i goes from {} to {}, j from {} to {}.", options.package.string(), cell.i,
                               cell.j, all.i_begin, all.i_end - 1, all.j_begin, all.j_end - 1));
}

PackageCheck check(const Package& package, const InfoOptions& options) {
  ProgressLine progress("check", options.run.verbosity);
  RunSettings run;
  run.threads = thread_count(options.run);
  run.on_progress = [&progress](const Progress& p) { progress.update(p.done, p.all); };
  return check_package(package, run);
}

PackageFacts facts_of(const Package& package, const InfoOptions& options) {
  PackageFacts facts{
      name_of(options.package), package.description(), inventory_of(package), plan_of_surface_model(package), {}, {}};
  if (options.cell) require_cell(facts.inventory, *options.cell, options);
  if (options.check) facts.check = check(package, options);
  if (options.cell) facts.cell = inspect_cell(package, *options.cell);
  return facts;
}

void write_neighborhood(const Package& package, const PackageFacts& facts, const std::filesystem::path& path) {
  const CellContents& contents = *facts.cell;
  const Point2d corner = contents.corners_projected[0];
  // Whole metres: what reads the file may have floats only
  const Point2d offset{std::floor(corner.x), std::floor(corner.y)};
  write_obj(geometry_of(package, contents.neighborhood), offset,
            {fmt::format("The neighbourhood of cell {},{} of {}", contents.cell.i, contents.cell.j, facts.package),
             "Metres, z up; CRS " + crs_text(facts.description)},
            path);
}

void draw_neighborhood(const Package& package, const PackageFacts& facts, const InfoOptions& options) {
  constexpr std::size_t most_segments = 50'000;
  const CellContents& contents = *facts.cell;
  RunSettings run;
  run.threads = thread_count(options.run);
  const CellScenery scenery{contents,
                            geometry_of(package, cells_of_plan(contents)),
                            building_outlines(package, CellPlanFrame(contents, cell_plan_edge).part(), most_segments, run),
                            far_view_of(package, contents.cell),
                            facts.description.convergence,
                            facts.package,
                            crs_text(facts.description)};
  write_drawing(draw_cell(scenery), options.picture_file);
}

void draw_city_of(const Package& package, const PackageFacts& facts, const InfoOptions& options) {
  ProgressLine progress("plan", options.run.verbosity);
  RunSettings run;
  run.threads = thread_count(options.run);
  run.on_progress = [&progress](const Progress& p) { progress.update(p.done, p.all); };
  write_drawing(draw_city(city_scenery(package, facts, options.report_file, run)), options.picture_file);
}

template <class Form>
std::vector<Form> with_sky(std::vector<Form> forms, const std::vector<CellSky>& skies) {
  for (std::size_t n = 0; n < forms.size(); ++n) forms[n].sky = skies[n];
  return forms;
}

std::vector<CellMorphology> morphology_of(const Package& package, const InfoOptions& options) {
  ProgressLine progress("cells", options.run.verbosity);
  RunSettings run;
  run.threads = thread_count(options.run);
  run.on_progress = [&progress](const Progress& p) { progress.update(p.done, p.all); };
  std::vector<CellMorphology> cells = morphology_of_cells(package, run);
  if (!options.sky_spacing_m) return cells;
  return with_sky(std::move(cells), sky_of_cells(package, *options.sky_spacing_m, {}, run));
}

RequestedZones zones_in(const InfoOptions& options, const PackageDescription& city) {
#ifdef FARLOD_WITH_GDAL
  return gdal_files().read_zones(options.zones_file, options.zones_layer, city.crs_wkt);
#else
  throw PointsError(options.zones_file.string() +
                    " needs GDAL, which this farlod-info was built without: leave --zones out."
                    " --cells then has a row for each cell, in " +
                    city.crs_name + ".");
#endif
}

std::vector<UrbanForm> forms_of(const Package& package, const RequestedZones& requested, const InfoOptions& options) {
  ProgressLine progress("zones", options.run.verbosity);
  RunSettings run;
  run.threads = thread_count(options.run);
  run.on_progress = [&progress](const Progress& p) { progress.update(p.done, p.all); };
  std::vector<Zone> zones;
  for (const std::vector<ZonePolygon>& polygons : requested.zones) {
    Zone& zone = zones.emplace_back();
    for (const ZonePolygon& polygon : polygons) {
      zone.push_back(polygon.shell);
      zone.insert(zone.end(), polygon.holes.begin(), polygon.holes.end());
    }
  }
  std::vector<UrbanForm> forms = morphology_of_zones(package, zones, run);
  if (!options.sky_spacing_m) return forms;
  return with_sky(std::move(forms), sky_of_zones(package, zones, *options.sky_spacing_m, {}, run));
}

/// The options that values depend on.
std::string settings_of_table(const InfoOptions& options) {
  const std::string cells = options.zones_file.empty() ? "--cells" : "--cells --zones";
  return options.sky_spacing_m ? fmt::format("{} --svf {:g}", cells, *options.sky_spacing_m) : cells;
}

struct RowsOfTable {
  std::size_t all = 0, beyond_grid = 0;
};

/// Returns the numbers of its rows.
RowsOfTable write_table_of_cells(const Package& package, const PackageFacts& facts, const InfoOptions& options) {
  const PackageDescription& city = facts.description;
  TableFrame frame{.columns = {}, .crs_wkt = city.crs_wkt, .epsg = city.epsg, .convergence = city.convergence};
  frame.columns.further = morphology_columns();
  frame.provenance = {std::string("Far-LoD ") + software_version, facts.package, fmt::format("{:016x}", city.manifest_xxh3),
                      settings_of_table(options)};
  const auto write = output_format_of(options.cells_file)->write_forms;
  if (options.zones_file.empty()) {
    const std::vector<CellMorphology> cells = morphology_of(package, options);
    write(table_of_cells(cells), frame, options.cells_file);
    return {cells.size(), 0};
  }
  const RequestedZones zones = zones_in(options, city);
  const std::vector<UrbanForm> forms = forms_of(package, zones, options);
  write(table_of_zones(zones, forms), frame, options.cells_file);
  const auto is_beyond = [](const UrbanForm& form) { return form.amounts.plan_area_m2 == 0.0; };
  return {forms.size(), static_cast<std::size_t>(std::ranges::count_if(forms, is_beyond))};
}

/// "cells.csv: 4 rows", in a line.
std::string text_of_table(const std::filesystem::path& file, const RowsOfTable& rows) {
  const std::string beyond = rows.beyond_grid > 0 ? fmt::format("; {} {} beyond the grid, without values", rows.beyond_grid,
                                                                rows.beyond_grid == 1 ? "lies" : "lie")
                                                  : std::string();
  return fmt::format("{}: {} {}{}\n", file.string(), rows.all, rows.all == 1 ? "row" : "rows", beyond);
}

void require_outputs(const InfoOptions& options) {
  const std::array<NamedFile, 2> inputs{{{"--report", options.report_file}, {"--zones", options.zones_file}}};
  const std::array<NamedOutput, 4> outputs{{{{"--obj", options.obj_file}},
                                            {{"--png", options.picture_file}},
                                            {{"--cells", options.cells_file}},
                                            {{"--summary", options.run.summary_file}}}};
  require_writable(outputs, {inputs, options.package});
}

int run(const InfoOptions& options) {
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, thread_count(options.run));
  require_outputs(options);
  const auto start = Clock::now();
  const Package package(options.package);
  const PackageFacts facts = facts_of(package, options);
  if (!options.obj_file.empty()) write_neighborhood(package, facts, options.obj_file);
  if (!options.picture_file.empty()) (options.cell ? draw_neighborhood : draw_city_of)(package, facts, options);
  std::string of_table;
  if (!options.cells_file.empty()) of_table = text_of_table(options.cells_file, write_table_of_cells(package, facts, options));
  const double total_s = std::chrono::duration<double>(Clock::now() - start).count();
  write_text(options.run.summary_file, info_summary_json(facts, total_s, options.run.settings_json));
  if (options.json)
    fmt::print("{}", facts_json(facts));
  else if (options.run.verbosity == Verbosity::normal)
    fmt::print("{}{}", facts_text(facts), of_table);
  if (!facts.check || facts.check->damage.empty()) return exit_done;
  std::fflush(stdout);
  for (const PackageDamage& damage : facts.check->damage) fmt::print(stderr, "farlod-info: {}\n", damage_text(damage));
  return exit_damaged_package;
}

}  // namespace
}  // namespace farlod

int main(int argc, char** argv) {
  using namespace farlod;
  use_bundled_fonts();
  return run_program({.name = "farlod-info", .when_out_of_memory = "Use fewer --threads."}, [&] {
    const ParsedInfoOptions parsed = parse_info_options(argc, argv);
    return parsed.options ? run(*parsed.options) : parsed.exit_code;
  });
}

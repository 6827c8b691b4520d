// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/info_options.hpp"

#include <CLI/CLI.hpp>

#include <charconv>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "console/option_list.hpp"
#include "farlod/error.hpp"
#include "results/output_format.hpp"

namespace farlod {
namespace {

ProgramDescription info_program() {
  return {.name = "farlod-info",
          .purpose = "tells what a package of farlod-pack holds, and whether it is whole",
          .examples = {"farlod-info town.farlod", "farlod-info town.farlod --check", "farlod-info town.farlod --png city.png",
                       "farlod-info town.farlod --cells cells.gpkg --svf 2",
                       "farlod-info town.farlod --cells blocks.csv --zones blocks.gpkg",
                       "farlod-info town.farlod --cell 3,2 --png cell.png --obj cell.obj"},
          .background =
              {"A package holds a city cut into cells, and for each cell what matters of the city far away. The manifest "
               "tells what was packed, how, and what was wrong with it; --check reads all the rest, too.",
               "The picture of a city shows it from above: heights of buildings, the ground, the grid, a scale and where it "
               "lies. The picture of a cell shows its neighborhood from above, and beside it the far map: the horizon that the "
               "city beyond the neighborhood has in the middle of the cell.",
               "The table of cells is for models of the urban canopy, and has the square of each cell where its format has "
               "places. What lies below the ground does not count, what roofs cover counts once, and party walls are none."},
          .exit_codes = {{exit_done, "done"},
                         {exit_internal, "an internal error"},
                         {exit_usage, "a wrong command line"},
                         {exit_unusable_input, "an input cannot be read or used"},
                         {exit_damaged_package, "a damaged package"},
                         {exit_limit_reached, "a limit was reached"}},
          .licence = "Apache-2.0"};
}

bool holds_cells(const OutputFormat& format) { return format.write_forms != nullptr; }

/// Options whose text must be understood after CLI11 has taken them.
struct RawOptions {
  std::string package, cell, cells, zones, obj, picture, report;
};

void add_cells_options(CLI::App& app, RawOptions& raw, InfoOptions& o) {
  app.add_option("--cells", raw.cells,
                 "Write the urban form of each cell of the grid to this table (" + endings_where(holds_cells) +
                     "): plan area fraction, frontal area density for 16 wind directions, areas and heights, roughness")
      ->type_name(file_value)
      ->group("Output");
  app.add_option("--svf", o.sky_spacing_m,
                 "Metres between receivers: --cells has the mean sky view factors of ground, walls and roofs, too")
      ->check(CLI::Range(0.05, 1000.0))
      ->group("Output");
  app.add_option("--zones", raw.zones,
                 "Cut the city by the polygons of this file (GeoPackage, GeoJSON, Shapefile, ... in any CRS) in the place of "
                 "cells: --cells has a row for each")
      ->type_name(file_value)
      ->group("Output");
  app.add_option("--zones-layer", o.zones_layer, "The layer of --zones, where several hold polygons")->group("Output");
}

void add_options(CLI::App& app, RawOptions& raw, InfoOptions& o) {
  app.add_option("PACKAGE", raw.package, "A folder that farlod-pack made")->required()->type_name(folder_value);
  app.add_flag("--json", o.json, "Print everything as JSON, also with --quiet")->group("Output");
  app.add_flag("--check", o.check, "Read all of the package, and tell what is damaged, and where")->group("Contents");
  app.add_option("--cell", raw.cell, "I,J: also tell what this cell holds")->group("Contents");
  add_cells_options(app, raw, o);
  app.add_option("--obj", raw.obj, "Write the neighborhood of --cell to this OBJ file, a group for each building")
      ->type_name(file_value)
      ->group("Output");
  app.add_option("--png", raw.picture,
                 "Draw the city from above, or --cell and its far map, as this picture (PNG, or SVG or PDF by its ending)")
      ->type_name(file_value)
      ->group("Output");
  app.add_option(
         "--report", raw.report,
         "Mark the places of this report of farlod-pack (FILE.geojson or FILE.json), or of any file of points, in the picture "
         "of the city")
      ->type_name(file_value)
      ->group("Output");
}

/// Two whole numbers with a comma between them.
std::optional<CellPlace> cell_in(std::string_view text) {
  CellPlace cell;
  const char* const end = text.data() + text.size();
  const auto [comma, error_i] = std::from_chars(text.data(), end, cell.i);
  if (error_i != std::errc() || comma == end || *comma != ',') return std::nullopt;
  const auto [rest, error_j] = std::from_chars(comma + 1, end, cell.j);
  if (error_j != std::errc() || rest != end) return std::nullopt;
  return cell;
}

bool is_picture(const std::filesystem::path& path) {
  const OutputFormat* const format = output_format_of(path);
  return format != nullptr && format->is_picture;
}

bool is_table_of_cells(const std::filesystem::path& path) {
  const OutputFormat* const format = output_format_of(path);
  return format != nullptr && holds_cells(*format);
}

void resolve_zones(const RawOptions& raw, InfoOptions& o) {
  o.zones_file = raw.zones;
  if (raw.zones.empty() && !o.zones_layer.empty()) throw CLI::ValidationError("--zones-layer", "it goes with --zones");
  if (raw.zones.empty()) return;
  if (raw.cells.empty()) throw CLI::ValidationError("--zones", "it goes with --cells");
}

void resolve(const RawOptions& raw, InfoOptions& o) {
  o.package = raw.package;
  o.obj_file = raw.obj;
  o.picture_file = raw.picture;
  o.cells_file = raw.cells;
  if (!raw.cell.empty()) {
    o.cell = cell_in(raw.cell);
    if (!o.cell) throw CLI::ValidationError("--cell", "\"" + raw.cell + "\" is not of the form I,J");
  }
  o.report_file = raw.report;
  if (!raw.cells.empty() && !is_table_of_cells(o.cells_file))
    throw CLI::ValidationError(
        "--cells", "\"" + raw.cells + "\" is not the name of a table of cells: choose one of " + endings_where(holds_cells));
  resolve_zones(raw, o);
  if (o.sky_spacing_m && raw.cells.empty()) throw CLI::ValidationError("--svf", "it goes with --cells");
  if (!raw.obj.empty() && !o.cell) throw CLI::ValidationError("--obj", "it goes with --cell");
  if (!raw.report.empty() && (raw.picture.empty() || o.cell))
    throw CLI::ValidationError("--report", "it goes with --png, and without --cell");
  if (!raw.picture.empty() && !is_picture(o.picture_file))
    throw CLI::ValidationError("--png", "\"" + raw.picture + "\" is not the name of a picture: choose one of " +
                                            endings_where([](const OutputFormat& f) { return f.is_picture; }));
}

/// All options, and what they are bound to.
struct CommandLine {
  CLI::App app;
  RawOptions raw;
  InfoOptions options;

  CommandLine() {
    describe_program(app, info_program());
    add_options(app, raw, options);
    add_run_options(app, info_program().name, options.run);
  }
};

}  // namespace

ParsedInfoOptions parse_info_options(int argc, char** argv) {
  CommandLine line;
  if (const auto exit_code = parse_command_line(line.app, argc, argv, [&] { resolve(line.raw, line.options); }))
    return {std::nullopt, *exit_code};
  return {std::move(line.options), exit_done};
}

void describe_info_options(const CommandLineVisitor& visit) { visit(info_program(), CommandLine().app); }

}  // namespace farlod

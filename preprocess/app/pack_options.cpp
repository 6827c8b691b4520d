// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pack_options.hpp"

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <vector>

#include "app/option_values.hpp"
#include "console/option_list.hpp"
#include "console/wrong_usage.hpp"
#include "farlod/error.hpp"

namespace farlod {
namespace {

ProgramDescription pack_program() {
  const InputFormatNames formats = input_format_names();
  return {
      .name = "farlod-pack",
      .purpose = "cuts a city model into a package of cells with far maps, from which farlod-svf computes sky view factors",
      .examples = {"farlod-pack town.gml -o town.farlod", "farlod-pack footprints.geojson --height-field height -o town.farlod",
                   "farlod-pack city.gml -o city.farlod --area quarter.gpkg"},
      .background = {"A grid of square cells is laid over the city. A package holds the geometry of each cell, and a far map: "
                     "what matters there of the city far away.",
                     "One bad building never ends the run. It is reported, and left out or repaired; --report lists each "
                     "problem, and --strict packs no city that has one.",
                     "A package is made in NAME.farlod.unfinished, and gets its name in one step when it is whole. A run that "
                     "is interrupted leaves there what it has finished, and the same command goes on with it. One package may be "
                     "made by several processes, on several machines: --shard and --merge.",
                     "Reads " + formats.all +
                         ", besides footprints in any vector format of GDAL (GeoJSON, GeoPackage, Shapefile "
                         "…); also from folders, .zip and .gz. Several inputs become one city. " +
                         formats.piped + " may come through a pipe; - is the standard input."},
      .exit_codes = {{exit_done, "done"},
                     {exit_internal, "an internal error"},
                     {exit_usage, "a wrong command line"},
                     {exit_unusable_input, "an input cannot be read or used (with --strict: has a problem)"},
                     {exit_limit_reached, "a limit was reached"},
                     {exit_busy, "another process is at work on the same package: try again later"},
                     {exit_interrupted, "and the number of a signal: interrupted; the same command goes on"}},
      .licence = "GPL-3.0-or-later"};
}

/// Options whose text is resolved after CLI11 has parsed them.
struct RawOptions {
  std::vector<std::string> inputs;
  std::string output, origin, up = "auto", lod = "best", align = "auto", assign = "clip", far_map = "horizon", surface = "auto";
  std::optional<std::string> area, ground_names;
  std::vector<std::string> terrain, far_terrains;
  std::string height_field, base_field, storeys_field, roof_field, layer, encoding;
  std::vector<std::string> trees;
  std::string tree_height_field, crown_field, trunk_field, trees_layer, canopy, trunk;
  bool canopy_absolute = false;
  std::string shard;
  bool force = false, strict = false;
};

void add_input_options(CLI::App& app, RawOptions& raw, PackOptions& o) {
  app.add_option("INPUT", raw.inputs,
                 "City files, folders with city files, .zip or .gz archives, pipes (-: standard input); all are put together. A "
                 "raster is a surface model")
      ->type_name(file_value);
  app.add_option("--crs", o.settings.crs, "CRS of inputs that do not say, as EPSG:n; of all, where each says its own")
      ->group("Input");
  app.add_option("--out-crs", o.settings.out_crs, "CRS of the package (default: the input's, or UTM for degrees)")
      ->group("Input");
  const std::string meshes = input_format_names().meshes + " files";
  app.add_option("--origin", raw.origin, "X,Y[,Z] added to the coordinates of " + meshes)->group("Input");
  app.add_option("--up", raw.up, "Axis that points up in these; auto: as the format has it, y in GLB and z in others")
      ->check(one_of_words({"auto", "z", "y"}))
      ->capture_default_str()
      ->group("Input");
  app.add_option(
         "--ground-names", raw.ground_names,
         "Names of objects, groups or materials in these that are ground, such as Gelaende,Strasse; besides Terrain, Road, "
         "Water and others")
      ->group("Input");
  app.add_option("--layer", raw.layer,
                 "Layer of a file of several (GeoPackage, File Geodatabase, netCDF) to read: features or a raster")
      ->group("Input");
  app.add_option("--encoding", raw.encoding, "Of the names and texts of Shapefiles without .cpg, such as GBK or CP1252")
      ->group("Input");
  app.add_option("--lod", raw.lod, "Level of detail to read")
      ->check(one_of_words({"best", "0", "1", "2", "3"}))
      ->capture_default_str()
      ->group("Input");
}

void add_footprint_options(CLI::App& app, RawOptions& raw, PackOptions& o) {
  app.add_option("--height-field", raw.height_field, "Attribute with a footprint's height above its base, in metres")
      ->group("Input");
  app.add_option("--base-field", raw.base_field, "Attribute with the elevation of a footprint's base, in metres")->group("Input");
  app.add_option("--roof-field", raw.roof_field,
                 "Attribute with the elevation of a footprint's roof, in metres; without --base-field needs a terrain")
      ->group("Input");
  app.add_option("--storeys-field", raw.storeys_field, "Attribute with a footprint's number of storeys, where no height is known")
      ->group("Input");
  app.add_option("--floor-height", o.settings.footprints.floor_height_m, "Height of a storey, in metres")
      ->check(between(1.0, 20.0))
      ->capture_default_str()
      ->group("Input");
  app.add_option("--default-height", o.settings.footprints.default_height_m, "Height of footprints that have none, in metres")
      ->check(between(0.01, 1000.0))
      ->group("Input");
  app.add_option("--unknown-height", o.settings.footprints.unknown_heights,
                 "Numbers that mean that a height is not known, such as 0,-1,999: storeys or the default height count then")
      ->delimiter(',')
      ->group("Input");
}

void add_terrain_options(CLI::App& app, RawOptions& raw, PackOptions& o) {
  app.add_option("--terrain", raw.terrain,
                 "Raster of ground elevations (any that GDAL reads), or a folder of them; may be given several times: later ones "
                 "lie on top")
      ->type_name(file_value)
      ->expected(1)
      ->take_all()
      ->group("Input");
  app.add_option("--terrain-offset", o.settings.terrain_offset_m,
                 "Metres added to the terrain, where its elevations count from another datum than the buildings")
      ->check(between(-1000.0, 1000.0))
      ->group("Input");
  app.add_option("--surface", raw.surface,
                 "A raster that is the city. auto: walls stand where pixels are a step apart; tin: all is slopes between pixels")
      ->check(one_of_words({"auto", "tin"}))
      ->capture_default_str()
      ->group("Input");
  app.add_option(
         "--far-terrain", raw.far_terrains,
         "Raster of elevations around the city, of any resolution, or a folder of them: mountains hide the sky; may be given "
         "several times")
      ->type_name(file_value)
      ->expected(1)
      ->take_all()
      ->group("Input");
}

void add_tree_options(CLI::App& app, RawOptions& raw) {
  app.add_option(
         "--trees", raw.trees,
         "Inventory of trees: points or outlines of crowns in a vector file, a table with columns lon, lat or x, y, or a city "
         "model; may be given several times")
      ->type_name(file_value)
      ->expected(1)
      ->take_all()
      ->group("Trees");
  app.add_option("--tree-height-field", raw.tree_height_field, "Attribute with a tree's height, in metres")->group("Trees");
  app.add_option("--trees-layer", raw.trees_layer, "Layer of a vector file of several, such as a GeoPackage")->group("Trees");
  app.add_option("--crown-field", raw.crown_field, "Attribute with the diameter of a tree's crown, in metres")->group("Trees");
  app.add_option("--trunk-field", raw.trunk_field, "Attribute with the height at which a tree's crown begins, in metres")
      ->group("Trees");
}

void add_canopy_options(CLI::App& app, RawOptions& raw, PackOptions& o) {
  auto* const canopy = app.add_option("--canopy", raw.canopy, "Raster of the heights of crowns above the ground; 0: none")
                           ->type_name(file_value)
                           ->group("Trees");
  app.add_option("--trunk", raw.trunk, "Raster of the heights above the ground at which the crowns of --canopy begin")
      ->needs(canopy)
      ->type_name(file_value)
      ->group("Trees");
  app.add_flag("--canopy-absolute", raw.canopy_absolute, "The heights of --canopy and --trunk are elevations")
      ->needs(canopy)
      ->group("Trees");
  app.add_option("--trunk-ratio", o.settings.trees.trunk_ratio,
                 "Share of its height at which a crown begins, where nothing else says it")
      ->check(between(0.0, 0.95))
      ->capture_default_str()
      ->group("Trees");
}

void add_grid_options(CLI::App& app, RawOptions& raw, PackOptions& o) {
  app.add_option("--cell", o.settings.cell_edge_m, "Edge of a cell in metres (default: 150, or what --max-error needs)")
      ->check(between(0.5, 10000.0))
      ->group("Grid");
  app.add_option("--neighborhood", o.settings.neighborhood,
                 "Cells along the edge of the near field, N: odd (default: 3, or what --max-error needs)")
      ->check(between(1, 999))
      ->group("Grid");
  app.add_option("--max-error", o.settings.max_error,
                 "Choose cells and neighborhood so that sky view factors keep this error; tell farlod-svf the same")
      ->check(between(0.0001, 1.0))
      ->group("Grid");
  app.add_option("--align", raw.align, "auto: along the streets; none: grid north; or degrees clockwise from grid north")
      ->capture_default_str()
      ->group("Grid");
  app.add_option("--assign", raw.assign,
                 "clip: cut at the cells' borders; whole: buildings go whole to the cell of their centroid")
      ->check(one_of_words({"clip", "whole"}))
      ->capture_default_str()
      ->group("Grid");
  app.add_option("--far-map", raw.far_map, "horizon: without parallax, with certain bounds; box: the paper's")
      ->check(one_of_words({"horizon", "box"}))
      ->capture_default_str()
      ->group("Grid");
}

void add_area_option(CLI::App& app, RawOptions& raw) {
  app.add_option(
         "--area", raw.area,
         "Make far maps only where this lies: X0,Y0,X1,Y1 in the package's CRS, a vector file, or a table of points (CSV); "
         "add them to the package of the same city that is there already")
      ->type_name(file_value)
      ->group("Output");
}

void add_shard_options(CLI::App& app, RawOptions& raw, PackOptions& o) {
  auto* const shard = app.add_option("--shard", raw.shard,
                                     "Make one part of N, counted from 0: I/N; auto in a job array of Slurm or AWS Batch; auto/N "
                                     "in an indexed job of Kubernetes")
                          ->type_name("I/N")
                          ->group("Output");
  app.add_flag("--merge", o.settings.merge, "Put the package together of what all shards have made; needs no INPUT")
      ->excludes(shard)
      ->group("Output");
}

void add_output_options(CLI::App& app, RawOptions& raw, PackOptions& o) {
  app.add_option("-o,--output", raw.output, "Folder of the package, NAME.farlod")
      ->required()
      ->type_name(folder_value)
      ->group("Output");
  app.add_flag("--force", raw.force, "Replace a package that is there already")->group("Output");
  app.add_flag("--resume", o.settings.resume,
               "Go on with what a run with the same inputs and options has left, and with no other; make a damaged package whole")
      ->group("Output");
  add_shard_options(app, raw, o);
  add_area_option(app, raw);
  app.add_option("--memory-limit", o.memory_limit_mib,
                 "Pack within so many MiB of memory, with more on disk; end where no portion is small enough")
      ->check(between(1, 1 << 30))
      ->group("Output");
  app.add_option("--report", o.report_file,
                 "Write every problem of the input to this JSON file; as points for a map when it ends in .geojson")
      ->type_name(file_value)
      ->group("Output");
  app.add_flag("--strict", raw.strict, "Write no package, and end with exit code 3, when the input has any problem")
      ->group("Output");
  add_run_options(app, pack_program().name, o.run);
}

void require_name(const std::string& name, const char* option) {
  if (name.empty()) throw CLI::ValidationError(option, "the name is empty: give a file");
}

void resolve_trees(const RawOptions& raw, TreeSettings& trees) {
  for (const std::string& file : raw.trees) {
    require_name(file, "--trees");
    trees.files.emplace_back(file);
  }
  if (!raw.tree_height_field.empty()) trees.height_field = raw.tree_height_field;
  if (!raw.crown_field.empty()) trees.crown_field = raw.crown_field;
  if (!raw.trunk_field.empty()) trees.trunk_field = raw.trunk_field;
  if (!raw.trees_layer.empty()) trees.layer = raw.trees_layer;
  if (!raw.encoding.empty()) trees.encoding = raw.encoding;
  if (!raw.canopy.empty()) trees.canopy = raw.canopy;
  if (!raw.trunk.empty()) trees.trunks = raw.trunk;
  trees.heights = raw.canopy_absolute ? CanopyHeights::elevations : CanopyHeights::above_ground;
}

void resolve_fields(const RawOptions& raw, FootprintSettings& footprints) {
  if (!raw.height_field.empty()) footprints.height_field = raw.height_field;
  if (!raw.base_field.empty()) footprints.base_field = raw.base_field;
  if (!raw.storeys_field.empty()) footprints.storeys_field = raw.storeys_field;
  if (!raw.layer.empty()) footprints.layer = raw.layer;
  if (!raw.encoding.empty()) footprints.encoding = raw.encoding;
  if (!raw.roof_field.empty()) footprints.roof_field = raw.roof_field;
}

void resolve_inputs(const RawOptions& raw, PackSettings& s) {
  for (const std::string& input : raw.inputs) s.inputs.emplace_back(input == "-" ? "/dev/stdin" : input);
  s.terrain.assign(raw.terrain.begin(), raw.terrain.end());
  for (const std::string& file : raw.far_terrains) {
    require_name(file, "--far-terrain");
    s.far_terrains.emplace_back(file);
  }
}

void resolve(const RawOptions& raw, PackOptions& o) {
  PackSettings& s = o.settings;
  resolve_inputs(raw, s);
  if (raw.output.empty()) throw CLI::ValidationError("-o", "the name is empty: give the folder of the package, NAME.farlod");
  s.output = raw.output;
  s.overwrite = raw.force ? Overwrite::replace : Overwrite::refuse;
  s.problems = raw.strict ? ProblemPolicy::refuse : ProblemPolicy::pack;
  resolve_trees(raw, s.trees);
  if (raw.area) s.area = area_in(*raw.area);
  if (!raw.shard.empty()) s.shard = shard_in(raw.shard);
  if (s.inputs.empty() && s.terrain.empty() && !s.merge) throw CLI::RequiredError("INPUT");
  if (s.neighborhood && *s.neighborhood % 2 == 0)
    throw CLI::ValidationError("--neighborhood", std::to_string(*s.neighborhood) +
                                                     " is even: a neighborhood has a cell in its middle, give an odd number");
  if (!raw.origin.empty()) s.obj_origin = origin_in(raw.origin);
  if (raw.ground_names) s.ground_names = names_in(*raw.ground_names);
  if (raw.up != "auto") s.up = raw.up == "y" ? UpAxis::y : UpAxis::z;
  if (raw.lod != "best") s.lod = std::stoi(raw.lod);
  resolve_fields(raw, s.footprints);
  set_alignment(raw.align, s);
  s.far_map = raw.far_map == "box" ? FarMapKind::box : FarMapKind::horizon;
  s.surface = raw.surface == "tin" ? SurfaceReading::tin : SurfaceReading::automatic;
  s.assign = raw.assign == "whole" ? Assign::whole : Assign::clip;
  if (s.max_error && s.far_map == FarMapKind::box)
    throw CLI::ValidationError("--max-error", "far maps of the kind box keep no error: leave --far-map out");
}

/// All options, and what they are bound to.
struct CommandLine {
  CLI::App app;
  RawOptions raw;
  PackOptions options;

  CommandLine() {
    describe_program(app, pack_program());
    add_input_options(app, raw, options);
    add_footprint_options(app, raw, options);
    add_terrain_options(app, raw, options);
    add_tree_options(app, raw);
    add_canopy_options(app, raw, options);
    add_grid_options(app, raw, options);
    add_output_options(app, raw, options);
  }
};

}  // namespace

ParsedPackOptions parse_pack_options(int argc, char** argv) {
  CommandLine line;
  if (const auto exit_code = parse_command_line(line.app, argc, argv, [&] { resolve(line.raw, line.options); }))
    return {std::nullopt, *exit_code};
  return {std::move(line.options), exit_done};
}

void describe_pack_options(const CommandLineVisitor& visit) { visit(pack_program(), CommandLine().app); }

}  // namespace farlod

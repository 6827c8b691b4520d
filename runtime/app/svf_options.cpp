// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/svf_options.hpp"

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "app/format_advice.hpp"
#include "app/format_options.hpp"
#include "app/matrix_options.hpp"
#include "app/picture_options.hpp"
#include "app/word_choice.hpp"
#include "app/work_options.hpp"
#include "base/expects.hpp"
#include "console/option_list.hpp"
#include "farlod/error.hpp"

namespace farlod {
namespace {

ProgramDescription svf_program() {
  return {.name = "farlod-svf",
          .purpose = "computes sky view factors from a package that farlod-pack made",
          .examples = {"farlod-svf town.farlod -o svf.tif --grid 2 --preview svf.png",
                       "farlod-svf town.farlod -o walls.csv --surfaces walls --spacing 2",
                       "farlod-svf town.farlod -o sky.png --at 691010,5335990"},
          .background =
              {"A package holds a city cut into cells, and for each cell what matters of the city far away. It is made "
               "once, and evaluated as often as you like.",
               "The receivers are the points where the sky is looked at: the pixels of a raster (--grid), the points of "
               "a file (--points), points spread over the buildings (--surfaces), or one point (--at). The sky view "
               "factor is the share of the sky that a receiver sees, from 0 to 1.",
               "Receivers inside a building get no answer: the declared no-data value in a raster, an empty field in a table."},
          .exit_codes = {{exit_done, "done"},
                         {exit_internal, "an internal error"},
                         {exit_usage, "a wrong command line"},
                         {exit_unusable_input, "an input cannot be read or used, or no receiver has an answer"},
                         {exit_damaged_package, "a damaged package"},
                         {exit_limit_reached, "a limit was reached"},
                         {exit_busy, "another process is at work on the same output: try again later"},
                         {exit_interrupted, "and the number of a signal: interrupted; the same command goes on"}},
          .licence = "Apache-2.0"};
}

std::string known_endings() {
  return endings_where([](const OutputFormat&) { return true; });
}

/// Options whose text must be understood after CLI11 has taken them.
struct RawOptions {
  std::string shard;
  std::string package, output, city, grid_like, points, along, surfaces, at, bbox, mask, engine = "auto", sky = "cosine",
                                                                                         directions = "partition";
  bool on_surface = false;
  RawQuantities quantities;
  RawLight light;
  RawPictures pictures;
};

std::vector<double> numbers_in(const std::string& text, const std::string& option, const std::string& form) {
  std::vector<double> numbers;
  // split() drops what is empty after the last comma: with one more, that is the comma's own
  for (const std::string& part : CLI::detail::split(text + ',', ',')) {
    char* end = nullptr;
    numbers.push_back(std::strtod(part.c_str(), &end));
    if (part.empty() || *end != '\0' || !std::isfinite(numbers.back()))
      throw CLI::ValidationError(option, "\"" + text + "\" is not of the form " + form);
  }
  return numbers;
}

void add_receiver_options(CLI::App& app, RawOptions& raw, SvfOptions& o) {
  auto* receivers = app.add_option_group(
      "Receivers", "Where the sky is looked at; of a city that is a raster, without any of these, its pixels");
  receivers->add_option("--grid", o.grid_step_m, "A raster with pixels of this many metres")->check(between(0.01, 10000.0));
  receivers->add_option("--grid-like", raw.grid_like, "The pixels of this raster, such as the surface model that SOLWEIG runs on")
      ->type_name(file_value);
  receivers
      ->add_option("--points", raw.points,
                   "The points of this file: GeoPackage, GeoJSON, Shapefile, FlatGeobuf, another format of GDAL's, or CSV with "
                   "lon and lat or x and y, perhaps z and id; azimuth and tilt are normals, other fields come back")
      ->type_name(file_value);
  receivers->add_option("--along", raw.along, "Points along the lines of this vector file, such as the axes of streets")
      ->type_name(file_value);
  receivers->add_option("--surfaces", raw.surfaces, "Points spread over the buildings, with averages per surface and building")
      ->check(one_of(surface_choice_words));
  receivers->add_option("--at", raw.at, "One point: X,Y or X,Y,Z in the package's CRS, or in degrees");
  receivers->require_option(0, 1);
}

void add_placing_options(CLI::App& app, RawOptions& raw, SvfOptions& o) {
  app.add_option("--height", o.placing.height_m, "Metres above ground (not for --surfaces, nor for points with a z)")
      ->check(between(0.0, 10000.0))
      ->capture_default_str()
      ->group("Placing");
  app.add_flag("--on-surface", raw.on_surface, "Count --height from whatever is highest there, ground or roof")->group("Placing");
  app.add_option("--spacing", o.surfaces.spacing_m, "Metres between receivers on surfaces, or along lines")
      ->check(between(0.05, 1000.0))
      ->capture_default_str()
      ->group("Placing");
  app.add_option("--points-crs", o.points_crs,
                 "CRS of --points or --along, as EPSG:n (default: the file's own, or the package's)")
      ->group("Placing");
  app.add_option("--points-layer", o.points_layer, "Layer of --points or --along (default: its only one)")->group("Placing");
  app.add_option("--bbox", raw.bbox,
                 "X0,Y0,X1,Y1: only receivers in this box, in the package's CRS or in degrees. Or city: the buildings and up to "
                 "50 m around "
                 "them, as --grid has it by default; or grid: all cells")
      ->group("Placing");
  app.add_option("--mask", raw.mask, "Only receivers in the polygons of this vector file")
      ->type_name(file_value)
      ->group("Placing");
  app.add_option("--within", o.evaluation.within_m,
                 "Only pixels that are at most so many metres from a building in the plan: those of pavements are within 3")
      ->check(between(0.0, largest_within_m))
      ->group("Placing");
}

void add_output_options(CLI::App& app, RawOptions& raw) {
  app.add_option("PACKAGE", raw.package, "A folder that farlod-pack made")->required()->type_name(folder_value);
  app.add_option("-o,--output", raw.output, "File to write; its ending says the format: " + known_endings())
      ->required()
      ->type_name(file_value)
      ->group("Output");
  app.add_option(
         "--city", raw.city,
         "With --surfaces: the CityGML, CityJSON or CityJSONSeq file that the package was made of, or the folder of such files. "
         "They are written again as -o (of a folder: into that folder), with the values as attributes of buildings and surfaces")
      ->type_name(file_value)
      ->group("Output");
}

/// How exactly the sky is looked at.
void add_sky_options(CLI::App& app, RawOptions& raw, SvfOptions& o) {
  app.add_option("--engine", raw.engine,
                 "auto: horizons, and rays where a cell has no far map or one of the kind box; horizon: horizons alone, but for "
                 "the kind box; rays: rays against horizons; exact: rays against all tiles, the reference")
      ->check(one_of(engine_words, Engine::near_only))
      ->capture_default_str()
      ->group("Accuracy");
  app.add_option("--rays", o.evaluation.rays,
                 "Directions a receiver, for rays (default: " + std::to_string(default_rays) +
                     ", or as many as --max-error needs for trees)")
      ->check(between(1, 10000000))
      ->group("Accuracy");
  app.add_option("--directions", raw.directions,
                 "Where rays go: partition, one in each of equal cells of the sky; fibonacci, a lattice of low discrepancy")
      ->check(one_of(direction_set_words))
      ->capture_default_str()
      ->group("Accuracy");
  app.add_option(
         "--azimuths", o.evaluation.azimuths,
         "Azimuths of a horizon (default: " + std::to_string(default_azimuths) + ", or as many as --max-error needs for trees)")
      ->check(between(4, 1000000))
      ->group("Accuracy");
  app.add_option("--sky", raw.sky, "Weight of the sky: cosine (svf) or solid (svf_solid)")
      ->check(one_of(sky_weight_words))
      ->capture_default_str()
      ->group("Accuracy");
}

void add_error_options(CLI::App& app, SvfOptions& o) {
  app.add_option("--max-error", o.evaluation.max_error,
                 "Largest error allowed, for certain: the whole city decides what is left open (with trees, a measured law)")
      ->check(between(0.0001, 1.0))
      ->group("Accuracy");
  app.add_flag("--bounds", o.evaluation.bounds,
               "Also write a lower and an upper bound of each value, between which the true one of the packed city lies")
      ->group("Accuracy");
  app.add_option("--verify", o.evaluation.verify, "Also compute this many random receivers exactly, and report the errors")
      ->check(between(0, 1000000000))
      ->group("Accuracy");
  app.add_option(
         "--verify-map", o.verify_file,
         "With --verify: draw the errors at these receivers as this map (PNG, SVG or PDF), or write them as a table (CSV)")
      ->type_name(file_value)
      ->group("Accuracy");
}

void add_limit_options(CLI::App& app, SvfOptions& o) {
  app.add_flag("--dry-run", o.evaluation.dry_run,
               "Write nothing, and tell what the run would take: receivers, memory, time and disk, from some of its cells")
      ->group("Run");
  app.add_option("--memory-limit", o.memory_limit_mib,
                 "Refuse to begin when the run needs more than this many MiB (default: 1.2 times what the machine has)")
      ->check(between(1, 1 << 30))
      ->group("Run");
}

void resolve_place(const RawOptions& raw, SvfOptions& o) {
  if (!raw.at.empty()) {
    const auto n = numbers_in(raw.at, "--at", "X,Y or X,Y,Z");
    if (n.size() != 2 && n.size() != 3) throw CLI::ValidationError("--at", "give X,Y or X,Y,Z");
    o.source = ReceiverSource::at;
    o.at = {"1", n[0], n[1], n.size() == 3 ? std::optional(n[2]) : std::nullopt, std::nullopt};
  } else if (!raw.grid_like.empty()) {
    o.grid_like = raw.grid_like;
  } else if (!raw.points.empty()) {
    o.source = ReceiverSource::points;
    o.points_file = raw.points;
  } else if (!raw.along.empty()) {
    o.source = ReceiverSource::lines;
    o.points_file = raw.along;
  } else if (!raw.surfaces.empty()) {
    o.source = ReceiverSource::surfaces;
    o.surfaces.choice = *value_of(surface_choice_words, raw.surfaces);
  } else if (o.grid_step_m == 0.0) {
    o.own_pixels = plan_of_surface_model(Package(o.package)).has_value();
    if (!o.own_pixels)
      throw CLI::ValidationError("one of --grid,--grid-like,--points,--along,--surfaces,--at is required, such as --grid 2");
  }
}

/// The box that --bbox says, in numbers or by what it is around.
Box2d box_of(const std::string& text, const std::filesystem::path& package) {
  if (text == "city") return Package(package).description().city_projected;
  if (text == "grid") return Package(package).description().outline_projected;
  const auto n = numbers_in(text, "--bbox", "X0,Y0,X1,Y1, city or grid");
  if (n.size() != 4 || n[0] >= n[2] || n[1] >= n[3])
    throw CLI::ValidationError("--bbox", "give X0,Y0,X1,Y1 with X0 < X1 and Y0 < Y1");
  constexpr double farthest_m = 1e8;  // no map is as large
  for (const double x : n)
    if (std::abs(x) > farthest_m) throw CLI::ValidationError("--bbox", fmt::format("{:g} lies nowhere on Earth", x));
  return {{n[0], n[1]}, {n[2], n[3]}};
}

/// Which of the receivers are asked for.
void resolve_part(const RawOptions& raw, SvfOptions& o) {
  o.mask_file = raw.mask;
  if (o.source == ReceiverSource::at && !(raw.mask.empty() && raw.bbox.empty()))
    throw CLI::ValidationError(raw.mask.empty() ? "--bbox" : "--mask", "it goes with --grid, --points, --along and --surfaces");
  if (o.evaluation.within_m && o.source != ReceiverSource::grid)
    throw CLI::ValidationError("--within", "it goes with --grid and --grid-like");
  if (raw.bbox.empty()) return;
  if (!raw.grid_like.empty())
    throw CLI::ValidationError("--bbox", "the raster of --grid-like says where its pixels are: give one of the two");
  o.bbox_projected = box_of(raw.bbox, o.package);
  if (o.source != ReceiverSource::grid && !raw.mask.empty())
    throw CLI::ValidationError("--bbox", "with --mask it goes with --grid only: give one of the two");
}

/// For messages: ".city.json (CityJSON), ...".
std::string city_endings() {
  std::string list;
  for (const CityFileFormat format : {CityFileFormat::cityjson, CityFileFormat::cityjsonseq, CityFileFormat::citygml})
    list += (list.empty() ? "" : ", ") + endings_of(format) + " (" + name_of(format) + ")";
  return list;
}

/// A city file has no receivers, and its attributes are numbers of whole surfaces.
void resolve_city(const RawOptions& raw, SvfOptions& o) {
  o.city_file = raw.city;
  if (o.source != ReceiverSource::surfaces) throw CLI::ValidationError("--city", "it goes with --surfaces");
  if (o.city_is_folder() == city_format_of(o.output).has_value())
    throw CLI::ValidationError(
        "-o", o.city_is_folder() ? "--city is a folder, and so is the output: choose the name of a folder"
                                 : "with --city the output is a city file, too: choose a name that ends in " + city_endings());
  if (o.evaluation.bounds)
    throw CLI::ValidationError("--bounds", "the attributes of a city file (--city) have no room for bounds");
}

void resolve_output(const RawOptions& raw, SvfOptions& o) {
  o.output = raw.output;
  if (!raw.city.empty()) {
    resolve_city(raw, o);
  } else if (city_format_of(o.output)) {
    throw CLI::ValidationError("-o", "a city file is the file that was packed, with values: name that file with --city");
  } else {
    resolve_format(raw.output, raw.quantities, o);
  }
  resolve_pictures(raw.pictures, o);
  if (o.evaluation.dry_run && o.source == ReceiverSource::at)
    throw CLI::ValidationError("--dry-run", "it goes with --grid, --grid-like, --points, --along and --surfaces");
  const bool has_file = o.source == ReceiverSource::points || o.source == ReceiverSource::lines;
  if (!o.points_crs.empty() && !has_file) throw CLI::ValidationError("--points-crs", "it goes with --points or --along");
  if (!o.points_layer.empty() && !has_file) throw CLI::ValidationError("--points-layer", "it goes with --points or --along");
}

/// Refuses numbers of rays and azimuths that cannot keep the allowed error.
void require_accuracy(const EvaluationSettings& settings) {
  try {
    (void)accuracy_of(settings);
  } catch (const InvalidArgument& error) {
    throw CLI::ValidationError(settings.max_error ? "--max-error" : "--bounds", error.what());
  }
}

/// The option by which more is asked for than svf.
const char* option_of_quantities(const RawQuantities& raw) {
  return !raw.quantities.empty() ? "--quantity"
         : raw.horizons > 0      ? "--horizons"
         : raw.sky_patches > 0   ? "--sky-patches"
                                 : "--sun";
}

/// It draws the horizon, and has no room for numbers of directions.
void refuse_on_sky_picture(const RawQuantities& raw, const Quantities& further) {
  constexpr const char* table = "leave the option out, or write a table (-o FILE.csv)";
  if (raw.horizons > 0)
    throw CLI::ValidationError("--horizons", std::string("a picture of the sky draws the horizon at every azimuth, and holds no "
                                                         "numbers of it: ") +
                                                 table);
  if (raw.sky_patches > 0)
    throw CLI::ValidationError("--sky-patches", std::string("a picture of the sky holds no numbers of its patches: ") + table);
  if (any_but_irradiation(further))
    throw CLI::ValidationError(
        "--quantity", "a picture of the sky shows svf, irradiation, and with --sun the sun's path: leave the others out");
}

void resolve_quantities(const RawOptions& raw, SvfOptions& o) {
  RequestedQuantities requested = resolved(raw.quantities, o.format);
  if (requested.further.any_weighted() && o.evaluation.weight == SkyWeight::solid_angle)
    throw CLI::ValidationError("--quantity",
                               "with --sky solid only " + words_of_unweighted() + " can be computed: leave --sky out");
  const bool is_sky = o.source == ReceiverSource::at && o.format != nullptr && o.format->is_picture;
  if (is_sky) refuse_on_sky_picture(raw.quantities, requested.further);
  const auto has_room = [&](const OutputFormat& f) { return fits(f, o.source) && f.holds_bounds; };
  const bool is_drawn = o.source == ReceiverSource::grid && o.format != nullptr && o.format->is_picture;
  if (requested.any() && !is_sky && o.format != nullptr && !o.format->holds_bounds && !(is_drawn && fits_picture(raw.quantities)))
    throw CLI::ValidationError(option_of_quantities(raw.quantities), "a file that ends in " + o.output.extension().string() +
                                                                         " has room for one quantity only: " + advice(has_room));
  requested.further.svf_total_bounds = requested.further.svf_total && o.evaluation.bounds;
  o.light = resolved_light(raw.light, requested.further);
  if (o.surfaces.irradiation_threshold_kwh_m2 && !(o.source == ReceiverSource::surfaces && requested.further.irradiation))
    throw CLI::ValidationError("--irradiation-threshold", "it goes with --surfaces and --quantity irradiation");
  o.names_quantities = !raw.quantities.quantities.empty() || raw.quantities.horizons > 0 || raw.quantities.sky_patches > 0;
  o.drawn_quantity = drawn_quantity(raw.quantities);
  o.evaluation.further = std::move(requested.further);
  o.sunshine = requested.sunshine;
}

void refuse_places_on_surfaces(const SvfOptions& o) {
  if (o.source == ReceiverSource::surfaces && o.evaluation.further.any_of_places())
    throw CLI::ValidationError("--quantity",
                               "view_cube, view_sphere and view_eye are what is seen around a place, half of which a surface "
                               "hides: leave them out, or give --points instead of --surfaces");
}

void resolve(const RawOptions& raw, SvfOptions& o) {
  o.package = raw.package;
  resolve_place(raw, o);
  resolve_part(raw, o);
  resolve_output(raw, o);
  o.placing.above = raw.on_surface ? HeightAbove::highest_surface : HeightAbove::ground;
  o.evaluation.directions = *value_of(direction_set_words, raw.directions);
  o.evaluation.engine = *value_of(engine_words, raw.engine);
  o.evaluation.weight = *value_of(sky_weight_words, raw.sky);
  resolve_quantities(raw, o);
  refuse_places_on_surfaces(o);
  resolve_work(raw.shard, o);
  resolve_matrix(o);
  require_accuracy(o.evaluation);
}

/// All options, and what they are bound to.
struct CommandLine {
  CLI::App app;
  RawOptions raw;
  SvfOptions options;

  CommandLine() {
    describe_program(app, svf_program());
    add_receiver_options(app, raw, options);
    add_placing_options(app, raw, options);
    add_output_options(app, raw);
    add_picture_options(app, raw.pictures, options);
    add_matrix_options(app, options);
    add_quantity_options(app, raw.quantities);
    add_light_options(app, raw.light, options.surfaces);
    add_sky_options(app, raw, options);
    add_error_options(app, options);
    add_limit_options(app, options);
    add_work_options(app, raw.shard, options);
    add_run_options(app, svf_program().name, options.run);
  }
};

}  // namespace

ParsedSvfOptions parse_svf_options(int argc, char** argv) {
  CommandLine line;
  if (const auto exit_code = parse_command_line(line.app, argc, argv, [&] { resolve(line.raw, line.options); }))
    return {std::nullopt, *exit_code};
  return {std::move(line.options), exit_done};
}

void describe_svf_options(const CommandLineVisitor& visit) { visit(svf_program(), CommandLine().app); }

}  // namespace farlod

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/app/city_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <utility>

#include "console/option_list.hpp"
#include "farlod/error.hpp"
#include "generator/generated_city.hpp"

namespace farlod {
namespace {

ProgramDescription city_program() {
  return {.name = "farlod-city",
          .purpose = "makes test cities of any size: same settings, same bytes, on every machine",
          .examples = {"farlod-city -o town.city.json --size 1000",
                       "farlod-city -o metropolis.obj --size 3500 --rotation 29 --lod 2 --overhangs"},
          .background =
              {"The cities have avenues, streets, towers and houses, and on demand what real models have: hills, overhangs, "
               "open shells, wrong heights. They are for tests and measurements of farlod-pack and farlod-svf.",
               "The ending of the output says the format: .gml (CityGML 2.0), .city.json (CityJSON 2.0), .obj, .geojson.",
               "GeoJSON holds footprints with `height` above `base`, both in metres: roofs of LoD2 and arcades are reduced to "
               "that, and a bridge has its underside as base. Its coordinates are in the CRS that the file names, since the "
               "city is not in degrees."},
          .exit_codes = {{exit_done, "done"},
                         {exit_internal, "an internal error"},
                         {exit_usage, "a wrong command line"},
                         {exit_unusable_input, "the output cannot be written"}},
          .licence = "Apache-2.0"};
}

/// Options whose texts are resolved after parsing.
struct RawOptions {
  std::string output, trees, crs = "EPSG:32632";
  std::int64_t buildings = 0;
};

/// Adds the options of the numeric settings. Their ranges are checked when all options are known.
void add_settings(CLI::App& app, CitySettings& settings) {
  CitySettings::describe(settings,
                         [&app](const char* name, auto& value, SettingRange range, const char* group, const char* help) {
                           const std::string text = fmt::format("{} ({:.12g} to {:.12g})", help, range.low, range.high);
                           app.add_option(std::string("--") + name, value, text)
                               ->default_str(fmt::format("{:.12g}", static_cast<double>(value)))
                               ->group(group);
                         });
}

void add_other_options(CLI::App& app, RawOptions& raw, CityOptions& o) {
  app.add_option("-o,--output", raw.output, "File to write")->required()->type_name(file_value)->group("Output");
  app.add_option("--trees", raw.trees, "GeoJSON to write trees to as well: avenues, yards and parks; for farlod-pack --trees")
      ->type_name(file_value)
      ->group("Output");
  app.add_flag("--obj-from-centre", o.obj_from_centre,
               "OBJ: count x and y from the city's centre, for viewers that compute in float")
      ->group("Output");
  app.add_option("--seed", o.settings.seed, "Number that chooses one of many cities alike")->capture_default_str()->group("City");
  app.add_option("--buildings", raw.buildings, "Choose the size such that the city has about so many buildings")
      ->excludes("--size")
      ->group("City");
  CitySettings::describe_switches(o.settings, [&app](const char* name, bool& value, const char* help) {
    app.add_flag(std::string("--") + name, value, help)->group("Buildings");
  });
  app.add_option("--crs", raw.crs, "CRS that the file names, as EPSG:n: projected, in metres, easting first")
      ->capture_default_str()
      ->group("Place");
  add_run_options(app, city_program().name, o.run);
  app.get_option("--threads")->description("As for the other programs; a city is written by one thread");
}

/// Refuses settings that footprints with heights cannot represent.
void check_geojson(const CitySettings& settings) {
  const std::pair<const char*, bool> lost[] = {{"--open-shells", settings.open_shells},
                                               {"--eaves", settings.eaves_m > 0.0},
                                               {"--balconies", settings.balconies},
                                               {"--projecting-floors", settings.projecting_floors},
                                               {"--facade-details", settings.facade_details}};
  for (const auto& [option, is_asked] : lost)
    if (is_asked)
      throw CLI::ValidationError(option, "cannot be shown by the footprints of .geojson; write .gml, .city.json or .obj");
}

void resolve(const RawOptions& raw, const CLI::App& app, CityOptions& o) {
  o.output = raw.output;
  const auto format = generated_format_of(o.output);
  if (!format) throw CLI::ValidationError("--output", raw.output + " must end in .gml, .city.json, .obj or .geojson");
  o.format = *format;
  o.trees = raw.trees;
  if (o.obj_from_centre && o.format != CityFormat::obj) throw CLI::ValidationError("--obj-from-centre", "is for .obj only");
  const auto epsg = epsg_code(raw.crs);
  if (!epsg) throw CLI::ValidationError("--crs", "\"" + raw.crs + "\" is not like EPSG:32632");
  o.settings.epsg = *epsg;
  check(o.settings);
  if (o.format == CityFormat::geojson) check_geojson(o.settings);
  if (app.count("--buildings") > 0) o.settings.size_m = size_for_buildings_m(o.settings, raw.buildings);
}

/// All options, and what they are bound to.
struct CommandLine {
  CLI::App app;
  RawOptions raw;
  CityOptions options;

  CommandLine() {
    describe_program(app, city_program());
    add_settings(app, options.settings);
    add_other_options(app, raw, options);
  }
};

}  // namespace

ParsedCityOptions parse_city_options(int argc, char** argv) {
  CommandLine line;
  if (const auto exit_code = parse_command_line(line.app, argc, argv, [&] { resolve(line.raw, line.app, line.options); }))
    return {std::nullopt, *exit_code};
  return {std::move(line.options), exit_done};
}

}  // namespace farlod

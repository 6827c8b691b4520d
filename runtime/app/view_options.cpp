// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/view_options.hpp"

#include <CLI/CLI.hpp>

#include <string>
#include <utility>

#include "base/lower_case.hpp"
#include "console/option_list.hpp"
#include "farlod/error.hpp"

namespace farlod {
namespace {

ProgramDescription view_program() {
  return {
      .name = "farlod-view",
      .purpose = "shows a package of farlod-pack in a browser, coloured by its sky view factors",
      .examples = {"farlod-view town.farlod", "farlod-view town.farlod svf.tif problems.geojson",
                   "farlod-view town.farlod --export town.html", "farlod-view town.farlod --export town_view"},
      .background =
          {"The program answers a browser on the same machine until it is interrupted. Values are computed when they are "
           "looked at: the colours with 96 azimuths, and those of a place that is clicked as farlod-svf --at computes them.",
           "What --export writes has the values down to whole cells of the grid, and answers for no single places, since no "
           "program stands behind it. A file of HTML is for areas of up to 64 MiB, and needs neither a server nor a network. A "
           "folder is for any web server."},
      .exit_codes = {{exit_done, "done"},
                     {exit_internal, "an internal error"},
                     {exit_usage, "a wrong command line"},
                     {exit_unusable_input, "an input cannot be read or used, or nobody can listen at the address"},
                     {exit_damaged_package, "a damaged package"},
                     {exit_limit_reached, "a limit was reached"},
                     {exit_interrupted, "and the number of a signal: interrupted"}},
      .licence = "Apache-2.0"};
}

/// Whether --export means one file.
bool is_of_html(const std::filesystem::path& name) {
  const std::string ending = lower_case(name.extension().string());
  return ending == ".html" || ending == ".htm";
}

struct RawOptions {
  std::string package, exported;
};

void add_options(CLI::App& app, RawOptions& raw, ViewOptions& o) {
  constexpr int most_ports = 65535;
  app.add_option("PACKAGE", raw.package, "A folder that farlod-pack made")->required()->type_name(folder_value);
  app.add_option(
         "RESULTS", o.results,
         "Results to draw: rasters, points and surfaces (walls.surfaces.csv) of farlod-svf, each perhaps with the name of "
         "a band or field (svf.tif:svf_total), and reports of farlod-pack --report FILE.geojson")
      ->type_name("FILE[:NAME]");
  auto* const port = app.add_option("--port", o.server.port, "Port to listen at; 0: any that is free")
                         ->capture_default_str()
                         ->check(between(0, most_ports))
                         ->group("Server");
  auto* const address =
      app.add_option("--listen", o.server.address, "Address to listen at. Any but 127.0.0.1 lets other machines look at the city")
          ->capture_default_str()
          ->group("Server");
  app.add_option(
         "--export", raw.exported,
         "Write all instead of serving it: to this file where its name ends in .html, which a browser opens from the disk, "
         "or else to a folder for any web server")
      ->type_name(file_value)
      ->excludes(port)
      ->excludes(address)
      ->group("Output");
}

/// All options, and what they are bound to.
struct CommandLine {
  CLI::App app;
  RawOptions raw;
  ViewOptions options;

  CommandLine() {
    describe_program(app, view_program());
    add_options(app, raw, options);
    add_run_options(app, view_program().name, options.run);
  }
};

}  // namespace

ParsedViewOptions parse_view_options(int argc, char** argv) {
  CommandLine line;
  const auto resolve = [&] {
    line.options.package = line.raw.package;
    (is_of_html(line.raw.exported) ? line.options.export_page : line.options.export_folder) = line.raw.exported;
  };
  if (const auto exit_code = parse_command_line(line.app, argc, argv, resolve)) return {std::nullopt, *exit_code};
  return {std::move(line.options), exit_done};
}

void describe_view_options(const CommandLineVisitor& visit) { visit(view_program(), CommandLine().app); }

}  // namespace farlod

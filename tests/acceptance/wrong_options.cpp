// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/acceptance/wrong_commands.hpp"

namespace farlod::acceptance {
namespace {

WrongCommand usage(const std::string& command, const std::vector<std::string>& said) { return {command, exit_usage, said}; }
WrongCommand map(const std::string& options, const std::vector<std::string>& said) {
  return usage("farlod-svf a.farlod -o o.asc --grid 20 " + options, said);
}
WrongCommand place(const std::string& options, const std::vector<std::string>& said) {
  return usage("farlod-svf a.farlod -o o.csv --at 500030,5500010 " + options, said);
}
WrongCommand pack(const std::string& options, const std::vector<std::string>& said) {
  return usage("farlod-pack town.geojson -o b.farlod " + options, said);
}
WrongCommand city(const std::string& options, const std::vector<std::string>& said) {
  return usage("farlod-city -o t.gml " + options, said);
}

/// Options that there are not, and words that are left over.
std::vector<WrongCommand> misspelt_options() {
  return {
      usage("farlod-svf a.farlod -o o.asc --grd 2", {"--grd: there is no such option; did you mean --grid?"}),
      usage("farlod-svf a.farlod -o o.asc --gird 2", {"--gird", "did you mean --grid?"}),
      usage("farlod-svf a.farlod -o o.asc --Grid 2", {"--Grid", "did you mean --grid?"}),
      usage("farlod-svf a.farlod -o o.asc -grid 2", {"-grid", "did you mean --grid?"}),
      usage("farlod-svf a.farlod -o o.asc -g 2", {"-g: there is no such option"}),
      usage("farlod-svf a.farlod --outptu o.asc --grid 2", {"--outptu", "did you mean --output?"}),
      usage("farlod-svf a.farlod -o o.asc --point p.csv", {"--point: there is no such option"}),
      usage("farlod-svf --verison", {"--verison", "did you mean --version?"}),
      map("---bounds", {"---bounds", "did you mean --bounds?"}),
      map("\xE2\x80\x93\x62ounds", {"options begin with two hyphens", "did you mean --bounds?"}),
      map("--time 12:00", {"--time: there is no such option"}),
      map("--leaf-off 2026", {"2026: nothing is known of this argument"}),
      usage("farlod-svf a.farlod -o o.csv --at 500030 5500010", {"5500010", "joined by commas, without blanks"}),
      map("--bbox 500000 5500000 500100 5500100", {"5500000", "joined by commas, without blanks"}),
      pack("--cel 50", {"--cel: there is no such option; did you mean --cell?"}),
      pack("--neighbourhood 3", {"--neighbourhood", "did you mean --neighborhood?"}),
      pack("--quite", {"--quite", "did you mean --quiet?"}),
      pack("--grid 2", {"--grid: there is no such option"}),
      usage("farlod-info a.farlod --chek", {"--chek", "did you mean --check?"}),
      usage("farlod-info a.farlod b.farlod", {"b.farlod: nothing is known of this argument"}),
      usage("farlod-svf a.farlod --surfaces all -o o --city cities empty",
            {"empty is one too many: --city takes one folder, and has cities; give the folder that holds both"}),
      usage("farlod-svf a.farlod -o o.csv --points points.csv page.csv",
            {"page.csv is one too many: --points takes one file, and has points.csv; give each file a run"}),
      usage("farlod-view a.farlod --exprt v.html", {"--exprt", "did you mean --export?"}),
      city("--sise 100", {"--sise", "did you mean --size?"}),
      map("--config typo.toml", {"--config: rayz is no option", "did you mean rays?"}),
      map("--config town.geojson", {"--config", "neither the summary of a run", "TOML"}),
      map("--config page.gml", {"--config", "give TOML, or the --summary of a run"}),
      map("--config lost.toml", {"--config: lost.toml does not exist"}),
      map("--config cities", {"--config: cities is a folder"}),
  };
}

/// Options that lack something, or each other, or are too many.
std::vector<WrongCommand> incomplete_options() {
  return {
      usage("farlod-svf", {"PACKAGE is required: a folder that farlod-pack made"}),
      usage("farlod-svf a.farlod --grid 2", {"--output is required: file to write"}),
      usage("farlod-svf a.farlod o.asc --grid 2", {"--output is required", "is it o.asc? Write -o o.asc"}),
      usage("farlod-svf a.farlod -o o.asc", {"one of --grid,", "such as --grid 2"}),
      usage("farlod-svf a.farlod -o o.asc --grid 2 --at 1,2", {"--grid and --at exclude each other", "at most 1 of --grid,"}),
      usage("farlod-svf a.farlod -o o.asc --grid", {"--grid has no value: give a number from 0.01 to 10000"}),
      usage("farlod-svf a.farlod -o o.asc --grid --bounds", {"--grid has no value, and --bounds follows: give a number"}),
      usage("farlod-svf a.farlod --grid 2 -o", {"--output has no value: file to write"}),
      usage("farlod-svf a.farlod -o o.csv --surfaces", {"--surfaces has no value: give one of roofs, walls, all"}),
      map("--grid 30", {"--grid was given 2 times: give it once"}),
      map("--merge --shard 0/2", {"--shard and --merge exclude each other"}),
      map("--bounds=maybe", {"--bounds takes no value", "maybe"}),
      usage("farlod-pack", {"--output is required: folder of the package"}),
      usage("farlod-pack -o b.farlod", {"INPUT is required: city files"}),
      pack("--cell", {"--cell has no value: give a number from 0.5 to 10000"}),
      pack("--merge --shard 0/2", {"--shard and --merge exclude each other"}),
      pack("--canopy-absolute", {"--canopy-absolute", "goes with --canopy, which is missing"}),
      usage("farlod-info", {"PACKAGE is required"}),
      usage("farlod-info a.farlod --png", {"--png has no value"}),
      usage("farlod-info a.farlod --obj o.obj", {"--obj", "--cell"}),
      usage("farlod-info a.farlod --report r.json", {"--report", "--png"}),
      usage("farlod-view", {"PACKAGE is required"}),
      usage("farlod-view a.farlod --export v --port 8000", {"--port and --export exclude each other"}),
      usage("farlod-city", {"--output is required: file to write"}),
      city("--size", {"--size has no value: give a number"}),
      city("--buildings 10 --size 100", {"--size and --buildings exclude each other"}),
  };
}

/// Values that are no numbers, or not those that are allowed.
std::vector<WrongCommand> wrong_numbers() {
  return {
      map("--height tall", {"--height: tall is not a number from 0 to 10000"}),
      map("--rays 1e6", {"--rays", "1e6", "give a whole number from 1 to 10000000"}),
      map("--threads 1.5", {"--threads", "1.5", "give a whole number from 1 to 4096"}),
      map("--threads -1", {"--threads: -1 is not a number from 1 to 4096"}),
      map("--max-error 2", {"--max-error: 2 is not a number from 0.0001 to 1"}),
      map("--memory-limit 2GB", {"--memory-limit: 2GB is not a number"}),
      map("--transmissivity 3", {"--transmissivity: 3 is not a number from 0 to 1"}),
      map("--shard 3/2", {"--shard: there is no shard 3 of 2: they count from 0 to 1"}),
      map("--shard 2", {"--shard: \"2\" is not of the form I/N"}),
      map("--shard auto", {"--shard", "no task of a job array", "Give --shard I/N"}),
      usage("farlod-svf a.farlod -o o.asc --grid 2m", {"--grid: 2m is not a number"}),
      usage("farlod-svf a.farlod -o o.asc --grid 2,5", {"--grid: 2,5 is not a number"}),
      usage("farlod-svf a.farlod -o o.asc --grid -2", {"--grid: -2 is not a number"}),
      usage("farlod-svf a.farlod -o o.csv --at here", {"--at: \"here\" is not of the form X,Y"}),
      map("--bbox '500000 5500000 500100 5500100'", {"--bbox", "is not of the form X0,Y0,X1,Y1"}),
      pack("--neighborhood 3.5", {"--neighborhood", "3.5", "give a whole number from 1 to 999"}),
      pack("--max-error 5%", {"--max-error: 5% is not a number"}),
      pack("--memory-limit 0", {"--memory-limit: 0 is not a number from 1 to"}),
      pack("--unknown-height none", {"--unknown-height", "none", "give a number"}),
      pack("--area 500100,5500000,500000,5500100", {"--area", "X0 < X1"}),
      pack("--area 9,49,10,50", {"meets no cell of the grid", "from 9.0,49.0 to 10.0,50.0", "check its coordinates"}),
      usage("farlod-info a.farlod --cell 1", {"--cell: \"1\" is not of the form I,J"}),
      usage("farlod-view a.farlod --port 99999", {"--port: 99999 is not a number from 0 to 65535"}),
      usage("farlod-view a.farlod --port http", {"--port: http is not a number"}),
      city("--size 0", {"--size is 0; it must be between 100 and 200000"}),
      city("--size 1km", {"--size", "1km", "give a number"}),
      city("--buildings 0", {"--buildings is 0"}),
  };
}

/// Words of which there are some.
std::vector<WrongCommand> wrong_words() {
  return {
      map("--engine horizn", {"--engine: horizn is not one of auto, horizon, rays, exact; did you mean horizon?"}),
      map("--engine Rays", {"--engine: Rays", "did you mean rays?"}),
      usage("farlod-svf a.farlod -o o.csv --surfaces roof", {"--surfaces: roof", "did you mean roofs?"}),
      map("--quantity sees_building", {"\"sees_building\" is a band of --quantity view_building"}),
      map("--quantity svfN", {"\"svfN\" is a band of --quantity directional"}),
      map("--quantity view_wall_ne", {"\"view_wall_ne\" is a band of --quantity view_factors"}),
      map("--quantity svff", {"\"svff\" is not one of svf, svf_solid", "did you mean svf?"}),
      map("--quantity irradiaton", {"\"irradiaton\" is not one of", "did you mean irradiation?"}),
      map("--quantity hidden,", {"--quantity", "\"hidden,\" has an empty name: leave a comma out"}),
      map("--quantity hidden,,directional", {"--quantity", "has an empty name"}),
      map("--quantity sunlit", {"--quantity", "give --sun"}),
      place("--quantity irradiation", {"--quantity", "give --weather", "--period"}),
      map("--sun tomorrow", {"--sun: \"tomorrow\" is neither a day, like 2026-06-21, nor a year"}),
      map("--sun 2026-02-30", {"--sun: \"2026-02-30\" is no day"}),
      map("--sun 21.06.2026", {"--sun", "like 2026-06-21"}),
      place("--quantity irradiation --period 2026-06/2026-05", {"--period", "it ends before it begins"}),
      place("--quantity irradiation --period yesterday", {"--period", "yesterday", "write it like 2026"}),
      map("--weather a.epw", {"--weather", "--quantity irradiation"}),
      map("--points-crs 4326", {"--points-crs", "--points or --along"}),
      map("--quantity view_factors --wall-sectors 6", {"--wall-sectors: 6 is not one of 4, 8"}),
      map("--quantity view_eye --eye-field 91", {"--eye-field", "from 1 to 90"}),
      map("--quantity view_building", {"--quantity", "view_building", "--sees"}),
      map("--sees b1", {"--sees: it goes with --quantity view_building"}),
      map("--sky-patches 9", {"--sky-patches: 9 is not one of 145, 577"}),
      usage("farlod-svf a.farlod -o o.aasc --grid 2", {"o.aasc", "choose one of", "did you mean .asc?"}),
      usage("farlod-svf a.farlod -o '' --grid 2", {"-o: the name is empty: give a file"}),
      usage("farlod-svf a.farlod -o cities --grid 2", {"-o: the ending of \"cities\"", "choose one of"}),
      usage("farlod-svf a.farlod -o o.csv --grid 2", {"-o: --grid makes a raster", "choose one of"}),
      pack("--lod LoD2", {"--lod: LoD2 is not one of best, 0, 1, 2, 3"}),
      pack("--far-map boxs", {"--far-map: boxs", "did you mean box?"}),
      pack("--align nroth", {"--align: \"nroth\"", "auto, none, or degrees"}),
      usage("farlod-info a.farlod --cells cells.tif", {"--cells", "cells.tif", "choose one of"}),
      usage("farlod-info a.farlod --png o.jpg", {"--png", "o.jpg", "choose one of"}),
      usage("farlod-city -o t.gmll", {"t.gmll must end in .gml"}),
      city("--crs 32632", {"--crs: \"32632\" is not like EPSG:32632"}),
      city("--obj-from-centre", {"--obj-from-centre", ".obj only"}),
  };
}

}  // namespace

std::vector<WrongCommand> wrong_options() {
  std::vector<WrongCommand> all;
  for (const auto& rows : {misspelt_options(), incomplete_options(), wrong_numbers(), wrong_words()})
    all.insert(all.end(), rows.begin(), rows.end());
  return all;
}

}  // namespace farlod::acceptance

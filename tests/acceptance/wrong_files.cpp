// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/acceptance/wrong_commands.hpp"

namespace farlod::acceptance {
namespace {

WrongCommand unusable_file(const std::string& command, const std::vector<std::string>& said) {
  return {command, exit_unusable_input, said};
}
WrongCommand map_of(const std::string& package, const std::vector<std::string>& said) {
  return unusable_file("farlod-svf " + package + " -o o.asc --grid 20", said);
}
WrongCommand map_with(const std::string& options, const std::vector<std::string>& said) {
  return unusable_file("farlod-svf a.farlod -o o.asc " + options, said);
}
WrongCommand table_with(const std::string& options, const std::vector<std::string>& said) {
  return unusable_file("farlod-svf a.farlod -o o.csv " + options, said);
}
WrongCommand pack_of(const std::string& input, const std::vector<std::string>& said) {
  return unusable_file("farlod-pack " + input + " -o b.farlod", said);
}
WrongCommand info(const std::string& options, const std::vector<std::string>& said) {
  return unusable_file("farlod-info " + options, said);
}
WrongCommand view(const std::string& options, const std::vector<std::string>& said) {
  return unusable_file("farlod-view " + options, said);
}
WrongCommand city_at(const std::string& options, const std::vector<std::string>& said) {
  return unusable_file("farlod-city --size 100 " + options, said);
}

/// What is given for a package is none.
std::vector<WrongCommand> packages_that_are_none() {
  return {
      map_of("town.geojson", {"town.geojson is a file", "farlod-pack town.geojson -o NAME.farlod"}),
      map_of("cities", {"cities is not a package", "box.obj", "farlod-pack cities -o NAME.farlod"}),
      map_of("empty", {"empty is an empty folder, and not a package"}),
      map_of("a.farlod/blocks", {"a.farlod/blocks is a part of the package a.farlod: give that folder"}),
      map_of("a.farlod/manifest.json", {"is a part of the package a.farlod: give that folder"}),
      map_of("a", {"a is not a package", "did you mean a.farlod?"}),
      map_of(".", {". is not a package, but a folder with some", "./a.farlod"}),
      map_of("elsewhere.farlod", {"elsewhere.farlod is not a package: there is no such folder. farlod-pack makes one"}),
      info("cities", {"cities is not a package", "farlod-pack cities"}),
      view("town.geojson", {"town.geojson is a file"}),
      pack_of("a.farlod", {"a.farlod is a package already", "farlod-svf"}),
      pack_of("a.farlod/manifest.json", {"a.farlod is a package already"}),
  };
}

/// Files that cannot be read.
std::vector<WrongCommand> inputs_that_are_others() {
  return {
      pack_of("twon.geojson", {"twon.geojson does not exist; did you mean town.geojson?"}),
      pack_of("town.geojson,box.obj", {"does not exist", "put blanks between the names of files"}),
      pack_of("https://example.org/t.gml", {"is an address of the web: download the file first"}),
      pack_of("'*.citygml'", {"*.citygml does not exist"}),
      pack_of("empty", {"empty holds no file of a city"}),
      pack_of("empty.gml", {"empty.gml is empty: 0 bytes"}),
      pack_of("page.gml", {"page.gml is a web page"}),
      pack_of("paper.pdf", {"paper.pdf is a document"}),
      pack_of("cut.zip", {"cut.zip is a zip archive that cannot be read"}),
      pack_of("points.csv", {"points.csv holds no layer of polygons"}),
      pack_of("box.obj", {"box.obj does not say its CRS: give --crs EPSG:n"}),
      pack_of("town.geojson --terrain lost.tif", {"lost.tif does not exist"}),
      pack_of("town.geojson --far-terrain lost.tif", {"lost.tif does not exist"}),
      pack_of("town.geojson --terrain empty", {"empty holds no raster of heights"}),
      pack_of("town.geojson --trees empty", {"empty is a folder: give a file"}),
      pack_of("town.geojson --area lost.gpkg", {"lost.gpkg does not exist"}),
      pack_of("town.geojson --height-field hight", {"no field \"hight\"", "height, floors", "--height-field"}),
      pack_of("streets.geojson --height-field street", {"the field street has a number in no feature", "numbers: height"}),
      table_with("--points lost.csv", {"lost.csv does not exist. Check the path"}),
      table_with("--points point.csv", {"point.csv does not exist; did you mean points.csv?"}),
      table_with("--points cities", {"cities is a folder: give a file"}),
      table_with("--points cut.zip", {"cut.zip is no table: give points as CSV"}),
      table_with("--points page.csv", {"page.csv is no table: give points as CSV"}),
      table_with("--at 500030,5500010 --quantity irradiation --weather lost.epw", {"lost.epw does not exist"}),
      table_with("--at 500030,5500010 --quantity irradiation --weather cities", {"cities is a folder: give a file"}),
      table_with("--at 500030,5500010 --quantity irradiation --weather page.gml", {"page.gml", "is no weather", "give an EPW"}),
      table_with("--at 500030,5500010 --quantity irradiation --weather points.csv",
                 {"points.csv:1", "is no weather", "name columns time"}),
      info("a.farlod --cell 100,100", {"a.farlod has no cell 100,100: i goes from"}),
      view("a.farlod lost.asc --export v", {"lost.asc does not exist"}),
      view("a.farlod points.csv --export v", {"points.csv has no field svf", "points.csv:FIELD"}),
      view("a.farlod cities --export v", {"cities is a folder: give a file"}),
#ifdef FARLOD_WITH_GDAL
      table_with("--points town.geojson", {"town.geojson holds no points"}),
      table_with("--points paper.pdf", {"paper.pdf cannot be read as a vector file", "give a GeoPackage"}),
      table_with("--points empty.gml", {"empty.gml is empty: 0 bytes"}),
      table_with("--along points.csv", {"points.csv holds no lines", "give lines"}),
      table_with("--along lost.gpkg", {"lost.gpkg does not exist"}),
      table_with("--along metres.geojson",
                 {"metres.geojson: point 1 at (500000, 5500010) cannot be projected from WGS 84 (degrees)", "GeoJSON",
                  "--points-crs EPSG:n"}),
      table_with("--along metres.geojson --points-crs EPSG:4326", {"cannot be projected from EPSG:4326: check --points-crs"}),
      table_with("--points metre.geojson",
                 {"metre.geojson: point 1 at (500000, 5500010) cannot be projected from WGS 84 (degrees)", "GeoJSON",
                  "--points-crs EPSG:n"}),
      table_with("--points points.csv --points-crs EPSG:4326", {"points.csv: point 1 at", "check --points-crs"}),
      map_with("--grid 20 --mask quarter.geojson",
               {"quarter.geojson: point 1 at (500000, 5500010) cannot be projected from WGS 84", "GeoJSON",
                "ogr2ogr -a_srs EPSG:n NEW.gpkg quarter.geojson"}),
      info("a.farlod --cells o.csv --zones quarter.geojson", {"quarter.geojson: feature 0", "ogr2ogr -a_srs EPSG:n NEW.gpkg"}),
      table_with("--points points.csv --points-crs 4326", {"\"4326\", is not known", "EPSG:4326"}),
      map_with("--grid 20 --mask lost.gpkg", {"lost.gpkg does not exist"}),
      map_with("--grid 20 --mask points.csv", {"points.csv holds no polygons"}),
      map_with("--grid-like lost.asc", {"lost.asc does not exist"}),
      map_with("--grid-like town.geojson", {"town.geojson cannot be read as a raster", "give a GeoTIFF"}),
      map_with("--grid-like cities", {"cities is a folder: give a file"}),
#endif
  };
}

/// Runs that would answer nothing.
std::vector<WrongCommand> places_of_nothing() {
  return {
      map_with("--grid 20 --bbox 2000,3000,2100,3100", {"No receiver has an answer", "The city lies from", "check --bbox"}),
      map_with("--grid 20 --bbox 2000,3000,2100,3100 --dry-run", {"No receiver has an answer", "check --bbox"}),
      map_with("--grid 20 --within 0 --bbox 500000,5500000,500100,5500100",
               {"No receiver has an answer", "farther than 0 m from any building", "--within"}),
      map_with("--grid 20 --bbox 5500000,500000,5500100,500100", {"none of", "The city lies from"}),
      table_with("--surfaces roofs --bbox 0,0,1,1", {"The city lies from"}),
      table_with("--at 49.65,9.0", {"49.65, 9 lies more than 100 km from the city", "give the longitude before the latitude"}),
      table_with("--at 5500000,500000", {"5500000, 500000 lies more than 100 km from the city", "check the coordinates"}),
      map_with("--grid 20 --merge", {"there is nothing to merge into o.asc"}),
      unusable_file("farlod-pack --merge -o b.farlod", {"there is nothing to merge into b.farlod"}),
#ifdef FARLOD_WITH_GDAL
      map_with("--grid 20 --bbox 9.5,50.1,9.6,50.2",
               {"The city lies from", "In degrees (longitude, latitude), --bbox goes from 9.5000, 50.1000",
                "and the city from 8.9998"}),
      map_with("--grid 20 --bbox 9.5,50.1,9.6,50.2 --dry-run", {"In degrees"}),
      map_with("--grid 20 --bbox 139.6,35.9,139.7,36.0", {"In degrees", "from 139.6000, 35.9000", "and the city from 8.9998"}),
      map_with("--grid-like far.asc", {"No receiver has an answer", "check --grid-like"}),
#endif
  };
}

/// Runs for which no machine has the memory.
std::vector<WrongCommand> more_than_machines_have() {
  // 4,096 cells are in flight, each with 100 million receivers of 100 bytes: 40 TB and more
  return {{"farlod-svf a.farlod -o o.tif --grid 0.01 --threads 1024 --quiet",
           exit_limit_reached,
           {"this run needs about ", "MiB, and this machine has ", "a coarser raster", "set a memory limit of", "--bbox"}}};
}

/// Outputs that cannot be written, or would take the place of something else.
std::vector<WrongCommand> outputs_in_the_way() {
  return {
      map_with("--grid 20 --preview lost/p.svg", {"cannot write lost/p.svg", "there is no folder lost"}),
      map_with("--grid 20 --summary cities", {"cannot write cities", "there is a folder of this name"}),
      map_with("--grid 20 --summary /proc/s.json", {"cannot write /proc/s.json", "nothing can be written in /proc"}),
      map_with("--grid 20 --summary o.asc", {"cannot write o.asc", "both -o and --summary name it"}),
      map_with("--grid 20 --summary ./o.asc", {"both -o and --summary name it"}),
      unusable_file("farlod-svf a.farlod -o o.svg --grid 20 --preview o.svg", {"both -o and --preview name it"}),
      unusable_file("farlod-svf a.farlod -o /proc/o.asc --grid 20",
                    {"cannot write /proc/o.asc", "nothing can be written in /proc"}),
      unusable_file("farlod-svf a.farlod -o folder.csv --at 500030,5500010",
                    {"cannot write folder.csv", "a folder of this name"}),
      unusable_file("farlod-svf a.farlod -o points.csv --points points.csv",
                    {"cannot write points.csv", "it is the file of --points"}),
      unusable_file("farlod-svf a.farlod -o a.farlod/o.asc --grid 20",
                    {"cannot write a.farlod/o.asc", "it lies in the package a.farlod"}),
      pack_of("town.geojson --report town.geojson", {"cannot write town.geojson", "it is the file of INPUT"}),
      pack_of("town.geojson --summary cities", {"cannot write cities", "there is a folder of this name"}),
      pack_of("town.geojson --report /proc/r.json", {"cannot write /proc/r.json", "nothing can be written in /proc"}),
      pack_of("town.geojson --report r.json --summary r.json", {"both --report and --summary name it"}),
      unusable_file("farlod-pack town.geojson -o a.farlod", {"a.farlod exists already", "--force"}),
      unusable_file("farlod-pack cities --crs EPSG:32632 -o cities", {"cities holds", "choose another folder"}),
      unusable_file("farlod-pack town.geojson -o town.geojson", {"town.geojson is a file: choose another name"}),
      info("a.farlod --summary a.farlod/manifest.json", {"it lies in the package a.farlod"}),
      info("a.farlod --cells o.csv --summary o.csv", {"both --cells and --summary name it"}),
      info("a.farlod --png lost/o.svg", {"there is no folder lost"}),
      view("a.farlod --export cities", {"cannot write cities", "it holds other files"}),
      view("a.farlod --export town.geojson", {"cannot write town.geojson", "it is a file"}),
      view("a.farlod --export /proc/v", {"cannot write /proc/v", "nothing can be written in /proc"}),
      view("a.farlod --export v.html --summary v.html", {"both --export and --summary name it"}),
      view("a.farlod --listen nowhere.invalid", {"nowhere.invalid is not an address"}),
      view("a.farlod --listen 192.0.2.1", {"192.0.2.1 is not an address of this machine", "--listen"}),
      city_at("-o lost/t.gml", {"cannot write lost/t.gml", "there is no folder lost"}),
      city_at("-o t.gml --trees t.gml", {"both -o and --trees name it"}),
      city_at("-o t.gml --summary lost/s.json", {"there is no folder lost"}),
      city_at("-o folder.gml", {"there is a folder of this name"}),
  };
}

}  // namespace

std::vector<WrongCommand> wrong_files() {
  std::vector<WrongCommand> all;
  for (const auto& rows :
       {packages_that_are_none(), inputs_that_are_others(), places_of_nothing(), more_than_machines_have(), outputs_in_the_way()})
    all.insert(all.end(), rows.begin(), rows.end());
  return all;
}

}  // namespace farlod::acceptance

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/citygml/citygml_reader.hpp"

#include <unordered_set>
#include <utility>

#include "city/input_error.hpp"
#include "ingest/citygml/citygml_parser.hpp"
#include "ingest/citygml/citygml_surface_finder.hpp"
#include "ingest/citygml/citygml_xml.hpp"

namespace farlod {
namespace {

/// References that lead to references that lead on: each step is one more reading of the file, and none that we know of
/// takes more than two.
constexpr int most_searches = 6;

struct Reading {
  SourceCity city;
  Report report;
  std::unordered_set<std::string> foreign_hrefs;
};

std::string list(const SkippedFeatures& skipped) {
  constexpr std::size_t most_listed = 5;
  std::string text;
  std::size_t listed = 0;
  for (const auto& [name, count] : skipped) {
    if (listed++ == most_listed) return text + ", ...";
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + name;
  }
  return text;
}

[[noreturn]] void throw_nothing_there(const InputFile& file, const CityGmlParser& parser) {
  if (parser.root() != "CityModel")
    throw InputError(file.name + " is XML, but not CityGML: it begins with <" + parser.root() + ">.");
  throw InputError(file.name + " holds no Building, Bridge, Tunnel, OtherConstruction or relief" +
                   (parser.skipped().empty() ? "." : ", but " + list(parser.skipped()) + ".") +
                   " Is it another theme of the city model?");
}

void report_unreadable_relief(std::size_t points, CityWriter& writer) {
  if (points > 0)
    writer.add_problem_at("relief", ProblemCode::unreadable_coordinate,
                          "points of the terrain that miss a coordinate, or have one that is not a number or beyond the Earth: " +
                              std::to_string(points));
}

Reading read_buildings(const InputFile& file, LodChoice lod, const GmlSurfaces& foreign) {
  Reading reading;
  Borrowing borrowing(foreign);
  CityWriter writer(file.name, reading.report);
  CityGmlParser parser([&](const CityGmlBuilding& building) {
    for (std::string& href : foreign_references(building)) reading.foreign_hrefs.insert(std::move(href));
    write_building(building, foreign, lod, borrowing, writer);
  });
  parse_xml(file, parser);
  ReliefReader& relief = parser.relief();
  if (writer.buildings_met() == 0 && relief.points().empty()) throw_nothing_there(file, parser);
  report_unreadable_relief(relief.unreadable_points(), writer);
  reading.city.source = file.name;
  reading.city.crs.definition = parser.srs_name();
  reading.city.city = writer.take_city();
  reading.city.relief_points = std::move(relief.points());
  reading.city.skipped = parser.skipped();
  return reading;
}

/// Surfaces found under foreign ids may refer on; the search goes on until it learns nothing new.
GmlSurfaces find_surfaces(const InputFile& file, std::unordered_set<std::string> hrefs) {
  for (int search = 1;; ++search) {
    GmlSurfaceFinder finder(hrefs);
    parse_xml(file, finder);
    const std::size_t known = hrefs.size();
    for (const GmlMember& member : finder.found().members)
      if (!member.polygon) hrefs.insert(member.href);
    if (hrefs.size() == known || search == most_searches) return std::move(finder.found());
  }
}

SourceCity hand_over(Reading reading, Report& report) {
  for (const Problem& problem : reading.report.problems()) report.add(problem);
  return std::move(reading.city);
}

}  // namespace

SourceCity read_citygml(const InputFile& file, LodChoice lod, Report& report) {
  std::unordered_set<std::string> foreign_hrefs;
  {
    // What was read goes before it is read anew: memory holds one city
    Reading reading = read_buildings(file, lod, {});
    if (reading.foreign_hrefs.empty()) return hand_over(std::move(reading), report);
    foreign_hrefs = std::move(reading.foreign_hrefs);
  }
  return hand_over(read_buildings(file, lod, find_surfaces(file, std::move(foreign_hrefs))), report);
}

}  // namespace farlod

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/citygml/citygml_reader.hpp"

#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "farlod/error.hpp"
#include "ingest/citygml/citygml_parser.hpp"
#include "ingest/citygml/citygml_xml.hpp"
#include "ingest/citygml/gml_surfaces.hpp"
#include "ingest/citygml/xml_element.hpp"

namespace farlod::ingest {
namespace {

/// The file is read once more for each step of a chain of references. Known files take at most two steps.
constexpr int most_searches = 6;

/// Finds the surfaces with given ids anywhere in a file, for buildings that refer to surfaces of other objects.
class GmlSurfaceFinder : public XmlListener {
 public:
  /// `hrefs`: the references as written in the file. References into other files ("town.gml#a") are never found.
  explicit GmlSurfaceFinder(const std::unordered_set<std::string>& hrefs) : hrefs_(hrefs) {}

  void start(const XmlElement& element) override {
    if (skipped_depth_ > 0) {
      ++skipped_depth_;
    } else if (wanted_depth_ > 0 || is_wanted(element.id)) {
      if (reader_.start(element) == GmlSurfaceReader::Answer::entered)
        ++wanted_depth_;
      else
        ++skipped_depth_;
    }
  }

  void end(std::string_view name) override {
    if (skipped_depth_ > 0) {
      --skipped_depth_;
    } else if (wanted_depth_ > 0) {
      reader_.end(name);
      --wanted_depth_;
    }
  }

  void text(std::string_view piece) override {
    if (wanted_depth_ > 0 && skipped_depth_ == 0) reader_.text(piece);
  }

  [[nodiscard]] GmlSurfaces& found() { return found_; }

 private:
  [[nodiscard]] bool is_wanted(std::string_view id) {
    if (id.empty()) return false;
    href_.assign(1, '#').append(id);
    return hrefs_.contains(href_);
  }

  const std::unordered_set<std::string>& hrefs_;
  GmlSurfaces found_;
  GmlSurfaceReader reader_{found_};
  std::size_t wanted_depth_ = 0, skipped_depth_ = 0;
  std::string href_;  ///< the reference to the current element
};

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

void report_unreadable_relief(std::size_t points, CityModelBuilder& builder) {
  if (points > 0)
    builder.add_problem_at(
        "relief", ProblemCode::unreadable_coordinate,
        "points of the terrain that miss a coordinate, or have one that is not a number or beyond the Earth: " +
            std::to_string(points));
}

Reading read_buildings(const InputFile& file, LodChoice lod, const GmlSurfaces& foreign) {
  Reading reading;
  ReferenceBudget budget(foreign);
  CityModelBuilder builder(file.name, reading.report);
  CityGmlParser parser([&](const CityGmlBuilding& building) {
    for (std::string& href : foreign_references(building)) reading.foreign_hrefs.insert(std::move(href));
    add_building(building, foreign, lod, budget, builder);
  });
  parse_xml(file, parser);
  ReliefReader& relief = parser.relief();
  if (builder.buildings_met() == 0 && relief.points().empty()) throw_nothing_there(file, parser);
  report_unreadable_relief(relief.unreadable_points(), builder);
  reading.city.source = file.name;
  reading.city.crs.definition = parser.srs_name();
  reading.city.city = builder.take_city();
  reading.city.relief_points = std::move(relief.points());
  reading.city.skipped = parser.skipped();
  return reading;
}

/// Surfaces that are found may contain references themselves. The search ends when it finds no new ones.
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
    // The first reading is dropped before the second begins, so that memory holds one city
    Reading reading = read_buildings(file, lod, {});
    if (reading.foreign_hrefs.empty()) return hand_over(std::move(reading), report);
    foreign_hrefs = std::move(reading.foreign_hrefs);
  }
  return hand_over(read_buildings(file, lod, find_surfaces(file, std::move(foreign_hrefs))), report);
}

}  // namespace farlod::ingest

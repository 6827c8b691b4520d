// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/citygml/citygml_reading.hpp"

#include <utility>

#include "farlod/error.hpp"

namespace farlod::ingest {
namespace {

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

}  // namespace

CityGmlReading::CityGmlReading(const ReadingTask& task, const ReferenceBudget& budget, RepeatedIds repeated_ids, bool has_crs,
                               std::vector<package::AttributeForm> forms)
    : task_(task),
      has_places_(has_byte_places(task.file)),
      budget_(budget),
      builder_(task.file.name, report_, repeated_ids),
      parser_([this](const CityGmlBuilding& building) { take(building); }, has_crs, std::move(forms)) {}

void CityGmlReading::take(const CityGmlBuilding& building) {
  for (std::string& href : foreign_references(building)) foreign_hrefs_.insert(std::move(href));
  add_building(building, task_.foreign, task_.lod, budget_, builder_, has_places_ ? &building.places : nullptr);
}

void CityGmlReading::append(CityGmlReading&& next) {
  if (!parser_.append(next.parser_) || !budget_.append(next.budget_)) throw CannotBeCut();
  builder_.append(std::move(next.builder_));
  foreign_hrefs_.merge(next.foreign_hrefs_);
}

CityGmlContents CityGmlReading::finish() {
  ReliefReader& relief = parser_.relief();
  if (builder_.buildings_met() == 0 && relief.points().empty()) throw_nothing_there();
  report_unreadable_relief(relief.unreadable_points());
  std::optional<PlacedFile> placed;
  if (has_places_) placed = {task_.file.on_disk, package::CityFileFormat::citygml, parser_.forms()};
  return {{.source = task_.file.name,
           .crs = {parser_.srs_name()},
           .city = builder_.take_city(),
           .relief_points = std::move(relief.points()),
           .skipped = parser_.skipped(),
           .placed = std::move(placed)},
          std::move(report_),
          std::move(foreign_hrefs_)};
}

void CityGmlReading::throw_nothing_there() const {
  if (parser_.root() != "CityModel")
    throw InputError(task_.file.name + " is XML, but not CityGML: it begins with <" + parser_.root() + ">.");
  throw InputError(task_.file.name + " holds no Building, Bridge, Tunnel, OtherConstruction or relief" +
                   (parser_.skipped().empty() ? "." : ", but " + list(parser_.skipped()) + ".") +
                   " Is it another theme of the city model?");
}

void CityGmlReading::report_unreadable_relief(std::size_t points) {
  if (points > 0)
    builder_.add_problem_at(
        "relief", ProblemCode::unreadable_coordinate,
        "points of the terrain that miss a coordinate, or have one that is not a number or beyond the Earth: " +
            std::to_string(points));
}

}  // namespace farlod::ingest

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/citygml/citygml_reader.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "ingest/citygml/citygml_reading.hpp"
#include "ingest/citygml/citygml_segmented_reading.hpp"
#include "ingest/citygml/citygml_xml.hpp"
#include "ingest/citygml/gml_surfaces.hpp"
#include "ingest/citygml/xml_element.hpp"
#include "ingest/ordered/ordered_work.hpp"

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

  void end(std::string_view name, std::uint64_t /*end*/) override {
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

CityGmlContents read_buildings(const ReadingTask& task) {
  if (threads_here() > 1)
    if (std::optional<CityGmlContents> contents = read_in_segments(task)) return std::move(*contents);
  CityGmlReading whole(task, ReferenceBudget(task.foreign), RepeatedIds::reported);
  parse_xml(task.file, whole.listener(), task.stop);
  return whole.finish();
}

/// Surfaces that are found may contain references themselves. The search ends when it finds no new ones.
GmlSurfaces find_surfaces(const InputFile& file, std::unordered_set<std::string> hrefs, const std::stop_token& stop) {
  for (int search = 1;; ++search) {
    GmlSurfaceFinder finder(hrefs);
    parse_xml(file, finder, stop);
    const std::size_t known = hrefs.size();
    for (const GmlMember& member : finder.found().members)
      if (!member.polygon) hrefs.insert(member.href);
    if (hrefs.size() == known || search == most_searches) return std::move(finder.found());
  }
}

SourceCity hand_over(CityGmlContents reading, Report& report) {
  for (const Problem& problem : reading.report.problems()) report.add(problem);
  return std::move(reading.city);
}

}  // namespace

SourceCity read_citygml(const InputFile& file, LodChoice lod, Report& report, const std::stop_token& stop,
                        const SegmentSizes& segments) {
  std::unordered_set<std::string> foreign_hrefs;
  {
    // The first reading is dropped before the second begins, so that memory holds one city
    CityGmlContents reading = read_buildings({file, lod, {}, stop, segments});
    if (reading.foreign_hrefs.empty()) return hand_over(std::move(reading), report);
    foreign_hrefs = std::move(reading.foreign_hrefs);
  }
  const GmlSurfaces foreign = find_surfaces(file, std::move(foreign_hrefs), stop);
  return hand_over(read_buildings({file, lod, foreign, stop, segments}), report);
}

}  // namespace farlod::ingest

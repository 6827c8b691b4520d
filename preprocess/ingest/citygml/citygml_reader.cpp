// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/citygml/citygml_reader.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "base/cancellation.hpp"
#include "farlod/error.hpp"
#include "ingest/citygml/gml_surfaces.hpp"

namespace farlod::ingest {
namespace {

/// Reads the segments of a file on all threads, and puts them together in their order.
class SegmentedReading {
 public:
  explicit SegmentedReading(const ReadingTask& task)
      : task_(task), cutter_(task.file, task.segments), whole_(task, budget_, RepeatedIds::reported) {}

  /// Throws CannotBeCut for a file that has to be read as a whole, and for one that is too short to be cut.
  void read_all() {
    // As a rule the first segment tells whether the file names a CRS, on which depends where prototypes are placed, and has all
    // forms of attributes that there are
    const FileSegment first = *cutter_.next();
    if (first.is_last) throw CannotBeCut();
    whole_.append(std::move(*read(first)));
    has_crs_ = whole_.has_crs();
    forms_ = whole_.forms();
    read_on();
  }

  [[nodiscard]] CityGmlContents finish() { return whole_.finish(); }

 private:
  /// A segment that is being read, or waits for its turn.
  struct InFlight {
    FileSegment segment;
    std::unique_ptr<CityGmlReading> reading;
  };

  void read_on() {
    std::vector<InFlight> in_flight(places_for_threads());
    const auto cut = [&](std::size_t place) {
      throw_if_cancelled(task_.stop);
      std::optional<FileSegment> segment = cutter_.next();
      if (segment) in_flight[place].segment = std::move(*segment);
      return segment.has_value();
    };
    const auto read_one = [&](std::size_t place) { in_flight[place].reading = read(in_flight[place].segment); };
    const auto append = [&](std::size_t place) {
      whole_.append(std::move(*in_flight[place].reading));
      in_flight[place] = {};
    };
    run_in_order(in_flight.size(), {cut, read_one, append});
  }

  [[nodiscard]] std::unique_ptr<CityGmlReading> read(const FileSegment& segment) const {
    auto reading = std::make_unique<CityGmlReading>(task_, budget_, RepeatedIds::reported_by_append, has_crs_, forms_);
    if (!parse_xml_segment({cutter_.head(), segment.text, segment.is_last, segment.begin}, reading->listener()))
      throw CannotBeCut();
    return reading;
  }

  const ReadingTask& task_;
  SegmentCutter cutter_;
  const ReferenceBudget budget_{task_.foreign};  ///< nothing is taken of it
  CityGmlReading whole_;
  bool has_crs_ = false;
  std::vector<package::AttributeForm> forms_;  ///< of the first segment
};

}  // namespace

std::optional<CityGmlContents> read_in_segments(const ReadingTask& task) {
  std::optional<SegmentedReading> reading;
  try {
    reading.emplace(task).read_all();
  } catch (const CannotBeCut&) {
    return std::nullopt;
  } catch (const InputError&) {
    return std::nullopt;
  }
  return reading->finish();
}

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

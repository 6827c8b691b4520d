// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/citygml/citygml_segmented_reading.hpp"

#include <memory>
#include <utility>
#include <vector>

#include "base/cancellation.hpp"
#include "farlod/error.hpp"
#include "ingest/citygml/citygml_xml.hpp"
#include "ingest/ordered/ordered_work.hpp"

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

}  // namespace farlod::ingest

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/obj/obj_mesh.hpp"

#include <optional>
#include <utility>

#include "base/cancellation.hpp"
#include "ingest/obj/obj_segment.hpp"
#include "ingest/ordered/ordered_work.hpp"

namespace farlod::ingest {

ObjMesh scan_obj(std::istream& text, const std::stop_token& stop, std::size_t segment_bytes) {
  /// A segment that is being parsed, or waits for its turn.
  struct InFlight {
    std::string text;
    ObjSegment segment;
  };
  std::vector<InFlight> in_flight(places_for_threads());
  ObjSegmentCutter cutter(text, segment_bytes);
  ObjMesh mesh;
  std::uint64_t lines = 0;
  const auto cut = [&](std::size_t place) {
    throw_if_cancelled(stop);
    std::optional<std::string> next = cutter.next();
    if (next) in_flight[place].text = std::move(*next);
    return next.has_value();
  };
  const auto scan = [&](std::size_t place) { in_flight[place].segment = scan_obj_segment(in_flight[place].text); };
  const auto append_one = [&](std::size_t place) {
    InFlight done = std::exchange(in_flight[place], {});
    const std::uint64_t lines_before = std::exchange(lines, lines + done.segment.lines);
    append(std::move(done.segment), lines_before, mesh);
  };
  run_in_order(in_flight.size(), {cut, scan, append_one});
  return mesh;
}

}  // namespace farlod::ingest

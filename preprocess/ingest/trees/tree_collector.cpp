// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/trees/tree_collector.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "farlod/error.hpp"

namespace farlod::ingest {
namespace {

/// Whether a problem has no place that could be told.
bool is_without_place(ProblemCode code) {
  return code == ProblemCode::no_geometry || code == ProblemCode::unreadable_coordinate ||
         code == ProblemCode::malformed_feature || code == ProblemCode::unsupported_geometry;
}

}  // namespace

void TreeCollector::note(ProblemCode code, const std::string& name, const std::string& detail, Point2d place) {
  Finding& finding = found_[code];
  if (finding.count++ == 0) finding = {1, name, detail, place};
}

void TreeCollector::add(const std::string& name, Point2d place, const StatedSizes& sizes) {
  if (!std::isfinite(place.x) || !std::isfinite(place.y))
    return note(ProblemCode::unreadable_coordinate, name, "a coordinate is not a finite number");
  result_.trees.push_back(sizes_.complete(sizes, name, place));
}

void TreeCollector::add_square(Point2d centre, double edge_m, double height_m) {
  result_.trees.push_back({.place = centre,
                           .height_m = static_cast<float>(height_m),
                           .crown_diameter_m = static_cast<float>(edge_m),
                           .shape = CrownShape::prism});
}

void TreeCollector::note_sizes() {
  constexpr const char* whole_file = "the whole file";
  const Point2d somewhere = result_.trees[0].place;
  if (const std::string missing = sizes_.missing(); !missing.empty())
    found_[ProblemCode::tree_size_missing] = {0, whole_file, missing, somewhere};
  if (const std::string classes = sizes_.classes(); !classes.empty())
    found_[ProblemCode::tree_size_classes] = {
        0, whole_file, classes + ": metres are taken; where they are classes, write metres into the file", somewhere};
  if (sizes_.absurd().count > 0) found_[ProblemCode::absurd_tree_size] = sizes_.absurd();
  if (sizes_.trunks().count > 0) found_[ProblemCode::trunk_above_crown] = sizes_.trunks();
}

SourceTrees TreeCollector::finish(std::uint64_t count, Report& report) {
  if (result_.trees.empty()) {
    std::string skipped;
    for (const auto& [what, times] : result_.skipped) skipped += "; " + std::to_string(times) + " " + what;
    throw InputError(result_.source + " holds no trees: of " + std::to_string(count) + " objects none can be used" +
                     (found_.empty() ? "" : ", since " + found_.begin()->second.first_detail) + skipped + ".");
  }
  note_sizes();
  for (const auto& [code, f] : found_) {
    const std::string counted = f.count > 1 ? std::to_string(f.count) + " trees, of which the first: " : "";
    std::optional<Point3d> position;
    if (!is_without_place(code)) position = Point3d{f.first_place.x, f.first_place.y, 0.0};
    report.add({code, result_.source, f.first_name, counted + f.first_detail, position});
  }
  return std::move(result_);
}

}  // namespace farlod::ingest

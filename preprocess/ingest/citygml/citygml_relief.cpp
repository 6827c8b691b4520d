// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/citygml/citygml_relief.hpp"

#include "ingest/model_builder/ring_cleaning.hpp"

namespace farlod::ingest {

void ReliefReader::begin(const XmlElement& property) {
  dimension_ = property.srs_dimension == "2" ? 2 : 3;
  in_list_ = false;
}

bool ReliefReader::start(const XmlElement& element) {
  if (element.srs_dimension == "2") dimension_ = 2;
  if (element.srs_dimension == "3") dimension_ = 3;
  // The corners of an envelope are no points of the terrain
  if (in_list_ || element.name == "boundedBy") return false;
  if (element.name == "posList" || element.name == "pos" || element.name == "coordinates") {
    in_list_ = true;
    numbers_.clear();
    first_of_list_.reset();
    points_of_list_ = 0;
  }
  return true;
}

void ReliefReader::text(std::string_view piece) {
  if (in_list_) scanner_.take(piece, [this](double number) { take_number(number); });
}

void ReliefReader::end() {
  if (!in_list_) return;
  in_list_ = false;
  scanner_.end([this](double number) { take_number(number); });
  if (!numbers_.empty()) ++unreadable_points_;
  const bool is_closed = points_of_list_ > 1 && first_of_list_ == points_.back();
  if (is_closed) points_.pop_back();
}

void ReliefReader::append(const ReliefReader& next) {
  points_.insert(points_.end(), next.points_.begin(), next.points_.end());
  unreadable_points_ += next.unreadable_points_;
}

void ReliefReader::take_number(double number) {
  numbers_.push_back(number);
  if (numbers_.size() < dimension_) return;
  add_point();
  numbers_.clear();
}

void ReliefReader::add_point() {
  const std::optional<Point3d> p = dimension_ < 3 ? std::nullopt : std::optional(Point3d{numbers_[0], numbers_[1], numbers_[2]});
  if (!p || !is_readable(*p)) {
    ++unreadable_points_;
    return;
  }
  points_.push_back(*p);
  if (points_of_list_++ == 0) first_of_list_ = points_.back();
}

}  // namespace farlod::ingest

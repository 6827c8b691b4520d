// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/citygml/citygml_prototype.hpp"

#include <cmath>

#include "base/expects.hpp"

namespace farlod::ingest {
namespace {

/// One more than a matrix has, so that a longer list is noticed.
constexpr std::size_t most_numbers = 17;

/// Longitudes end at 180. No known projected city is that close to the origin of its CRS.
bool reads_like_degrees(const Point3d& p) { return std::abs(p.x) <= 180.0 && std::abs(p.y) <= 180.0; }

}  // namespace

void PrototypeReader::begin(std::string_view property, const SurfaceUse& use) {
  property_ = property;
  use_ = use;
  matrix_.clear();
  position_.clear();
  is_elsewhere_ = has_surfaces_ = false;
}

bool PrototypeReader::start(std::string_view name) {
  if (name == "transformationMatrix")
    numbers_ = &matrix_;
  else if (name == "pos" || name == "coordinates")
    numbers_ = &position_;
  else
    return false;
  numbers_->clear();
  return true;
}

void PrototypeReader::text(std::string_view piece) {
  FARLOD_EXPECTS(numbers_ != nullptr);
  scanner_.take(piece, [this](double number) {
    if (numbers_->size() < most_numbers) numbers_->push_back(number);
  });
}

void PrototypeReader::end_numbers() {
  scanner_.end([this](double number) { numbers_->push_back(number); });
  numbers_ = nullptr;
}

std::optional<Placement> PrototypeReader::placement(bool has_crs, std::string& unread) const {
  unread = "a geometry by " + property_;
  if (!has_surfaces_) {
    if (is_elsewhere_) unread += " in another file (libraryObject)";
    return std::nullopt;
  }
  const bool has_position = position_.size() == 3 && std::isfinite(position_[0] + position_[1] + position_[2]);
  const Point3d reference_point = has_position ? Point3d{position_[0], position_[1], position_[2]} : Point3d{};
  const std::optional<Placement> placement = Placement::from(matrix_, reference_point);
  if (!has_position)
    unread += " without a readable referencePoint";
  else if (!placement)
    unread += " whose transformationMatrix is not 16 numbers";
  else if (has_crs && reads_like_degrees(reference_point))
    unread += " whose referencePoint is in degrees (its matrix counts in metres, so the file has to be in a projected CRS)";
  else
    return placement;
  return std::nullopt;
}

}  // namespace farlod::ingest

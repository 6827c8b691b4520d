// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "city/city_model.hpp"
#include "farlod/problem.hpp"
#include "georeference/crs.hpp"

namespace farlod::georeference {

/// Brings heights from the vertical system of one CRS to that of another, by PROJ and the grids that are installed.
///   (1) systems that are the same need no shift
///   (2) an operation that PROJ only pretends to have (ballpark), or whose grid is not installed, is none: no height is changed
class HeightShift {
 public:
  /// Both CRSs must have a vertical system. `typical`: a place in `from`, the easting or longitude first.
  HeightShift(const Crs& from, const Crs& to, Point2d typical);

  [[nodiscard]] bool is_needed() const { return !is_same_; }
  [[nodiscard]] bool is_known() const { return impl_ != nullptr; }
  /// What is added to a height, in metres. Empty where the operation has no answer. It must be known.
  [[nodiscard]] std::optional<double> at(Point2d p_from) const;
  /// For the user: both systems, and why nothing is known. It must not be known.
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
  bool is_same_ = false;
  std::string reason_;
};

struct ResolvedSource;

/// The shift between a file and the model; reports another_datum where it is needed and not known. Empty where there is nothing
/// to do: one of the two does not say its vertical system, or both are the same.
[[nodiscard]] std::optional<HeightShift> height_shift_for(const std::string& source, const Crs& own,
                                                          const std::string& heights_of_model, Point2d typical, Report& report);

/// For the user.
[[nodiscard]] std::string note_of_shift(const std::string& source, const Crs& own, const std::string& heights_of_model,
                                        double shift_m);

/// For the user: heights are taken in the unit of the map, which is no metre, since the CRS has no vertical axis. Empty where
/// they are not. `way_to_metres`: how to say that they are in metres.
[[nodiscard]] std::optional<std::string> note_of_height_unit(const std::string& source, const Crs& own,
                                                             const std::string& way_to_metres);

/// Brings the heights of a file to the vertical system of the model, which becomes that of the first file that has one. Heights
/// above the ground have none. `notes`: for the user.
void shift_heights(ResolvedSource& resolved, std::vector<std::string>& notes, std::string& heights_of_model, Report& report);

/// Brings the heights of a terrain that was read from a CRS to the vertical system of the model. Between nodes at most 100 m
/// apart, the shift is linear: geoids bend by less than a millimetre there.
void shift_heights(TerrainRaster& terrain, const std::string& source, const Crs& own, const Georeference& georeference,
                   Report& report);

}  // namespace farlod::georeference

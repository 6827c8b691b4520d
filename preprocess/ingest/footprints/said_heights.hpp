// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ingest/footprints/footprint_reader.hpp"
#include "plausibility/elevations_as_heights.hpp"

namespace farlod::ingest {

/// What the fields of a table say of some of its buildings, to find out whether these are no heights.
class SaidHeights {
 public:
  /// A field, and what its values were read as.
  using Field = std::pair<std::size_t, HeightSource>;

  void keep(const Field& field, const plausibility::SaidHeight& said) { keep(field, said, said_); }
  /// One that no building has.
  void keep_too_high(const Field& field, const plausibility::SaidHeight& said) { keep(field, said, too_high_); }

  /// Throws InputError where the heights of a field of `source` are elevations.
  void require_no_elevations(const std::string& source, const std::vector<std::string>& names) const;
  /// What is doubtful of a field, behind its name.
  [[nodiscard]] std::vector<std::string> doubts(const std::vector<std::string>& names, double floor_height_m) const;

 private:
  using OfFields = std::map<Field, std::vector<plausibility::SaidHeight>>;
  static void keep(const Field& field, const plausibility::SaidHeight& said, OfFields& heights);

  OfFields said_, too_high_;
};

}  // namespace farlod::ingest

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ingest/citygml/citygml_building.hpp"
#include "ingest/citygml/citygml_placement.hpp"
#include "ingest/citygml/gml_surfaces_numbers.hpp"

namespace farlod::ingest {

/// Reads the placement of an ImplicitGeometry of CityGML: its matrix and its reference point.
class PrototypeReader {
 public:
  /// Begins a property with a prototype whose surfaces have the use `use`.
  void begin(std::string_view property, const SurfaceUse& use);
  /// Begins an element; returns whether it holds numbers of the placement.
  [[nodiscard]] bool start(std::string_view name);
  void end_numbers();
  void text(std::string_view piece);
  void note_library_object() { is_elsewhere_ = true; }
  void note_surfaces() { has_surfaces_ = true; }
  [[nodiscard]] const SurfaceUse& use() const { return use_; }

  /// The placement of the prototype. Empty where there is none, with the reason added to `unread`. A matrix in metres cannot be
  /// used in a file whose CRS is in degrees.
  [[nodiscard]] std::optional<Placement> placement(bool has_crs, std::string& unread) const;

 private:
  NumberScanner scanner_;
  std::vector<double> matrix_, position_;
  std::vector<double>* numbers_ = nullptr;  ///< which of the two lists is being read
  std::string property_;
  SurfaceUse use_;
  bool is_elsewhere_ = false, has_surfaces_ = false;
};

}  // namespace farlod::ingest

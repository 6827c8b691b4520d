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

/// Reads what CityGML's ImplicitGeometry has besides surfaces: the matrix and the point that place a prototype.
class PrototypeReader {
 public:
  /// A property with a prototype begins, whose surfaces are for `use`.
  void begin(std::string_view property, const SurfaceUse& use);
  /// Whether the element holds numbers of the placement.
  [[nodiscard]] bool start(std::string_view name);
  void end_numbers();
  void text(std::string_view piece);
  void note_library_object() { is_elsewhere_ = true; }
  void note_surfaces() { has_surfaces_ = true; }
  [[nodiscard]] const SurfaceUse& use() const { return use_; }

  /// Where the prototype stands; empty where that cannot be told, and `unread` says why. Files whose reference system is in
  /// degrees have no place for a matrix in metres.
  [[nodiscard]] std::optional<Placement> placement(bool has_crs, std::string& unread) const;

 private:
  NumberScanner scanner_;
  std::vector<double> matrix_, position_;
  std::vector<double>* numbers_ = nullptr;  ///< of these two, which one is being read
  std::string property_;
  SurfaceUse use_;
  bool is_elsewhere_ = false, has_surfaces_ = false;
};

}  // namespace farlod::ingest

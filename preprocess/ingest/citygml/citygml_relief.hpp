// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "farlod/point.hpp"
#include "ingest/citygml/gml_surfaces_numbers.hpp"
#include "ingest/citygml/xml_element.hpp"

namespace farlod::ingest {

/// Collects the points of a terrain: the corners of the triangles of a TIN, its control points, or a point cloud. Stores the
/// points alone, which may repeat, without the closing points of rings.
class ReliefReader {
 public:
  /// Whether a property of the relief module of CityGML holds points of the terrain.
  [[nodiscard]] static bool is_point_property(std::string_view name) { return name == "tin" || name == "reliefPoints"; }

  /// Begins a property with points.
  void begin(const XmlElement& property);
  /// Begins an element. If it returns false, the caller passes neither the content of the element nor its end.
  [[nodiscard]] bool start(const XmlElement& element);
  void end();
  void text(std::string_view piece);
  /// Adds what was collected from the next segment of the file.
  void append(const ReliefReader& next);

  [[nodiscard]] std::vector<Point3d>& points() { return points_; }
  /// The number of points left out because a coordinate is missing, is not a number, or lies beyond the Earth.
  [[nodiscard]] std::size_t unreadable_points() const { return unreadable_points_; }

 private:
  void take_number(double number);
  void add_point();

  NumberScanner scanner_;
  std::size_t dimension_ = 3;
  bool in_list_ = false;
  std::vector<double> numbers_;  ///< of a point whose coordinates are not complete yet
  std::optional<Point3d> first_of_list_;
  std::size_t points_of_list_ = 0;
  std::vector<Point3d> points_;
  std::size_t unreadable_points_ = 0;
};

}  // namespace farlod::ingest

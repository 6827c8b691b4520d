// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "city/city_model.hpp"
#include "farlod/box.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// A part of the plane: all of its shapes together, in the frame that the function says which hands it out.
struct Area {
  using Line = std::vector<Point2d>;
  using Polygon = std::vector<Line>;  ///< rings, which may repeat their first point; between them by the even-odd rule

  std::vector<Point2d> points;
  std::vector<Line> lines;
  std::vector<Polygon> polygons;

  [[nodiscard]] std::size_t shape_count() const { return points.size() + lines.size() + polygons.size(); }

  template <class Visit>
  void for_each_point(const Visit& visit) {
    for (Point2d& p : points) visit(p);
    for (Line& line : lines)
      for (Point2d& p : line) visit(p);
    for (Polygon& polygon : polygons)
      for (Line& ring : polygon)
        for (Point2d& p : ring) visit(p);
  }
};

[[nodiscard]] inline Area area_of(const Box2d& box) {
  return {{}, {}, {{{box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}}}}};
}

[[nodiscard]] inline Box2d outline_of(Area area) {
  Box2d outline;
  area.for_each_point([&](const Point2d& p) { outline.add(p); });
  return outline;
}

}  // namespace farlod

namespace farlod::georeference {

/// An area as it was asked for, in parts, each in its own CRS.
struct RequestedArea {
  struct Part {
    Area shapes;
    std::string crs_wkt;  ///< empty: that of the package
  };
  std::string name;  ///< for messages
  std::vector<Part> parts;
};

/// Reads an area from a file.
///   (1) a table (.csv, .tsv, .txt) holds points, in the columns that base/point_columns.hpp names (without a header row: x
///       and y), in the CRS of the package
///   (2) of any other vector file that GDAL reads, all points, lines and polygons of all layers count; arcs become chords
/// Throws InputError when the file cannot be read to its end, or holds nothing of this.
[[nodiscard]] RequestedArea read_area(const std::filesystem::path& file);

/// Brings an area to the city frame, point by point. Throws InputError when a part is in a CRS that is not known, or has a point
/// without a place in the CRS of the package.
[[nodiscard]] Area located(const RequestedArea& area, const Georeference& georeference);

}  // namespace farlod::georeference

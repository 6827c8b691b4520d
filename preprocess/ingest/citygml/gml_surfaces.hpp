// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ingest/citygml/gml_surfaces_numbers.hpp"
#include "ingest/citygml/xml_element.hpp"
#include "ingest/model_builder/ring_cleaning.hpp"

namespace farlod::ingest {

/// The longest ring that is read, in points. The limit keeps a single list from filling the memory.
inline constexpr std::size_t most_points_of_ring = std::size_t{1} << 20;

struct GmlPolygon {
  std::string id;
  Rings rings;
  bool has_curves = false;   ///< bounded by a curve that is not a LinearRing
  bool is_too_long = false;  ///< a ring had more than most_points_of_ring points, and was dropped

  /// The points that a visit counts: those of its rings, and one more.
  [[nodiscard]] std::size_t point_count() const {
    std::size_t points = 1;
    for (const Ring& ring : rings) points += ring.size();
    return points;
  }
};

/// A member of a surface or solid: a polygon, or a reference to an object with polygons.
struct GmlMember {
  std::optional<std::size_t> polygon;  ///< row in GmlSurfaces::polygons
  std::string href;                    ///< where there is no polygon
  bool is_reversed = false;
  std::uint32_t use = 0;  ///< the number that the caller gave to begin_use
};

/// The members [begin, end) of the object with a gml:id, and whether an OrientableSurface around it reverses them.
struct GmlRange {
  std::size_t begin = 0, end = 0;
  bool was_reversed = false;
};

/// The surfaces of one building (or of those that other buildings refer to), in the order of the file.
struct GmlSurfaces {
  std::vector<GmlPolygon> polygons;
  std::vector<GmlMember> members;
  std::unordered_map<std::string, GmlRange> ranges;
};

/// Reads surfaces and solids of GML 3.1 and 3.2, and the rings of GML 2, element by element. Neither the XML syntax nor buildings
/// are its concern.
class GmlSurfaceReader {
 public:
  enum class Answer { entered, skip, unsupported };

  explicit GmlSurfaceReader(GmlSurfaces& surfaces) : surfaces_(surfaces) {}

  /// All following surfaces get the use `use`.
  void begin_use(std::uint32_t use);
  /// Begins an element. After `skip` and `unsupported`, the caller passes neither the content of the element nor its end.
  [[nodiscard]] Answer start(const XmlElement& element);
  void end(std::string_view name);
  void text(std::string_view piece);
  void add_reference(std::string_view href);

 private:
  struct Open {
    std::string id;
    GmlRange range;
    bool reverses = false;
  };

  void start_polygon(const XmlElement& element);
  void start_aggregate(const XmlElement& element);
  [[nodiscard]] Answer start_property(const XmlElement& element);
  [[nodiscard]] Answer start_in_polygon(const XmlElement& element);
  void end_open();
  void take_number(double number);
  void take_coordinates(std::string_view name);
  void note_dimension(std::string_view srs_dimension);

  GmlSurfaces& surfaces_;
  std::vector<Open> open_;
  bool is_reversed_ = false;
  bool in_polygon_ = false, in_ring_ = false, in_coordinates_ = false;
  std::uint32_t use_ = 0;
  std::size_t dimension_ = 3;
  NumberScanner scanner_;
  std::vector<double> numbers_;  ///< of the current list
};

}  // namespace farlod::ingest

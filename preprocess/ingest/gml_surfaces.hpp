// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ingest/ring_cleaning.hpp"
#include "ingest/xml_element.hpp"

namespace farlod {

struct GmlPolygon {
  std::string id;
  Rings rings;
  bool has_curves = false;  ///< bounded by a curve that is not a LinearRing
};

/// One entry of a surface or solid: a polygon, or a reference to something that holds polygons.
struct GmlMember {
  std::optional<std::size_t> polygon;  ///< row in GmlSurfaces::polygons
  std::string href;                    ///< where there is no polygon
  bool is_reversed = false;
  std::uint32_t use = 0;  ///< for the reader above: what the surface is used for
};

/// What a gml:id stands for: the members [begin, end), which were read with `was_reversed` around them.
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

struct ResolvedPolygon {
  const GmlPolygon* polygon = nullptr;
  bool is_reversed = false;
};

/// The polygons that a member stands for. References are looked up among `own`, then among `foreign`; those that lead to
/// nothing are appended to `dangling`.
[[nodiscard]] std::vector<ResolvedPolygon> resolve(const GmlMember& member, const GmlSurfaces& own, const GmlSurfaces& foreign,
                                                   std::vector<std::string>& dangling);

/// Understands GML's surfaces and solids, element by element: 3.1 and 3.2, and the rings of GML 2. Knows nothing of XML
/// syntax and nothing of buildings.
class GmlSurfaceReader {
 public:
  enum class Answer { entered, skip, unsupported };

  explicit GmlSurfaceReader(GmlSurfaces& surfaces) : surfaces_(surfaces) {}

  /// Surfaces from here on are used for `use`.
  void begin_use(std::uint32_t use);
  /// `skip` and `unsupported`: the caller passes neither the element's content nor its end.
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
  void take_coordinates(std::string_view name);
  void note_dimension(std::string_view srs_dimension);

  GmlSurfaces& surfaces_;
  std::vector<Open> open_;
  bool is_reversed_ = false;
  bool in_polygon_ = false, in_ring_ = false, in_coordinates_ = false;
  std::uint32_t use_ = 0;
  std::size_t dimension_ = 3;
  std::string text_;
};

}  // namespace farlod

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "city/city_model.hpp"
#include "city/problem.hpp"
#include "ingest/model_builder/polygon_deduplicator.hpp"
#include "ingest/model_builder/ring_cleaning.hpp"

namespace farlod::ingest {

/// What is known of a polygon besides its points.
struct PolygonTraits {
  SurfaceKind kind = SurfaceKind::unknown;
  std::uint16_t part = 0;
  std::optional<std::uint32_t> surface;  ///< empty: a surface of its own
  std::string_view name;                 ///< for the report; empty: its number
};

/// Builds the CityModel of one file from what a reader finds: cleans the rings, and reports what is wrong with them.
/// The readers of all formats use it, so that the same town gives the same model and the same problems in each.
class CityModelBuilder {
 public:
  CityModelBuilder(std::string source, Report& report) : source_(std::move(source)), report_(report) {}

  void begin_building(std::string id, HeightReference height_reference = HeightReference::elevation);
  /// Cleans the rings in place, and adds the polygon unless its outer ring is unusable or the building's part has the same
  /// polygon already; unusable holes are filled.
  void add_polygon(Rings& rings, RingEnd end, const PolygonTraits& traits);
  /// Adds a prism over a footprint (z of its rings is ignored): roof, floor, and a wall per edge, all facing outwards.
  void add_prism(Rings& rings, RingEnd end, double base_m, double top_m, std::uint16_t part);
  /// Reports a problem of the building begun last; without a position of its own it is at the building's first vertex.
  void add_problem(ProblemCode code, std::string detail, std::optional<Point3d> position = {}, std::string ring = {});
  /// Reports a problem of something that is not a building.
  void add_problem_at(std::string place, ProblemCode code, std::string detail, std::optional<Point3d> position = {});
  /// Takes the building back when nothing of it is usable; `missing` then says what the reader knows about the reason.
  void end_building(std::string_view missing = "it has no surfaces");

  [[nodiscard]] std::size_t buildings_met() const { return buildings_met_; }
  [[nodiscard]] const std::string& source() const { return source_; }
  [[nodiscard]] CityModel take_city() { return std::move(city_); }

 private:
  [[nodiscard]] bool clean_polygon(Rings& rings, RingEnd end, std::string_view name);
  [[nodiscard]] bool clean(Ring& ring, RingEnd end, std::string_view polygon, std::size_t k);
  /// What ring `k` of the polygon in hand is called in the report; a polygon without a name goes by its number.
  [[nodiscard]] std::string name_of_ring(std::string_view polygon, std::size_t k) const;
  void note_repairs(const RingFindings& findings, const std::optional<Point3d>& position, std::string_view polygon,
                    std::size_t k);
  void add_once(const Rings& rings, const PolygonTraits& traits);
  void add_facet(const Rings& rings, SurfaceKind kind, std::uint32_t surface, std::uint16_t part);
  /// Elevations beyond the Earth, or so high that a small height is lost beside them, leave none.
  [[nodiscard]] bool leaves_room_for_walls(double base_m, double top_m);
  void add_walls(const Ring& ring, double base_m, double top_m, std::uint16_t part);
  void report_repairs();
  void place_problems();

  std::string source_;
  Report& report_;
  CityModel city_;
  std::unordered_set<std::string> ids_;
  std::string id_;
  std::size_t buildings_met_ = 0;
  std::uint32_t next_surface_ = 0;
  PolygonDeduplicator added_{SamePolygon::rings};
  std::size_t repeated_vertices_ = 0, open_rings_ = 0;
  double largest_gap_ = 0.0;
  std::string repeating_ring_, widest_open_ring_;
  std::optional<Point3d> at_repeating_ring_, at_largest_gap_, first_vertex_;
  std::size_t problems_before_ = 0;  ///< in the report, when the building began
  Ring wall_ = Ring(4);
};

}  // namespace farlod::ingest

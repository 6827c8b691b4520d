// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "city/city_model.hpp"
#include "farlod/problem.hpp"
#include "farlod/surface_kind.hpp"
#include "ingest/model_builder/ring_cleaning.hpp"
#include "package/sources_layout.hpp"

namespace farlod::ingest {

/// The level of detail that a user asks for.
struct LodChoice {
  std::optional<int> exactly;  ///< 0 to 3; empty: the best from 1 to 3
};

/// The level of detail to read of each part of a building; empty: nothing is read of the part. `lods_of_parts` has the levels
/// with usable surfaces, of the building itself (first) and of each part. Refined levels (2.2) belong to their whole number (2).
///   (1) one level is chosen for the whole building
///   (2) a part that lacks it is read in its best level
///   (3) of the building itself nothing is read if it lacks that level: a coarser shell would enclose the parts again
[[nodiscard]] std::vector<std::optional<double>> choose_lods(std::span<const std::vector<double>> lods_of_parts,
                                                             LodChoice choice);

/// For messages: "1, 2.2", or "none".
[[nodiscard]] std::string list_lods(std::span<const std::vector<double>> lods_of_parts);

/// The text of the report about the polygons of levels that were not chosen.
[[nodiscard]] std::string unused_polygons(std::size_t count, std::span<const std::vector<double>> lods_of_parts);

/// What a polygon is of in its file: rows of PlacesOfBuilding.
struct PolygonOrigin {
  std::uint32_t object = 0;
  std::optional<std::uint32_t> semantics = {};
};

/// Where attributes of a building are inserted into its file.
struct PlacesOfBuilding {
  std::vector<package::AttributePlace> objects;    ///< the building itself first, then its parts and installations
  std::vector<package::AttributePlace> semantics;  ///< of all its semantic surfaces
};

/// The properties of a polygon besides its points.
struct PolygonTraits {
  SurfaceKind kind = SurfaceKind::unknown;
  std::uint16_t part = 0;
  std::optional<std::uint32_t> surface;  ///< empty: the polygon is a surface by itself
  std::string_view name;                 ///< in the report; empty: its number is used
  PolygonOrigin origin = {};
  std::string_view id = {};  ///< in the file, of its semantic surface or its own; empty: none
};

/// Whether a builder reports an id that it has met before, or leaves that to the builder that it is appended to.
enum class RepeatedIds { reported, reported_by_append };

/// Builds the CityModel of one file from the polygons that a reader finds: cleans their rings, and reports the defects of these.
/// The readers of all formats use it, so that the same town gives the same model and the same problems in each format.
class CityModelBuilder {
 public:
  CityModelBuilder(std::string source, Report& report, RepeatedIds repeated_ids = RepeatedIds::reported)
      : source_(std::move(source)), report_(report), repeated_ids_(repeated_ids) {}

  void begin_building(std::string id, HeightReference height_reference = HeightReference::elevation, Foot foot = Foot::unsaid);
  /// Cleans the rings in place and adds the polygon, unless its outer ring is unusable or the part of the building already has
  /// the same polygon. Unusable holes are filled. Returns the number of the surface that the polygon is, the same for one that
  /// is there already; nothing where it is unusable.
  std::optional<std::uint32_t> add_polygon(Rings& rings, RingEnd end, const PolygonTraits& traits);
  /// The file has a surface of the current building once more.
  void add_origin(std::uint32_t surface, const PolygonOrigin& origin);
  /// Adds a prism over a footprint: roof, floor, and a wall for each edge, all facing outwards. The z of the rings is ignored.
  /// Its surfaces are of the object, and of no semantic surface.
  void add_prism(Rings& rings, RingEnd end, double base_m, double top_m, std::uint16_t part, std::uint32_t object = 0);
  /// Reports a problem of the current building. Without a position, it is at the first vertex of the building.
  void add_problem(ProblemCode code, std::string detail, std::optional<Point3d> position = {}, std::string ring = {});
  /// Reports a problem of something that is not a building.
  void add_problem_at(std::string place, ProblemCode code, std::string detail, std::optional<Point3d> position = {});
  /// Ends the current building. If nothing of it is usable, it is removed, and `missing` is the reason that the reader knows.
  /// `places`: of a file into which attributes can be inserted. Ids of surfaces are kept without places, too.
  void end_building(std::string_view missing = "it has no surfaces", const PlacesOfBuilding* places = nullptr);
  /// Adds the buildings and the problems of a builder of the next segment of the file, which leaves repeated ids to this one and
  /// has a report of its own. City and report become those of a single builder of both segments.
  void append(CityModelBuilder&& next);

  [[nodiscard]] std::size_t buildings_met() const { return buildings_met_; }
  [[nodiscard]] const std::string& source() const { return source_; }
  [[nodiscard]] CityModel take_city() { return std::move(city_); }

 private:
  [[nodiscard]] bool clean_polygon(Rings& rings, RingEnd end, std::string_view name);
  [[nodiscard]] bool clean(Ring& ring, RingEnd end, std::string_view polygon, std::size_t k);
  /// The name of ring `k` of the current polygon in the report. A polygon without a name is called by its number.
  [[nodiscard]] std::string name_of_ring(std::string_view polygon, std::size_t k) const;
  void note_repairs(const RingFindings& findings, const std::optional<Point3d>& position, std::string_view polygon,
                    std::size_t k);
  /// Returns the number of the surface that it is.
  std::uint32_t add_once(const Rings& rings, const PolygonTraits& traits);
  void add_facet(const Rings& rings, SurfaceKind kind, std::uint32_t surface, std::uint16_t part, std::uint32_t object = 0);
  [[nodiscard]] package::BuildingOrigin origin_among(const PlacesOfBuilding& places);
  void note_id(std::uint32_t surface, std::string_view id);
  /// Those of consecutive surfaces together.
  [[nodiscard]] std::vector<package::SurfaceIds> take_ids();
  /// Whether the base is on the Earth and below the top; reports it if not. The sum of a large base and a small height may be the
  /// base itself.
  [[nodiscard]] bool leaves_room_for_walls(double base_m, double top_m);
  void add_walls(const Ring& ring, double base_m, double top_m, std::uint16_t part, std::uint32_t object);
  void report_repairs();
  void place_problems();
  [[nodiscard]] Problem repeated_id(std::string id, std::optional<Point3d> position) const;

  /// A building whose id `append` still has to check.
  struct UncheckedId {
    std::string id;
    std::size_t problems_before;  ///< problems in the report when the building began
    std::optional<Point3d> first_vertex;
  };

  std::string source_;
  Report& report_;
  RepeatedIds repeated_ids_;
  CityModel city_;
  std::vector<UncheckedId> unchecked_ids_;
  std::unordered_set<std::string> ids_;
  std::string id_;
  std::size_t buildings_met_ = 0;
  std::uint32_t next_surface_ = 0;
  PolygonDeduplicator added_{SamePolygon::rings};
  // What is known of the current building
  std::vector<package::SurfaceOrigin> origins_;   ///< rows of all places; what is not worth noting down is not there
  std::vector<package::SurfaceIds> surface_ids_;  ///< one for each surface that has an id
  std::vector<std::uint32_t> object_of_surface_;  ///< by number; of those beyond its end, the building itself
  std::size_t repeated_vertices_ = 0, open_rings_ = 0;
  double largest_gap_ = 0.0;
  std::string repeating_ring_, widest_open_ring_;
  std::optional<Point3d> at_repeating_ring_, at_largest_gap_, first_vertex_;
  std::size_t problems_before_ = 0;  ///< problems in the report when the building began
  Rings wall_ = Rings(1);
};

/// The kind of surface that a class name of CityGML or CityJSON stands for; unknown for other names. Outer ceilings face down and
/// outer floors face up: they are the undersides and the terraces of a building.
[[nodiscard]] constexpr SurfaceKind kind_of_surface_name(std::string_view name) {
  if (name == "RoofSurface" || name == "OuterFloorSurface") return SurfaceKind::roof;
  if (name == "WallSurface" || name == "Window" || name == "Door" || name == "WindowSurface" || name == "DoorSurface")
    return SurfaceKind::wall;
  if (name == "GroundSurface" || name == "OuterCeilingSurface") return SurfaceKind::floor;
  return SurfaceKind::unknown;
}

/// Surfaces of rooms. They hide no sky that the building does not hide.
[[nodiscard]] constexpr bool is_interior_surface_name(std::string_view name) {
  return name == "InteriorWallSurface" || name == "CeilingSurface" || name == "FloorSurface";
}

}  // namespace farlod::ingest

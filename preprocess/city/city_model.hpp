// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expects.hpp"
#include "base/paging/paged_array.hpp"
#include "farlod/angle.hpp"
#include "farlod/pack.hpp"
#include "farlod/point.hpp"
#include "farlod/surface_kind.hpp"
#include "package/sources_layout.hpp"

namespace farlod {

/// A planar polygon with holes. Rings are not closed (the last point is not the first again).
struct Facet {
  std::uint64_t first_ring = 0;
  std::uint32_t ring_count = 0;  ///< the first is the outer one, the others are holes
  /// The surface it belongs to, counted within its building. Polygons of a file are surfaces of their own;
  /// the coplanar triangles of a mesh share one.
  std::uint32_t surface = 0;
  std::uint16_t part = 0;  ///< the closed part (BuildingPart) of the building, for the question "inside?"
  SurfaceKind kind = SurfaceKind::unknown;
};

/// The reference of a building's heights.
enum class HeightReference : std::uint8_t {
  elevation,       ///< the zero of the CRS: the file gives elevations
  on_ground,       ///< the ground below the building, which only a terrain gives
  down_to_ground,  ///< the roof has an elevation; the points nearer to the base than to the roof still have to move to the ground
};

/// What a file says of where a building begins.
enum class Foot : std::uint8_t {
  unsaid,        ///< its lowest points are there, whatever is below them
  on_ground,     ///< it reaches down to the ground: a footprint
  above_ground,  ///< as an arch does
};

struct Building {
  std::string id;
  std::uint64_t first_facet = 0;
  std::uint32_t facet_count = 0;
  HeightReference height_reference = HeightReference::elevation;
  Foot foot = Foot::unsaid;
  std::uint32_t source = 0;  ///< place in LocatedCity::sources of the file that it comes from
  std::uint64_t first_origin_byte = 0;
  std::uint64_t origin_bytes = 0;  ///< 0: nothing is known of the places of its surfaces in a file
};

/// All buildings of a city, as flat arrays: a city has millions of rings, and a vector for each would double it.
/// Coordinates are in the frame of the stage that made it.
class CityModel {
 public:
  [[nodiscard]] std::span<const Building> buildings() const { return buildings_; }
  [[nodiscard]] std::span<const Facet> facets() const { return facets_; }
  [[nodiscard]] std::span<const Facet> facets_of(const Building& b) const {
    return std::span(facets_).subspan(b.first_facet, b.facet_count);
  }
  /// Ring `k` of a facet: 0 is the outer one.
  [[nodiscard]] std::span<const Point3d> ring(const Facet& f, std::uint32_t k) const {
    FARLOD_EXPECTS(k < f.ring_count);
    return points_of_ring(f.first_ring + k);
  }
  [[nodiscard]] std::span<const std::uint8_t> origin_of(const Building& b) const {
    return std::span(origins_).subspan(b.first_origin_byte, b.origin_bytes);
  }
  [[nodiscard]] std::span<const Point3d> points_of(const Building& b) const;
  [[nodiscard]] std::span<Point3d> points_of(const Building& b);
  [[nodiscard]] std::span<const Point3d> points() const { return points_; }
  [[nodiscard]] std::span<Point3d> points() { return points_; }

  /// Building up: a building, then its facets, each with its rings, outer ring first.
  void begin_building(std::string id, HeightReference height_reference = HeightReference::elevation, std::uint32_t source = 0,
                      Foot foot = Foot::unsaid);
  void begin_facet(SurfaceKind kind, std::uint32_t surface, std::uint16_t part = 0);
  void add_ring(std::span<const Point3d> points);
  /// Where the building begun last comes from in its file, as package::append_origin writes it. Facets that are dropped leave it
  /// as it is: it counts by the numbers of surfaces.
  void set_origin(std::span<const std::uint8_t> origin);
  /// Removes the building begun last with all its facets.
  void drop_last_building();
  /// Removes the facets for which `is_dropped` is true, and buildings without other facets.
  void drop_facets(const std::vector<bool>& is_dropped);
  void set_source(std::uint32_t source);  ///< of all buildings
  /// Appends the buildings of another model; takes it over whole where there is nothing yet.
  void append(CityModel&& other);

  /// Calls visit(n, building) for each building in order. Of what lies on disk (PagedArray), only that of the last few buildings
  /// takes memory.
  template <class Visit>
  void for_each_building(const Visit& visit) const {
    for (std::size_t n = 0; n < buildings_.size(); ++n) {
      visit(n, buildings_[n]);
      if (n % buildings_held == buildings_held - 1) let_go_before(n);
    }
    let_go_before(buildings_.size());
  }
  static constexpr std::size_t buildings_held = 4096;
  /// Gives back the memory of the buildings before this one, as far as they lie on disk: they are read again when somebody asks
  /// for them. May be called while others read.
  void let_go_before(std::size_t building) const;

 private:
  [[nodiscard]] std::span<const Point3d> points_of_ring(std::uint64_t r) const {
    return std::span(points_).subspan(ring_begin(r), ring_end_[r] - ring_begin(r));
  }

  std::vector<Building> buildings_;
  [[nodiscard]] std::uint64_t ring_begin(std::uint64_t r) const { return r == 0 ? 0 : ring_end_[r - 1]; }

  PagedArray<Facet> facets_;
  PagedArray<std::uint64_t> ring_end_;  ///< one past the last point of each ring
  PagedArray<Point3d> points_;
  PagedArray<std::uint8_t> origins_;  ///< one building after the other
};

/// What a file says of its coordinate reference system.
struct SourceCrs {
  /// "EPSG:n", a URN, a URL, an AdV name or WKT, as found in the file; empty when the file does not say.
  std::string definition;
  /// x is the longitude whatever the definition's axis order says (GeoJSON, and all that GDAL hands out).
  bool longitude_first = false;
  /// z is in metres whatever the horizontal unit is (heights taken from an attribute).
  bool heights_in_metres = false;
};

/// What a user can do about coordinates that are wrong, which depends on the format of the file: sentences for messages.
struct FormatAdvice {
  std::string_view scale = "Convert it to metres where it is exported, or name the CRS that counts in its unit.";
  std::string_view up = "Export it with z as the upward axis.";
};

/// A city file into whose text attributes can be inserted: CityModel::origin_of has the places.
struct PlacedFile {
  std::filesystem::path path;
  package::CityFileFormat format = package::CityFileFormat::citygml;
  std::vector<package::AttributeForm> forms;
};

/// One input file, read: coordinates are still those of the file.
struct SourceCity {
  std::string source;  ///< the file's name as the user gave it
  SourceCrs crs;
  CityModel city;
  std::vector<Point3d> relief_points = {};  ///< corners of the triangles that the file gives as terrain; may repeat
  SkippedFeatures skipped = {};
  std::vector<std::string> notes = {};  ///< for the user: what was taken from elsewhere, or guessed
  std::optional<PlacedFile> placed = {};
  FormatAdvice advice = {};
  std::vector<std::string> owners_of_parts = {};   ///< ids of buildings, perhaps of other files, whose parts are among these
  std::vector<std::string> met_ground_names = {};  ///< of the user's (PackSettings::ground_names): those that something has
};

/// Where the city frame lies on the Earth.
struct Georeference {
  std::string crs_wkt;      ///< the output CRS: projected, in metres
  std::optional<int> epsg;  ///< its code, where it has one
  std::string crs_name;     ///< for people
  Point2d origin_m;         ///< easting and northing of the city frame's origin
  /// Meridian convergence γ at the origin: true azimuth = grid azimuth + γ.
  Angle convergence;
  /// The first CRS among the inputs that has a vertical system, with it: all heights count in that. Empty where none has.
  std::string heights_wkt = {};
};

/// A city in the city frame: metres, x along the output CRS's easting, y along its northing, minus the origin.
struct LocatedCity {
  CityModel city;
  Georeference georeference;
  std::vector<std::string> sources = {};               ///< names of the files, for messages
  std::vector<Point3d> relief_points = {};             ///< points of the ground that the files give as terrain
  std::vector<std::optional<PlacedFile>> placed = {};  ///< of the sources: empty where attributes have no places
  std::vector<FormatAdvice> advice = {};               ///< of the sources
  std::vector<std::string> notes = {};                 ///< for the user: what was done to heights
};

/// No building is higher: the highest has 828 m.
inline constexpr double highest_building_m = 1000.0;
/// The highest building on the highest mountain (8,849 m); and below the deepest shore (-430 m).
inline constexpr double highest_elevation_m = 9850.0, lowest_elevation_m = -500.0;
[[nodiscard]] constexpr bool may_be_elevation(double elevation_m) {
  return lowest_elevation_m <= elevation_m && elevation_m <= highest_elevation_m;
}

/// The length of a degree of latitude, to three digits.
inline constexpr double metres_in_a_degree = 111e3;

/// Heights of the ground at the nodes of a regular net in the city frame (not turned: a terrain in another CRS is
/// resampled on reading). Node (column, row) lies at first + (column, row)·step; rows go north.
struct TerrainRaster {
  Point2d first;  ///< the south-west node, city frame
  Point2d step_m{1.0, 1.0};
  std::size_t columns = 0, rows = 0;
  std::vector<std::optional<float>> height_m;  ///< row by row from the south; empty where the raster has no data
  std::vector<std::string> notes = {};         ///< for the user: what was done to the file
  std::optional<std::string> note_of_unit;     ///< for the user: its heights are taken in the unit of the map
  double offset_m = 0.0;                       ///< by which the user raised the heights
  bool is_resampled = false;                   ///< its pixels are not those of a file
  bool covers_pixels = false;                  ///< to their outer sides, with walls where steps are (tiles::SteppedSurface)
  bool is_in_crs_of_city = false;              ///< for want of one of its own
  std::string source = {};                     ///< the file, or the first of several

  [[nodiscard]] Point2d node(std::size_t column, std::size_t row) const {
    return {first.x + static_cast<double>(column) * step_m.x, first.y + static_cast<double>(row) * step_m.y};
  }
  /// Bilinear height; empty outside or where a node around it has no data.
  [[nodiscard]] std::optional<double> height_at(Point2d p_city) const;
};

}  // namespace farlod

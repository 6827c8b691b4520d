// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "farlod/point.hpp"
#include "farlod/surface_kind.hpp"
#include "ingest/citygml/citygml_xml.hpp"
#include "ingest/citygml/gml_surfaces.hpp"
#include "ingest/model_builder/city_model_builder.hpp"
#include "ingest/model_builder/ring_cleaning.hpp"

namespace farlod::ingest {

/// The placement of a prototype (implicit geometry of CityGML): a matrix in metres, then a translation to the reference point.
class Placement {
 public:
  /// From the 16 numbers of a matrix, row by row; the last row is not used. Without numbers, the matrix is the identity. Empty
  /// when there are not 16 numbers, or when one is NaN.
  [[nodiscard]] static std::optional<Placement> from(std::span<const double> matrix, const Point3d& reference_point);

  [[nodiscard]] Point3d place(const Point3d& p_prototype) const;
  /// The placed rings. A matrix that mirrors also reverses them, so that they keep their outer side.
  [[nodiscard]] Rings place(const Rings& rings_prototype) const;

 private:
  Placement(const Point3d& x, const Point3d& y, const Point3d& z, const Point3d& origin)
      : x_axis_(x), y_axis_(y), z_axis_(z), origin_(origin) {}

  Point3d x_axis_, y_axis_, z_axis_, origin_;
};

/// What a surface of a CityGML building is part of.
enum class SurfaceRole {
  boundary,      ///< a semantic surface: RoofSurface, WallSurface ...
  shell,         ///< a solid or surface of the building itself, often a copy of the semantic ones
  installation,  ///< a chimney, a dormer, a balcony
  element,       ///< a pylon or a deck: a bridge or tunnel may consist of such elements alone
  footprint,     ///< LoD 0, at the bottom
  roof_edge,     ///< LoD 0, at the top
  inside,        ///< an installation inside the building, which the file says after its geometry; not used
};

struct SurfaceUse {
  int lod = 0;
  std::uint16_t part = 0;  ///< 0: the building itself
  SurfaceRole role = SurfaceRole::shell;
  SurfaceKind kind = SurfaceKind::unknown;
  std::optional<std::size_t> placement = {};  ///< row in CityGmlBuilding::placements, where the surfaces are a prototype's
  PolygonOrigin origin = {};
};

/// One building of a CityGML file with all its parts and all its levels of detail, as read.
struct CityGmlBuilding {
  std::string id;
  std::vector<SurfaceUse> uses;
  GmlSurfaces surfaces;
  std::vector<std::optional<Placement>> placements;                    ///< empty: cannot be placed; `unread` has the reason
  std::vector<std::optional<double>> measured_height_m{std::nullopt};  ///< of the building and of each part
  std::map<std::string, std::size_t> unread;                           ///< what is not read, with its number
  PlacesOfBuilding places;
  std::vector<std::string> semantic_ids;  ///< of places.semantics; empty where one has none

  /// Counts something that is not read. After a few kinds, all others are counted as one.
  void add_unread(std::string what);
};

/// The references of a building to ids that it does not contain.
[[nodiscard]] std::vector<std::string> foreign_references(const CityGmlBuilding& building);

/// Chooses the level of detail, and adds the building's polygons to the model: each once, semantic surfaces first. `places`: as
/// CityModelBuilder::end_building has it.
void add_building(const CityGmlBuilding& building, const GmlSurfaces& foreign, LodChoice lod, ReferenceBudget& budget,
                  CityModelBuilder& builder, const PlacesOfBuilding* places = nullptr);

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

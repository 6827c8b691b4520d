// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "farlod/error.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// What can be wrong with a user's data. By stage: 1xx ingest, 2xx georeference, 3xx align, 4xx tiles.
/// docs/problems.md has a paragraph for each, datasets/broken a file for each.
enum class ProblemCode : std::uint16_t {
  too_few_points = 101,
  unreadable_coordinate = 102,
  repeated_vertex = 103,
  ring_not_closed = 104,
  dangling_reference = 105,
  repeated_id = 106,
  no_height = 107,
  not_an_area = 108,
  height_not_positive = 109,
  vertex_index_out_of_range = 110,
  no_geometry = 111,
  unsupported_geometry = 112,
  malformed_feature = 113,
  other_level_of_detail = 114,
  duplicate_surface = 115,
  absurd_height = 116,
  another_format = 117,
  empty_file = 118,
  unusable_file = 119,
  tree_size_missing = 120,
  tree_size_classes = 121,
  absurd_tree_size = 122,
  duplicate_tree = 123,
  unusable_canopy_height = 124,
  trunk_above_crown = 125,
  outside_of_projection = 201,
  axes_swapped = 202,
  two_crs = 203,
  crs_unknown = 204,
  unlikely_place = 205,
  zone_in_easting = 206,
  far_away = 207,
  implausible_size = 208,
  lies_on_its_side = 209,
  tree_outside_of_grid = 210,
  undeclared_no_data = 211,
  another_datum = 212,
  beyond_terrain = 213,
  described_twice = 214,
  no_dominant_direction = 301,
  nearly_empty_grid = 302,
  zero_area = 401,
  self_intersecting = 402,
  not_planar = 403,
  spike = 404,
  hole_outside = 405,
  floor_in_the_air = 406,
  below_ground = 407,
};

/// What happened to the thing that has the problem.
enum class Effect { kept, repaired, left_out };

[[nodiscard]] constexpr std::string_view name_of(Effect effect) {
  return effect == Effect::kept ? "kept" : effect == Effect::repaired ? "repaired" : "left out";
}

struct ProblemDescription {
  ProblemCode code;
  std::string_view slug;
  Effect effect;
  std::string_view summary;
};

/// Whether the whole model is in doubt, so that the long work may be in vain: told before it begins.
[[nodiscard]] constexpr bool doubts_the_model(ProblemCode code) {
  return code == ProblemCode::unlikely_place || code == ProblemCode::implausible_size || code == ProblemCode::lies_on_its_side ||
         code == ProblemCode::another_datum || code == ProblemCode::described_twice || code == ProblemCode::nearly_empty_grid;
}

/// All problems that exist, by code.
inline constexpr std::array problem_descriptions{
    ProblemDescription{ProblemCode::too_few_points, "too_few_points", Effect::left_out,
                       "a ring has fewer than three different points"},
    ProblemDescription{ProblemCode::unreadable_coordinate, "unreadable_coordinate", Effect::left_out,
                       "a coordinate is not a finite number"},
    ProblemDescription{ProblemCode::repeated_vertex, "repeated_vertex", Effect::repaired, "a ring repeats a vertex in a row"},
    ProblemDescription{ProblemCode::ring_not_closed, "ring_not_closed", Effect::repaired,
                       "the last vertex of a ring is not its first"},
    ProblemDescription{ProblemCode::dangling_reference, "dangling_reference", Effect::left_out,
                       "a reference leads to nothing in the file"},
    ProblemDescription{ProblemCode::repeated_id, "repeated_id", Effect::kept, "two buildings carry the same id"},
    ProblemDescription{ProblemCode::no_height, "no_height", Effect::left_out, "a footprint has no usable height"},
    ProblemDescription{ProblemCode::not_an_area, "not_an_area", Effect::left_out, "a feature is a point or a line, not an area"},
    ProblemDescription{ProblemCode::height_not_positive, "height_not_positive", Effect::left_out,
                       "a footprint's height is zero or negative"},
    ProblemDescription{ProblemCode::vertex_index_out_of_range, "vertex_index_out_of_range", Effect::left_out,
                       "a face names a vertex that does not exist"},
    ProblemDescription{ProblemCode::no_geometry, "no_geometry", Effect::left_out, "a building has no usable surface"},
    ProblemDescription{ProblemCode::unsupported_geometry, "unsupported_geometry", Effect::left_out,
                       "a geometry of a kind that is not read"},
    ProblemDescription{ProblemCode::malformed_feature, "malformed_feature", Effect::left_out,
                       "a feature does not follow its format"},
    ProblemDescription{ProblemCode::other_level_of_detail, "other_level_of_detail", Effect::left_out,
                       "a building has further levels of detail, of which one counts"},
    ProblemDescription{ProblemCode::duplicate_surface, "duplicate_surface", Effect::left_out,
                       "a building has the same surface twice"},
    ProblemDescription{ProblemCode::absurd_height, "absurd_height", Effect::left_out,
                       "a footprint is higher than any building on Earth"},
    ProblemDescription{ProblemCode::another_format, "another_format", Effect::kept,
                       "a file is of another format than its name says"},
    ProblemDescription{ProblemCode::empty_file, "empty_file", Effect::left_out, "a file has nothing in it"},
    ProblemDescription{ProblemCode::unusable_file, "unusable_file", Effect::left_out, "one of several files cannot be used"},
    ProblemDescription{ProblemCode::tree_size_missing, "tree_size_missing", Effect::repaired,
                       "trees lack a size, which is taken from their other sizes, or assumed"},
    ProblemDescription{ProblemCode::tree_size_classes, "tree_size_classes", Effect::kept,
                       "sizes of trees look like classes, not like metres"},
    ProblemDescription{ProblemCode::absurd_tree_size, "absurd_tree_size", Effect::repaired,
                       "trees have sizes that no tree on Earth has"},
    ProblemDescription{ProblemCode::duplicate_tree, "duplicate_tree", Effect::left_out,
                       "trees are there twice, at one place and with the same sizes"},
    ProblemDescription{ProblemCode::unusable_canopy_height, "unusable_canopy_height", Effect::left_out,
                       "cells of a canopy raster have heights that no tree has"},
    ProblemDescription{ProblemCode::trunk_above_crown, "trunk_above_crown", Effect::repaired,
                       "crowns begin below the ground, or not below their tops"},
    ProblemDescription{ProblemCode::outside_of_projection, "outside_of_projection", Effect::left_out,
                       "a building has a vertex that cannot be projected"},
    ProblemDescription{ProblemCode::axes_swapped, "axes_swapped", Effect::repaired,
                       "a file writes its coordinates in another order than its CRS says"},
    ProblemDescription{ProblemCode::two_crs, "two_crs", Effect::repaired, "a file says one CRS, and --crs another"},
    ProblemDescription{ProblemCode::crs_unknown, "crs_unknown", Effect::repaired,
                       "a file names a CRS that nobody knows, and --crs stands in"},
    ProblemDescription{ProblemCode::unlikely_place, "unlikely_place", Effect::kept,
                       "a file lies where its CRS is not meant to be used"},
    ProblemDescription{ProblemCode::zone_in_easting, "zone_in_easting", Effect::repaired,
                       "eastings begin with the number of their zone"},
    ProblemDescription{ProblemCode::far_away, "far_away", Effect::left_out,
                       "a facet or a building lies far from all the rest of the city"},
    ProblemDescription{ProblemCode::implausible_size, "implausible_size", Effect::kept,
                       "sizes or heights of a file can hardly be those of a city in metres"},
    ProblemDescription{ProblemCode::lies_on_its_side, "lies_on_its_side", Effect::kept,
                       "a file's z axis does not seem to point upward"},
    ProblemDescription{ProblemCode::tree_outside_of_grid, "tree_outside_of_grid", Effect::left_out,
                       "trees stand outside of the grid"},
    ProblemDescription{ProblemCode::undeclared_no_data, "undeclared_no_data", Effect::left_out,
                       "pixels of a raster hold a number that is no height"},
    ProblemDescription{ProblemCode::another_datum, "another_datum", Effect::kept,
                       "heights of a file count from another zero than those of the others"},
    ProblemDescription{ProblemCode::beyond_terrain, "beyond_terrain", Effect::kept, "buildings lie beyond the terrain"},
    ProblemDescription{ProblemCode::described_twice, "described_twice", Effect::kept, "two files have the same buildings"},
    ProblemDescription{ProblemCode::no_dominant_direction, "no_dominant_direction", Effect::kept,
                       "the streets have no dominant direction"},
    ProblemDescription{ProblemCode::nearly_empty_grid, "nearly_empty_grid", Effect::kept,
                       "the grid is very large for so few buildings"},
    ProblemDescription{ProblemCode::zero_area, "zero_area", Effect::left_out, "a facet has no area"},
    ProblemDescription{ProblemCode::self_intersecting, "self_intersecting", Effect::repaired,
                       "the rings of a facet cross each other"},
    ProblemDescription{ProblemCode::not_planar, "not_planar", Effect::kept, "a facet is not planar"},
    ProblemDescription{ProblemCode::spike, "spike", Effect::repaired, "a ring goes out and comes back the same way"},
    ProblemDescription{ProblemCode::hole_outside, "hole_outside", Effect::left_out,
                       "a hole lies outside of the facet that it is a hole of"},
    ProblemDescription{ProblemCode::floor_in_the_air, "floor_in_the_air", Effect::repaired,
                       "a building's lowest floor is more than a storey above the ground"},
    ProblemDescription{ProblemCode::below_ground, "below_ground", Effect::kept,
                       "most of a building is below the ground, or all of it"},
};

/// Throws InvalidArgument for a number that is none of the codes.
[[nodiscard]] constexpr const ProblemDescription& describe(ProblemCode code) {
  for (const ProblemDescription& d : problem_descriptions)
    if (d.code == code) return d;
  throw InvalidArgument("there is no problem with the code " + std::to_string(static_cast<int>(code)));
}

/// One thing that is wrong with the user's data, and where.
struct Problem {
  ProblemCode code;
  std::string source;  ///< the file's name as the user gave it
  std::string place;   ///< the building's id, the feature's number or the line
  std::string detail;  ///< what exactly, with figures
  /// A place on the ground, where one is known. 1xx and 2xx: as the file counts, in its axis order (an OBJ file with its
  /// origin added, z up); 123, 124, 207 to 210, 212 to 214, 4xx and what waits for the terrain: easting, northing and height in
  /// the CRS of the package.
  std::optional<Point3d> position = {};
  /// The same in degrees of WGS 84, longitude first; known once the CRS of the position is.
  std::optional<Point2d> lon_lat_deg = {};
  /// Where a ring is concerned, which one: "polygon UUID_1, ring 0 (outer)"; empty where none is.
  std::string ring = {};
};

/// Collects problems in the order in which they are met. Never ends a run.
class Report {
 public:
  void add(Problem problem) { problems_.push_back(std::move(problem)); }
  [[nodiscard]] const std::vector<Problem>& problems() const { return problems_; }
  /// From number `first` on: what is wrong is known at once, where on the ground only later. Valid until the next one is added.
  [[nodiscard]] std::span<Problem> since(std::size_t first) { return std::span(problems_).subspan(first); }
  [[nodiscard]] std::size_t count(ProblemCode code) const {
    std::size_t n = 0;
    for (const Problem& p : problems_) n += p.code == code ? 1 : 0;
    return n;
  }

 private:
  std::vector<Problem> problems_;
};

}  // namespace farlod

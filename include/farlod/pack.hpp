// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "farlod/angle.hpp"
#include "farlod/box.hpp"
#include "farlod/export.hpp"
#include "farlod/package.hpp"
#include "farlod/point.hpp"
#include "farlod/problem.hpp"
#include "farlod/run.hpp"
#include "farlod/shard.hpp"

namespace farlod {

// The library farlod::preprocess has what follows. It is under GPL-3.0-or-later, as CGAL's packages are that it uses.

/// Which axis of a mesh points upwards.
enum class UpAxis { z, y };

/// How the grid lies.
enum class AlignMode {
  automatic,  ///< along the dominant street direction, if there is one
  none,       ///< to grid north
  fixed,      ///< along a given bearing
};

/// What stands between the pixels of a surface model.
enum class SurfaceReading {
  automatic,  ///< walls, where neighbors are a step apart, as at buildings; slopes elsewhere, and where pixels are wide
  tin,        ///< slopes, from the centre of each pixel to the next
};

/// How buildings come to cells.
enum class Assign {
  clip,  ///< cut exactly at the cells' borders
  whole  ///< as in the paper: each building whole, to the cell of its footprint's centroid
};

enum class FarMapKind : std::uint8_t {
  horizon,  ///< explicit occluders, and bounds for the rest of the far city: without parallax
  box       ///< the paper's: a picture on the walls of a box, looked up by direction alone
};

/// What to do when the package's folder is there already.
enum class Overwrite {
  refuse,  ///< with PackSettings::area: far maps are added to the package
  replace
};

/// A part of the city: a rectangle in the CRS of the package, or a file with points, lines and polygons. A vector file that GDAL
/// reads is in its own CRS, and in that of the package where it says none. A table (.csv, .tsv, .txt) holds points in the CRS of
/// the package, in columns that are called as those of `farlod-svf --points`.
using FarMapArea = std::variant<Box2d, std::filesystem::path>;

/// Whether a city with problems is packed.
enum class ProblemPolicy { pack, refuse };

/// Where the heights of footprints come from: names of attributes, and values for features without them. Lengths in metres.
struct FootprintSettings {
  std::optional<std::string> height_field = {};   ///< height above the base
  std::optional<std::string> base_field = {};     ///< elevation of the base
  std::optional<std::string> storeys_field = {};  ///< number of storeys
  double floor_height_m = 3.0;                    ///< 1 to 20: height of a storey, where only the number of storeys is known
  std::optional<std::string> roof_field = {};     ///< elevation of the roof
  std::optional<double> default_height_m = {};    ///< 0.01 to 1,000: for footprints without any height
  std::vector<double> unknown_heights = {};       ///< numbers of the table that mean that a height is not known
  std::optional<std::string> layer = {};          ///< of a file of several, features or rasters: the one to read
  std::optional<std::string> encoding = {};       ///< of the names and texts of Shapefiles, as iconv names it
};

/// What the heights of a canopy raster count from.
enum class CanopyHeights {
  above_ground,
  elevations  ///< from the zero of heights, as those of a surface model
};

/// Trees: from inventories, each tree with a crown of its own, and from a raster of canopies. docs/stages/ingest.md has the names
/// of fields that are known, and the rules for sizes that are missing.
struct TreeSettings {
  /// Points or outlines of crowns, in any vector format of GDAL; a table (.csv, .tsv, .txt) with columns of coordinates; CityGML
  /// and CityJSON, of which trees alone are read.
  std::vector<std::filesystem::path> files;
  std::optional<std::string> height_field = {};         ///< height of a tree
  std::optional<std::string> crown_field = {};          ///< diameter of its crown; an area where the name says so
  std::optional<std::string> trunk_field = {};          ///< height at which its crown begins
  std::optional<std::string> layer = {};                ///< of a vector file of several: the one to read
  std::optional<std::string> encoding = {};             ///< of the names and texts of Shapefiles, as iconv names it
  std::optional<std::filesystem::path> canopy = {};     ///< a raster of the tops of crowns; 0: none
  std::optional<std::filesystem::path> trunks = {};     ///< a raster of the heights at which crowns begin; needs `canopy`
  CanopyHeights heights = CanopyHeights::above_ground;  ///< of both rasters
  /// 0 to 0.95: the height at which a crown begins, as a share of its top's, where nothing else says it.
  double trunk_ratio = 0.25;

  [[nodiscard]] bool any() const { return !files.empty() || canopy.has_value(); }
};

/// From which files a package is made, and how. The defaults are those of farlod-pack.
struct PackSettings {
  /// Files, folders and archives; all are put together. A raster among them is a surface model. May be empty if there is a
  /// terrain.
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path output;  ///< the folder to make
  /// Rasters of ground elevations, any that GDAL reads, and folders of them: the tiles of one terrain. Where they overlap, later
  /// ones lie on top, but for where they have no data.
  std::vector<std::filesystem::path> terrain;
  double terrain_offset_m = 0.0;                       ///< added to them, where they count from another datum than the buildings
  SurfaceReading surface = SurfaceReading::automatic;  ///< of a city that is a raster
  /// More rasters of elevations, of any resolution: beyond the grid of the city, and beyond what `terrain` covers there,
  /// mountains hide the sky, sunk by the Earth's curvature. Where several have heights, the first counts.
  std::vector<std::filesystem::path> far_terrains = {};
  Overwrite overwrite = Overwrite::refuse;
  ProblemPolicy problems = ProblemPolicy::pack;

  std::string crs;                    ///< "EPSG:n", of inputs that do not say; of all, where each says its own; may be empty
  std::string out_crs;                ///< of the package: projected, in metres; empty: the input's, or UTM for degrees
  std::optional<Point3d> obj_origin;  ///< added to the coordinates of meshes: OBJ, STL, PLY and GLB files
  std::optional<UpAxis> up;           ///< of meshes; empty: y of GLB, z of others
  /// Words by which objects, groups and materials of meshes are ground, besides those that docs/stages/ingest.md lists.
  std::vector<std::string> ground_names;
  std::optional<int> lod;  ///< level of detail to read, 0 to 3; empty: the best from 1 to 3
  FootprintSettings footprints;
  TreeSettings trees;

  std::optional<double> cell_edge_m;  ///< 0.5 to 10,000; empty: 150, or what `max_error` needs
  std::optional<int>
      neighborhood;  ///< cells along the edge of the near field, odd, 1 to 999; empty: 3, or what `max_error` needs
  std::optional<double> max_error;  ///< 0.0001 to 1: chooses cells and neighborhood so that sky view factors keep this error
  AlignMode align = AlignMode::automatic;
  Angle fixed_bearing = {};  ///< of the grid's y axis, clockwise from grid north, a full turn at the most; with AlignMode::fixed
  Assign assign = Assign::clip;
  FarMapKind far_map = FarMapKind::horizon;

  /// Makes far maps only for the cells that this area meets; the package has the tiles of all. If the folder holds a package of
  /// the same city and settings, they are added to it: its files become those of one run for all areas, whatever their order.
  /// Coordinates of a rectangle are within 100,000 km.
  std::optional<FarMapArea> area = {};

  /// Goes on with what an interrupted run has left, as any run does whose inputs and settings are the same; but where they are
  /// not, this is refused, with what differs. A package that is there is not refused: what is damaged or missing of it is made
  /// anew.
  bool resume = false;
  /// Makes one part of the package, and leaves it beside `output` for `merge`. The first shard that comes reads the city; the
  /// others wait for it, and read what they need of it.
  std::optional<Shard> shard = {};
  /// Puts together what all shards have made. `inputs` may be empty; where they are not, they and the settings must be the same.
  bool merge = false;
};

/// The expected cost of a run, estimated when the grid is known. An estimate, not a bound.
struct PackEstimate {
  std::uint64_t cells = 0;
  std::uint64_t far_maps = 0;  ///< that are baked: one for each cell, or fewer with PackSettings::area
  double seconds = 0.0;        ///< of the stages from the tiles on
  double memory_mib = 0.0, package_mib = 0.0;
  double least_memory_mib = 0.0;  ///< the least RunSettings::memory_limit_mib that can be kept
};

/// What far maps do to the sky view factors of some random receivers, against Engine::exact with the same rays: the error of
/// sampling the sky is not in it.
struct FarErrorEstimate {
  std::size_t receivers = 0;
  double mean_error = 0.0, max_error = 0.0;  ///< |estimate − exact|
  /// From the estimate to the farther of the two bounds: 99 % of the receivers have no wider interval on that side.
  double p99_half_width = 0.0;
  double explicit_edges_per_cell = 0.0;
  double near_triangles_per_cell = 0.0;  ///< in the neighborhood
};

/// A cell size, a neighborhood and the tolerance of its far maps; what these were found to do, and what a receiver costs.
struct GridChoice {
  double cell_edge_m = 0.0;
  int neighborhood = 0;
  double tolerance = 0.0;
  FarErrorEstimate far_error;
  /// Expected, packing included, at 1,000 rays on a 2 m grid: to compare choices with, not to plan a run by.
  double receiver_us = 0.0;
};

/// The grid that was chosen to keep PackSettings::max_error, and its error at receivers that were not used for the choice.
struct ChosenGrid {
  std::optional<GridChoice> best;  ///< none: nothing keeps the error, and the settings were taken as they are
  FarErrorEstimate measured;
};

/// How often something was met that is not used, by what it is: vegetation, water, elements of extensions.
using SkippedFeatures = std::map<std::string, std::uint64_t>;

/// The crowns of a package.
struct CrownCounts {
  std::uint64_t of_trees = 0;   ///< of inventories
  std::uint64_t of_canopy = 0;  ///< cells of the raster

  bool operator==(const CrownCounts&) const = default;
};

/// What the ground between the buildings follows from.
enum class GroundSource : std::uint8_t {
  terrain,
  relief,   ///< of the city files
  bases,    ///< of buildings
  nothing,  ///< it is flat: footprints do not say where they stand
  surface   ///< of a raster that is the city, roofs and ground alike
};

/// Where a city lies and how high it is: what a person looks at to see whether it is the right one.
struct CityLooks {
  struct Heights {
    double least_m = 0.0, median_m = 0.0, tallest_m = 0.0;
  };
  /// By how much the lowest points of buildings lie above a terrain in their middle; of those whose files tell both.
  struct Feet {
    Heights above_m;
    std::string lowest_id, highest_id;  ///< the buildings at both ends
  };
  struct Ground {
    double low_m = 0.0, high_m = 0.0;  ///< at the buildings; of a relief and of a surface, all of it
    GroundSource source = GroundSource::bases;
    std::optional<Feet> feet = {};
  };
  std::optional<Point2d> lon_lat_deg;  ///< the middle of the buildings, in WGS 84
  std::string country;                 ///< that the CRS of the package is meant for; empty where it is not for one alone
  /// From the lowest point of a building to its highest; of a raster that is the city, of the walls between its pixels.
  std::optional<Heights> heights;  ///< none without buildings and walls
  std::optional<Ground> ground;
};

/// The counts and measurements of a run.
struct PackResult {
  PackageDescription package;
  CityLooks looks;
  Angle street_bearing;              ///< of the dominant direction, clockwise from grid north, in (-45°, 45°]
  double alignment_strength = 0.0;   ///< 0: no direction is preferred; 1: all walls are parallel or perpendicular
  std::optional<ChosenGrid> chosen;  ///< with PackSettings::max_error
  std::uint64_t facets = 0;          ///< polygons as the files have them: a surface of a mesh is made of several triangles
  std::uint64_t foundations = 0;     ///< buildings of which a low floor was closed down to the ground
  CrownCounts crowns;
  SkippedFeatures skipped;         ///< features of the files that are not used
  std::vector<std::string> notes;  ///< for the user: what was read from files beside the inputs, or assumed
  std::uint64_t package_bytes = 0;
  std::uint64_t far_map_bytes = 0;  ///< of the far maps that this run wrote
  PackEstimate estimate;
  std::uint64_t blocks = 0;        ///< that this run was to make: all of the package, or those of its shard
  std::uint64_t blocks_found = 0;  ///< of these, that were finished before
  /// In the order in which the stages ran. The package is written while far maps are baked, so that these two overlap.
  std::vector<std::pair<std::string, double>> stage_seconds;
};

/// The formats of city files that are read, for help and messages. Besides, footprints come in any vector format of GDAL.
struct InputFormatNames {
  std::string all;     ///< "CityGML 1.0 to 3.0, CityJSON 1.0 to 2.0, OBJ and GLB"
  std::string meshes;  ///< those that PackSettings::obj_origin, `up` and `ground_names` are about
  std::string piped;   ///< those that may come through a pipe
};
[[nodiscard]] FARLOD_EXPORT InputFormatNames input_format_names();

/// Called before the long stages with what they are expected to need.
using OnEstimate = std::function<void(const PackEstimate&)>;

/// Makes a package from city files. Problems of single buildings are added to the report, as far as the run comes, and end
/// nothing. The package is made beside its name, in NAME.farlod.unfinished, and gets its name in one step when it is whole. A
/// package that is replaced, or to which far maps are added, stays as it was until then, and after that for those who have it
/// open. A run that ends before leaves what is finished, and the next one with the same inputs and settings goes on with it.
/// Where far maps are added to a package of another city or of other settings, OutputError says what differs. Throws
/// InvalidArgument, InputError, ProblemsRefused, OutputError, Busy, LimitReached, Cancelled.
FARLOD_EXPORT PackResult pack(const PackSettings& settings, Report& report, const RunSettings& run = {},
                              const OnEstimate& on_estimate = {});

}  // namespace farlod

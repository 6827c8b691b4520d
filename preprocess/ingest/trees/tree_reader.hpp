// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <string_view>

#include "city/tree.hpp"
#include "farlod/pack.hpp"
#include "farlod/problem.hpp"
#include "ingest/files/input_file.hpp"
#include "package/crown.hpp"
#include "plausibility/doubtful_trees.hpp"

namespace farlod::ingest {

/// What winter does to a tree of this species, by its scientific or English name or its genus alone: one of a short list of
/// evergreen genera, or unknown.
[[nodiscard]] Foliage foliage_of_species(std::string_view species);

/// By the values of OpenStreetMap's `leaf_cycle` and `leaf_type`: "evergreen", "deciduous", "needleleaved" (of which the few that
/// shed their needles have another leaf cycle).
[[nodiscard]] Foliage foliage_of_leaves(std::string_view leaves);

/// What the fields of a feature say of a tree.
struct StatedSizes {
  std::optional<double> height_m, crown_diameter_m, trunk_height_m, trunk_diameter_m;
  Foliage foliage = Foliage::unknown;
  bool is_tree = true;  ///< false: the feature says that it is something else
};

/// Makes trees of what inventories say, and counts what it did for that. Of each tree:
///   (1) the height is the one that is stated; else it follows from the crown's diameter, else from the trunk's, else it is the
///       default
///   (2) the crown's diameter is the one that is stated; else it follows from the height
///   (3) the crown begins at the trunk height that is stated, if that is below the height; else at a share of the height
///   (4) a size that no tree has counts as not stated
class TreeSizes {
 public:
  explicit TreeSizes(double trunk_ratio) : trunk_ratio_(trunk_ratio) {}

  /// `name` is the tree's, for messages.
  [[nodiscard]] Tree complete(const StatedSizes& stated, const std::string& name, Point2d place);

  /// The trees whose size was taken from elsewhere, for people: "crown diameters from heights: 12 of 30 trees"; none: empty.
  [[nodiscard]] std::string missing() const;
  /// Which of the sizes look like numbers of classes, and why; none: empty.
  [[nodiscard]] std::string classes() const;

  /// Why the heights are hardly metres; none: empty.
  [[nodiscard]] std::optional<std::string> doubt() const {
    return stated_heights_.doubt("Convert them to metres above the ground");
  }

  /// How often something was met, and how and where it was the first time.
  struct Finding {
    std::size_t count = 0;
    std::string first_name, first_detail;
    Point2d first_place;
  };
  [[nodiscard]] const Finding& absurd() const { return absurd_; }
  [[nodiscard]] const Finding& trunks() const { return trunks_; }

 private:
  /// The values of one size in all trees, which tell whether they look like classes.
  struct Spread {
    std::size_t count = 0;
    double largest = 0.0;
    bool is_whole = true;
    std::set<int> different;  ///< of the whole ones, as many as tell classes from a value that stands for all

    void add(double value);
    [[nodiscard]] bool looks_like_classes() const;
  };
  [[nodiscard]] std::optional<double> possible(std::optional<double> size_m, double largest_m, const char* what);
  void note(Finding& finding, const std::string& detail) const;
  [[nodiscard]] double height_of(const StatedSizes& s);

  double trunk_ratio_;
  std::size_t count_ = 0, heights_from_crowns_ = 0, heights_from_trunks_ = 0, heights_by_default_ = 0, crowns_from_heights_ = 0;
  Spread heights_, crowns_;
  plausibility::HeightsOfTrees stated_heights_;
  Finding absurd_, trunks_;
  std::string name_;  ///< of the tree at hand
  Point2d place_;
};

/// Gathers the trees of a file, and what is wrong with them: one entry of the report for each kind of problem.
class TreeCollector {
 public:
  TreeCollector(const std::string& source, double trunk_ratio) : sizes_(trunk_ratio) { result_.source = source; }

  [[nodiscard]] SourceCrs& crs() { return result_.crs; }
  /// `name`: of the tree, for messages. A place that is not a finite one is noted as a problem.
  void add(const std::string& name, Point2d place, const StatedSizes& sizes);
  /// A square of a plant cover, full of plants from the ground to a height.
  void add_square(Point2d centre, double edge_m, double height_m);
  void note(ProblemCode code, const std::string& name, const std::string& detail, Point2d place = {});
  /// Something that is no tree.
  void skip(const std::string& what, std::uint64_t count = 1) { result_.skipped[what] += count; }

  /// `count`: how many things were met. Throws InputError when none of them is a tree.
  [[nodiscard]] SourceTrees finish(std::uint64_t count, Report& report);

 private:
  using Finding = TreeSizes::Finding;
  void note_sizes();

  TreeSizes sizes_;
  std::map<ProblemCode, Finding> found_;
  SourceTrees result_;
};

/// Reads each SolitaryVegetationObject and PlantCover of a city model.
///   (1) the tree stands at the reference point of its implicit geometry; without one, in the middle of its explicit geometry
///   (2) its sizes are `height`, `crownDiameter` and `trunkDiameter` (of which more than 3 m is centimetres); what is missing of
///       height and crown is as large as the explicit geometry
///   (3) a plant cover becomes what PlantCover (plant_cover.hpp) says
///   (4) everything else in the file is skipped
/// Throws InputError when the file is damaged, or holds no tree; Cancelled.
[[nodiscard]] SourceTrees read_citygml_trees(const InputFile& file, const TreeSettings& settings, Report& report,
                                             const std::stop_token& stop);
/// The same of CityJSON and CityJSONSeq. Holds a whole file, or a whole line of CityJSONSeq.
[[nodiscard]] SourceTrees read_cityjson_trees(const InputFile& file, const TreeSettings& settings, Report& report,
                                              const std::stop_token& stop);

/// Reads the trees of a vector file that GDAL reads.
///   (1) a point is a tree; of several points of a feature, each is one
///   (2) an area is the outline of a crown: the tree stands at its centroid; where no field says the crown's diameter, it is that
///       of a circle of the same area
///   (3) where the file has no geometries, two of its columns are the coordinates: longitude and latitude in WGS 84, or x and y
///       in a CRS that the file does not say
///   (4) the sizes are those that TreeFields finds
/// The first of several layers with points or areas is read (of those, the first with the height field that the settings name);
/// others are in the report. Features that OpenStreetMap calls something else than a tree are not read. Throws InputError when
/// the file cannot be read, or holds no tree; Cancelled.
[[nodiscard]] SourceTrees read_feature_trees(const std::filesystem::path& file, const TreeSettings& settings, Report& report,
                                             const std::stop_token& stop);

/// Reads an inventory of trees, from a file whose content decides which format it is: CityGML and CityJSON as above, any other
/// as read_feature_trees does. TreeSizes fills in what is missing. What is left out, filled in or doubtful is in
/// the report, an entry for each kind of problem. Throws InputError when the file cannot be read to its end, or holds no tree;
/// Cancelled.
[[nodiscard]] SourceTrees read_trees(const std::filesystem::path& file, const TreeSettings& settings, Report& report,
                                     const std::stop_token& stop = {});

}  // namespace farlod::ingest

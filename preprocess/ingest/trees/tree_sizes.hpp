// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "city/tree.hpp"

namespace farlod::ingest {

/// What the fields of a feature say of a tree.
struct StatedSizes {
  std::optional<double> height_m, crown_diameter_m, trunk_height_m, trunk_diameter_m;
  Foliage foliage = Foliage::unknown;
  bool is_tree = true;  ///< false: the feature says that it is something else
};

/// The rules for what is missing. Inventories of Berlin, Tokyo and Yokohama have median crown diameters of 0.44 to 0.97 of the
/// height.
inline constexpr double crown_diameter_per_height = 0.5;
/// The height is so many metres times the root of the trunk's diameter in metres: 11 m for 30 cm, 20 m for 1 m.
inline constexpr double height_of_one_metre_trunk_m = 20.0;
inline constexpr double default_tree_height_m = 10.0;

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
  Finding absurd_, trunks_;
  std::string name_;  ///< of the tree at hand
  Point2d place_;
};

}  // namespace farlod::ingest

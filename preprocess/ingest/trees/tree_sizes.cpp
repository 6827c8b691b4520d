// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/trees/tree_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace farlod::ingest {
namespace {

/// Fewer different numbers are no classes, but values that stand for all trees.
constexpr std::size_t fewest_classes = 3;

/// Smaller ones are what is left of a 0 after computing with it.
constexpr double smallest_m = 1e-3;

/// Above the diameter of the thickest trunk on Earth, twelve metres and more.
constexpr double thickest_trunk_m = 15.0;

std::string text_of(double size_m) {
  std::ostringstream text;
  text.precision(6);
  text << size_m << " m";
  return std::move(text).str();
}

}  // namespace

void TreeSizes::Spread::add(double value) {
  ++count;
  largest = std::max(largest, value);
  is_whole = is_whole && value == std::floor(value);
  if (is_whole && different.size() < fewest_classes) different.insert(static_cast<int>(value));
}

bool TreeSizes::Spread::looks_like_classes() const {
  constexpr std::size_t enough = 20;
  constexpr double most_classes = 9.0;
  return count >= enough && is_whole && largest <= most_classes && different.size() >= fewest_classes;
}

void TreeSizes::note(Finding& finding, const std::string& detail) const {
  if (finding.count++ == 0) finding = {1, name_, detail, place_};
}

std::optional<double> TreeSizes::possible(std::optional<double> size_m, double largest_m, const char* what) {
  // Many inventories write 0 for what they do not know
  if (!size_m || *size_m == 0.0) return std::nullopt;
  if (*size_m >= smallest_m && *size_m <= largest_m) return size_m;
  note(absurd_, std::string(what) + " of " + text_of(*size_m));
  return std::nullopt;
}

double TreeSizes::height_of(const StatedSizes& s) {
  if (s.height_m) return *s.height_m;
  if (s.crown_diameter_m) {
    ++heights_from_crowns_;
    return std::min(*s.crown_diameter_m / crown_diameter_per_height, highest_tree_m);
  }
  if (s.trunk_diameter_m) {
    ++heights_from_trunks_;
    return height_of_one_metre_trunk_m * std::sqrt(*s.trunk_diameter_m);
  }
  ++heights_by_default_;
  return default_tree_height_m;
}

Tree TreeSizes::complete(const StatedSizes& stated, const std::string& name, Point2d place) {
  ++count_;
  name_ = name;
  place_ = place;
  StatedSizes s = stated;
  s.height_m = possible(s.height_m, highest_tree_m, "a height");
  s.crown_diameter_m = possible(s.crown_diameter_m, widest_crown_m, "a crown's diameter");
  s.trunk_diameter_m = possible(s.trunk_diameter_m, thickest_trunk_m, "a trunk's diameter");
  if (s.height_m) heights_.add(*s.height_m);
  if (s.crown_diameter_m) crowns_.add(*s.crown_diameter_m);
  Tree tree;
  tree.place = place;
  tree.height_m = static_cast<float>(height_of(s));
  crowns_from_heights_ += s.crown_diameter_m ? 0 : 1;
  tree.crown_diameter_m = static_cast<float>(s.crown_diameter_m.value_or(crown_diameter_per_height * tree.height_m));
  tree.trunk_height_m = static_cast<float>(trunk_ratio_ * tree.height_m);
  tree.foliage = s.foliage;
  if (!s.trunk_height_m) return tree;
  // A trunk height of 0 is a bush
  const auto trunk_m = static_cast<float>(*s.trunk_height_m);
  if (trunk_m >= 0.0F && trunk_m < tree.height_m)
    tree.trunk_height_m = trunk_m;
  else
    note(trunks_, "a crown from " + text_of(*s.trunk_height_m) + " to " + text_of(tree.height_m));
  return tree;
}

std::string TreeSizes::missing() const {
  std::string text;
  const auto add = [&](std::size_t count, const std::string& what) {
    if (count > 0) text += (text.empty() ? "" : "; ") + what + ": " + std::to_string(count) + " of " + std::to_string(count_);
  };
  add(heights_from_crowns_, "heights from crown diameters");
  add(heights_from_trunks_, "heights from trunk diameters");
  add(heights_by_default_, "heights of " + text_of(default_tree_height_m) + " by default");
  add(crowns_from_heights_, "crown diameters from heights");
  return text;
}

std::string TreeSizes::classes() const {
  std::string text;
  const auto add = [&](const Spread& spread, const char* what) {
    if (spread.looks_like_classes())
      text += (text.empty() ? "" : "; ") + ("the " + std::to_string(spread.count) + " " + what) + " are whole numbers up to " +
              text_of(spread.largest);
  };
  add(heights_, "heights");
  add(crowns_, "crown diameters");
  return text;
}

}  // namespace farlod::ingest

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/trees/tree_reader.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <system_error>
#include <utility>

#include "base/lower_case.hpp"
#include "base/unread_file.hpp"
#include "farlod/error.hpp"
#include "ingest/files/file_format.hpp"

namespace farlod::ingest {
namespace {

/// Genera of which all or nearly all species in streets and parks are evergreen, and their English names, sorted.
constexpr std::array<std::string_view, 60> evergreen_words{
    "abies",         "acacia",        "agathis",    "araucaria",    "arbutus",     "buxus",
    "callistemon",   "callitris",     "casuarina",  "cedar",        "cedrus",      "ceratonia",
    "chamaecyparis", "cinnamomum",    "citrus",     "corymbia",     "cryptomeria", "cupressocyparis",
    "cupressus",     "cypress",       "eucalyptus", "fir",          "grevillea",   "hemlock",
    "holly",         "ilex",          "juniper",    "juniperus",    "laurus",      "livistona",
    "lophostemon",   "macadamia",     "melaleuca",  "metrosideros", "nerium",      "olea",
    "olive",         "palm",          "phoenix",    "photinia",     "picea",       "pine",
    "pinus",         "pittosporum",   "podocarpus", "pseudotsuga",  "sequoia",     "sequoiadendron",
    "spruce",        "syagrus",       "syzygium",   "taxus",        "thuja",       "thujopsis",
    "trachycarpus",  "tristaniopsis", "tsuga",      "washingtonia", "waterhousea", "yew"};
static_assert(std::is_sorted(evergreen_words.begin(), evergreen_words.end()));

/// Words of names of which another one would say evergreen ("bald cypress", "false acacia").
constexpr std::array<std::string_view, 7> deciduous_words{"bald", "dawn", "false", "larix", "metasequoia", "robinia", "taxodium"};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Calls visit(word) for each word of Latin letters, in lower case.
template <class Visit>
void for_each_word(std::string_view text, const Visit& visit) {
  while (!text.empty()) {
    const auto begin = std::find_if(text.begin(), text.end(), is_letter);
    const auto end = std::find_if_not(begin, text.end(), is_letter);
    if (begin != end) visit(lower_case(std::string(begin, end)));
    text.remove_prefix(static_cast<std::size_t>(end - text.begin()));
  }
}

}  // namespace

Foliage foliage_of_species(std::string_view species) {
  bool is_evergreen = false, is_deciduous = false;
  for_each_word(species, [&](const std::string& word) {
    is_evergreen = is_evergreen || std::binary_search(evergreen_words.begin(), evergreen_words.end(), std::string_view(word));
    is_deciduous = is_deciduous ||
                   std::find(deciduous_words.begin(), deciduous_words.end(), std::string_view(word)) != deciduous_words.end();
  });
  return is_deciduous ? Foliage::deciduous : is_evergreen ? Foliage::evergreen : Foliage::unknown;
}

Foliage foliage_of_leaves(std::string_view leaves) {
  const std::string text = lower_case(std::string(leaves));
  if (text == "evergreen" || text == "needleleaved") return Foliage::evergreen;
  if (text == "deciduous" || text == "semi_deciduous") return Foliage::deciduous;
  return Foliage::unknown;
}

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

namespace {

/// The rules for what is missing. Inventories of Berlin, Tokyo and Yokohama have median crown diameters of 0.44 to 0.97 of the
/// height.
constexpr double crown_diameter_per_height = 0.5;

/// The height is so many metres times the root of the trunk's diameter in metres: 11 m for 30 cm, 20 m for 1 m.
constexpr double height_of_one_metre_trunk_m = 20.0;

constexpr double default_tree_height_m = 10.0;

}  // namespace

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
  if (s.height_m.value_or(0.0) > 0.0) stated_heights_.add(*s.height_m);
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

namespace {

/// Whether a problem has no place that could be told.
bool is_without_place(ProblemCode code) {
  return code == ProblemCode::no_geometry || code == ProblemCode::unreadable_coordinate ||
         code == ProblemCode::malformed_feature || code == ProblemCode::unsupported_geometry;
}

}  // namespace

void TreeCollector::note(ProblemCode code, const std::string& name, const std::string& detail, Point2d place) {
  Finding& finding = found_[code];
  if (finding.count++ == 0) finding = {1, name, detail, place};
}

void TreeCollector::add(const std::string& name, Point2d place, const StatedSizes& sizes) {
  if (!std::isfinite(place.x) || !std::isfinite(place.y))
    return note(ProblemCode::unreadable_coordinate, name, "a coordinate is not a finite number");
  result_.trees.push_back(sizes_.complete(sizes, name, place));
}

void TreeCollector::add_square(Point2d centre, double edge_m, double height_m) {
  result_.trees.push_back({.place = centre,
                           .height_m = static_cast<float>(height_m),
                           .crown_diameter_m = static_cast<float>(edge_m),
                           .shape = CrownShape::prism});
}

void TreeCollector::note_sizes() {
  constexpr const char* whole_file = "the whole file";
  const Point2d somewhere = result_.trees[0].place;
  if (const std::string missing = sizes_.missing(); !missing.empty())
    found_[ProblemCode::tree_size_missing] = {0, whole_file, missing, somewhere};
  if (const std::string classes = sizes_.classes(); !classes.empty())
    found_[ProblemCode::tree_size_classes] = {
        0, whole_file, classes + ": metres are taken; where they are classes, write metres into the file", somewhere};
  if (const auto doubt = sizes_.doubt()) found_[ProblemCode::implausible_size] = {0, whole_file, *doubt, somewhere};
  if (sizes_.absurd().count > 0) found_[ProblemCode::absurd_tree_size] = sizes_.absurd();
  if (sizes_.trunks().count > 0) found_[ProblemCode::trunk_above_crown] = sizes_.trunks();
}

SourceTrees TreeCollector::finish(std::uint64_t count, Report& report) {
  if (result_.trees.empty()) {
    std::string skipped;
    for (const auto& [what, times] : result_.skipped) skipped += "; " + std::to_string(times) + " " + what;
    throw InputError(result_.source + " holds no trees: of " + std::to_string(count) + " objects none can be used" +
                     (found_.empty() ? "" : ", since " + found_.begin()->second.first_detail) + skipped + ".");
  }
  note_sizes();
  for (const auto& [code, f] : found_) {
    const std::string counted = f.count > 1 ? std::to_string(f.count) + " trees, of which the first: " : "";
    std::optional<Point3d> position;
    if (!is_without_place(code)) position = Point3d{f.first_place.x, f.first_place.y, 0.0};
    report.add({code, result_.source, f.first_name, counted + f.first_detail, position});
  }
  return std::move(result_);
}

SourceTrees read_trees(const std::filesystem::path& file, const TreeSettings& settings, Report& report,
                       const std::stop_token& stop) {
  std::error_code unread;
  if (!std::filesystem::exists(file, unread)) throw InputError(why_unread(file));
  const bool is_file = std::filesystem::is_regular_file(file, unread);
  if (is_file && std::filesystem::file_size(file, unread) == 0)
    throw InputError(file.string() + " is empty: 0 bytes. Was the download cut short?");
  const FileFormat format = is_file ? format_by_content(InputFile(file)) : FileFormat::features;
  if (format == FileFormat::citygml) return read_citygml_trees(InputFile(file), settings, report, stop);
  if (format == FileFormat::cityjson) return read_cityjson_trees(InputFile(file), settings, report, stop);
  return read_feature_trees(file, settings, report, stop);
}

}  // namespace farlod::ingest

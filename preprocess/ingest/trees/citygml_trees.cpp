// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "ingest/citygml/citygml_xml.hpp"
#include "ingest/citygml/gml_surfaces_numbers.hpp"
#include "ingest/footprints/height_text.hpp"
#include "ingest/trees/city_trees.hpp"
#include "ingest/trees/foliage_text.hpp"
#include "ingest/trees/tree_shape.hpp"

namespace farlod::ingest {
namespace {

/// The longest text of a size or a name that is kept.
constexpr std::size_t most_words = 256;

bool holds_words(std::string_view name) {
  return name == "height" || name == "crownDiameter" || name == "trunkDiameter" || name == "species";
}
bool holds_coordinates(std::string_view name) { return name == "pos" || name == "posList" || name == "coordinates"; }
/// What is in a frame of its own.
bool is_relative(std::string_view name) {
  return name == "relativeGMLGeometry" || name == "relativeGeometry" || name == "transformationMatrix";
}

class TreeListener : public XmlListener {
 public:
  explicit TreeListener(TreeCollector& trees) : trees_(trees) {}

  void start(const XmlElement& element) override {
    if (trees_.crs().definition.empty() && !element.srs_name.empty()) trees_.crs().definition = element.srs_name;
    ++depth_;
    if (tree_depth_ == 0 && element.name == "SolitaryVegetationObject") return begin_tree(element);
    if (tree_depth_ == 0 || relative_depth_ != 0) return;
    if (is_relative(element.name)) relative_depth_ = depth_;
    if (element.name == "referencePoint") reference_depth_ = depth_;
    // A height in a geometry of an extension is another one
    is_words_ = depth_ == tree_depth_ + 1 && holds_words(element.name);
    is_numbers_ = holds_coordinates(element.name) && relative_depth_ == 0;
    words_.clear();
    numbers_.clear();
  }

  void end(std::string_view name) override {
    if (is_words_) take_words(name);
    if (is_numbers_) take_numbers();
    is_words_ = is_numbers_ = false;
    if (depth_ == tree_depth_) end_tree();
    if (depth_ == relative_depth_) relative_depth_ = 0;
    if (depth_ == reference_depth_) reference_depth_ = 0;
    --depth_;
  }

  void text(std::string_view piece) override {
    if (is_words_) words_.append(piece.substr(0, most_words - std::min(most_words, words_.size())));
    if (is_numbers_) scanner_.take(piece, [this](double number) { numbers_.push_back(number); });
  }

  [[nodiscard]] std::uint64_t count() const { return count_; }

 private:
  void begin_tree(const XmlElement& element) {
    tree_depth_ = depth_;
    ++count_;
    tree_ = {};
    tree_.name = element.id.empty() ? "tree " + std::to_string(count_) : std::string(element.id);
  }
  void end_tree() {
    tree_depth_ = 0;
    tree_.hand_over(trees_);
  }

  void take_words(std::string_view name) {
    if (name == "species") {
      tree_.sizes.foliage = foliage_of_species(words_);
      return;
    }
    const std::optional<double> size_m = length_m_from(words_);
    (name == "height"          ? tree_.sizes.height_m
     : name == "crownDiameter" ? tree_.sizes.crown_diameter_m
                               : tree_.sizes.trunk_diameter_m) = size_m;
  }

  void take_numbers() {
    scanner_.end([this](double number) { numbers_.push_back(number); });
    if (reference_depth_ != 0) {
      if (numbers_.size() >= 2) tree_.reference_point = Point3d{numbers_[0], numbers_[1], 0.0};
      return;
    }
    for (std::size_t n = 0; n + 2 < numbers_.size(); n += 3) tree_.add_corner({numbers_[n], numbers_[n + 1], numbers_[n + 2]});
  }

  TreeCollector& trees_;
  std::size_t depth_ = 0, tree_depth_ = 0, relative_depth_ = 0, reference_depth_ = 0;  ///< of elements; 0: not in one
  bool is_words_ = false, is_numbers_ = false;
  std::string words_;
  NumberScanner scanner_;
  std::vector<double> numbers_;
  TreeShape tree_;
  std::uint64_t count_ = 0;
};

}  // namespace

SourceTrees read_citygml_trees(const InputFile& file, const TreeSettings& settings, Report& report, const std::stop_token& stop) {
  TreeCollector trees(file.name, settings.trunk_ratio);
  trees.crs().heights_in_metres = true;
  TreeListener listener(trees);
  parse_xml(file, listener, stop);
  return trees.finish(listener.count(), report);
}

}  // namespace farlod::ingest

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ingest/citygml/citygml_xml.hpp"
#include "ingest/citygml/gml_surfaces.hpp"
#include "ingest/footprints/footprint_reader.hpp"
#include "ingest/trees/plant_cover.hpp"
#include "ingest/trees/tree_reader.hpp"

namespace farlod::ingest {
namespace {

bool holds_words(std::string_view name) {
  return name == "height" || name == "crownDiameter" || name == "trunkDiameter" || name == "species";
}
bool holds_coordinates(std::string_view name) { return name == "pos" || name == "posList" || name == "coordinates"; }
/// What is in a frame of its own.
bool is_relative(std::string_view name) {
  return name == "relativeGMLGeometry" || name == "relativeGeometry" || name == "transformationMatrix";
}

/// Puts the surfaces of a plant cover together, from the elements below it.
class CoverListener {
 public:
  void begin(const XmlElement& element, std::uint64_t number) {
    *this = {};
    cover_.name = element.id.empty() ? "plant cover " + std::to_string(number) : std::string(element.id);
  }
  void start(std::string_view name) {
    if (name.starts_with("lod") && name.size() > 3 && name[3] >= '0' && name[3] <= '4') level_ = name[3] - '0';
    if (name == "Solid") cover_.begin_geometry(level_, /*is_solid=*/true), is_in_solid_ = true;
    if (is_face(name)) begin_face();
    if (name == "LinearRing") face_.emplace_back();
  }
  void end(std::string_view name) {
    if (name == "Solid") is_in_solid_ = false;
    if (is_face(name)) cover_.add_face(std::exchange(face_, {}));
  }
  /// Adds points of a ring, in one piece or in several.
  void add(const std::vector<double>& coordinates) {
    for (std::size_t n = 0; n + 2 < coordinates.size() && !face_.empty(); n += 3)
      face_.back().push_back({coordinates[n], coordinates[n + 1], coordinates[n + 2]});
  }
  void take_average_height(const std::string& words) { cover_.average_height_m = length_m_from(words); }
  void hand_over(TreeCollector& trees) const { cover_.hand_over(trees); }

 private:
  static bool is_face(std::string_view name) {
    return name == "Polygon" || name == "PolygonPatch" || name == "Triangle" || name == "Rectangle";
  }
  void begin_face() {
    face_.clear();
    if (!is_in_solid_) cover_.begin_geometry(level_, /*is_solid=*/false);
  }

  PlantCover cover_;
  PlantCover::Face face_;
  int level_ = 0;
  bool is_in_solid_ = false;
};

class TreeListener : public XmlListener {
 public:
  explicit TreeListener(TreeCollector& trees) : trees_(trees) {}

  void start(const XmlElement& element) override {
    if (trees_.crs().definition.empty() && !element.srs_name.empty()) trees_.crs().definition = element.srs_name;
    ++depth_;
    if (tree_depth_ == 0 && is_vegetation(element.name)) return begin(element);
    if (tree_depth_ == 0 || relative_depth_ != 0) return;
    if (is_relative(element.name)) relative_depth_ = depth_;
    if (element.name == "referencePoint") reference_depth_ = depth_;
    if (is_cover_ && relative_depth_ == 0) cover_.start(element.name);
    // A height in a geometry of an extension is another one
    is_words_ = depth_ == tree_depth_ + 1 && (is_cover_ ? element.name == "averageHeight" : holds_words(element.name));
    is_numbers_ = holds_coordinates(element.name) && relative_depth_ == 0;
    words_.clear();
    numbers_.clear();
  }

  void end(std::string_view name, std::uint64_t /*end*/) override {
    if (is_words_) take_words(name);
    if (is_numbers_) take_numbers();
    is_words_ = is_numbers_ = false;
    if (is_cover_ && tree_depth_ != 0 && relative_depth_ == 0) cover_.end(name);
    if (depth_ == tree_depth_) hand_over();
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
  static bool is_vegetation(std::string_view name) { return name == "SolitaryVegetationObject" || name == "PlantCover"; }

  void begin(const XmlElement& element) {
    tree_depth_ = depth_;
    ++count_;
    is_cover_ = element.name == "PlantCover";
    if (is_cover_) return cover_.begin(element, count_);
    tree_ = {};
    tree_.name = element.id.empty() ? "tree " + std::to_string(count_) : std::string(element.id);
  }
  void hand_over() {
    tree_depth_ = 0;
    is_cover_ ? cover_.hand_over(trees_) : tree_.hand_over(trees_);
    is_cover_ = false;
  }

  void take_words(std::string_view name) {
    if (is_cover_) return cover_.take_average_height(words_);
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
    if (is_cover_) return cover_.add(numbers_);
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
  bool is_cover_ = false;  ///< whether a plant cover is being read
  CoverListener cover_;
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

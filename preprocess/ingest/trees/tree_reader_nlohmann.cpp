// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <istream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/cancellation.hpp"
#include "farlod/error.hpp"
#include "ingest/footprints/footprint_reader.hpp"
#include "ingest/trees/plant_cover.hpp"
#include "ingest/trees/tree_fields.hpp"
#include "ingest/trees/tree_reader.hpp"

namespace farlod::ingest {
namespace {

using nlohmann::json;

/// No city is nested this deep. nlohmann deletes trees by recursion, which would overflow the stack.
constexpr int deepest_tree_nesting = 500;

struct Transform {
  std::array<double, 3> scale{1.0, 1.0, 1.0}, translate{0.0, 0.0, 0.0};
};

/// A city, or a line of CityJSONSeq: each has vertices of its own.
class CityJsonTrees {
 public:
  explicit CityJsonTrees(TreeCollector& trees) : trees_(trees) {}

  void take(const json& city) {
    if (city.contains("transform")) {
      transform_.scale = city.at("transform").at("scale").get<std::array<double, 3>>();
      transform_.translate = city.at("transform").at("translate").get<std::array<double, 3>>();
    }
    if (city.contains("metadata")) {
      const json& crs = city.at("metadata").value("referenceSystem", json());
      if (crs.is_string()) trees_.crs().definition = crs.get<std::string>();
    }
    if (!city.contains("CityObjects")) return;
    static const json no_vertices = json::array();
    vertices_ = city.contains("vertices") ? &city.at("vertices") : &no_vertices;
    for (const auto& [id, object] : city.at("CityObjects").items()) {
      const std::string type = object.value("type", "");
      if (type == "SolitaryVegetationObject") take_tree(id, object);
      if (type == "PlantCover") take_cover(id, object);
    }
  }
  [[nodiscard]] std::uint64_t count() const { return count_; }

 private:
  static std::optional<double> size_in(const json& attributes, const char* name) {
    const auto found = attributes.find(name);
    if (found == attributes.end()) return std::nullopt;
    if (found->is_number()) return found->get<double>();
    return found->is_string() ? length_m_from(found->get<std::string>()) : std::nullopt;
  }

  void take_tree(const std::string& id, const json& object) {
    ++count_;
    TreeShape tree;
    tree.name = id;
    if (const auto attributes = object.find("attributes"); attributes != object.end() && attributes->is_object()) {
      tree.sizes.height_m = size_in(*attributes, "height");
      tree.sizes.crown_diameter_m = size_in(*attributes, "crownDiameter");
      tree.sizes.trunk_diameter_m = size_in(*attributes, "trunkDiameter");
      const json& species = attributes->value("species", json());
      if (species.is_string()) tree.sizes.foliage = foliage_of_species(species.get<std::string>());
    }
    if (const auto geometry = object.find("geometry"); geometry != object.end())
      for (const json& one : *geometry) take_geometry(one, tree);
    tree.hand_over(trees_);
  }

  /// A number, or a text such as "2.1".
  static int level_of_detail(const json& lod) {
    const std::string text = lod.is_string() ? lod.get<std::string>() : lod.dump();
    return !text.empty() && text[0] >= '0' && text[0] <= '9' ? text[0] - '0' : 0;
  }

  void take_cover(const std::string& id, const json& object) {
    ++count_;
    PlantCover cover;
    cover.name = id;
    if (const auto attributes = object.find("attributes"); attributes != object.end() && attributes->is_object())
      cover.average_height_m = size_in(*attributes, "averageHeight");
    if (const auto geometry = object.find("geometry"); geometry != object.end())
      for (const json& one : *geometry) take_geometry(one, cover);
    cover.hand_over(trees_);
  }

  void take_geometry(const json& geometry, PlantCover& cover) const {
    const std::string type = geometry.value("type", "");
    const std::size_t lists_around_faces = type.ends_with("Surface") ? 0 : type == "Solid" ? 1 : 2;
    if (type != "MultiSurface" && !type.ends_with("Solid") && type != "CompositeSurface") return;
    cover.begin_geometry(level_of_detail(geometry.value("lod", json())), lists_around_faces > 0);
    add_faces(geometry.at("boundaries"), lists_around_faces, cover);
  }

  void add_faces(const json& boundaries, std::size_t lists_around_faces, PlantCover& cover) const {
    for (const json& one : boundaries) {
      if (lists_around_faces > 0) {
        add_faces(one, lists_around_faces - 1, cover);
        continue;
      }
      PlantCover::Face face;
      for (const json& ring : one) {
        face.emplace_back();
        for (const json& number : ring) face.back().push_back(vertex(number));
      }
      cover.add_face(std::move(face));
    }
  }

  void take_geometry(const json& geometry, TreeShape& tree) const {
    const json& boundaries = geometry.at("boundaries");
    if (geometry.value("type", "") == "GeometryInstance") {
      tree.reference_point = vertex(boundaries.at(0));
      return;
    }
    add_corners(boundaries, tree);
  }

  void add_corners(const json& boundaries, TreeShape& tree) const {
    for (const json& one : boundaries)
      if (one.is_array())
        add_corners(one, tree);
      else
        tree.add_corner(vertex(one));
  }

  /// Not a finite point where there is no such vertex.
  [[nodiscard]] Point3d vertex(const json& number) const {
    constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
    if (!number.is_number_unsigned() || number.get<std::size_t>() >= vertices_->size()) return {nowhere, nowhere, nowhere};
    const auto v = vertices_->at(number.get<std::size_t>()).get<std::array<double, 3>>();
    const auto& [scale, translate] = transform_;
    return {v[0] * scale[0] + translate[0], v[1] * scale[1] + translate[1], v[2] * scale[2] + translate[2]};
  }

  TreeCollector& trees_;
  Transform transform_;
  const json* vertices_ = nullptr;
  std::uint64_t count_ = 0;
};

json parsed(const std::string& text, const InputFile& file) {
  return json::parse(text, [&](int depth, json::parse_event_t, const json&) {
    if (depth > deepest_tree_nesting) throw InputError(file.name + " is nested deeper than any city.");
    return true;
  });
}

}  // namespace

SourceTrees read_cityjson_trees(const InputFile& file, const TreeSettings& settings, Report& report,
                                const std::stop_token& stop) {
  TreeCollector trees(file.name, settings.trunk_ratio);
  trees.crs().heights_in_metres = true;
  CityJsonTrees reader(trees);
  const std::unique_ptr<std::istream> stream = open_input(file);
  try {
    std::string text;
    std::getline(*stream, text);
    // A first line that is a value of its own begins CityJSONSeq
    if (json::accept(text)) {
      do {
        throw_if_cancelled(stop);
        if (text.find('{') != std::string::npos) reader.take(parsed(text, file));
      } while (std::getline(*stream, text));
    } else {
      text.append(1, '\n').append(std::istreambuf_iterator<char>(*stream), {});
      reader.take(parsed(text, file));
    }
  } catch (const json::exception& error) {
    throw InputError(file.name + " is no CityJSON that can be read: " + error.what());
  }
  return trees.finish(reader.count(), report);
}

}  // namespace farlod::ingest

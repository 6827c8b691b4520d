// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "city/city_model.hpp"
#include "ingest/citygml/citygml_xml.hpp"
#include "package/sources_layout.hpp"

namespace farlod::ingest {

/// The vocabulary that the namespace of an element belongs to, in any version of CityGML and GML.
enum class Vocabulary {
  gml,
  core,           ///< the core of CityGML, and textured surfaces
  constructions,  ///< buildings, bridges, tunnels and other constructions
  relief,
  other_citygml,  ///< a module without parts of constructions: generics, appearance, vegetation ...
  foreign,        ///< an application domain extension (ADE)
};

[[nodiscard]] Vocabulary vocabulary_of(std::string_view space);

/// Whether elements of a vocabulary can contain surfaces of a construction.
[[nodiscard]] inline bool may_hold_surfaces(Vocabulary vocabulary) {
  return vocabulary == Vocabulary::gml || vocabulary == Vocabulary::core || vocabulary == Vocabulary::constructions;
}

/// Building, Bridge, Tunnel, OtherConstruction, which all count as buildings, and their parts, which may occur alone.
[[nodiscard]] bool is_construction_name(std::string_view name);
[[nodiscard]] bool is_part_name(std::string_view name);
/// Installations outside of a building: balconies, chimneys, portals.
[[nodiscard]] bool is_installation_name(std::string_view name);
/// Constructive elements, of which a construction may consist entirely: pylons, decks, walls, slabs.
[[nodiscard]] bool is_element_name(std::string_view name);
/// Rooms, hollow spaces, furniture, addresses, and the properties that contain them or refer to other buildings.
[[nodiscard]] bool is_inner_name(std::string_view name);
/// Semantic surfaces: RoofSurface, WallSurface ...
[[nodiscard]] bool is_boundary_name(std::string_view name);
/// A property with geometry: lod0 to lod9, followed by the kind of geometry.
[[nodiscard]] bool is_lod_property(std::string_view name);
/// Properties that contain one object of the city each.
[[nodiscard]] bool is_member_name(std::string_view name);

/// Counts the skipped features of a CityGML file by the name of the element without its prefix. The namespace of an extension
/// follows the name: "RiverFloodingRiskAttribute (https://www.geospatial.jp/iur/uro/2.0)".
class SkippedCount {
 public:
  /// All further names are counted as one, so that no file can make the table grow without limit.
  static constexpr std::size_t most_names = 100;
  static constexpr const char* other_names = "elements of still other names";

  void add(const XmlElement& element);
  /// Adds the counts of the next segment of the file. Returns false when there are so many names that the two segments, read as
  /// one, might tell others apart.
  [[nodiscard]] bool append(const SkippedCount& next);
  [[nodiscard]] const SkippedFeatures& counts() const { return counts_; }

 private:
  SkippedFeatures counts_;
};

/// Finds where generic attributes of objects of the city belong: behind the properties that precede them in the schema. It is
/// told each element of the file.
class CityGmlPlaces {
 public:
  /// `forms`: those of earlier segments of the file.
  explicit CityGmlPlaces(std::vector<package::AttributeForm> forms) : forms_(std::move(forms)) {}

  void bind(std::string_view prefix, std::string_view space) {
    bindings_.emplace_back(prefix, space);
    known_.reset();
  }
  void unbind() {
    bindings_.pop_back();
    known_.reset();
  }
  void start(const XmlElement& element);
  /// `end`: one past the last byte of the element.
  void end(std::uint64_t end);

  /// The element that has just started is an object of the city, or a semantic surface.
  void open(const XmlElement& element);
  /// Called before `end` for what was opened last.
  [[nodiscard]] package::AttributePlace close();

  /// The forms of all places so far, by their numbers.
  [[nodiscard]] const std::vector<package::AttributeForm>& forms() const { return forms_; }
  /// Adds what was found in the next segment. Returns false where the two would have numbered their forms otherwise as one.
  [[nodiscard]] bool append(const CityGmlPlaces& next);

 private:
  struct Open {
    std::size_t depth = 0;
    package::AttributePlace place;
    bool has_later_property = false;  ///< one that comes behind generic attributes
    bool is_before = false;           ///< the property that is open comes before them
  };

  [[nodiscard]] bool is_in_property() const { return !open_.empty() && depth_ == open_.back().depth + 1; }
  /// The number of the form of attributes of an element; 0 where no known version of CityGML has such.
  [[nodiscard]] std::uint32_t form_number_of(std::string_view space);
  [[nodiscard]] std::optional<package::AttributeForm> form_of(std::string_view space) const;
  [[nodiscard]] std::optional<std::string> prefix_of(std::string_view space) const;

  std::vector<std::pair<std::string, std::string>> bindings_;  ///< prefixes and namespaces, the innermost last
  std::vector<package::AttributeForm> forms_;
  std::optional<std::pair<std::string, std::uint32_t>> known_;  ///< a namespace, and its form as long as prefixes stay
  std::vector<Open> open_;
  std::size_t depth_ = 0;
};

}  // namespace farlod::ingest

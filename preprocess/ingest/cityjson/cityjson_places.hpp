// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "package/sources_layout.hpp"

namespace farlod::ingest {

/// Where attributes of an object of CityJSON belong, and those of the semantic surfaces of each of its geometries.
struct CityJsonPlaces {
  package::AttributePlace object;
  std::vector<std::vector<package::AttributePlace>> semantics;  ///< by geometry, by row of `semantics.surfaces`
};

/// Finds the places of one object while it is parsed. It is told each value within the object, of names that occur several times
/// the last one counts, as in a tree of the values.
class CityJsonPlaceFinder {
 public:
  /// The forms of all places, by their numbers.
  [[nodiscard]] static std::vector<package::AttributeForm> forms();

  /// An object or an array begins: the object itself first. `name`: its own, within an object. `at`: behind its bracket.
  void open(std::string_view name, bool is_object, std::uint64_t at);
  /// It ends.
  void close(std::uint64_t at);
  /// A string, a number or the like ends.
  void value(std::string_view name, std::uint64_t at);
  /// Once the object has ended.
  [[nodiscard]] CityJsonPlaces take();

 private:
  /// What is open.
  enum class Thing { object, attributes, geometries, geometry, semantics, surfaces, surface, other };
  struct Open {
    Thing thing = Thing::other;
    std::uint64_t first = 0, last = 0;  ///< behind the opening bracket, and behind the last value
  };

  [[nodiscard]] static Thing thing_in(Thing outer, std::string_view name, bool is_object);
  [[nodiscard]] static package::AttributePlace place_in(const Open& members, std::uint32_t form);

  std::vector<Open> open_;
  CityJsonPlaces places_;
  bool takes_attributes_ = true;  ///< false where `attributes` is there and is no object
  std::optional<package::AttributePlace> among_attributes_;
};

}  // namespace farlod::ingest

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "results/city/city_file.hpp"
#include "results/city/xml_text.hpp"

namespace farlod {

/// What is written before the name of a generic attribute, between its name and its value, and behind that.
struct GenericAttributeForm {
  std::string before_name, before_value, behind_value;
  bool operator==(const GenericAttributeForm&) const = default;
};

/// An object of the city has ended.
struct ClosedPlace {
  std::optional<AttributePlace> place;  ///< empty: no version of CityGML that is known has such attributes
  std::vector<std::string> names;       ///< of the generic attributes that it has
};

/// Finds where the generic attributes of objects of the city belong: behind the properties that precede them in the schema. It is
/// told each element of the file.
class CityGmlPlaces {
 public:
  void bind(std::string_view prefix, std::string_view space) { bindings_.emplace_back(prefix, space); }
  void unbind() { bindings_.pop_back(); }
  void start(const XmlTag& tag);
  void text(std::string_view piece);
  /// `end`: one past the last byte of the element.
  void end(std::size_t end);

  /// The element that has just started is an object of the city.
  void open(const XmlTag& tag);
  /// Called before `end` for the object that was opened last.
  [[nodiscard]] ClosedPlace close();
  /// The forms of all places so far, by their numbers.
  [[nodiscard]] const std::vector<GenericAttributeForm>& forms() const { return forms_; }

 private:
  struct Open {
    std::size_t depth = 0;
    std::optional<AttributePlace> place;
    std::vector<std::string> names;
    bool has_later_property = false;  ///< one that comes behind generic attributes
    bool is_before = false;           ///< the property that is open comes before them
  };

  [[nodiscard]] bool is_inside(std::size_t levels) const { return !open_.empty() && depth_ == open_.back().depth + levels; }
  [[nodiscard]] std::optional<GenericAttributeForm> form_of(std::string_view space) const;
  [[nodiscard]] std::optional<std::string> prefix_of(std::string_view space) const;

  std::vector<std::pair<std::string, std::string>> bindings_;  ///< prefixes and namespaces, the innermost last
  std::vector<GenericAttributeForm> forms_;
  std::vector<Open> open_;
  std::size_t depth_ = 0;
  bool in_name_ = false;
  std::string name_;
};

}  // namespace farlod

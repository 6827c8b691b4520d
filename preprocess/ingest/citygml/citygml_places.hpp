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

#include "ingest/citygml/xml_element.hpp"
#include "package/sources_layout.hpp"

namespace farlod::ingest {

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

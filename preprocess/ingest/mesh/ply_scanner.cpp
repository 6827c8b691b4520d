// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <istream>
#include <memory>
#include <string>
#include <vector>

#include "farlod/error.hpp"
#include "ingest/mesh/mesh_scanners.hpp"
#include "ingest/mesh/words.hpp"

namespace farlod::ingest {
namespace {

/// A type of numbers, which has two names.
struct PlyType {
  std::string_view name, sized_name;
  std::size_t bytes;
  double (*value)(const char* bytes);
};

template <class Number>
double value_of_ply(const char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return static_cast<double>(number);
}

constexpr std::array ply_types{
    PlyType{"char", "int8", 1, value_of_ply<std::int8_t>},    PlyType{"uchar", "uint8", 1, value_of_ply<std::uint8_t>},
    PlyType{"short", "int16", 2, value_of_ply<std::int16_t>}, PlyType{"ushort", "uint16", 2, value_of_ply<std::uint16_t>},
    PlyType{"int", "int32", 4, value_of_ply<std::int32_t>},   PlyType{"uint", "uint32", 4, value_of_ply<std::uint32_t>},
    PlyType{"float", "float32", 4, value_of_ply<float>},      PlyType{"double", "float64", 8, value_of_ply<double>}};

struct PlyProperty {
  std::string name;
  const PlyType* count = nullptr;  ///< of a list
  const PlyType* type = nullptr;
};

struct PlyElement {
  std::string name;
  double count = 0.0;
  std::vector<PlyProperty> properties = {};
};

class PlyScanner {
 public:
  PlyScanner(std::istream& stream, const std::string& name) : stream_(stream), name_(name) { mesh_.places = "face"; }

  Mesh scan() {
    read_head();
    for (const PlyElement& element : elements_)
      for (double n = 0.0; n < element.count && !element.properties.empty(); ++n) read_element(element);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(name_ + " cannot be read as PLY: " + what + " after " + std::to_string(mesh_.vertices.size()) +
                     " vertices and " + std::to_string(mesh_.faces.size()) + " faces.");
  }

  const PlyType* type_of(std::string_view word) const {
    for (const PlyType& type : ply_types)
      if (word == type.name || word == type.sized_name) return &type;
    refuse("it has numbers of an unknown type, \"" + std::string(word.substr(0, 20)) + "\",");
  }

  void read_head() {
    for (std::string line; std::getline(stream_, line);) {
      std::string_view rest = line;
      const std::string_view keyword = take_word(rest);
      if (keyword == "end_header") return;
      if (keyword == "format") {
        const std::string_view format = take_word(rest);
        is_text_ = format == "ascii";
        is_swapped_ = format == (std::endian::native == std::endian::little ? "binary_big_endian" : "binary_little_endian");
      } else if (keyword == "element") {
        elements_.push_back({std::string(take_word(rest))});
        elements_.back().count = coordinate_from(take_word(rest));
      } else if (keyword == "property" && !elements_.empty()) {
        PlyProperty& property = elements_.back().properties.emplace_back();
        std::string_view type = take_word(rest);
        if (type == "list") {
          property.count = type_of(take_word(rest));
          type = take_word(rest);
        }
        property.type = type_of(type);
        property.name = take_word(rest);
      }
    }
    refuse("its head does not end");
  }

  double next(const PlyType& type) {
    if (is_text_) {
      if (!(stream_ >> word_)) refuse("it ends");
      return coordinate_from(word_);
    }
    std::array<char, 8> bytes{};
    if (!stream_.read(bytes.data(), static_cast<std::streamsize>(type.bytes))) refuse("it ends");
    if (is_swapped_) std::reverse(bytes.begin(), bytes.begin() + type.bytes);
    return type.value(bytes.data());
  }

  void read_element(const PlyElement& element) {
    Point3d p;
    bool has_corners = false;
    for (const PlyProperty& property : element.properties) {
      const double value = next(property.count != nullptr ? *property.count : *property.type);
      if (property.count != nullptr)
        has_corners |= read_list(property, value);
      else if (property.name == "x" || property.name == "y" || property.name == "z")
        (property.name == "x" ? p.x : property.name == "y" ? p.y : p.z) = value;
    }
    if (element.name == "vertex") mesh_.vertices.push_back(p);
    if (element.name == "face" && has_corners) mesh_.add_face(corners_);
  }

  /// Whether the list has the corners of a face.
  bool read_list(const PlyProperty& property, double count) {
    const bool is_corners = property.name == "vertex_indices" || property.name == "vertex_index";
    if (is_corners) corners_.clear();
    for (double n = 0.0; n < count; ++n) {
      const double number = next(*property.type);
      constexpr double largest = 9007199254740992.0;  // whole numbers up to here are exact
      const bool is_number = std::abs(number) <= largest;
      if (is_corners) corners_.push_back(is_number ? static_cast<std::int64_t>(number) : -1);
    }
    return is_corners;
  }

  std::istream& stream_;
  const std::string& name_;
  std::vector<PlyElement> elements_;
  bool is_text_ = false, is_swapped_ = false;
  std::vector<std::int64_t> corners_;
  std::string word_;
  Mesh mesh_;
};

}  // namespace

Mesh scan_ply(const InputFile& file) { return PlyScanner(*open_input(file), file.name).scan(); }

}  // namespace farlod::ingest

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <stdexcept>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

#include "city/city_model.hpp"
#include "farlod/point.hpp"
#include "farlod/problem.hpp"
#include "farlod/surface_kind.hpp"
#include "ingest/files/input_file.hpp"
#include "ingest/model_builder/city_model_builder.hpp"
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

/// The buffer of a stream that knows the place of the byte that is read next: a parser of JSON does not tell it.
class PlacedBuffer : public std::streambuf {
 public:
  /// Reads the stream piece by piece. What its buffer throws passes through.
  explicit PlacedBuffer(std::istream& source) : source_(&source), pieces_(piece_bytes) {}
  /// Reads a text that has a place in its file. The text must outlive it.
  PlacedBuffer(std::string& text, std::uint64_t begin) : begin_(begin) {
    setg(text.data(), text.data(), text.data() + text.size());
  }

  [[nodiscard]] std::uint64_t at() const { return begin_ + static_cast<std::uint64_t>(gptr() - eback()); }

 protected:
  int_type underflow() override {
    if (source_ == nullptr) return traits_type::eof();
    begin_ = at();
    source_->read(pieces_.data(), static_cast<std::streamsize>(pieces_.size()));
    setg(pieces_.data(), pieces_.data(), pieces_.data() + source_->gcount());
    return source_->gcount() == 0 ? traits_type::eof() : traits_type::to_int_type(pieces_.front());
  }

 private:
  static constexpr std::size_t piece_bytes = std::size_t{1} << 16;

  std::istream* source_ = nullptr;
  std::vector<char> pieces_;
  std::uint64_t begin_ = 0;  ///< of what the buffer holds
};

struct CityJsonPolygon {
  std::vector<std::vector<std::int64_t>> rings;  ///< rows of the vertex list, not checked yet
  SurfaceKind kind = SurfaceKind::unknown;
  std::optional<std::uint32_t> semantics = {};  ///< row of `semantics.surfaces`
};

/// The number of nested lists around the surfaces of a geometry; empty for types without surfaces.
[[nodiscard]] inline std::optional<int> nesting_of(std::string_view type) {
  if (type == "MultiSurface" || type == "CompositeSurface") return 0;
  if (type == "Solid") return 1;
  if (type == "MultiSolid" || type == "CompositeSolid") return 2;
  return std::nullopt;
}

/// An instance of a template: transformed by a 4 × 4 matrix (row by row), then moved to a vertex.
struct CityJsonInstance {
  std::size_t template_row = 0;
  std::array<double, 16> matrix{};
  std::int64_t anchor = 0;
};

struct CityJsonGeometry {
  std::string type;
  double lod = 0.0;
  std::vector<CityJsonPolygon> polygons;
  std::optional<CityJsonInstance> instance;    ///< if set, the polygons are those of its template
  std::vector<std::string> semantic_ids = {};  ///< by row of `semantics.surfaces`; empty where one has none
};

struct CityJsonObject {
  std::string id, type;
  std::vector<std::string> parents, children;
  std::vector<CityJsonGeometry> geometries;
  std::optional<double> measured_height_m;
  std::string malformed;                      ///< how it breaks the format; it has no geometries then
  std::optional<CityJsonPlaces> places = {};  ///< in a file into which attributes can be inserted
};

/// The id of a polygon's semantic surface. CityJSON asks for none: where there is none, the id of the object and the row, as in
/// "B1#3". Empty for a polygon without semantics.
[[nodiscard]] inline std::string surface_id(const CityJsonObject& object, const CityJsonGeometry& geometry,
                                            const CityJsonPolygon& polygon) {
  if (!polygon.semantics) return {};
  const std::string& id = geometry.semantic_ids[*polygon.semantics];
  return id.empty() ? object.id + '#' + std::to_string(*polygon.semantics) : id;
}

/// The templates of a file, which all its objects may use.
struct CityJsonTemplates {
  std::vector<CityJsonGeometry> geometries;
  std::vector<Point3d> vertices;
};

/// What was read or skipped besides buildings.
struct ObjectAccount {
  std::vector<Point3d> relief_points;  ///< corners of the triangles of terrain, in its best level of detail
  SkippedFeatures skipped;             ///< types of the objects that are not used
  std::uint64_t template_corners = 0;  ///< corners that instances of templates added
  /// Polygons, rings and corners of the templates of all instances, whether or not they come to count.
  std::uint64_t template_pieces = 0;
};

/// Adds the buildings among the objects that share a vertex list: those of a CityJSON file, or of a line of a CityJSONSeq.
/// Buildings, bridges, tunnels and other constructions are read with their parts and outer installations. Terrain becomes relief
/// points. Plants, rooms, types of extensions and all others are counted as skipped. An object belongs to at most one building.
void add_objects(const std::vector<CityJsonObject>& objects, const std::vector<Point3d>& vertices,
                 const CityJsonTemplates& templates, LodChoice lod, CityModelBuilder& builder, ObjectAccount& account);

/// A text that is JSON, but not CityJSON.
class JsonFlaw : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A text that is not JSON.
class SyntaxFlaw : public JsonFlaw {
  using JsonFlaw::JsonFlaw;
};

/// A message of nlohmann without the number in brackets that it begins with.
[[nodiscard]] inline std::string plain(std::string_view message) {
  const std::size_t at = message.find("] ");
  return std::string(at == message.npos ? message : message.substr(at + 2));
}

/// ", but 15 SolitaryVegetationObject": the objects of a file without buildings.
[[nodiscard]] inline std::string said(const SkippedFeatures& skipped) {
  std::string text;
  for (const auto& [type, count] : skipped) text += (text.empty() ? ", but " : ", ") + std::to_string(count) + " " + type;
  return text;
}

/// The file with the transform and the CRS of a CityJSONFeature that no header precedes: `metadata.json` in its folder, or in one
/// of up to three folders above, as roofer writes it. Throws InputError when there is none.
[[nodiscard]] InputFile metadata_of_feature(const InputFile& feature);

/// Reads CityJSON 1.0 to 2.0, or CityJSONSeq line by line; also one or several CityJSONFeatures without a header, which is read
/// from metadata_of_feature. Throws InputError for a file that is not JSON (with line and column), is not CityJSON, or has
/// neither buildings nor a relief.
[[nodiscard]] SourceCity read_cityjson(const InputFile& file, LodChoice lod, Report& report);

}  // namespace farlod::ingest

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "farlod/point.hpp"
#include "farlod/surface_kind.hpp"
#include "results/city/json_cursor.hpp"

namespace farlod {

/// An object of `semantics.surfaces`.
struct SemanticSurface {
  JsonExtent members;  ///< in the text
  std::vector<std::string> names;
  SurfaceKind kind = SurfaceKind::unknown;
};

struct FilePolygon {
  std::vector<std::vector<std::int64_t>> rings;  ///< rows of the vertex list, not checked yet
  std::optional<std::size_t> semantics;          ///< in FileGeometry::semantics
};

/// A template, placed by a 4 × 4 matrix (row by row), then moved to a vertex.
struct FileInstance {
  std::size_t template_row = 0;
  std::array<double, 16> matrix{};
  std::int64_t anchor = 0;
};

struct FileGeometry {
  std::string type;
  double lod = 0.0;
  std::vector<FilePolygon> polygons;
  std::vector<SemanticSurface> semantics;
  std::optional<FileInstance> instance;
};

/// A member of `CityObjects`, without its geometry.
struct FileObject {
  std::string id, type;
  std::vector<std::string> parents, children;
  std::size_t at = 0;  ///< where its value begins
};

/// The geometry of an object, and where attributes of it belong.
struct FileObjectContents {
  JsonExtent members;
  std::optional<JsonExtent> attributes;  ///< members of `attributes`
  bool takes_attributes = true;          ///< false where `attributes` is there and is no object
  std::vector<std::string> attribute_names;
  std::vector<FileGeometry> geometries;  ///< empty where one is malformed, as farlod-pack has it
};

/// A JSON text of CityJSON: a file, or a line of a CityJSONSeq. It knows its vertices, and where its objects are. Geometry is
/// read object by object, so that a city needs little more memory than its text, which has to outlive it.
class CityJsonText {
 public:
  /// Reads the file that begins at `at`, or the first text of a sequence. Throws JsonCursorError, also for a text that is no
  /// CityJSON.
  CityJsonText(std::string_view text, std::size_t at);
  /// Reads a CityJSONFeature. `header`: the first text of the sequence, which has to outlive it.
  CityJsonText(std::string_view text, std::size_t at, const CityJsonText& header);

  /// Behind its last byte.
  [[nodiscard]] std::size_t end() const { return end_; }
  [[nodiscard]] const std::vector<FileObject>& objects() const { return objects_; }
  [[nodiscard]] const std::vector<Point3d>& vertices() const { return vertices_; }
  [[nodiscard]] const std::vector<FileGeometry>& templates() const { return header().templates_; }
  [[nodiscard]] const std::vector<Point3d>& template_vertices() const { return header().template_vertices_; }
  [[nodiscard]] FileObjectContents contents_of(const FileObject& object) const;
  /// What it holds besides the text.
  [[nodiscard]] std::size_t bytes() const;

 private:
  [[nodiscard]] const CityJsonText& header() const { return header_ == nullptr ? *this : *header_; }
  void read(std::size_t at, std::string_view type);
  void read_objects(JsonCursor& cursor);
  void read_templates(JsonCursor& cursor);
  void read_transform(JsonCursor& cursor);

  std::string_view text_;
  const CityJsonText* header_ = nullptr;
  std::size_t end_ = 0;
  std::vector<FileObject> objects_;
  std::vector<Point3d> vertices_, template_vertices_;
  std::vector<FileGeometry> templates_;
  std::array<double, 3> scale_{1.0, 1.0, 1.0}, translate_{};
};

}  // namespace farlod

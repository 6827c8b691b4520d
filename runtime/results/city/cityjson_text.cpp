// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/city/cityjson_text.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "results/city/surface_numbering.hpp"

namespace farlod {
namespace {

/// The number of nested lists around the surfaces of a geometry; empty for types without surfaces.
std::optional<int> nesting_of(std::string_view type) {
  if (type == "MultiSurface" || type == "CompositeSurface") return 0;
  if (type == "Solid") return 1;
  if (type == "MultiSolid" || type == "CompositeSolid") return 2;
  return std::nullopt;
}

std::vector<std::string> strings_from(JsonCursor& cursor) {
  std::vector<std::string> strings;
  cursor.elements([&](std::size_t) { strings.push_back(cursor.string()); });
  return strings;
}

bool is_number(JsonCursor& cursor) {
  const char c = cursor.peek();
  return c == '-' || ('0' <= c && c <= '9');
}

/// A point that is none has no readable coordinates, and so has each ring with it.
Point3d point_from(JsonCursor& cursor) {
  constexpr double unreadable = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> p;
  if (cursor.peek() == '[') cursor.elements([&](std::size_t) { p.push_back(is_number(cursor) ? cursor.number() : unreadable); });
  return p.size() == 3 ? Point3d{p[0], p[1], p[2]} : Point3d{unreadable, unreadable, unreadable};
}

std::vector<Point3d> points_from(JsonCursor& cursor) {
  std::vector<Point3d> points;
  cursor.elements([&](std::size_t) { points.push_back(point_from(cursor)); });
  return points;
}

template <std::size_t N>
std::array<double, N> numbers_from(JsonCursor& cursor) {
  std::array<double, N> numbers{};
  const std::size_t begin = cursor.at();
  std::size_t count = 0;
  cursor.elements([&](std::size_t k) {
    const double x = cursor.number();
    if (k < N) numbers[k] = x;
    ++count;
  });
  if (count != N) throw JsonCursorError(begin, "there are not " + std::to_string(N) + " numbers");
  return numbers;
}

std::int64_t row_from(JsonCursor& cursor) {
  const std::size_t begin = cursor.at();
  const auto row = cursor.whole();
  if (!row) throw JsonCursorError(begin, "the number of a vertex is not whole");
  return *row;
}

double lod_from(JsonCursor& cursor) {
  if (is_number(cursor)) return cursor.number();
  const std::string text = cursor.string();
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return std::isfinite(value) ? value : 0.0;
}

/// Reads a geometry whose members may come in any order: first where they are, then what they are.
class GeometryReading {
 public:
  explicit GeometryReading(std::string_view text) : text_(text) {}

  FileGeometry read(JsonCursor& cursor) {
    std::optional<std::size_t> boundaries, semantics, matrix, template_row;
    cursor.members([&](const std::string& name) {
      if (name == "type") geometry_.type = cursor.string();
      if (name == "lod") geometry_.lod = lod_from(cursor);
      if (name == "boundaries") boundaries = cursor.at();
      if (name == "semantics") semantics = cursor.at();
      if (name == "transformationMatrix") matrix = cursor.at();
      if (name == "template") template_row = cursor.at();
    });
    if (semantics) read_semantics(*semantics);
    if (geometry_.type == "GeometryInstance" && boundaries && matrix && template_row)
      read_instance(*template_row, *matrix, *boundaries);
    else if (const auto nesting = nesting_of(geometry_.type); nesting && boundaries) {
      JsonCursor lists(text_, *boundaries);
      add_polygons(lists, values_, *nesting);
    }
    return std::move(geometry_);
  }

 private:
  void read_semantics(std::size_t at) {
    JsonCursor cursor(text_, at);
    if (cursor.peek() != '{') return;
    cursor.members([&](const std::string& name) {
      if (name == "values") values_ = cursor.at();
      if (name == "surfaces") cursor.elements([&](std::size_t) { geometry_.semantics.push_back(semantic_surface(cursor)); });
    });
  }

  static SemanticSurface semantic_surface(JsonCursor& cursor) {
    SemanticSurface surface;
    surface.members = cursor.members([&](const std::string& name) {
      surface.names.push_back(name);
      if (name == "type") surface.kind = kind_of_semantics(cursor.string());
    });
    return surface;
  }

  void read_instance(std::size_t template_row, std::size_t matrix, std::size_t boundaries) {
    FileInstance instance;
    JsonCursor at_row(text_, template_row), at_matrix(text_, matrix), at_anchor(text_, boundaries);
    instance.template_row = static_cast<std::size_t>(row_from(at_row));
    instance.matrix = numbers_from<16>(at_matrix);
    at_anchor.elements([&](std::size_t k) {
      if (k == 0) instance.anchor = row_from(at_anchor);
    });
    geometry_.instance = instance;
  }

  /// Where the elements of a list begin; none where the value is null.
  std::vector<std::size_t> places_of(const std::optional<std::size_t>& at) const {
    std::vector<std::size_t> places;
    if (!at) return places;
    JsonCursor cursor(text_, *at);
    if (cursor.peek() == '[') cursor.elements([&](std::size_t) { places.push_back(cursor.at()); });
    return places;
  }

  std::optional<std::size_t> semantics_at(const std::optional<std::size_t>& at) const {
    if (!at) return std::nullopt;
    JsonCursor cursor(text_, *at);
    if (!is_number(cursor)) return std::nullopt;
    const auto row = cursor.whole();
    const bool is_known = row && *row >= 0 && static_cast<std::size_t>(*row) < geometry_.semantics.size();
    return is_known ? std::optional(static_cast<std::size_t>(*row)) : std::nullopt;
  }

  /// Polygons in the order of the file; the numbers of their semantics are nested as they are, and may be null at any depth.
  void add_polygons(JsonCursor& lists, const std::optional<std::size_t>& values, int nesting) {
    const std::vector<std::size_t> places = places_of(values);
    lists.elements([&](std::size_t i) {
      std::optional<std::size_t> value;
      if (i < places.size()) value = places[i];
      if (nesting > 0) return add_polygons(lists, value, nesting - 1);
      FilePolygon& polygon = geometry_.polygons.emplace_back();
      polygon.semantics = semantics_at(value);
      lists.elements([&](std::size_t) {
        auto& ring = polygon.rings.emplace_back();
        lists.elements([&](std::size_t) { ring.push_back(row_from(lists)); });
      });
    });
  }

  std::string_view text_;
  FileGeometry geometry_;
  std::optional<std::size_t> values_;
};

std::vector<FileGeometry> geometries_from(std::string_view text, JsonCursor& cursor) {
  std::vector<FileGeometry> geometries;
  cursor.elements([&](std::size_t) { geometries.push_back(GeometryReading(text).read(cursor)); });
  return geometries;
}

}  // namespace

CityJsonText::CityJsonText(std::string_view text, std::size_t at) : text_(text) { read(at, "CityJSON"); }

CityJsonText::CityJsonText(std::string_view text, std::size_t at, const CityJsonText& header) : text_(text), header_(&header) {
  read(at, "CityJSONFeature");
}

void CityJsonText::read(std::size_t at, std::string_view type) {
  JsonCursor cursor(text_, at);
  std::string found;
  cursor.members([&](const std::string& name) {
    if (name == "type") found = cursor.string();
    if (name == "CityObjects") read_objects(cursor);
    if (name == "vertices") vertices_ = points_from(cursor);
    if (name == "transform") read_transform(cursor);
    if (name == "geometry-templates") read_templates(cursor);
  });
  if (found != type) throw JsonCursorError(at, "there is no \"type\": \"" + std::string(type) + "\"");
  end_ = cursor.at();
  const std::array<double, 3>&scale = header().scale_, &translate = header().translate_;
  for (Point3d& p : vertices_) p = {p.x * scale[0] + translate[0], p.y * scale[1] + translate[1], p.z * scale[2] + translate[2]};
}

void CityJsonText::read_objects(JsonCursor& cursor) {
  cursor.members([&](const std::string& id) {
    FileObject& object = objects_.emplace_back();
    object.id = id;
    (void)cursor.peek();
    object.at = cursor.at();
    cursor.members([&](const std::string& name) {
      if (name == "type") object.type = cursor.string();
      if (name == "parents") object.parents = strings_from(cursor);
      if (name == "children") object.children = strings_from(cursor);
    });
  });
}

void CityJsonText::read_templates(JsonCursor& cursor) {
  cursor.members([&](const std::string& name) {
    if (name == "templates") templates_ = geometries_from(text_, cursor);
    if (name == "vertices-templates") template_vertices_ = points_from(cursor);
  });
}

void CityJsonText::read_transform(JsonCursor& cursor) {
  cursor.members([&](const std::string& name) {
    if (name == "scale") scale_ = numbers_from<3>(cursor);
    if (name == "translate") translate_ = numbers_from<3>(cursor);
  });
}

FileObjectContents CityJsonText::contents_of(const FileObject& object) const {
  FileObjectContents contents;
  std::optional<std::size_t> geometry;
  JsonCursor cursor(text_, object.at);
  contents.members = cursor.members([&](const std::string& name) {
    if (name == "geometry") geometry = cursor.at();
    if (name != "attributes") return;
    contents.takes_attributes = cursor.peek() == '{';
    if (contents.takes_attributes)
      contents.attributes = cursor.members([&](const std::string& attribute) { contents.attribute_names.push_back(attribute); });
  });
  if (!geometry) return contents;
  JsonCursor at_geometry(text_, *geometry);
  try {
    if (at_geometry.peek() == '[') contents.geometries = geometries_from(text_, at_geometry);
  } catch (const JsonCursorError&) {
    contents.geometries.clear();
  }
  return contents;
}

std::size_t CityJsonText::bytes() const { return objects_.size() * sizeof(FileObject) + vertices_.size() * sizeof(Point3d); }

}  // namespace farlod

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/city/cityjson_city.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "results/city/surface_numbering.hpp"

namespace farlod {
namespace {

enum class FileRole { none, building, part, installation, element };

FileRole role_of(std::string_view type) {
  if (type == "OtherConstruction") return FileRole::building;
  for (const std::string_view kind : {"Building", "Bridge", "Tunnel"}) {
    if (!type.starts_with(kind)) continue;
    const std::string_view rest = type.substr(kind.size());
    if (rest.empty()) return FileRole::building;
    if (rest == "Part") return FileRole::part;
    if (rest == "Installation") return FileRole::installation;
    if (rest == "ConstructiveElement" || rest == "ConstructionElement") return FileRole::element;
  }
  return FileRole::none;
}

/// The hierarchy of objects, which files give in `children`, in `parents`, or in both.
class FileFamily {
 public:
  explicit FileFamily(const std::vector<FileObject>& objects)
      : objects_(objects), children_(objects.size()), has_parent_(objects.size()) {
    for (std::size_t k = 0; k < objects.size(); ++k) row_of_.try_emplace(objects[k].id, k);
    for (std::size_t k = 0; k < objects.size(); ++k) {
      for (const std::string& child : objects[k].children)
        if (const auto row = row_of_.find(child); row != row_of_.end()) link(k, row->second);
      for (const std::string& parent : objects[k].parents)
        if (const auto row = row_of_.find(parent); row != row_of_.end()) link(row->second, k);
    }
  }
  [[nodiscard]] const std::set<std::size_t>& children_of(std::size_t k) const { return children_[k]; }
  [[nodiscard]] bool has_parent(std::size_t k) const { return has_parent_[k]; }

 private:
  void link(std::size_t parent, std::size_t child) {
    if (child == parent || role_of(objects_[parent].type) == FileRole::none) return;
    children_[parent].insert(child);
    has_parent_[child] = true;
  }

  const std::vector<FileObject>& objects_;
  std::unordered_map<std::string_view, std::size_t> row_of_;
  std::vector<std::set<std::size_t>> children_;
  std::vector<bool> has_parent_;
};

/// What surrounds attributes in the text: a sum of these.
constexpr std::size_t behind_others = 1, with_a_member_of_their_own = 2;

AttributePlace place_behind(const JsonExtent& extent, std::size_t form) {
  return {extent.last, form + (extent.is_empty() ? 0 : behind_others)};
}

std::optional<AttributePlace> place_in(const FileObjectContents& object) {
  if (!object.takes_attributes) return std::nullopt;
  return object.attributes ? place_behind(*object.attributes, 0) : place_behind(object.members, with_a_member_of_their_own);
}

/// A geometry, or an instance with the geometry of its template.
struct FileShape {
  const FileGeometry* geometry = nullptr;
  const FileInstance* instance = nullptr;
  std::size_t object = 0;  ///< in FileBuilding::objects
  std::size_t part = 0;
  FileRole role = FileRole::building;
};

bool has_surfaces(std::string_view type) {
  for (const std::string_view name : {"MultiSurface", "CompositeSurface", "Solid", "MultiSolid", "CompositeSolid"})
    if (type == name) return true;
  return false;
}

bool has_usable_rings(const FilePolygon& polygon) {
  if (polygon.rings.empty()) return false;
  return std::set<std::int64_t>(polygon.rings[0].begin(), polygon.rings[0].end()).size() >= 3;
}

/// Numbers the polygons of one building.
class BuildingNumbering {
 public:
  BuildingNumbering(const CityJsonText& file, const FileFamily& family, std::vector<bool>& visited)
      : file_(file), family_(family), visited_(visited) {}

  FileBuilding building_of(std::size_t root, PackedLod lod) {
    building_.id = file_.objects()[root].id;
    gather(root);
    for (std::size_t k = 0; k < contents_.size(); ++k) add_shapes(k);
    const std::vector<std::optional<double>> chosen = chosen_lods(usable_lods(), lod);
    std::vector<const FileShape*> wanted;
    for (const FileShape& shape : shapes_)
      if (chosen[shape.part] && *chosen[shape.part] == shape.geometry->lod) wanted.push_back(&shape);
    for (const FileShape* shape : wanted) add_polygons(*shape, wanted.size() == 1);
    return std::move(building_);
  }

 private:
  /// Visits the parts depth first, with a list instead of recursion: a file may nest them deeper than the stack of the program.
  void gather(std::size_t root) {
    std::vector<std::pair<std::size_t, std::size_t>> waiting{{root, 0}};
    while (!waiting.empty()) {
      const auto [k, part_of_parent] = waiting.back();
      waiting.pop_back();
      if (visited_[k]) continue;
      visited_[k] = true;
      const FileObject& object = file_.objects()[k];
      const FileRole role = role_of(object.type);
      const bool shares_part = k == root || role == FileRole::installation || role == FileRole::element;
      if (!shares_part && parts_ < most_parts) ++parts_;
      const std::size_t part = shares_part ? part_of_parent : parts_;
      add_object(object);
      places_.emplace_back(part, k == root ? FileRole::building : role);
      const std::set<std::size_t>& children = family_.children_of(k);
      for (auto child = children.rbegin(); child != children.rend(); ++child)
        if (role_of(file_.objects()[*child].type) != FileRole::none) waiting.emplace_back(*child, part);
    }
  }

  void add_object(const FileObject& object) {
    const FileObjectContents& contents = contents_.emplace_back(file_.contents_of(object));
    building_.objects.push_back(place_in(contents));
    std::ranges::copy(contents.attribute_names, std::back_inserter(building_.names_of_objects));
    for (const FileGeometry& geometry : contents.geometries)
      for (const SemanticSurface& surface : geometry.semantics)
        std::ranges::copy(surface.names, std::back_inserter(building_.names_of_surfaces));
  }

  void add_shapes(std::size_t object) {
    for (const FileGeometry& geometry : contents_[object].geometries) {
      FileShape shape{&geometry, nullptr, object, places_[object].first, places_[object].second};
      if (geometry.instance) {
        if (geometry.instance->template_row >= file_.templates().size()) continue;
        shape.instance = &*geometry.instance;
        shape.geometry = &file_.templates()[geometry.instance->template_row];
      }
      if (has_surfaces(shape.geometry->type)) shapes_.push_back(shape);
    }
  }

  /// Constructive elements make a level of detail eligible only where there is nothing else, as in some bridges.
  [[nodiscard]] LodsOfParts usable_lods() const {
    LodsOfParts lods = lods_of([](FileRole role) { return role == FileRole::building || role == FileRole::part; });
    const bool has_any = std::ranges::any_of(lods, [](const auto& of_part) { return !of_part.empty(); });
    return has_any ? lods : lods_of([](FileRole role) { return role == FileRole::element; });
  }

  template <class Decides>
  LodsOfParts lods_of(const Decides& decides) const {
    LodsOfParts lods(parts_ + 1);
    for (const FileShape& shape : shapes_)
      if (decides(shape.role) && std::ranges::any_of(shape.geometry->polygons, has_usable_rings))
        lods[shape.part].push_back(shape.geometry->lod);
    return lods;
  }

  /// Equal polygons of one geometry are kept. Those of two geometries are the same surface twice.
  void add_polygons(const FileShape& shape, bool is_alone) {
    std::vector<std::pair<FileCorners, std::uint32_t>> fresh;
    const std::size_t first_semantics = building_.semantics.size();
    if (!shape.instance)
      for (const SemanticSurface& surface : shape.geometry->semantics)
        building_.semantics.push_back({surface.kind, place_behind(surface.members, 0)});
    for (const FilePolygon& polygon : shape.geometry->polygons) {
      const std::optional<FileRings> rings = points_of(polygon, shape);
      if (!rings) continue;
      const auto corners = is_alone ? FileCorners() : corners_of(*rings);
      const auto seen = is_alone ? seen_.end() : seen_.find(corners);
      const std::uint32_t number = seen == seen_.end() ? next_number_++ : seen->second;
      if (!is_alone && seen == seen_.end()) fresh.emplace_back(corners, number);
      NumberedPolygon& added = building_.polygons.emplace_back(NumberedPolygon{number, shape.object, {}});
      if (polygon.semantics && !shape.instance) added.semantics = first_semantics + *polygon.semantics;
      measure(*rings, added);
    }
    seen_.insert(fresh.begin(), fresh.end());
  }

  /// Empty where a ring names a vertex that is not there: such a polygon has no number.
  [[nodiscard]] std::optional<FileRings> points_of(const FilePolygon& polygon, const FileShape& shape) const {
    const std::vector<Point3d>& vertices = shape.instance ? file_.template_vertices() : file_.vertices();
    FileRings rings;
    for (const std::vector<std::int64_t>& rows : polygon.rings) {
      FileRing& ring = rings.emplace_back();
      for (const std::int64_t row : rows) {
        const Point3d* p = vertex(vertices, row);
        const Point3d* anchor = shape.instance ? vertex(file_.vertices(), shape.instance->anchor) : p;
        if (p == nullptr || anchor == nullptr) return std::nullopt;
        ring.push_back(shape.instance ? placed(*p, shape.instance->matrix) + *anchor : *p);
      }
    }
    return rings;
  }

  static const Point3d* vertex(const std::vector<Point3d>& vertices, std::int64_t row) {
    return row < 0 || row >= static_cast<std::int64_t>(vertices.size()) ? nullptr : &vertices[static_cast<std::size_t>(row)];
  }

  static Point3d placed(const Point3d& p, const std::array<double, 16>& m) {
    const auto row = [&](std::size_t r) { return m[r] * p.x + m[r + 1] * p.y + m[r + 2] * p.z + m[r + 3]; };
    return {row(0) / row(12), row(4) / row(12), row(8) / row(12)};
  }

  static constexpr std::size_t most_parts = std::numeric_limits<std::uint16_t>::max();

  const CityJsonText& file_;
  const FileFamily& family_;
  std::vector<bool>& visited_;
  FileBuilding building_;
  std::vector<FileObjectContents> contents_;              ///< of the objects of the building
  std::vector<std::pair<std::size_t, FileRole>> places_;  ///< part and role of each object of the building
  std::vector<FileShape> shapes_;
  std::map<FileCorners, std::uint32_t> seen_;
  std::size_t parts_ = 0;
  std::uint32_t next_number_ = 0;
};

void for_each_building_of(const CityJsonText& text, PackedLod lod, const std::function<void(const FileBuilding&)>& on) {
  const std::vector<FileObject>& objects = text.objects();
  const FileFamily family(objects);
  std::vector<bool> visited(objects.size());
  // The first round begins at objects without parent. The objects that it leaves form circles of parents
  for (const bool is_first_round : {true, false})
    for (std::size_t k = 0; k < objects.size(); ++k)
      if (role_of(objects[k].type) != FileRole::none && !visited[k] && (!is_first_round || !family.has_parent(k)))
        on(BuildingNumbering(text, family, visited).building_of(k, lod));
}

}  // namespace

CityJsonCity::CityJsonCity(std::string text) : text_(std::move(text)) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  first_.emplace(text_, text_.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
  JsonCursor behind(text_, first_->end());
  is_sequence_ = behind.peek() == '{';
  if (!is_sequence_ && behind.peek() != '\0') throw JsonCursorError(behind.at(), "there is more text behind its end");
  std::unordered_set<std::string> ids;
  for_each_text([&](const CityJsonText& part) {
    for (const FileObject& object : part.objects())
      if (!ids.insert(object.id).second) repeated_ids_.insert(object.id);
    has_degrees_ = has_degrees_ && std::ranges::all_of(part.vertices(), [](const Point3d& p) {
                     return std::abs(p.x) <= 360.0 && std::abs(p.y) <= 360.0;
                   });
  });
}

void CityJsonCity::for_each_text(const std::function<void(const CityJsonText&)>& on) const {
  on(*first_);
  if (!is_sequence_) return;
  const std::string_view text = text_;
  for (std::size_t at = first_->end(); at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::optional<CityJsonText> feature;
    try {
      feature.emplace(text.substr(0, end), at, *first_);
    } catch (const JsonCursorError&) {
    }
    if (feature) on(*feature);
    at = end + 1;
  }
}

void CityJsonCity::for_each_building(PackedLod lod, const std::function<void(const FileBuilding&)>& on) const {
  for_each_text([&](const CityJsonText& text) { for_each_building_of(text, lod, on); });
}

std::string CityJsonCity::text_of(const CityAttributes& attributes, std::size_t form) const {
  std::string members;
  for (const auto& [name, value] : attributes)
    members.append(members.empty() ? "\"" : ",\"").append(name).append("\":").append(value);
  if ((form & with_a_member_of_their_own) != 0) members = "\"attributes\":{" + members + "}";
  return ((form & behind_others) != 0 ? "," : "") + members;
}

}  // namespace farlod

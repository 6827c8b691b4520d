// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/city/cityjson_buildings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <unordered_map>
#include <utility>

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

bool is_usable(const FilePolygon& polygon) {
  if (polygon.rings.empty()) return false;
  return std::set<std::int64_t>(polygon.rings[0].begin(), polygon.rings[0].end()).size() >= 3;
}

using LodsOfParts = std::vector<std::vector<double>>;

std::optional<double> best_of(const std::vector<double>& lods, PackedLod choice) {
  std::optional<double> best;
  for (const double lod : lods) {
    const double whole = std::floor(lod);
    const bool is_wanted = choice ? whole == static_cast<double>(*choice) : whole >= 1.0 && whole <= 3.0;
    if (is_wanted && (!best || lod > *best)) best = lod;
  }
  return best;
}

/// One level for the whole building. A part that lacks it has its own best; the building itself, which would enclose the parts
/// again, has none.
std::vector<std::optional<double>> chosen_lods(const LodsOfParts& lods_of_parts, PackedLod choice) {
  std::vector<std::optional<double>> chosen;
  for (const std::vector<double>& lods : lods_of_parts) chosen.push_back(best_of(lods, choice));
  const std::optional<double> level = *std::max_element(chosen.begin(), chosen.end());
  if (!level) return chosen;
  for (std::size_t part = 0; part < chosen.size(); ++part) {
    if (std::ranges::count(lods_of_parts[part], *level) > 0)
      chosen[part] = level;
    else if (part == 0)
      chosen[part].reset();
  }
  return chosen;
}

using PointRing = std::vector<Point3d>;
using PointRings = std::vector<PointRing>;

/// Twice the area of a ring, as a vector along its normal. It counts from the first point: far from the origin, the rounding of
/// the products would exceed the area.
Point3d double_area_of(const PointRing& ring) {
  Point3d sum{};
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) sum = sum + cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
  return sum;
}

/// The distinct corners in ascending order: two polygons with the same ones are one surface, whichever way they face.
std::vector<std::array<double, 3>> corners_of(const PointRings& rings) {
  // NaN has no place in an order
  const auto ordered = [](double x) { return std::isnan(x) ? std::numeric_limits<double>::infinity() : x + 0.0; };
  std::set<std::array<double, 3>> corners;
  for (const PointRing& ring : rings)
    for (const Point3d& p : ring) corners.insert({ordered(p.x), ordered(p.y), ordered(p.z)});
  return {corners.begin(), corners.end()};
}

/// Numbers the polygons of one building.
class BuildingNumbering {
 public:
  BuildingNumbering(const CityJsonFile& file, const FileFamily& family, std::vector<bool>& visited)
      : file_(file), family_(family), visited_(visited) {}

  FileBuilding building_of(std::size_t root, PackedLod lod) {
    building_.id = file_.objects()[root].id;
    gather(root);
    for (std::size_t k = 0; k < building_.objects.size(); ++k) add_shapes(k);
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
      building_.objects.push_back({&object, file_.contents_of(object)});
      places_.emplace_back(part, k == root ? FileRole::building : role);
      const std::set<std::size_t>& children = family_.children_of(k);
      for (auto child = children.rbegin(); child != children.rend(); ++child)
        if (role_of(file_.objects()[*child].type) != FileRole::none) waiting.emplace_back(*child, part);
    }
  }

  void add_shapes(std::size_t object) {
    for (const FileGeometry& geometry : building_.objects[object].contents.geometries) {
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
      if (decides(shape.role) && std::ranges::any_of(shape.geometry->polygons, is_usable))
        lods[shape.part].push_back(shape.geometry->lod);
    return lods;
  }

  /// Equal polygons of one geometry are kept. Those of two geometries are the same surface twice.
  void add_polygons(const FileShape& shape, bool is_alone) {
    std::vector<std::pair<std::vector<std::array<double, 3>>, std::uint32_t>> fresh;
    const std::size_t first_semantics = building_.semantics.size();
    if (!shape.instance)
      for (const SemanticSurface& surface : shape.geometry->semantics) building_.semantics.push_back(&surface);
    for (const FilePolygon& polygon : shape.geometry->polygons) {
      const std::optional<PointRings> rings = points_of(polygon, shape);
      if (!rings) continue;
      const auto corners = is_alone ? std::vector<std::array<double, 3>>() : corners_of(*rings);
      const auto seen = is_alone ? seen_.end() : seen_.find(corners);
      const std::uint32_t number = seen == seen_.end() ? next_number_++ : seen->second;
      if (!is_alone && seen == seen_.end()) fresh.emplace_back(corners, number);
      NumberedPolygon& added = building_.polygons.emplace_back(NumberedPolygon{number, shape.object, {}});
      if (polygon.semantics && !shape.instance) added.semantics = first_semantics + *polygon.semantics;
      measure(*rings, added);
    }
    seen_.insert(fresh.begin(), fresh.end());
  }

  static void measure(const PointRings& rings, NumberedPolygon& polygon) {
    Point3d sum{};
    for (const PointRing& ring : rings) sum = sum + double_area_of(ring);
    const double length = norm(sum);
    polygon.area = 0.5 * length;
    polygon.steepness = length > 0.0 ? std::abs(sum.z) / length : 0.0;
  }

  /// Empty where a ring names a vertex that is not there: such a polygon has no number.
  [[nodiscard]] std::optional<PointRings> points_of(const FilePolygon& polygon, const FileShape& shape) const {
    const std::vector<Point3d>& vertices = shape.instance ? file_.template_vertices() : file_.vertices();
    PointRings rings;
    for (const std::vector<std::int64_t>& rows : polygon.rings) {
      PointRing& ring = rings.emplace_back();
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

  const CityJsonFile& file_;
  const FileFamily& family_;
  std::vector<bool>& visited_;
  FileBuilding building_;
  std::vector<std::pair<std::size_t, FileRole>> places_;  ///< part and role of each object of the building
  std::vector<FileShape> shapes_;
  std::map<std::vector<std::array<double, 3>>, std::uint32_t> seen_;
  std::size_t parts_ = 0;
  std::uint32_t next_number_ = 0;
};

}  // namespace

void for_each_building(const CityJsonFile& file, PackedLod lod, const std::function<void(const FileBuilding&)>& on) {
  const std::vector<FileObject>& objects = file.objects();
  const FileFamily family(objects);
  std::vector<bool> visited(objects.size());
  // The first round begins at objects without parent. The objects that it leaves form circles of parents
  for (const bool is_first_round : {true, false})
    for (std::size_t k = 0; k < objects.size(); ++k)
      if (role_of(objects[k].type) != FileRole::none && !visited[k] && (!is_first_round || !family.has_parent(k)))
        on(BuildingNumbering(file, family, visited).building_of(k, lod));
}

}  // namespace farlod

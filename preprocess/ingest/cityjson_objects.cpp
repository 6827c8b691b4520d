// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/cityjson_objects.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <unordered_map>
#include <utility>

#include "ingest/seen_polygons.hpp"

namespace farlod {
namespace {

enum class ObjectRole { none, building, part, installation };

ObjectRole role_of(std::string_view type) {
  if (type == "Building" || type == "Bridge" || type == "OtherConstruction") return ObjectRole::building;
  if (type == "BuildingPart" || type == "BridgePart") return ObjectRole::part;
  for (const std::string_view name : {"BuildingInstallation", "BridgeInstallation", "BuildingConstructiveElement",
                                      "BridgeConstructiveElement", "BridgeConstructionElement"})
    if (type == name) return ObjectRole::installation;
  return ObjectRole::none;
}

bool has_surfaces(std::string_view type) {
  for (const std::string_view name : {"MultiSurface", "CompositeSurface", "Solid", "MultiSolid", "CompositeSolid"})
    if (type == name) return true;
  return false;
}

/// A geometry with its template looked up.
struct Shape {
  const CityJsonGeometry* geometry = nullptr;
  const CityJsonInstance* instance = nullptr;
  const CityJsonObject* object = nullptr;
  std::uint16_t part = 0;
  bool is_installation = false;  ///< a lone chimney decides no level of detail
};

bool is_usable(const CityJsonPolygon& polygon) {
  if (polygon.rings.empty()) return false;
  return std::set<std::int64_t>(polygon.rings[0].begin(), polygon.rings[0].end()).size() >= 3;
}

/// Who belongs to whom. Files say it in `children`, in `parents`, or in both.
class Family {
 public:
  explicit Family(const std::vector<CityJsonObject>& objects)
      : objects_(objects), children_(objects.size()), has_parent_(objects.size()) {
    for (std::size_t k = 0; k < objects.size(); ++k) row_of_.try_emplace(objects[k].id, k);
    for (std::size_t k = 0; k < objects.size(); ++k) {
      for (const std::string& child : objects[k].children) link(k, find(child));
      for (const std::string& parent : objects[k].parents)
        if (const auto row = find(parent)) link(*row, k);
    }
  }

  std::optional<std::size_t> find(const std::string& id) const {
    const auto found = row_of_.find(id);
    return found == row_of_.end() ? std::nullopt : std::optional(found->second);
  }
  const std::set<std::size_t>& children_of(std::size_t k) const { return children_[k]; }
  bool is_root(std::size_t k) const { return !has_parent_[k] && role_of(objects_[k].type) != ObjectRole::none; }

 private:
  void link(std::size_t parent, std::optional<std::size_t> child) {
    // Only what hides the sky can adopt: a building within a group is still a building
    if (!child || *child == parent || role_of(objects_[parent].type) == ObjectRole::none) return;
    children_[parent].insert(*child);
    has_parent_[*child] = true;
  }

  const std::vector<CityJsonObject>& objects_;
  std::unordered_map<std::string, std::size_t> row_of_;
  std::vector<std::set<std::size_t>> children_;
  std::vector<bool> has_parent_;
};

class BuildingWriter {
 public:
  BuildingWriter(const std::vector<CityJsonObject>& objects, const Family& family, const std::vector<Point3d>& vertices,
                 const CityJsonTemplates& templates, CityWriter& writer)
      : objects_(objects), family_(family), vertices_(vertices), templates_(templates), writer_(writer) {}

  void write(std::size_t root, LodChoice lod) {
    root_ = &objects_[root];
    writer_.begin_building(objects_[root].id);
    gather(root);
    const std::vector<std::vector<double>> lods = usable_lods();
    const std::vector<std::optional<double>> chosen = choose_lods(lods, lod);
    std::size_t others = 0;
    bool has_chosen = false;
    for (const Shape& shape : shapes_) {
      const bool is_chosen = chosen[shape.part] && *chosen[shape.part] == shape.geometry->lod;
      has_chosen |= is_chosen;
      if (is_chosen)
        write(shape);
      else
        others += shape.geometry->polygons.size();
    }
    if (has_chosen && others > 0) writer_.add_problem(ProblemCode::other_level_of_detail, unused_polygons(others, lods));
    writer_.end_building("no usable surface in the level of detail asked for; it has LoD " + list_lods(lods));
  }

 private:
  /// Depth first, with a list of its own: a file may nest its parts deeper than the program's stack is.
  void gather(std::size_t root) {
    std::vector<std::pair<std::size_t, std::uint16_t>> waiting{{root, 0}};
    while (!waiting.empty()) {
      const auto [k, part_of_parent] = waiting.back();
      waiting.pop_back();
      if (!visited_.insert(k).second) continue;
      const bool shares_part = k == root || role_of(objects_[k].type) == ObjectRole::installation;
      const std::uint16_t part = shares_part ? part_of_parent : next_part();
      gather_own(objects_[k], part);
      const std::set<std::size_t>& children = family_.children_of(k);
      for (auto child = children.rbegin(); child != children.rend(); ++child)
        if (role_of(objects_[*child].type) != ObjectRole::none) waiting.emplace_back(*child, part);
    }
  }

  void gather_own(const CityJsonObject& object, std::uint16_t part) {
    if (!object.malformed.empty()) writer_.add_problem(ProblemCode::malformed_feature, object.id + ": " + object.malformed);
    for (const CityJsonGeometry& geometry : object.geometries) add_shape(object, geometry, part);
    for (const std::vector<std::string>* relatives : {&object.parents, &object.children})
      for (const std::string& id : *relatives)
        if (!family_.find(id)) writer_.add_problem(ProblemCode::dangling_reference, object.id + " refers to " + id);
  }

  std::uint16_t next_part() {
    if (parts_ < std::numeric_limits<std::uint16_t>::max()) ++parts_;
    return parts_;
  }

  void add_shape(const CityJsonObject& object, const CityJsonGeometry& geometry, std::uint16_t part) {
    Shape shape{&geometry, nullptr, &object, part, &object != root_ && role_of(object.type) == ObjectRole::installation};
    if (geometry.instance) {
      if (geometry.instance->template_row >= templates_.geometries.size()) {
        writer_.add_problem(ProblemCode::dangling_reference,
                            "there is no template " + std::to_string(geometry.instance->template_row));
        return;
      }
      shape.instance = &*geometry.instance;
      shape.geometry = &templates_.geometries[geometry.instance->template_row];
    }
    if (has_surfaces(shape.geometry->type))
      shapes_.push_back(shape);
    else
      writer_.add_problem(ProblemCode::unsupported_geometry, "a " + shape.geometry->type + " is not read");
  }

  std::vector<std::vector<double>> usable_lods() const {
    std::vector<std::vector<double>> lods(static_cast<std::size_t>(parts_) + 1);
    for (const Shape& shape : shapes_) {
      const auto& polygons = shape.geometry->polygons;
      if (!shape.is_installation && std::any_of(polygons.begin(), polygons.end(), is_usable))
        lods[shape.part].push_back(shape.geometry->lod);
    }
    return lods;
  }

  void write(const Shape& shape) {
    // Within one geometry two equal polygons are the author's; over several they are one surface told twice
    std::vector<Rings> fresh;
    for (const CityJsonPolygon& polygon : shape.geometry->polygons) {
      std::optional<Rings> rings = points_of(polygon, shape);
      if (!rings || seen_.contains(*rings)) continue;
      fresh.push_back(*rings);
      if (shape.geometry->lod < 1.0)
        write_footprint(*rings, shape);
      else
        writer_.add_polygon(*rings, RingEnd::implied, {.kind = polygon.kind, .part = shape.part, .surface = {}, .name = {}});
    }
    for (const Rings& rings : fresh) (void)seen_.insert(rings);
  }

  std::optional<Rings> points_of(const CityJsonPolygon& polygon, const Shape& shape) {
    const std::vector<Point3d>& vertices = shape.instance ? templates_.vertices : vertices_;
    Rings rings;
    for (const std::vector<std::int64_t>& rows : polygon.rings) {
      Ring& ring = rings.emplace_back();
      for (const std::int64_t row : rows) {
        const std::optional<Point3d> p = vertex(vertices, row);
        const std::optional<Point3d> anchor = shape.instance ? vertex(vertices_, shape.instance->anchor) : Point3d{};
        if (!p || !anchor) {
          writer_.add_problem(ProblemCode::vertex_index_out_of_range,
                              "a ring names vertex " + std::to_string(p ? shape.instance->anchor : row) + " of " +
                                  std::to_string(p ? vertices_.size() : vertices.size()));
          return std::nullopt;
        }
        ring.push_back(shape.instance ? placed(*p, shape.instance->matrix) + *anchor : *p);
      }
    }
    return rings;
  }

  static std::optional<Point3d> vertex(const std::vector<Point3d>& vertices, std::int64_t row) {
    if (row < 0 || row >= static_cast<std::int64_t>(vertices.size())) return std::nullopt;
    return vertices[static_cast<std::size_t>(row)];
  }

  static Point3d placed(const Point3d& p, const std::array<double, 16>& m) {
    const auto row = [&](std::size_t r) { return m[r] * p.x + m[r + 1] * p.y + m[r + 2] * p.z + m[r + 3]; };
    const double w = row(12);
    return {row(0) / w, row(4) / w, row(8) / w};
  }

  /// LoD 0 has no volume: it is raised by the measured height.
  void write_footprint(Rings& rings, const Shape& shape) {
    const std::optional<double> height_m = shape.object->measured_height_m;
    const double base_m = rings.empty() || rings[0].empty() ? 0.0 : rings[0][0].z;
    if (!height_m)
      writer_.add_problem(ProblemCode::no_height, "LoD 0 needs the attribute measuredHeight", first_readable(rings));
    else if (!(*height_m > 0.0))
      writer_.add_problem(ProblemCode::height_not_positive, "measuredHeight is " + std::to_string(*height_m),
                          first_readable(rings));
    else
      writer_.add_prism(rings, RingEnd::implied, base_m, base_m + *height_m, shape.part);
  }

  const std::vector<CityJsonObject>& objects_;
  const Family& family_;
  const std::vector<Point3d>& vertices_;
  const CityJsonTemplates& templates_;
  CityWriter& writer_;
  const CityJsonObject* root_ = nullptr;
  std::set<std::size_t> visited_;
  std::vector<Shape> shapes_;
  SeenPolygons seen_;
  std::uint16_t parts_ = 0;
};

}  // namespace

void write_buildings(const std::vector<CityJsonObject>& objects, const std::vector<Point3d>& vertices,
                     const CityJsonTemplates& templates, LodChoice lod, CityWriter& writer) {
  const Family family(objects);
  for (std::size_t k = 0; k < objects.size(); ++k)
    if (family.is_root(k)) BuildingWriter(objects, family, vertices, templates, writer).write(k, lod);
}

}  // namespace farlod

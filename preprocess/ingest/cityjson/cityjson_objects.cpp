// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "farlod/error.hpp"
#include "ingest/cityjson/cityjson_reader.hpp"
#include "ingest/model_builder/ring_cleaning.hpp"

namespace farlod::ingest {
namespace {

enum class ObjectRole { none, building, part, installation, element, relief };

ObjectRole role_of(std::string_view type) {
  if (type == "TINRelief") return ObjectRole::relief;
  if (type == "OtherConstruction") return ObjectRole::building;
  for (const std::string_view kind : {"Building", "Bridge", "Tunnel"}) {
    if (!type.starts_with(kind)) continue;
    const std::string_view rest = type.substr(kind.size());
    if (rest.empty()) return ObjectRole::building;
    if (rest == "Part") return ObjectRole::part;
    if (rest == "Installation") return ObjectRole::installation;
    // CityJSON 1.0 says ConstructionElement
    if (rest == "ConstructiveElement" || rest == "ConstructionElement") return ObjectRole::element;
  }
  return ObjectRole::none;
}

bool hides_the_sky(const CityJsonObject& object) {
  const ObjectRole role = role_of(object.type);
  return role != ObjectRole::none && role != ObjectRole::relief;
}

/// The hierarchy of objects, which files give in `children`, in `parents`, or in both.
class CityJsonFamily {
 public:
  explicit CityJsonFamily(const std::vector<CityJsonObject>& objects)
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
  bool has_parent(std::size_t k) const { return has_parent_[k]; }

 private:
  void link(std::size_t parent, std::optional<std::size_t> child) {
    // Only objects that hide the sky are parents here: a building in a CityObjectGroup has no parent
    if (!child || *child == parent || !hides_the_sky(objects_[parent])) return;
    children_[parent].insert(*child);
    has_parent_[*child] = true;
  }

  const std::vector<CityJsonObject>& objects_;
  std::unordered_map<std::string, std::size_t> row_of_;
  std::vector<std::set<std::size_t>> children_;
  std::vector<bool> has_parent_;
};

/// More than the prefabricated buildings of a whole city have. Most templates are lamps and trees.
constexpr std::uint64_t most_template_corners = 10'000'000;
/// A polygon has a piece more for itself and one for each ring. Of thousands of instances, each is gone through before it is
/// known which level of detail counts, and polygons without corners are gone through, too.
constexpr std::uint64_t most_template_pieces = 3 * most_template_corners;

std::uint64_t pieces_of(const CityJsonGeometry& geometry) {
  std::uint64_t pieces = 1;
  for (const CityJsonPolygon& polygon : geometry.polygons) {
    pieces += 1 + polygon.rings.size();
    for (const auto& ring : polygon.rings) pieces += ring.size();
  }
  return pieces;
}

/// A geometry, or an instance with the geometry of its template.
struct Shape {
  const CityJsonGeometry* geometry = nullptr;
  const CityJsonInstance* instance = nullptr;
  const CityJsonObject* object = nullptr;
  std::uint32_t object_row = 0;  ///< in PlacesOfBuilding
  std::uint16_t part = 0;
  ObjectRole role = ObjectRole::building;  ///< decides whether it makes its level of detail eligible
};

/// A polygon of an earlier geometry, and the surface that it is; none where it cannot be used, or became a prism.
struct EarlierPolygon {
  Rings rings;
  std::optional<std::uint32_t> surface;
};

bool is_polygon(const CityJsonPolygon& polygon) {
  if (polygon.rings.empty()) return false;
  return std::set<std::int64_t>(polygon.rings[0].begin(), polygon.rings[0].end()).size() >= 3;
}

class CityJsonAssembler {
 public:
  CityJsonAssembler(const std::vector<CityJsonObject>& objects, const CityJsonFamily& family,
                    const std::vector<Point3d>& vertices, const CityJsonTemplates& templates, std::vector<bool>& visited,
                    CityModelBuilder& builder, ObjectAccount& account)
      : objects_(objects),
        family_(family),
        vertices_(vertices),
        templates_(templates),
        visited_(visited),
        builder_(builder),
        account_(account) {}

  void add(std::size_t root, LodChoice lod) {
    root_ = &objects_[root];
    builder_.begin_building(objects_[root].id);
    gather(root);
    const std::vector<std::vector<double>> lods = usable_lods();
    const std::vector<std::optional<double>> chosen = choose_lods(lods, lod);
    std::vector<const Shape*> wanted;
    std::size_t others = 0;
    for (const Shape& shape : shapes_) {
      const bool is_chosen = chosen[shape.part] && *chosen[shape.part] == shape.geometry->lod;
      if (is_chosen) wanted.push_back(&shape);
      others += is_chosen ? 0 : shape.geometry->polygons.size();
    }
    for (const Shape* shape : wanted) add(*shape, wanted.size() == 1);
    if (!wanted.empty() && others > 0) builder_.add_problem(ProblemCode::other_level_of_detail, unused_polygons(others, lods));
    builder_.end_building("no usable surface in the level of detail asked for; it has LoD " + list_lods(lods),
                          root_->places ? &places_ : nullptr);
  }

 private:
  /// Visits the parts depth first, with a list instead of recursion: a file may nest them deeper than the stack of the program.
  void gather(std::size_t root) {
    std::vector<std::pair<std::size_t, std::uint16_t>> waiting{{root, 0}};
    while (!waiting.empty()) {
      const auto [k, part_of_parent] = waiting.back();
      waiting.pop_back();
      if (visited_[k]) continue;
      visited_[k] = true;
      const ObjectRole role = role_of(objects_[k].type);
      const bool shares_part = k == root || role == ObjectRole::installation || role == ObjectRole::element;
      if (!shares_part && parts_ < std::numeric_limits<std::uint16_t>::max()) ++parts_;
      const std::uint16_t part = shares_part ? part_of_parent : parts_;
      gather_own(objects_[k], part);
      const std::set<std::size_t>& children = family_.children_of(k);
      for (auto child = children.rbegin(); child != children.rend(); ++child)
        if (hides_the_sky(objects_[*child])) waiting.emplace_back(*child, part);
    }
  }

  void gather_own(const CityJsonObject& object, std::uint16_t part) {
    places_.objects.push_back(object.places ? object.places->object : package::AttributePlace());
    if (!object.malformed.empty()) builder_.add_problem(ProblemCode::malformed_feature, object.id + ": " + object.malformed);
    for (const CityJsonGeometry& geometry : object.geometries) add_shape(object, geometry, part);
    for (const std::vector<std::string>* relatives : {&object.parents, &object.children})
      for (const std::string& id : *relatives)
        if (!family_.find(id)) builder_.add_problem(ProblemCode::dangling_reference, object.id + " refers to " + id);
  }

  void add_shape(const CityJsonObject& object, const CityJsonGeometry& geometry, std::uint16_t part) {
    const auto row = static_cast<std::uint32_t>(places_.objects.size() - 1);
    Shape shape{&geometry, nullptr, &object, row, part, &object == root_ ? ObjectRole::building : role_of(object.type)};
    if (geometry.instance) {
      if (geometry.instance->template_row >= templates_.geometries.size()) {
        builder_.add_problem(ProblemCode::dangling_reference,
                             "there is no template " + std::to_string(geometry.instance->template_row));
        return;
      }
      shape.instance = &*geometry.instance;
      shape.geometry = &templates_.geometries[geometry.instance->template_row];
      account_.template_pieces += pieces_of(*shape.geometry);
      if (account_.template_pieces > most_template_pieces) refuse_unfolding();
    }
    if (nesting_of(shape.geometry->type))
      shapes_.push_back(shape);
    else
      builder_.add_problem(ProblemCode::unsupported_geometry, "a " + shape.geometry->type + " is not read");
  }

  /// Constructive elements make a level of detail eligible only where there is nothing else, as in some bridges.
  std::vector<std::vector<double>> usable_lods() const {
    const auto lods = lods_of([](ObjectRole role) { return role == ObjectRole::building || role == ObjectRole::part; });
    const bool has_any = std::any_of(lods.begin(), lods.end(), [](const auto& of_part) { return !of_part.empty(); });
    return has_any ? lods : lods_of([](ObjectRole role) { return role == ObjectRole::element; });
  }

  template <class Decides>
  std::vector<std::vector<double>> lods_of(const Decides& decides) const {
    std::vector<std::vector<double>> lods(static_cast<std::size_t>(parts_) + 1);
    for (const Shape& shape : shapes_) {
      const auto& polygons = shape.geometry->polygons;
      if (decides(shape.role) && std::any_of(polygons.begin(), polygons.end(), is_polygon))
        lods[shape.part].push_back(shape.geometry->lod);
    }
    return lods;
  }

  void add(const Shape& shape, bool is_alone) {
    // Equal polygons of one geometry are kept. Those of two geometries are the same surface twice
    std::vector<EarlierPolygon> fresh;
    const std::uint32_t first_semantics = begin_semantics(shape);
    for (const CityJsonPolygon& polygon : shape.geometry->polygons) {
      std::optional<Rings> rings = points_of(polygon, shape);
      if (!rings) continue;
      const PolygonOrigin origin = origin_of(polygon, shape, first_semantics);
      if (const EarlierPolygon* seen = is_alone ? nullptr : find_seen(*rings)) {
        if (seen->surface) builder_.add_origin(*seen->surface, origin);
        continue;
      }
      if (!is_alone) fresh.push_back({*rings, {}});
      const std::optional<std::uint32_t> surface = add_polygon(*rings, polygon, shape, origin);
      if (!is_alone) fresh.back().surface = surface;
    }
    for (EarlierPolygon& polygon : fresh) note_seen(std::move(polygon));
  }

  /// What many objects share, a template, has no id that tells them apart.
  std::optional<std::uint32_t> add_polygon(Rings& rings, const CityJsonPolygon& polygon, const Shape& shape,
                                           PolygonOrigin origin) {
    if (shape.geometry->lod < 1.0) return add_footprint(rings, shape), std::nullopt;
    const std::string id = shape.instance ? std::string() : surface_id(*shape.object, *shape.geometry, polygon);
    const PolygonTraits traits{.kind = polygon.kind, .part = shape.part, .surface = {}, .name = {}, .origin = origin, .id = id};
    return builder_.add_polygon(rings, RingEnd::implied, traits);
  }

  /// Adds the semantic surfaces of a geometry to those of the building. Returns the row of the first.
  std::uint32_t begin_semantics(const Shape& shape) {
    const auto first = static_cast<std::uint32_t>(places_.semantics.size());
    if (shape.instance || !shape.object->places) return first;
    const auto geometry = static_cast<std::size_t>(shape.geometry - shape.object->geometries.data());
    const std::vector<std::vector<package::AttributePlace>>& by_geometry = shape.object->places->semantics;
    // A list that is written as an object has no places
    if (geometry < by_geometry.size())
      places_.semantics.insert(places_.semantics.end(), by_geometry[geometry].begin(), by_geometry[geometry].end());
    return first;
  }

  /// Many objects share the semantic surfaces of a template.
  [[nodiscard]] PolygonOrigin origin_of(const CityJsonPolygon& polygon, const Shape& shape, std::uint32_t first_semantics) const {
    PolygonOrigin origin{shape.object_row, {}};
    if (!polygon.semantics || shape.instance) return origin;
    if (const std::uint32_t row = first_semantics + *polygon.semantics; row < places_.semantics.size()) origin.semantics = row;
    return origin;
  }

  [[nodiscard]] std::vector<std::span<const Point3d>> seen_at(std::uint64_t number) const {
    return spans_of(earlier_[number].rings);
  }

  [[nodiscard]] const EarlierPolygon* find_seen(const Rings& rings) const {
    const auto number = seen_.find(rings, 0, [this](std::uint64_t n) { return seen_at(n); });
    return number ? &earlier_[*number] : nullptr;
  }

  void note_seen(EarlierPolygon&& polygon) {
    if (!seen_.find_or_insert(polygon.rings, 0, earlier_.size(), [this](std::uint64_t n) { return seen_at(n); }))
      earlier_.push_back(std::move(polygon));
  }

  std::optional<Rings> points_of(const CityJsonPolygon& polygon, const Shape& shape) {
    const std::vector<Point3d>& vertices = shape.instance ? templates_.vertices : vertices_;
    Rings rings;
    for (const std::vector<std::int64_t>& rows : polygon.rings) {
      if (shape.instance) count_unfolded(rows.size());
      Ring& ring = rings.emplace_back();
      for (const std::int64_t row : rows) {
        const std::optional<Point3d> p = vertex(vertices, row);
        const std::optional<Point3d> anchor = shape.instance ? vertex(vertices_, shape.instance->anchor) : Point3d{};
        if (!p || !anchor) {
          builder_.add_problem(ProblemCode::vertex_index_out_of_range,
                               "a ring names vertex " + std::to_string(p ? shape.instance->anchor : row) + " of " +
                                   std::to_string(p ? vertices_.size() : vertices.size()));
          return std::nullopt;
        }
        ring.push_back(shape.instance ? placed(*p, shape.instance->matrix) + *anchor : *p);
      }
    }
    return rings;
  }

  /// Counts the corners that instances of templates add, which could otherwise fill the memory from a small file.
  void count_unfolded(std::size_t corners) {
    account_.template_corners += corners;
    if (account_.template_corners > most_template_corners) refuse_unfolding();
  }

  [[noreturn]] void refuse_unfolding() const {
    throw InputError(builder_.source() + ": its geometry templates unfold to more than " + std::to_string(most_template_corners) +
                     " corners of buildings. Split it into tiles.");
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

  /// LoD 0 has no volume. The footprint becomes a prism of the measured height.
  void add_footprint(Rings& rings, const Shape& shape) {
    const std::optional<double> height_m = shape.object->measured_height_m;
    const double base_m = rings.empty() || rings[0].empty() ? 0.0 : rings[0][0].z;
    if (!height_m)
      builder_.add_problem(ProblemCode::no_height, "LoD 0 needs the attribute measuredHeight", first_readable(rings));
    else if (!(*height_m > 0.0))
      builder_.add_problem(ProblemCode::height_not_positive, "measuredHeight is " + std::to_string(*height_m),
                           first_readable(rings));
    else
      builder_.add_prism(rings, RingEnd::implied, base_m, base_m + *height_m, shape.part, shape.object_row);
  }

  const std::vector<CityJsonObject>& objects_;
  const CityJsonFamily& family_;
  const std::vector<Point3d>& vertices_;
  const CityJsonTemplates& templates_;
  std::vector<bool>& visited_;
  CityModelBuilder& builder_;
  ObjectAccount& account_;
  const CityJsonObject* root_ = nullptr;
  std::vector<Shape> shapes_;
  PolygonDeduplicator seen_{SamePolygon::corners};
  std::vector<EarlierPolygon> earlier_;  ///< by their numbers in `seen_`
  PlacesOfBuilding places_;
  std::uint16_t parts_ = 0;
};

/// Collects the corners of the triangles of a terrain. Triangles share corners; each vertex of the file is collected once.
class ReliefCollector {
 public:
  ReliefCollector(const std::vector<Point3d>& vertices, CityModelBuilder& builder, std::vector<Point3d>& points)
      : vertices_(vertices), is_taken_(vertices.size()), builder_(builder), points_(points) {}

  void add(const CityJsonObject& relief) {
    if (!relief.malformed.empty()) builder_.add_problem_at(relief.id, ProblemCode::malformed_feature, relief.malformed);
    double best = -1.0;
    for (const CityJsonGeometry& geometry : relief.geometries) best = std::max(best, geometry.lod);
    std::size_t unknown = 0;
    for (const CityJsonGeometry& geometry : relief.geometries)
      if (geometry.lod == best)
        for (const CityJsonPolygon& polygon : geometry.polygons)
          for (const auto& ring : polygon.rings)
            for (const std::int64_t row : ring) unknown += take(row) ? 0 : 1;
    if (unknown > 0)
      builder_.add_problem_at(relief.id, ProblemCode::vertex_index_out_of_range,
                              std::to_string(unknown) + " corners of its triangles are not among the " +
                                  std::to_string(vertices_.size()) + " vertices, or not numbers");
  }

 private:
  bool take(std::int64_t row) {
    const auto k = static_cast<std::size_t>(row);
    if (row < 0 || k >= vertices_.size() || !is_readable(vertices_[k])) return false;
    if (!is_taken_[k]) points_.push_back(vertices_[k]);
    is_taken_[k] = true;
    return true;
  }

  const std::vector<Point3d>& vertices_;
  std::vector<bool> is_taken_;
  CityModelBuilder& builder_;
  std::vector<Point3d>& points_;
};

}  // namespace

void add_objects(const std::vector<CityJsonObject>& objects, const std::vector<Point3d>& vertices,
                 const CityJsonTemplates& templates, LodChoice lod, CityModelBuilder& builder, ObjectAccount& account) {
  const CityJsonFamily family(objects);
  std::vector<bool> visited(objects.size());
  // The first round begins at objects without parent. The objects that it leaves form circles of parents
  for (const bool is_first_round : {true, false})
    for (std::size_t k = 0; k < objects.size(); ++k)
      if (hides_the_sky(objects[k]) && !visited[k] && (!is_first_round || !family.has_parent(k)))
        CityJsonAssembler(objects, family, vertices, templates, visited, builder, account).add(k, lod);
  ReliefCollector relief(vertices, builder, account.relief_points);
  for (const CityJsonObject& object : objects) {
    if (role_of(object.type) == ObjectRole::relief) relief.add(object);
    if (role_of(object.type) == ObjectRole::none) ++account.skipped[object.type.empty() ? "objects without a type" : object.type];
  }
}

}  // namespace farlod::ingest

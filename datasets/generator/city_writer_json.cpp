// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <iterator>
#include <span>

#include "generator/city_writer.hpp"

namespace farlod {
namespace {

/// CityJSON has one array of vertices after all objects. The vertices are collected in a temporary file until then.
class CityJsonWriter final : public GeneratedCityWriter {
 public:
  CityJsonWriter(const std::filesystem::path& path, const CityHeader& header)
      : header_(header), objects_(path), vertices_(path.string() + ".vertices") {}

  void begin() override {
    // Vertices are whole millimetres from the centre of the city
    fmt::format_to(out(),
                   "{{\"type\":\"CityJSON\",\"version\":\"2.0\",\n\"transform\":{{\"scale\":[0.001,0.001,0.001],\"translate\":[");
    append_metres(objects_.text(), header_.centre_easting_mm);
    objects_.text() += ',';
    append_metres(objects_.text(), header_.centre_northing_mm);
    fmt::format_to(
        out(),
        ",0.0]}},\n\"metadata\":{{\"title\":\"{}\",\"referenceSystem\":\"https://www.opengis.net/def/crs/EPSG/0/{}\"}},\n"
        "\"CityObjects\":{{",
        header_.name, header_.epsg);
  }

  void add(const GeneratedBuilding& building) override {
    const bool has_body = building.components.front().kind == ComponentKind::body;
    begin_object("Building", building.id, building.top_mm - building.base_mm);
    fmt::format_to(out(), FMT_STRING(",\"storeysAboveGround\":{}}}"), building.storeys);
    if (has_body) add_geometry(building, building.components.front());
    add_children(building);
    objects_.text() += '}';
    for (const GeneratedComponent& c : building.components) {
      if (c.kind == ComponentKind::body) continue;
      begin_object(c.kind == ComponentKind::part ? "BuildingPart" : "BuildingInstallation", c.id, c.top_mm - c.base_mm);
      fmt::format_to(out(), FMT_STRING("}},\"parents\":[\"{}\"]"), building.id);
      add_geometry(building, c);
      objects_.text() += '}';
    }
    add_vertices(building);
    objects_.drain();
    vertices_.drain();
  }

  std::uint64_t end() override {
    objects_.text() += "\n},\n\"vertices\":[";
    objects_.append(vertices_);
    objects_.text() += "\n]}\n";
    return objects_.commit();
  }

 private:
  [[nodiscard]] std::back_insert_iterator<std::string> out() { return std::back_inserter(objects_.text()); }

  /// Writes an object up to its first attribute.
  void begin_object(std::string_view type, const std::string& id, std::int64_t height_mm) {
    fmt::format_to(out(), FMT_STRING("{}\n\"{}\":{{\"type\":\"{}\",\"attributes\":{{\"measuredHeight\":"), is_first_ ? "" : ",",
                   id, type);
    is_first_ = false;
    append_metres(objects_.text(), height_mm);
  }

  void add_children(const GeneratedBuilding& building) {
    const std::size_t bodies = building.components.front().kind == ComponentKind::body ? 1 : 0;
    if (building.components.size() == bodies) return;
    for (std::size_t k = bodies; k < building.components.size(); ++k)
      fmt::format_to(out(), FMT_STRING("{}\"{}\""), k == bodies ? ",\"children\":[" : ",", building.components[k].id);
    objects_.text() += ']';
  }

  /// A shell that is not closed is a MultiSurface, whose boundaries are nested one level less than those of a Solid.
  void add_geometry(const GeneratedBuilding& building, const GeneratedComponent& component) {
    fmt::format_to(out(), FMT_STRING(",\"geometry\":[{{\"type\":\"{}\",\"lod\":\"{}\",\"boundaries\":{}"),
                   component.closed ? "Solid" : "MultiSurface", header_.lod, component.closed ? "[[" : "[");
    add_boundaries(facets_of(building, component));
    objects_.text() += component.closed ? "]]" : "]";
    if (header_.lod >= 2) add_semantics(facets_of(building, component), component.closed);
    objects_.text() += "}]";
  }

  [[nodiscard]] static std::span<const GeneratedFacet> facets_of(const GeneratedBuilding& building, const GeneratedComponent& c) {
    return std::span(building.facets).subspan(c.first_facet, c.facet_count);
  }

  void add_boundaries(std::span<const GeneratedFacet> facets) {
    for (const GeneratedFacet& facet : facets) {
      objects_.text() += &facet == facets.data() ? "[" : ",[";
      add_ring(facet.outer);
      if (!facet.hole.empty()) add_inner_ring(facet.hole);
      for (const std::vector<std::uint32_t>& opening : facet.openings) add_inner_ring(opening);
      objects_.text() += ']';
    }
  }

  void add_inner_ring(const std::vector<std::uint32_t>& ring) {
    objects_.text() += ',';
    add_ring(ring);
  }

  void add_ring(const std::vector<std::uint32_t>& ring) {
    for (std::size_t k = 0; k < ring.size(); ++k)
      fmt::format_to(out(), FMT_STRING("{}{}"), k == 0 ? '[' : ',', vertices_before_ + ring[k]);
    objects_.text() += ']';
  }

  /// One entry for each role, in LoD3 also for windows and doors, and for each facet the number of its entry.
  void add_semantics(std::span<const GeneratedFacet> facets, bool closed) {
    constexpr std::array roles{FacetRole::roof, FacetRole::wall, FacetRole::ground, FacetRole::outer_ceiling};
    objects_.text() += R"(,"semantics":{"surfaces":[)";
    for (const FacetRole role : roles)
      fmt::format_to(out(), FMT_STRING("{}{{\"type\":\"{}\"}}"), role == roles.front() ? "" : ",", surface_name_of(role));
    if (header_.lod >= 3) objects_.text() += R"(,{"type":"Window"},{"type":"Door"})";
    objects_.text() += closed ? "],\"values\":[" : "],\"values\":";
    for (const GeneratedFacet& facet : facets)
      fmt::format_to(out(), FMT_STRING("{}{}"), &facet == facets.data() ? '[' : ',', semantic_number(facet));
    objects_.text() += closed ? "]]}" : "]}";
  }

  [[nodiscard]] static int semantic_number(const GeneratedFacet& facet) {
    if (facet.filling == Filling::none) return static_cast<int>(facet.role);
    return facet.filling == Filling::window ? 4 : 5;
  }

  void add_vertices(const GeneratedBuilding& building) {
    for (const PointMm& p : building.vertices) {
      fmt::format_to(std::back_inserter(vertices_.text()), FMT_STRING("{}[{},{},{}]"), vertices_before_ == 0 ? "\n" : ",\n", p.x,
                     p.y, p.z);
      ++vertices_before_;
    }
  }

  CityHeader header_;
  CityTextFile objects_, vertices_;
  std::uint64_t vertices_before_ = 0;
  bool is_first_ = true;
};

}  // namespace

std::unique_ptr<GeneratedCityWriter> make_cityjson_writer(const std::filesystem::path& path, const CityHeader& header) {
  return std::make_unique<CityJsonWriter>(path, header);
}

namespace {

class GeoJsonWriter final : public GeneratedCityWriter {
 public:
  GeoJsonWriter(const std::filesystem::path& path, const CityHeader& header) : header_(header), file_(path) {}

  void begin() override {
    // RFC 7946 removed the member `crs`. Projected coordinates need it, and GDAL reads it
    fmt::format_to(std::back_inserter(file_.text()),
                   R"({{"type":"FeatureCollection","name":"{}",)"
                   "\n"
                   R"("crs":{{"type":"name","properties":{{"name":"urn:ogc:def:crs:EPSG::{}"}}}},)"
                   "\n\"features\":[",
                   header_.name, header_.epsg);
  }

  void add(const GeneratedBuilding& building) override {
    for (const GeneratedComponent& component : building.components)
      if (component.kind != ComponentKind::installation) add_feature(component);
    file_.drain();
  }

  std::uint64_t end() override {
    file_.text() += "\n]}\n";
    return file_.commit();
  }

 private:
  void add_feature(const GeneratedComponent& component) {
    std::string& text = file_.text();
    text += first_ ? "\n" : ",\n";
    first_ = false;
    fmt::format_to(std::back_inserter(text), R"({{"type":"Feature","properties":{{"id":"{}","height":)", component.id);
    append_metres(text, component.top_mm - component.base_mm);
    text += R"(,"base":)";
    append_metres(text, component.base_mm);
    text += R"(},"geometry":{"type":"Polygon","coordinates":[)";
    add_ring(component.footprint);
    if (!component.footprint_hole.empty()) {
      text += ',';
      add_ring(component.footprint_hole);
    }
    text += "]}}";
  }

  void add_ring(const std::vector<PlanPointMm>& ring) {
    std::string& text = file_.text();
    // A ring of GeoJSON repeats its first point at the end
    for (std::size_t k = 0; k <= ring.size(); ++k) {
      text += k == 0 ? "[[" : ",[";
      append_metres(text, header_.centre_easting_mm + ring[k % ring.size()][0]);
      text += ',';
      append_metres(text, header_.centre_northing_mm + ring[k % ring.size()][1]);
      text += ']';
    }
    text += ']';
  }

  CityHeader header_;
  CityTextFile file_;
  bool first_ = true;
};

}  // namespace

std::unique_ptr<GeneratedCityWriter> make_geojson_writer(const std::filesystem::path& path, const CityHeader& header) {
  return std::make_unique<GeoJsonWriter>(path, header);
}

}  // namespace farlod

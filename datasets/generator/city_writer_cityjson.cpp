// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <iterator>

#include "generator/city_text_file.hpp"
#include "generator/city_writer.hpp"

namespace farlod {
namespace {

[[nodiscard]] std::string_view surface_type(FacetRole role) {
  switch (role) {
    case FacetRole::roof:
      return "RoofSurface";
    case FacetRole::wall:
      return "WallSurface";
    case FacetRole::ground:
      return "GroundSurface";
    case FacetRole::outer_ceiling:
      break;
  }
  return "OuterCeilingSurface";
}

/// The vertices of CityJSON are one array for the whole file. They wait in a file of their own until all objects are written.
class CityJsonWriter final : public GeneratedCityWriter {
 public:
  CityJsonWriter(const std::filesystem::path& path, const CityHeader& header)
      : header_(header), objects_(path), vertices_(path.string() + ".vertices") {}

  void begin() override {
    // Vertices are written as whole millimetres from the city's centre
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
    fmt::format_to(out(), FMT_STRING("{}\n\"{}\":{{\"type\":\"Building\",\"attributes\":{{\"measuredHeight\":"),
                   vertices_before_ == 0 ? "" : ",", building.id);
    append_metres(objects_.text(), building.top_mm - building.base_mm);
    fmt::format_to(out(),
                   FMT_STRING(",\"storeysAboveGround\":{}}},\"geometry\":[{{\"type\":\"Solid\",\"lod\":\"{}\",\"boundaries\":[["),
                   building.storeys, header_.lod);
    add_boundaries(building);
    objects_.text() += "]]";
    if (header_.lod >= 2) add_semantics(building);
    objects_.text() += "}]}";
    add_vertices(building);
    objects_.drain();
    vertices_.drain();
  }

  void end() override {
    objects_.text() += "\n},\n\"vertices\":[";
    objects_.append(vertices_);
    objects_.text() += "\n]}\n";
    objects_.commit();
  }

 private:
  [[nodiscard]] std::back_insert_iterator<std::string> out() { return std::back_inserter(objects_.text()); }

  void add_boundaries(const GeneratedBuilding& building) {
    for (const GeneratedFacet& facet : building.facets) {
      objects_.text() += &facet == &building.facets.front() ? "[" : ",[";
      add_ring(facet.outer);
      if (!facet.hole.empty()) {
        objects_.text() += ',';
        add_ring(facet.hole);
      }
      objects_.text() += ']';
    }
  }

  void add_ring(const std::vector<std::uint32_t>& ring) {
    for (std::size_t k = 0; k < ring.size(); ++k)
      fmt::format_to(out(), FMT_STRING("{}{}"), k == 0 ? '[' : ',', vertices_before_ + ring[k]);
    objects_.text() += ']';
  }

  /// One entry for each role, and for each facet the number of its role.
  void add_semantics(const GeneratedBuilding& building) {
    constexpr std::array roles{FacetRole::roof, FacetRole::wall, FacetRole::ground, FacetRole::outer_ceiling};
    objects_.text() += ",\"semantics\":{\"surfaces\":[";
    for (const FacetRole role : roles)
      fmt::format_to(out(), FMT_STRING("{}{{\"type\":\"{}\"}}"), role == roles.front() ? "" : ",", surface_type(role));
    objects_.text() += "],\"values\":[";
    for (const GeneratedFacet& facet : building.facets)
      fmt::format_to(out(), FMT_STRING("{}{}"), &facet == &building.facets.front() ? '[' : ',', static_cast<int>(facet.role));
    objects_.text() += "]]}";
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
};

}  // namespace

std::unique_ptr<GeneratedCityWriter> make_cityjson_writer(const std::filesystem::path& path, const CityHeader& header) {
  return std::make_unique<CityJsonWriter>(path, header);
}

}  // namespace farlod

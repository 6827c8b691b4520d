// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "farlod/point.hpp"
#include "generator/city_writer.hpp"

namespace farlod {
namespace {

constexpr std::string_view prologue = R"(<?xml version="1.0" encoding="UTF-8"?>
<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:bldg="http://www.opengis.net/citygml/building/2.0" xmlns:gml="http://www.opengis.net/gml" xmlns:xlink="http://www.w3.org/1999/xlink" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:schemaLocation="http://www.opengis.net/citygml/building/2.0 http://schemas.opengis.net/citygml/building/2.0/building.xsd">
)";

/// An upright box of space. Starts empty (low > high), and grows.
struct Box3d {
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  Point3d low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};

  [[nodiscard]] bool empty() const { return !(low.x <= high.x && low.y <= high.y && low.z <= high.z); }
  void add(const Point3d& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
};

class CityGmlWriter final : public GeneratedCityWriter {
 public:
  CityGmlWriter(const std::filesystem::path& path, const CityHeader& header) : header_(header), file_(path) {}

  void begin() override {
    file_.text() += prologue;
    fmt::format_to(out(), "<gml:name>{}</gml:name>\n", header_.name);
    // The envelope is known at the end. Blanks reserve its place
    envelope_at_ = file_.position();
    file_.text().append(envelope().size(), ' ');
    file_.text() += '\n';
  }

  void add(const GeneratedBuilding& building) override {
    file_.text() += "<core:cityObjectMember>";
    begin_building("Building", building.id, building.top_mm - building.base_mm);
    fmt::format_to(out(), FMT_STRING("<bldg:storeysAboveGround>{}</bldg:storeysAboveGround>\n"), building.storeys);
    if (building.components.front().kind == ComponentKind::body) add_body(building, building.components.front());
    add_parts(building);
    file_.text() += "</bldg:Building></core:cityObjectMember>\n";
    for (const PointMm& p : building.vertices)
      extent_.add({static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
    file_.drain();
  }

  std::uint64_t end() override {
    file_.text() += "</core:CityModel>\n";
    file_.overwrite(envelope_at_, envelope());
    return file_.commit();
  }

 private:
  [[nodiscard]] std::back_insert_iterator<std::string> out() { return std::back_inserter(file_.text()); }

  void begin_building(std::string_view element, const std::string& id, std::int64_t height_mm) {
    fmt::format_to(out(), FMT_STRING("<bldg:{} gml:id=\"{}\">\n<bldg:measuredHeight uom=\"m\">"), element, id);
    append_metres(file_.text(), height_mm);
    file_.text() += "</bldg:measuredHeight>";
  }

  void add_parts(const GeneratedBuilding& building) {
    for (const GeneratedComponent& part : building.components) {
      if (part.kind != ComponentKind::part) continue;
      file_.text() += "<bldg:consistsOfBuildingPart>";
      begin_building("BuildingPart", part.id, part.top_mm - part.base_mm);
      file_.text() += '\n';
      add_body(building, part);
      file_.text() += "</bldg:BuildingPart></bldg:consistsOfBuildingPart>\n";
    }
  }

  /// In the order of the schema: solids of LoD1 and 2, installations, surfaces, solids of LoD3.
  void add_body(const GeneratedBuilding& building, const GeneratedComponent& body) {
    if (header_.lod == 1) return add_lod1(building, body);
    if (header_.lod == 2 && body.closed) add_solid_of_surfaces(body);
    if (body.kind == ComponentKind::body) add_installations(building);
    for (std::size_t k = 0; k < body.facet_count; ++k) add_surface(building, body, k);
    if (header_.lod == 3 && body.closed) add_solid_of_surfaces(body);
  }

  void add_lod1(const GeneratedBuilding& building, const GeneratedComponent& body) {
    if (body.closed) {
      file_.text() += "<bldg:lod1Solid><gml:Solid><gml:exterior><gml:CompositeSurface>\n";
      add_polygons(building, body);
      file_.text() += "</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod1Solid>\n";
    } else {
      file_.text() += "<bldg:lod1MultiSurface><gml:MultiSurface>\n";
      add_polygons(building, body);
      file_.text() += "</gml:MultiSurface></bldg:lod1MultiSurface>\n";
    }
  }

  void add_polygons(const GeneratedBuilding& building, const GeneratedComponent& component) {
    for (std::size_t k = 0; k < component.facet_count; ++k) {
      file_.text() += "<gml:surfaceMember><gml:Polygon>";
      add_rings(building.facets[component.first_facet + k], building.vertices);
      file_.text() += "</gml:Polygon></gml:surfaceMember>\n";
    }
  }

  /// Writes a solid of references to the polygons of the surfaces. In the file, those of LoD2 follow it and those of LoD3 precede
  /// it.
  void add_solid_of_surfaces(const GeneratedComponent& body) {
    fmt::format_to(out(), FMT_STRING("<bldg:lod{}Solid><gml:Solid><gml:exterior><gml:CompositeSurface>\n"), header_.lod);
    for (std::size_t k = 0; k < body.facet_count; ++k)
      fmt::format_to(out(), FMT_STRING("<gml:surfaceMember xlink:href=\"#{}_p{}\"/>\n"), body.id, k);
    fmt::format_to(out(), FMT_STRING("</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod{}Solid>\n"), header_.lod);
  }

  void add_installations(const GeneratedBuilding& building) {
    for (const GeneratedComponent& c : building.components) {
      if (c.kind != ComponentKind::installation) continue;
      fmt::format_to(out(),
                     FMT_STRING("<bldg:outerBuildingInstallation><bldg:BuildingInstallation gml:id=\"{}\"><bldg:lod{}Geometry>"
                                "<gml:Solid><gml:exterior><gml:CompositeSurface>\n"),
                     c.id, header_.lod);
      add_polygons(building, c);
      fmt::format_to(out(),
                     FMT_STRING("</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod{}Geometry>"
                                "</bldg:BuildingInstallation></bldg:outerBuildingInstallation>\n"),
                     header_.lod);
    }
  }

  void add_surface(const GeneratedBuilding& building, const GeneratedComponent& body, std::size_t k) {
    const GeneratedFacet& facet = building.facets[body.first_facet + k];
    if (facet.filling != Filling::none) return;  // written inside of its wall
    const std::string_view element = surface_name_of(facet.role);
    file_.text() += "<bldg:boundedBy>";
    begin_surface(building, body, k, element);
    if (!facet.openings.empty()) add_fillings(building, body, body.first_facet + k);
    fmt::format_to(out(), FMT_STRING("</bldg:{}></bldg:boundedBy>\n"), element);
  }

  void add_fillings(const GeneratedBuilding& building, const GeneratedComponent& body, std::size_t wall) {
    for (std::size_t k = 0; k < body.facet_count; ++k) {
      const GeneratedFacet& facet = building.facets[body.first_facet + k];
      if (facet.filling == Filling::none || facet.in_wall != wall) continue;
      const std::string_view element = facet.filling == Filling::door ? "Door" : "Window";
      file_.text() += "\n<bldg:opening>";
      begin_surface(building, body, k, element);
      fmt::format_to(out(), FMT_STRING("</bldg:{}></bldg:opening>"), element);
    }
  }

  /// Writes the element with its polygon, without the end tag.
  void begin_surface(const GeneratedBuilding& building, const GeneratedComponent& body, std::size_t k, std::string_view element) {
    fmt::format_to(out(),
                   FMT_STRING("<bldg:{0} gml:id=\"{1}_s{2}\"><bldg:lod{3}MultiSurface><gml:MultiSurface>"
                              "<gml:surfaceMember><gml:Polygon gml:id=\"{1}_p{2}\">"),
                   element, body.id, k, header_.lod);
    add_rings(building.facets[body.first_facet + k], building.vertices);
    fmt::format_to(out(), FMT_STRING("</gml:Polygon></gml:surfaceMember></gml:MultiSurface></bldg:lod{}MultiSurface>"),
                   header_.lod);
  }

  void add_rings(const GeneratedFacet& facet, const std::vector<PointMm>& vertices) {
    file_.text() += "<gml:exterior>";
    add_ring(facet.outer, vertices);
    file_.text() += "</gml:exterior>";
    if (!facet.hole.empty()) add_interior(facet.hole, vertices);
    for (const std::vector<std::uint32_t>& opening : facet.openings) add_interior(opening, vertices);
  }

  void add_interior(const std::vector<std::uint32_t>& ring, const std::vector<PointMm>& vertices) {
    file_.text() += "<gml:interior>";
    add_ring(ring, vertices);
    file_.text() += "</gml:interior>";
  }

  void add_ring(const std::vector<std::uint32_t>& ring, const std::vector<PointMm>& vertices) {
    file_.text() += "<gml:LinearRing><gml:posList>";
    // A ring of GML repeats its first point at the end
    for (std::size_t k = 0; k <= ring.size(); ++k) add_point(vertices[ring[k % ring.size()]], k == 0 ? "" : " ");
    file_.text() += "</gml:posList></gml:LinearRing>";
  }

  void add_point(const PointMm& p_city, std::string_view separator) {
    std::string& text = file_.text();
    text += separator;
    append_metres(text, header_.centre_easting_mm + p_city.x);
    text += ' ';
    append_metres(text, header_.centre_northing_mm + p_city.y);
    text += ' ';
    append_metres(text, p_city.z);
  }

  /// The text has the same length for all numbers.
  [[nodiscard]] std::string envelope() const {
    const Point3d centre{static_cast<double>(header_.centre_easting_mm), static_cast<double>(header_.centre_northing_mm), 0.0};
    const Box3d box = extent_.empty() ? Box3d{{}, {}} : extent_;
    const Point3d low = 1e-3 * (centre + box.low), high = 1e-3 * (centre + box.high);
    return fmt::format(
        "<gml:boundedBy><gml:Envelope srsName=\"urn:ogc:def:crs:EPSG::{}\" srsDimension=\"3\">"
        "<gml:lowerCorner>{:15.3f} {:15.3f} {:15.3f}</gml:lowerCorner><gml:upperCorner>{:15.3f} {:15.3f} "
        "{:15.3f}</gml:upperCorner>"
        "</gml:Envelope></gml:boundedBy>",
        header_.epsg, low.x, low.y, low.z, high.x, high.y, high.z);
  }

  CityHeader header_;
  CityTextFile file_;
  Box3d extent_;  ///< city frame, in millimetres
  std::uint64_t envelope_at_ = 0;
};

}  // namespace

std::unique_ptr<GeneratedCityWriter> make_citygml_writer(const std::filesystem::path& path, const CityHeader& header) {
  return std::make_unique<CityGmlWriter>(path, header);
}

}  // namespace farlod

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "farlod/box.hpp"
#include "generator/city_text_file.hpp"
#include "generator/city_writer.hpp"

namespace farlod {
namespace {

constexpr std::string_view prologue = R"(<?xml version="1.0" encoding="UTF-8"?>
<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:bldg="http://www.opengis.net/citygml/building/2.0" xmlns:gml="http://www.opengis.net/gml" xmlns:xlink="http://www.w3.org/1999/xlink" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:schemaLocation="http://www.opengis.net/citygml/building/2.0 http://schemas.opengis.net/citygml/building/2.0/building.xsd">
)";

[[nodiscard]] std::string_view surface_element(FacetRole role) {
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

class CityGmlWriter final : public GeneratedCityWriter {
 public:
  CityGmlWriter(const std::filesystem::path& path, const CityHeader& header) : header_(header), file_(path) {}

  void begin() override {
    file_.text() += prologue;
    fmt::format_to(out(), "<gml:name>{}</gml:name>\n", header_.name);
    // What the envelope will be is known at the end, and stands here: blanks keep its place
    envelope_at_ = file_.position();
    file_.text().append(envelope().size(), ' ');
    file_.text() += '\n';
  }

  void add(const GeneratedBuilding& building) override {
    fmt::format_to(out(), FMT_STRING("<core:cityObjectMember><bldg:Building gml:id=\"{}\">\n<bldg:measuredHeight uom=\"m\">"),
                   building.id);
    append_metres(file_.text(), building.top_mm - building.base_mm);
    fmt::format_to(out(), FMT_STRING("</bldg:measuredHeight><bldg:storeysAboveGround>{}</bldg:storeysAboveGround>\n"),
                   building.storeys);
    header_.lod == 1 ? add_lod1(building) : add_lod2(building);
    file_.text() += "</bldg:Building></core:cityObjectMember>\n";
    for (const PointMm& p : building.vertices)
      extent_.add({static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
    file_.drain();
  }

  void end() override {
    file_.text() += "</core:CityModel>\n";
    file_.overwrite(envelope_at_, envelope());
    file_.commit();
  }

 private:
  [[nodiscard]] std::back_insert_iterator<std::string> out() { return std::back_inserter(file_.text()); }

  void add_lod1(const GeneratedBuilding& building) {
    file_.text() += "<bldg:lod1Solid><gml:Solid><gml:exterior><gml:CompositeSurface>\n";
    for (const GeneratedFacet& facet : building.facets) {
      file_.text() += "<gml:surfaceMember><gml:Polygon>";
      add_rings(facet, building.vertices);
      file_.text() += "</gml:Polygon></gml:surfaceMember>\n";
    }
    file_.text() += "</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod1Solid>\n";
  }

  void add_lod2(const GeneratedBuilding& building) {
    // The solid comes first, as the schema asks, and names the polygons of the surfaces below it
    file_.text() += "<bldg:lod2Solid><gml:Solid><gml:exterior><gml:CompositeSurface>\n";
    for (std::size_t k = 0; k < building.facets.size(); ++k)
      fmt::format_to(out(), FMT_STRING("<gml:surfaceMember xlink:href=\"#{}_p{}\"/>\n"), building.id, k);
    file_.text() += "</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod2Solid>\n";
    for (std::size_t k = 0; k < building.facets.size(); ++k) add_surface(building, k);
  }

  void add_surface(const GeneratedBuilding& building, std::size_t k) {
    const std::string_view element = surface_element(building.facets[k].role);
    fmt::format_to(out(),
                   FMT_STRING("<bldg:boundedBy><bldg:{0} gml:id=\"{1}_s{2}\"><bldg:lod2MultiSurface><gml:MultiSurface>"
                              "<gml:surfaceMember><gml:Polygon gml:id=\"{1}_p{2}\">"),
                   element, building.id, k);
    add_rings(building.facets[k], building.vertices);
    fmt::format_to(
        out(),
        FMT_STRING("</gml:Polygon></gml:surfaceMember></gml:MultiSurface></bldg:lod2MultiSurface></bldg:{}></bldg:boundedBy>\n"),
        element);
  }

  void add_rings(const GeneratedFacet& facet, const std::vector<PointMm>& vertices) {
    file_.text() += "<gml:exterior>";
    add_ring(facet.outer, vertices);
    file_.text() += "</gml:exterior>";
    if (facet.hole.empty()) return;
    file_.text() += "<gml:interior>";
    add_ring(facet.hole, vertices);
    file_.text() += "</gml:interior>";
  }

  void add_ring(const std::vector<std::uint32_t>& ring, const std::vector<PointMm>& vertices) {
    file_.text() += "<gml:LinearRing><gml:posList>";
    // A ring of GML ends with its first point again
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

  /// Always of the same length, whatever the numbers.
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

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <iterator>

#include "generator/city_text_file.hpp"
#include "generator/city_writer.hpp"

namespace farlod {
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

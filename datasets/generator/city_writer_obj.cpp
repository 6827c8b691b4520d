// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <iterator>

#include "generator/city_writer.hpp"
#include "generator/convex_faces.hpp"

namespace farlod {
namespace {

class ObjWriter final : public GeneratedCityWriter {
 public:
  ObjWriter(const std::filesystem::path& path, const CityHeader& header) : header_(header), file_(path) {}

  void begin() override {
    const std::int64_t east_mm = header_.centre_easting_mm, north_mm = header_.centre_northing_mm;
    fmt::format_to(out(), "# {}: buildings in metres, z up\n# CRS: EPSG:{}\n", header_.name, header_.epsg);
    if (!header_.obj_from_centre) return;
    fmt::format_to(out(), "# Origin, to be added to x and y: {:.3f},{:.3f}\n", 1e-3 * static_cast<double>(east_mm),
                   1e-3 * static_cast<double>(north_mm));
  }

  void add(const GeneratedBuilding& building) override {
    fmt::format_to(out(), "g {}\n", building.id);
    for (const PointMm& p : building.vertices) add_vertex(p);
    for (const GeneratedFacet& facet : building.facets)
      for (const FaceRing& face : convex_faces(facet, building.vertices)) add_face(face);
    vertices_before_ += building.vertices.size();
    file_.drain();
  }

  std::uint64_t end() override { return file_.commit(); }

 private:
  [[nodiscard]] std::back_insert_iterator<std::string> out() { return std::back_inserter(file_.text()); }

  void add_vertex(const PointMm& p_city) {
    std::string& text = file_.text();
    text += "v ";
    append_metres(text, p_city.x + (header_.obj_from_centre ? 0 : header_.centre_easting_mm));
    text += ' ';
    append_metres(text, p_city.y + (header_.obj_from_centre ? 0 : header_.centre_northing_mm));
    text += ' ';
    append_metres(text, p_city.z);
    text += '\n';
  }

  void add_face(const FaceRing& face) {
    file_.text() += 'f';
    // OBJ numbers the vertices of the whole file from 1
    for (const std::uint32_t k : face) fmt::format_to(out(), FMT_STRING(" {}"), vertices_before_ + k + 1);
    file_.text() += '\n';
  }

  CityHeader header_;
  CityTextFile file_;
  std::uint64_t vertices_before_ = 0;
};

}  // namespace

std::unique_ptr<GeneratedCityWriter> make_obj_writer(const std::filesystem::path& path, const CityHeader& header) {
  return std::make_unique<ObjWriter>(path, header);
}

}  // namespace farlod

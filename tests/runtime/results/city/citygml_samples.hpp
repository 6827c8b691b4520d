// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "farlod/error.hpp"
#include "results/city/enriched_city_file.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {

/// Two roofs of 100 m² and a wall of 80 m² below one of them.
inline constexpr const char *roof_1 = "1000 2000 8 1010 2000 8 1010 2010 8 1000 2010 8 1000 2000 8",
                            *roof_2 = "1010 2000 8 1020 2000 8 1020 2010 8 1010 2010 8 1010 2000 8",
                            *wall = "1000 2000 0 1000 2010 0 1000 2010 8 1000 2000 8 1000 2000 0";

inline constexpr const char* spaces_of_version_2 =
    "xmlns=\"http://www.opengis.net/citygml/2.0\" xmlns:gml=\"http://www.opengis.net/gml\" "
    "xmlns:xlink=\"http://www.w3.org/1999/xlink\" xmlns:bldg=\"http://www.opengis.net/citygml/building/2.0\"";
inline constexpr const char* generics_2 = " xmlns:gen=\"http://www.opengis.net/citygml/generics/2.0\"";

inline std::string model(const std::string& spaces, const std::string& members) {
  return "<?xml version='1.0'?>\n<CityModel " + spaces + ">" + members + "</CityModel>\n";
}
inline std::string member(const std::string& content, const std::string& id = "b") {
  return "<cityObjectMember><bldg:Building gml:id=\"" + id + "\">" + content + "</bldg:Building></cityObjectMember>";
}
inline std::string file_with(const std::string& content) {
  return model(std::string(spaces_of_version_2) + generics_2, member(content));
}

inline std::string polygon(const std::string& corners, const std::string& id = "") {
  return "<gml:surfaceMember><gml:Polygon" + (id.empty() ? "" : " gml:id=\"" + id + "\"") +
         "><gml:exterior><gml:LinearRing><gml:posList>" + corners +
         "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>";
}
inline std::string reference(const std::string& id) { return "<gml:surfaceMember xlink:href=\"#" + id + "\"/>"; }
inline std::string geometry(const std::string& property, const std::string& members) {
  return "<bldg:" + property + "><gml:MultiSurface>" + members + "</gml:MultiSurface></bldg:" + property + ">";
}
inline std::string solid(const std::string& members) {
  return "<bldg:lod2Solid><gml:Solid><gml:exterior><gml:CompositeSurface>" + members +
         "</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod2Solid>";
}
/// The same file in another version of CityGML.
inline std::string in_version(const std::string& version, std::string text) {
  for (std::size_t at = text.find("/2.0\""); at != text.npos; at = text.find("/2.0\"")) text.replace(at + 1, 3, version);
  return text;
}

/// A semantic surface; `values` stand where generic attributes belong.
inline std::string surface(const std::string& name, const std::string& values, const std::string& members,
                           const std::string& property = "lod2MultiSurface") {
  return "<bldg:boundedBy><bldg:" + name + ">" + values + geometry(property, members) + "</bldg:" + name + "></bldg:boundedBy>";
}
inline std::string roofs_and_wall(const std::string& of_roof = "", const std::string& of_wall = "") {
  return surface("RoofSurface", of_roof, polygon(roof_1, "p1") + polygon(roof_2, "p2")) +
         surface("WallSurface", of_wall, polygon(wall, "p3"));
}

/// Names and values as `form` writes them: "@" is the name, "#" the value.
inline std::string attributes(const std::vector<std::pair<std::string, std::string>>& values, const std::string& form) {
  std::string text;
  for (const auto& [name, value] : values) {
    std::string one = form;
    one.replace(one.find('@'), 1, name);
    one.replace(one.find('#'), 1, value);
    text += one;
  }
  return text;
}
inline constexpr const char* form_2 = "<gen:doubleAttribute name=\"@\"><gen:value>#</gen:value></gen:doubleAttribute>";

inline std::string of_building(const std::string& form = form_2) {
  return attributes({{"svf_roofs", "0.650000"},
                     {"svf_walls", "0.250000"},
                     {"roof_area_m2", "175"},
                     {"wall_area_m2", "80"},
                     {"covered_roof_area_m2", "25"},
                     {"covered_wall_area_m2", "0"}},
                    form);
}
inline std::string of_roofs(const std::string& form = form_2) {
  return attributes({{"svf_mean", "0.650000"},
                     {"svf_min", "0.400000"},
                     {"svf_max", "0.950000"},
                     {"svf_area_m2", "175"},
                     {"covered_area_m2", "25"}},
                    form);
}
inline std::string of_wall(const std::string& form = form_2) {
  return attributes({{"svf_mean", "0.250000"},
                     {"svf_min", "0.150000"},
                     {"svf_max", "0.350000"},
                     {"svf_area_m2", "80"},
                     {"covered_area_m2", "0"}},
                    form);
}

inline SurfaceMean mean(std::uint32_t number, SurfaceKind kind, double area_m2, double svf) {
  SurfaceMean mean{"b", number, kind, {}, kind == SurfaceKind::wall ? Angle::degrees(90.0) : Angle{}, area_m2, 0.0, 4, 0};
  mean.svf_mean = svf;
  mean.svf_min = svf - 0.1;
  mean.svf_max = svf + 0.1;
  return mean;
}

/// What a run says of the two roofs and the wall, if they have these numbers; a quarter of the second roof has no answer.
inline SurfaceMeans means_of(std::uint32_t roof, std::uint32_t other_roof, std::uint32_t below) {
  SurfaceMeans means;
  means.surfaces = {mean(roof, SurfaceKind::roof, 100.0, 0.5), mean(other_roof, SurfaceKind::roof, 75.0, 0.85),
                    mean(below, SurfaceKind::wall, 80.0, 0.25)};
  means.surfaces[1].covered_area_m2 = 25.0;
  means.buildings = {{"b", 175.0, 80.0, 25.0, 0.0, 12, 1, 0.65, 0.25}};
  return means;
}

/// Writes a file again with what a run said.
class CityGmlRun : public testing::Test {
 protected:
  std::string enriched(const std::string& text, const SurfaceMeans& means = means_of(0, 1, 2)) {
    std::ofstream(folder.file("a.gml"), std::ios::binary) << text;
    notes = EnrichedCityFile(folder.file("a.gml"), {"svf"}).write(means, EnrichedExtent::whole_buildings, folder.file("b.gml"));
    return scenes::text_of(folder.file("b.gml"));
  }
  void expect_refused(const std::string& text, const std::string& said) {
    try {
      (void)enriched(text);
      ADD_FAILURE() << "not refused: " << said;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(said));
    }
    EXPECT_FALSE(std::filesystem::exists(folder.file("b.gml")));
  }

  scenes::TemporaryFolder folder;
  std::vector<std::string> notes;
};

}  // namespace farlod

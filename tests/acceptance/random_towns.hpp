// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/acceptance/enriched_city_values.hpp"

namespace farlod::acceptance {

// ---- CityGML

inline std::string gml_model(const std::string& members, const std::string& encoding = "UTF-8") {
  return "<?xml version='1.0' encoding='" + encoding +
         "'?>\n<CityModel xmlns='http://www.opengis.net/citygml/2.0' xmlns:gml='http://www.opengis.net/gml' "
         "xmlns:xlink='http://www.w3.org/1999/xlink' xmlns:bldg='http://www.opengis.net/citygml/building/2.0'>\n" +
         members + "</CityModel>\n";
}
inline std::string gml_building(const std::string& id, const std::string& content) {
  return "<cityObjectMember><bldg:Building gml:id=\"" + id + "\">\n" + content + "</bldg:Building></cityObjectMember>\n";
}
inline std::string gml_solid(const std::string& members) {
  return "<gml:Solid><gml:exterior><gml:CompositeSurface>" + members + "</gml:CompositeSurface></gml:exterior></gml:Solid>";
}
inline std::string gml_part(const std::string& content) {
  return "<bldg:consistsOfBuildingPart><bldg:BuildingPart>" + content + "</bldg:BuildingPart></bldg:consistsOfBuildingPart>\n";
}
/// A semantic surface; `head` ends its tag, and holds what stands before its geometry.
inline std::string gml_boundary(const std::string& type, const std::string& head, const std::string& members,
                                const std::string& property = "lod2MultiSurface") {
  return "<bldg:boundedBy><bldg:" + type + head + "<bldg:" + property + "><gml:MultiSurface>" + members +
         "</gml:MultiSurface></bldg:" + property + "></bldg:" + type + "></bldg:boundedBy>\n";
}
inline std::string gml_polygon(const Corners& corners, const std::string& id) {
  std::string list;
  for (std::size_t n = 0; n <= corners.size(); ++n)
    for (const double x : corners[n % corners.size()]) list += number(x) + " ";
  return "<gml:surfaceMember><gml:Polygon gml:id=\"" + id + "\"><gml:exterior><gml:LinearRing><gml:posList>" + list +
         "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>";
}
inline std::string gml_reference(const std::string& id) { return "<gml:surfaceMember xlink:href=\"#" + id + "\"/>"; }

/// A town in CityGML in which anything that changes the numbers of surfaces may happen anywhere.
class CityGmlTown {
 public:
  explicit CityGmlTown(std::uint32_t seed) : draw_(seed) {
    for (int n = 0; n < 12; ++n) text_ += building("b" + std::to_string(n));
    text_ = gml_model(text_);
  }
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] const std::vector<WrittenSurface>& surfaces() const { return surfaces_; }

 private:
  [[nodiscard]] std::string next_id() { return "i" + std::to_string(++ids_); }

  std::string building(const std::string& id) {
    id_ = id;
    std::string content, late;
    if (draw_.one_in(2)) content += "<gml:name>A &amp; B</gml:name>";
    if (draw_.one_in(3)) content += "<bldg:lod1Solid>" + shell({}) + "</bldg:lod1Solid>";
    std::vector<std::string> referred;
    std::string boundaries;
    for (int n = 2 + draw_.below(4); n > 0; --n) boundaries += boundary(referred);
    std::string solid = "<bldg:lod2Solid>" + shell(referred) + "</bldg:lod2Solid>";
    if (draw_.one_in(2)) std::swap(solid, boundaries);
    if (draw_.one_in(2)) late += installation();
    if (draw_.one_in(3)) late += part();
    return gml_building(id, content + solid + boundaries + late);
  }

  /// A semantic surface of one or several polygons, some of them unusable.
  std::string boundary(std::vector<std::string>& referred) {
    WrittenSurface& surface = surfaces_.emplace_back(WrittenSurface{id_, next_id(), {}});
    std::string members;
    const bool is_roof = draw_.one_in(3);  // of a roof, the file says so: one that lies alone might be a floor
    for (int n = draw_.one_in(3) ? 2 : 1; n > 0; --n) {
      if (draw_.one_in(6)) members += unusable();
      const Face face = is_roof ? street_.next_roof() : street_.next_wall();
      const std::string polygon = next_id();
      surface.areas.push_back(face.area_m2);
      members += gml_polygon(face.corners, polygon);
      if (draw_.one_in(2)) referred.push_back(gml_reference(polygon));
      // The same corners in the solid are a copy
      if (draw_.one_in(4)) {
        Corners turned = face.corners;
        std::rotate(turned.begin(), turned.begin() + 1, turned.end());
        referred.push_back(gml_polygon(turned, next_id()));
      }
      last_ = face.corners;
    }
    // The same polygon once more: one surface of the package, and of both semantic surfaces
    std::string again;
    if (draw_.one_in(5)) {
      WrittenSurface& other = surfaces_.emplace_back(WrittenSurface{id_, next_id(), {surface_area_of_last()}});
      again = boundary_text("ClosureSurface", other.name, gml_polygon(last_, next_id()));
    }
    const std::string name = surfaces_[surfaces_.size() - (again.empty() ? 1 : 2)].name;
    std::string other_level;
    if (draw_.one_in(4))
      other_level =
          boundary_text("WallSurface", next_id(), gml_polygon(street_.next_wall().corners, next_id()), "lod1MultiSurface");
    return other_level +
           boundary_text(is_roof           ? "RoofSurface"
                         : draw_.one_in(2) ? "WallSurface"
                                           : "ClosureSurface",
                         name, members) +
           again;
  }
  [[nodiscard]] double surface_area_of_last() const {
    const Corner &a = last_[0], &b = last_[1], &c = last_[2];
    return (b[0] - a[0]) * std::max(c[1] - b[1], c[2] - b[2]);
  }

  static std::string boundary_text(const std::string& type, const std::string& name, const std::string& members,
                                   const std::string& property = "lod2MultiSurface") {
    return gml_boundary(type, " gml:id=\"" + name + "\">", members, property);
  }

  std::string unusable() {
    if (draw_.one_in(3)) return gml_polygon({{1, 2, 3}, {4, 5, 6}}, next_id());
    return "<gml:surfaceMember><gml:Polygon><gml:exterior>" +
           std::string(draw_.one_in(2)
                           ? "<gml:Ring><gml:curveMember/></gml:Ring>"
                           : "<gml:LinearRing><gml:posList>1 two 3 4 5 6 7 8 9 1 two 3</gml:posList></gml:LinearRing>") +
           "</gml:exterior></gml:Polygon></gml:surfaceMember>";
  }

  std::string shell(const std::vector<std::string>& referred) {
    std::string members;
    for (const std::string& member : referred) members += member;
    if (referred.empty() || draw_.one_in(2)) members += gml_polygon(street_.next_wall().corners, next_id());
    return gml_solid(members);
  }

  std::string installation() {
    std::string geometry;
    if (draw_.one_in(2)) {
      const Corner at = street_.next_wall().corners.front();
      geometry = "<bldg:lod2ImplicitRepresentation><ImplicitGeometry><relativeGMLGeometry><gml:MultiSurface gml:id=\"" +
                 next_id() + "\">" + gml_polygon({{0, 0, 0}, {1, 0, 0}, {1, 0, 1}}, next_id()) +
                 "</gml:MultiSurface></relativeGMLGeometry><referencePoint><gml:Point><gml:pos>" + number(at[0]) + " " +
                 number(at[1]) +
                 " 1</gml:pos></gml:Point></referencePoint></ImplicitGeometry>"
                 "</bldg:lod2ImplicitRepresentation>";
    } else {
      geometry = "<bldg:lod2Geometry><gml:MultiSurface>" + gml_polygon(street_.next_wall().corners, next_id()) +
                 "</gml:MultiSurface></bldg:lod2Geometry>";
    }
    return "<bldg:outerBuildingInstallation><bldg:BuildingInstallation>" + geometry +
           "</bldg:BuildingInstallation></bldg:outerBuildingInstallation>\n";
  }

  std::string part() {
    std::vector<std::string> referred;
    return gml_part(boundary(referred));
  }

  Draw draw_;
  Street street_;
  int ids_ = 0;
  std::string id_, text_;
  Corners last_;
  std::vector<WrittenSurface> surfaces_;
};

inline const std::regex gml_attribute(
    "<gen:doubleAttribute xmlns:gen=\"[^\"]+\" name=\"((svf|roof|wall|covered)_\\w+)\"><gen:value>([0-9.]+)</gen:value>"
    "</gen:doubleAttribute>");

inline FoundValues values_in_gml(const std::string& text) {
  FoundValues found;
  const std::regex surface("Surface gml:id=\"(i\\d+)\">((<gen:doubleAttribute.*?</gen:doubleAttribute>)+)");
  for (std::sregex_iterator at(text.begin(), text.end(), surface), end; at != end; ++at) {
    const std::string attributes = (*at)[2];
    for (std::sregex_iterator one(attributes.begin(), attributes.end(), gml_attribute); one != end; ++one)
      found[(*at)[1]][(*one)[1]] = (*one)[3];
  }
  return found;
}

// ---- CityJSON

/// A town in CityJSON, likewise.
class CityJsonTown {
 public:
  explicit CityJsonTown(std::uint32_t seed) : draw_(seed) {
    std::string objects;
    for (int n = 0; n < 12; ++n) objects += (n == 0 ? "" : ",\n") + building("b" + std::to_string(n));
    std::string list;
    for (const Corner& p : vertices_)
      list +=
          (list.empty() ? "[" : ",[") + number(p[0] - 500'000.0) + "," + number(p[1] - 5'500'000.0) + "," + number(p[2]) + "]";
    text_ = "{\"type\":\"CityJSON\",\"version\":\"2.0\", \"CityObjects\":{" + objects + "},\n\"vertices\":[" + list +
            "],\"transform\":{\"scale\":[1,1,1],\"translate\":[500000,5500000,0]},\"geometry-templates\":{\"templates\":["
            "{\"type\":\"MultiSurface\",\"lod\":\"2\",\"boundaries\":[[[0,1,2]]],\"semantics\":{\"surfaces\":"
            "[{\"type\":\"WallSurface\",\"mark\":\"template\"}],\"values\":[0]}}],\"vertices-templates\":[[0,0,0],[1,0,0],[1,0,1]"
            "]}}\n";
  }
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] const std::vector<WrittenSurface>& surfaces() const { return surfaces_; }

 private:
  std::string building(const std::string& id) {
    id_ = id;
    seen_.clear();
    std::string geometries = geometry("2"), children;
    if (draw_.one_in(3)) geometries = geometry("1.2", false) + "," + geometries;
    for (int n = draw_.below(3); n > 0; --n) geometries += ", " + geometry("2");
    std::string other;
    if (draw_.one_in(3)) {
      other =
          ",\"" + id + "_part\" : {\"type\":\"BuildingPart\",\"parents\":[\"" + id + "\"],\"geometry\":[" + geometry("2") + "]}";
      if (draw_.one_in(2)) children = ",\"children\":[\"" + id + "_part\"]";
    }
    if (draw_.one_in(3)) other += installation(id);
    const std::string attributes = draw_.one_in(3)   ? ", \"attributes\": {} "
                                   : draw_.one_in(2) ? ",\"attributes\":{\"h\": 7.50 }"
                                                     : "";
    return "\"" + id + "\": {\"type\":\"Building\"" + children + ",\"geometry\": [" + geometries + "]" + attributes + "}" + other;
  }

  std::string installation(const std::string& id) {
    const std::size_t anchor = vertex(street_.next_wall().corners.front());
    return ",\"" + id + "_i\":{\"type\":\"BuildingInstallation\",\"parents\":[\"" + id +
           "\"],\"geometry\":[{\"type\":\"GeometryInstance\",\"template\":0,\"boundaries\":[" + std::to_string(anchor) +
           "],\"transformationMatrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}]}";
  }

  std::size_t vertex(const Corner& p) {
    vertices_.push_back(p);
    return vertices_.size() - 1;
  }
  std::string ring_of(const Corners& corners) {
    std::string rows;
    for (const Corner& p : corners) rows += (rows.empty() ? "" : ",") + std::to_string(vertex(p));
    return "[[" + rows + "]]";
  }

  std::string geometry(const std::string& lod, bool is_packed = true) {
    std::string boundaries, values, semantics;
    const int surface_count = 1 + draw_.below(3);
    const std::size_t first = surfaces_.size();
    for (int n = 0; n < surface_count; ++n) {
      WrittenSurface& surface = surfaces_.emplace_back(WrittenSurface{id_, "m" + std::to_string(++marks_), {}});
      const std::string kind = draw_.one_in(2) ? "\"type\" : \"ClosureSurface\"," : "\"type\":\"+Other\" , ";
      semantics += (n == 0 ? "{" : ", { ") + kind + "\"mark\":\"" + surface.name + "\" }";
    }
    const auto add = [&](const std::string& rings, const std::string& value) {
      boundaries += (boundaries.empty() ? "" : ",") + rings;
      values += (values.empty() ? "" : ",") + value;
    };
    std::vector<Face> fresh;
    for (int n = 3 + draw_.below(4); n > 0; --n) {
      const int row = draw_.below(surface_count);
      if (draw_.one_in(7)) add("[[0,0,1]]", std::to_string(row));         // unusable: not three points
      if (draw_.one_in(9)) add("[[0,1,99999999]]", std::to_string(row));  // no such vertex
      const bool is_again = is_packed && !seen_.empty() && draw_.one_in(4);
      const Face face =
          is_again ? seen_[static_cast<std::size_t>(draw_.below(static_cast<int>(seen_.size())))] : street_.next_wall();
      std::string rings = ring_of(face.corners);
      if (draw_.one_in(6)) {
        add(rings, "null");
      } else {
        add(rings, std::to_string(row));
        std::vector<double>& areas = surfaces_[first + static_cast<std::size_t>(row)].areas;
        if (is_packed && std::find(areas.begin(), areas.end(), face.area_m2) == areas.end()) areas.push_back(face.area_m2);
      }
      if (!is_again) fresh.push_back(face);
    }
    if (is_packed) seen_.insert(seen_.end(), fresh.begin(), fresh.end());
    return "{\"type\":\"MultiSurface\",\"lod\":\"" + lod + "\",\"semantics\":{\"values\":[" + values + "],\"surfaces\":[" +
           semantics + "]},\"boundaries\":[" + boundaries + "]}";
  }

  Draw draw_;
  Street street_;
  int marks_ = 0;
  std::string id_, text_;
  std::vector<Corner> vertices_;
  std::vector<Face> seen_;
  std::vector<WrittenSurface> surfaces_;
};

inline void collect_marks(const json& value, FoundValues& found) {
  if (value.is_object() && value.contains("mark") && value.contains("svf_area_m2"))
    for (const auto& [name, number] : value.items())
      if (number.is_number()) found[value.at("mark").get<std::string>()][name] = number.dump();
  if (value.is_structured())
    for (const json& inner : value) collect_marks(inner, found);
}

/// A text without the attributes that farlod-svf adds.
inline std::string without_values(const std::string& text) {
  const std::string names = "\"(svf[A-Za-z]*_(roofs|walls|mean|min|max|area_m2)|(covered_)?(roof_|wall_)?area_m2)\":[0-9.]+";
  const std::regex object(",\"attributes\":\\{" + names + "(," + names + ")*\\}"), member("," + names),
      first("\\{" + names + "(," + names + ")*");
  return std::regex_replace(std::regex_replace(std::regex_replace(text, object, ""), first, "{"), member, "");
}

}  // namespace farlod::acceptance

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/citygml_parser.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

#include "ingest/surface_names.hpp"

namespace farlod {
namespace {

constexpr std::string_view citygml = "http://www.opengis.net/citygml/";

bool is_gml(std::string_view space) { return space.starts_with("http://www.opengis.net/gml"); }

/// Whether elements of a namespace can lead to surfaces of a building. The core has a version where modules have a name.
bool may_hold_surfaces(std::string_view space) {
  if (is_gml(space)) return true;
  if (!space.starts_with(citygml)) return false;
  const std::string_view module = space.substr(citygml.size());
  return module.starts_with("building/") || module.starts_with("bridge/") || module.starts_with("construction/") ||
         module.starts_with("texturedsurface/") || (!module.empty() && module.front() >= '0' && module.front() <= '9');
}

bool is_construction(std::string_view space) {
  return space.starts_with(citygml) && (space.find("/building/") != space.npos || space.find("/bridge/") != space.npos);
}

/// Properties that hold rooms, furniture, addresses, or other buildings.
constexpr std::array<std::string_view, 13> inner_properties{"interiorRoom",
                                                            "interiorBuildingInstallation",
                                                            "interiorBridgeRoom",
                                                            "interiorBridgeInstallation",
                                                            "buildingRoom",
                                                            "buildingSubdivision",
                                                            "bridgeRoom",
                                                            "roomInstallation",
                                                            "generalizesTo",
                                                            "address",
                                                            "IntBuildingInstallation",
                                                            "IntBridgeInstallation",
                                                            "appearance"};

constexpr std::array<std::string_view, 6> installation_names{"BuildingInstallation",      "BridgeInstallation",
                                                             "BridgeConstructionElement", "BuildingConstructiveElement",
                                                             "BridgeConstructiveElement", "OtherConstruction"};

template <std::size_t n>
bool is_one_of(std::string_view name, const std::array<std::string_view, n>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_surface_name(std::string_view name) { return name.ends_with("Surface"); }

bool is_lod_property(std::string_view name) {
  return name.size() > 4 && name.starts_with("lod") && name[3] >= '0' && name[3] <= '9';
}

}  // namespace

void CityGmlParser::start(const XmlElement& element) {
  if (root_.empty()) root_ = element.name;
  if (srs_name_.empty() && !element.srs_name.empty()) srs_name_ = element.srs_name;
  if (passed_over_ > 0 || is_passed_over(element)) {
    ++passed_over_;
    return;
  }
  if (in_surfaces_) {
    const GmlSurfaceReader::Answer answer = reader_.start(element);
    if (answer == GmlSurfaceReader::Answer::unsupported) building_.unread.emplace_back("a gml:").append(element.name);
    if (answer == GmlSurfaceReader::Answer::entered)
      open_.push_back(Meaning::geometry);
    else
      ++passed_over_;
  } else if (!in_building_) {
    open_.push_back(meaning_outside(element));
  } else if (is_lod_property(element.name)) {
    if (start_surfaces(element))
      open_.push_back(Meaning::surfaces);
    else
      ++passed_over_;
  } else {
    open_.push_back(meaning_inside(element));
  }
}

bool CityGmlParser::is_passed_over(const XmlElement& element) const {
  if (!in_building_) return false;
  return !may_hold_surfaces(element.space) || is_one_of(element.name, inner_properties) || is_interior_surface_name(element.name);
}

CityGmlParser::Meaning CityGmlParser::meaning_outside(const XmlElement& element) {
  // A part that stands alone is as good as a building
  const bool is_root =
      element.name == "Building" || element.name == "Bridge" || element.name == "BuildingPart" || element.name == "BridgePart";
  if (!is_root || !is_construction(element.space)) return Meaning::nothing;
  begin_building(element);
  return Meaning::building;
}

CityGmlParser::Meaning CityGmlParser::meaning_inside(const XmlElement& element) {
  const std::string_view name = element.name;
  if (is_gml(element.space)) return Meaning::nothing;
  if (name == "BuildingPart" || name == "BridgePart") {
    begin_part();
    return Meaning::part;
  }
  if (is_one_of(name, installation_names)) {
    ++installations_;
    kinds_.push_back(SurfaceKind::unknown);
    return Meaning::installation;
  }
  if (is_surface_name(name)) {
    ++boundaries_;
    kinds_.push_back(kind_of_surface_name(name));
    return Meaning::boundary;
  }
  if (name == "measuredHeight" || (name == "value" && element.space.find("/construction/") != name.npos)) {
    height_text_.clear();
    in_height_ = true;
    return Meaning::height;
  }
  return Meaning::nothing;
}

bool CityGmlParser::start_surfaces(const XmlElement& element) {
  const int lod = element.name[3] - '0';
  const std::string_view what = element.name.substr(4);
  if (lod > 3) return false;
  SurfaceUse use{lod, parts_.back(), SurfaceRole::shell, kinds_.back()};
  if (what == "ImplicitRepresentation") building_.unread.emplace_back("a geometry by ").append(element.name);
  if (what == "FootPrint")
    use.role = SurfaceRole::footprint;
  else if (what == "RoofEdge")
    use.role = SurfaceRole::roof_edge;
  else if (what != "Solid" && what != "MultiSurface" && what != "Geometry")
    return false;
  else if (lod == 0)
    return false;
  else if (installations_ > 0)
    use.role = SurfaceRole::installation;
  else if (boundaries_ > 0)
    use.role = SurfaceRole::boundary;
  reader_.begin_use(static_cast<std::uint32_t>(building_.uses.size()));
  building_.uses.push_back(use);
  if (!element.href.empty()) reader_.add_reference(element.href);
  in_surfaces_ = true;
  return true;
}

void CityGmlParser::begin_building(const XmlElement& element) {
  ++buildings_;
  building_.id = element.id.empty() ? "building " + std::to_string(buildings_) : std::string(element.id);
  parts_ = {0};
  kinds_ = {SurfaceKind::unknown};
  in_building_ = true;
}

void CityGmlParser::begin_part() {
  FARLOD_EXPECTS(!building_.measured_height_m.empty());
  // More than 65,535 parts: the last number serves for the rest, as parts only matter to the question "inside?"
  const std::size_t number = std::min<std::size_t>(building_.measured_height_m.size(), std::numeric_limits<std::uint16_t>::max());
  building_.measured_height_m.resize(number + 1);
  parts_.push_back(static_cast<std::uint16_t>(number));
  kinds_.push_back(SurfaceKind::unknown);
}

void CityGmlParser::end(std::string_view name) {
  if (passed_over_ > 0) {
    --passed_over_;
    return;
  }
  FARLOD_EXPECTS(!open_.empty());
  const Meaning meaning = open_.back();
  open_.pop_back();
  undo(meaning, name);
}

void CityGmlParser::undo(Meaning meaning, std::string_view name) {
  // Each of these put a kind on the stack when it began
  if (meaning == Meaning::part || meaning == Meaning::boundary || meaning == Meaning::installation) kinds_.pop_back();
  switch (meaning) {
    case Meaning::nothing:
      break;
    case Meaning::building:
      end_building();
      break;
    case Meaning::part:
      parts_.pop_back();
      break;
    case Meaning::boundary:
      --boundaries_;
      break;
    case Meaning::installation:
      --installations_;
      break;
    case Meaning::surfaces:
      in_surfaces_ = false;
      break;
    case Meaning::geometry:
      reader_.end(name);
      break;
    case Meaning::height:
      take_height();
      break;
  }
}

void CityGmlParser::end_building() {
  take_(building_);
  building_.uses.clear();
  building_.unread.clear();
  building_.surfaces = {};
  building_.measured_height_m = {std::nullopt};
  in_building_ = false;
}

void CityGmlParser::take_height() {
  in_height_ = false;
  const std::size_t begin = std::min(height_text_.find_first_not_of(" \t\r\n+"), height_text_.size());
  double height_m = 0.0;
  const auto [end, error] = std::from_chars(height_text_.data() + begin, height_text_.data() + height_text_.size(), height_m);
  if (error == std::errc() && end != height_text_.data()) building_.measured_height_m[parts_.back()] = height_m;
}

void CityGmlParser::text(std::string_view piece) {
  if (passed_over_ > 0) return;
  if (in_surfaces_)
    reader_.text(piece);
  else if (in_height_)
    height_text_.append(piece);
}

void GmlSurfaceFinder::start(const XmlElement& element) {
  const bool is_wanted = !element.id.empty() && hrefs_.contains(std::string(1, '#').append(element.id));
  if (passed_over_ > 0) {
    ++passed_over_;
  } else if (wanted_depth_ > 0 || is_wanted) {
    if (reader_.start(element) == GmlSurfaceReader::Answer::entered)
      ++wanted_depth_;
    else
      ++passed_over_;
  }
}

void GmlSurfaceFinder::end(std::string_view name) {
  if (passed_over_ > 0) {
    --passed_over_;
  } else if (wanted_depth_ > 0) {
    reader_.end(name);
    --wanted_depth_;
  }
}

void GmlSurfaceFinder::text(std::string_view piece) {
  if (wanted_depth_ > 0 && passed_over_ == 0) reader_.text(piece);
}

}  // namespace farlod

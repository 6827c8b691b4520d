// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/citygml/citygml_reading.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

#include "base/expects.hpp"
#include "farlod/error.hpp"

namespace farlod::ingest {
namespace {

/// Reliefs that are not read: rasters, break lines, and point clouds in other files.
bool is_unread_relief(std::string_view name) {
  return name == "RasterRelief" || name == "BreaklineRelief" || name == "PointCloud";
}

bool is_read_relief(std::string_view name) { return name == "ReliefFeature" || name == "TINRelief" || name == "MassPointRelief"; }

}  // namespace

void CityGmlParser::start(const XmlElement& element) {
  if (root_.empty()) root_ = element.name;
  if (srs_name_.empty() && !element.srs_name.empty()) srs_name_ = element.srs_name;
  places_.start(element);
  if (skipped_depth_ > 0) {
    ++skipped_depth_;
  } else if (const MaybeMeaning meaning = meaning_of(element)) {
    open_.push_back(*meaning);
  } else {
    skipped_depth_ = 1;
  }
}

CityGmlParser::MaybeMeaning CityGmlParser::meaning_of(const XmlElement& element) {
  if (in_surfaces_) return meaning_in_surfaces(element);
  if (in_building_) return meaning_inside(element);
  return in_relief_ ? meaning_in_relief(element) : meaning_outside(element);
}

CityGmlParser::MaybeMeaning CityGmlParser::meaning_outside(const XmlElement& element) {
  const Vocabulary vocabulary = vocabulary_of(element.space);
  if (vocabulary == Vocabulary::constructions && is_construction_name(element.name)) {
    begin_building(element);
    return Meaning::building;
  }
  if (vocabulary == Vocabulary::relief && ReliefReader::is_point_property(element.name)) {
    relief_.begin(element);
    in_relief_ = true;
    return Meaning::terrain;
  }
  const bool is_object = !open_.empty() && open_.back() == Meaning::members;
  const bool is_read = vocabulary == Vocabulary::relief && is_read_relief(element.name);
  const bool is_unread = vocabulary != Vocabulary::foreign && is_unread_relief(element.name);
  if (is_unread || (is_object && !is_read)) skipped_.add(element);
  return is_member_name(element.name) ? Meaning::members : Meaning::nothing;
}

CityGmlParser::MaybeMeaning CityGmlParser::meaning_in_relief(const XmlElement& element) {
  return relief_.start(element) ? MaybeMeaning(Meaning::terrain) : std::nullopt;
}

CityGmlParser::MaybeMeaning CityGmlParser::meaning_in_surfaces(const XmlElement& element) {
  const Vocabulary vocabulary = vocabulary_of(element.space);
  if (vocabulary == Vocabulary::foreign) skipped_.add(element);
  if (!may_hold_surfaces(vocabulary)) return std::nullopt;
  const GmlSurfaceReader::Answer answer = reader_.start(element);
  if (answer == GmlSurfaceReader::Answer::unsupported) building_.add_unread(std::string("a gml:").append(element.name));
  return answer == GmlSurfaceReader::Answer::entered ? MaybeMeaning(Meaning::geometry) : std::nullopt;
}

CityGmlParser::MaybeMeaning CityGmlParser::meaning_inside(const XmlElement& element) {
  const Vocabulary vocabulary = vocabulary_of(element.space);
  if (vocabulary == Vocabulary::foreign) skipped_.add(element);
  if (!may_hold_surfaces(vocabulary) || is_inner_name(element.name)) return std::nullopt;
  if (in_prototype_) return meaning_in_prototype(element);
  if (is_lod_property(element.name)) return meaning_of_lod_property(element);
  return vocabulary == Vocabulary::gml ? Meaning::nothing : meaning_of_thing(element, vocabulary);
}

CityGmlParser::MaybeMeaning CityGmlParser::meaning_of_thing(const XmlElement& element, Vocabulary vocabulary) {
  const std::string_view name = element.name;
  if (is_part_name(name)) {
    begin_part(element);
    return Meaning::part;
  }
  if (is_element_name(name) || is_installation_name(name) || name == "OtherConstruction") {
    begin_installation(element, is_element_name(name) ? SurfaceRole::element : SurfaceRole::installation);
    return Meaning::installation;
  }
  if (is_boundary_name(name)) {
    ++boundaries_;
    kinds_.push_back(kind_of_surface_name(name));
    open_semantics(element);
    return Meaning::boundary;
  }
  if (name == "Window" || name == "Door") {
    open_semantics(element);
    return Meaning::opening;
  }
  if (name == "measuredHeight" || (name == "value" && vocabulary == Vocabulary::constructions))
    return begin_words(Meaning::height);
  if (name == "relationToConstruction" && !installations_.empty()) return begin_words(Meaning::relation);
  return Meaning::nothing;
}

CityGmlParser::Meaning CityGmlParser::begin_words(Meaning meaning) {
  words_.clear();
  in_words_ = true;
  return meaning;
}

CityGmlParser::MaybeMeaning CityGmlParser::meaning_of_lod_property(const XmlElement& element) {
  const int lod = element.name[3] - '0';
  const std::string_view what = element.name.substr(4);
  if (lod > 3) return std::nullopt;
  if (what == "ImplicitRepresentation") {
    SurfaceUse use = use_here(lod, role_here());
    use.placement = building_.placements.size();
    prototype_.begin(element.name, use);
    in_prototype_ = true;
    return Meaning::prototype;
  }
  const std::optional<SurfaceRole> role = role_of_lod_property(lod, what);
  if (!role) return std::nullopt;
  begin_surfaces(use_here(lod, *role), element);
  return Meaning::surfaces;
}

SurfaceUse CityGmlParser::use_here(int lod, SurfaceRole role) const {
  return {lod, parts_.back(), role, kinds_.back(), {}, origins_.back()};
}

SurfaceRole CityGmlParser::role_here() const {
  if (!installations_.empty()) return installations_.back().role;
  return boundaries_ > 0 ? SurfaceRole::boundary : SurfaceRole::shell;
}

std::optional<SurfaceRole> CityGmlParser::role_of_lod_property(int lod, std::string_view what) const {
  if (what == "FootPrint") return SurfaceRole::footprint;
  if (what == "RoofEdge") return SurfaceRole::roof_edge;
  if (what != "Solid" && what != "MultiSurface" && what != "Geometry") return std::nullopt;
  if (lod > 0) return role_here();
  // In CityGML 3.0, the kind of the surface tells footprints from roof edges
  if (what != "MultiSurface" || !installations_.empty()) return std::nullopt;
  if (boundaries_ == 0 || kinds_.back() == SurfaceKind::floor) return SurfaceRole::footprint;
  return kinds_.back() == SurfaceKind::roof ? std::optional(SurfaceRole::roof_edge) : std::nullopt;
}

void CityGmlParser::begin_surfaces(const SurfaceUse& use, const XmlElement& element) {
  reader_.begin_use(static_cast<std::uint32_t>(building_.uses.size()));
  building_.uses.push_back(use);
  if (!element.href.empty()) reader_.add_reference(element.href);
  in_surfaces_ = true;
}

CityGmlParser::MaybeMeaning CityGmlParser::meaning_in_prototype(const XmlElement& element) {
  if (open_.back() == Meaning::prototype_number) return std::nullopt;
  if (prototype_.start(element.name)) return Meaning::prototype_number;
  if (element.name == "libraryObject") prototype_.note_library_object();
  if (element.name != "relativeGMLGeometry" && element.name != "relativeGeometry") return Meaning::nothing;
  prototype_.note_surfaces();
  begin_surfaces(prototype_.use(), element);
  return Meaning::surfaces;
}

void CityGmlParser::begin_building(const XmlElement& element) {
  ++buildings_;
  has_unnamed_buildings_ |= element.id.empty();
  building_.id = element.id.empty() ? "building " + std::to_string(buildings_) : std::string(element.id);
  parts_ = {0};
  kinds_ = {SurfaceKind::unknown};
  open_object(element);
  in_building_ = true;
}

void CityGmlParser::open_object(const XmlElement& element) {
  origins_.push_back({static_cast<std::uint32_t>(building_.places.objects.size()), {}});
  building_.places.objects.emplace_back();
  places_.open(element);
}

void CityGmlParser::open_semantics(const XmlElement& element) {
  origins_.push_back({origins_.back().object, static_cast<std::uint32_t>(building_.places.semantics.size())});
  building_.places.semantics.emplace_back();
  building_.semantic_ids.emplace_back(element.id);
  places_.open(element);
}

void CityGmlParser::close_place() {
  const PolygonOrigin& of = origins_.back();
  (of.semantics ? building_.places.semantics[*of.semantics] : building_.places.objects[of.object]) = places_.close();
  origins_.pop_back();
}

void CityGmlParser::begin_part(const XmlElement& element) {
  FARLOD_EXPECTS(!building_.measured_height_m.empty());
  // All parts beyond 65,535 share the last number. They count as one volume
  const std::size_t number = std::min<std::size_t>(building_.measured_height_m.size(), std::numeric_limits<std::uint16_t>::max());
  building_.measured_height_m.resize(number + 1);
  parts_.push_back(static_cast<std::uint16_t>(number));
  kinds_.push_back(SurfaceKind::unknown);
  open_object(element);
}

void CityGmlParser::begin_installation(const XmlElement& element, SurfaceRole role) {
  open_object(element);
  installations_.push_back({role, building_.uses.size()});
  kinds_.push_back(SurfaceKind::unknown);
}

void CityGmlParser::end(std::string_view name, std::uint64_t end) {
  if (skipped_depth_ > 0) {
    --skipped_depth_;
  } else {
    FARLOD_EXPECTS(!open_.empty());
    const Meaning meaning = open_.back();
    open_.pop_back();
    undo(meaning, name);
  }
  places_.end(end);
}

void CityGmlParser::undo(Meaning meaning, std::string_view name) {
  // The beginning of each of these pushed a kind
  if (meaning == Meaning::part || meaning == Meaning::boundary || meaning == Meaning::installation) kinds_.pop_back();
  switch (meaning) {
    case Meaning::nothing:
    case Meaning::members:
      break;
    case Meaning::building:
      return end_building();
    case Meaning::part:
      parts_.pop_back();
      return close_place();
    case Meaning::boundary:
      --boundaries_;
      return close_place();
    case Meaning::opening:
      return close_place();
    case Meaning::installation:
      return end_installation();
    case Meaning::surfaces:
      in_surfaces_ = false;
      break;
    case Meaning::geometry:
      return reader_.end(name);
    case Meaning::height:
      return take_height();
    case Meaning::relation:
      in_words_ = false;
      installations_.back().is_inside = words_ == "inside";
      break;
    case Meaning::prototype:
      return end_prototype();
    case Meaning::prototype_number:
      return prototype_.end_numbers();
    case Meaning::terrain:
      relief_.end();
      in_relief_ = !open_.empty() && open_.back() == Meaning::terrain;
      break;
  }
}

void CityGmlParser::end_building() {
  close_place();
  take_(building_);
  building_.places = {};
  building_.semantic_ids.clear();
  building_.uses.clear();
  building_.unread.clear();
  building_.placements.clear();
  building_.surfaces = {};
  building_.measured_height_m = {std::nullopt};
  in_building_ = false;
}

void CityGmlParser::end_installation() {
  // CityGML 3.0 says only after the geometry whether an installation is inside
  if (installations_.back().is_inside)
    for (std::size_t k = installations_.back().first_use; k < building_.uses.size(); ++k)
      building_.uses[k].role = SurfaceRole::inside;
  installations_.pop_back();
  close_place();
}

void CityGmlParser::end_prototype() {
  in_prototype_ = false;
  const bool has_crs = has_crs_ || !srs_name_.empty();
  has_placed_without_crs_ |= !has_crs;
  std::string unread;
  building_.placements.push_back(prototype_.placement(has_crs, unread));
  if (!building_.placements.back()) building_.add_unread(std::move(unread));
}

void CityGmlParser::take_height() {
  in_words_ = false;
  const std::size_t begin = std::min(words_.find_first_not_of(" \t\r\n+"), words_.size());
  double height_m = 0.0;
  const auto [end, error] = std::from_chars(words_.data() + begin, words_.data() + words_.size(), height_m);
  if (error == std::errc() && end != words_.data()) building_.measured_height_m[parts_.back()] = height_m;
}

bool CityGmlParser::append(const CityGmlParser& next) {
  const bool is_as_one = !next.has_unnamed_buildings_ && (!next.has_placed_without_crs_ || srs_name_.empty());
  if (root_.empty()) root_ = next.root_;
  if (srs_name_.empty()) srs_name_ = next.srs_name_;
  relief_.append(next.relief_);
  return skipped_.append(next.skipped_) && places_.append(next.places_) && is_as_one;
}

void CityGmlParser::text(std::string_view piece) {
  if (skipped_depth_ > 0) return;
  if (in_surfaces_)
    reader_.text(piece);
  else if (in_relief_)
    relief_.text(piece);
  else if (in_words_)
    words_.append(piece.substr(0, most_words - std::min(most_words, words_.size())));
  else if (!open_.empty() && open_.back() == Meaning::prototype_number)
    prototype_.text(piece);
}

namespace {

std::string list(const SkippedFeatures& skipped) {
  constexpr std::size_t most_listed = 5;
  std::string text;
  std::size_t listed = 0;
  for (const auto& [name, count] : skipped) {
    if (listed++ == most_listed) return text + ", ...";
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + name;
  }
  return text;
}

}  // namespace

CityGmlReading::CityGmlReading(const ReadingTask& task, const ReferenceBudget& budget, RepeatedIds repeated_ids, bool has_crs,
                               std::vector<package::AttributeForm> forms)
    : task_(task),
      has_places_(has_byte_places(task.file)),
      budget_(budget),
      builder_(task.file.name, report_, repeated_ids),
      parser_([this](const CityGmlBuilding& building) { take(building); }, has_crs, std::move(forms)) {}

void CityGmlReading::take(const CityGmlBuilding& building) {
  for (std::string& href : foreign_references(building)) foreign_hrefs_.insert(std::move(href));
  add_building(building, task_.foreign, task_.lod, budget_, builder_, has_places_ ? &building.places : nullptr);
}

void CityGmlReading::append(CityGmlReading&& next) {
  if (!parser_.append(next.parser_) || !budget_.append(next.budget_)) throw CannotBeCut();
  builder_.append(std::move(next.builder_));
  foreign_hrefs_.merge(next.foreign_hrefs_);
}

CityGmlContents CityGmlReading::finish() {
  ReliefReader& relief = parser_.relief();
  if (builder_.buildings_met() == 0 && relief.points().empty()) throw_nothing_there();
  report_unreadable_relief(relief.unreadable_points());
  std::optional<PlacedFile> placed;
  if (has_places_) placed = {task_.file.on_disk, package::CityFileFormat::citygml, parser_.forms()};
  return {{.source = task_.file.name,
           .crs = {parser_.srs_name()},
           .city = builder_.take_city(),
           .relief_points = std::move(relief.points()),
           .skipped = parser_.skipped(),
           .placed = std::move(placed)},
          std::move(report_),
          std::move(foreign_hrefs_)};
}

void CityGmlReading::throw_nothing_there() const {
  if (parser_.root() != "CityModel")
    throw InputError(task_.file.name + " is XML, but not CityGML: it begins with <" + parser_.root() + ">.");
  throw InputError(task_.file.name + " holds no Building, Bridge, Tunnel, OtherConstruction or relief" +
                   (parser_.skipped().empty() ? "." : ", but " + list(parser_.skipped()) + ".") +
                   " Is it another theme of the city model?");
}

void CityGmlReading::report_unreadable_relief(std::size_t points) {
  if (points > 0)
    builder_.add_problem_at(
        "relief", ProblemCode::unreadable_coordinate,
        "points of the terrain that miss a coordinate, or have one that is not a number or beyond the Earth: " +
            std::to_string(points));
}

}  // namespace farlod::ingest
